// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Limits of the system that a process met, as sentences that name them.
#pragma once

#include <exception>
#include <string>

namespace cases {

// Why a process or a thread could not be started: "Resource temporarily unavailable; the limit of
// processes (ulimit -u) is 64, and a container may have a lower one (pids.max)".
std::string process_limit(int error);
// Why a descriptor could not be had: "Too many open files; the limit (ulimit -n) is 8".
std::string descriptor_limit(int error);
// Limits of this process under which a driver may not work, one sentence that names them; empty if
// there are none.
std::string tight_limits();
// Throws if a file could not be opened for want of a descriptor: that is no fault of the file's.
void throw_if_limit(int error);
// Whether it tells of memory, threads or descriptors that ran out.
bool is_limit(const std::exception& error);
// What an exception says, of a limit with its name and number.
std::string reason_of(const std::exception& error);

}  // namespace cases
