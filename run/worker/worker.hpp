// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The hidden command "worker": the only process that loads a driver. It reads frames from
// kRequestFd and answers on kResultFd until the parent closes the request pipe.
#pragma once

namespace cli {

inline constexpr int kRequestFd = 3;
inline constexpr int kResultFd = 4;
inline constexpr int kSharedFd = 5;  // memory for captures, may be closed

int run_worker();

}  // namespace cli
