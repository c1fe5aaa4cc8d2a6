// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The hidden command "worker": the only process of a run that loads a driver. It reads frames from
// kRequestFd and answers on kResultFd until the parent closes the request pipe.
#pragma once

#include "capture/renderer.hpp"

namespace run {

int run_worker(capture::RendererKinds renderers);

}  // namespace run
