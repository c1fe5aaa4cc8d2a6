// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a run's options mean for the loop that draws and judges.
#pragma once

#include "cli/options/options.hpp"
#include "cli/options/program.hpp"
#include "cli/prepare/device_answer.hpp"
#include "run/run_loop.hpp"

namespace cli {

run::LoopConfig loop_config(const Program& program, const RunOptions& options);

// One line for each wrong limit, for commands whose reports have no place for it.
void warn_of_limits(const capture::DeviceInfo& device);
// The device that a run has asked, for commands that ask none.
JudgedDevice judged_device(const capture::DeviceInfo& device);
// The limits of a device that is not asked.
ref::Limits limits_of(const JudgedDevice& device);
// Starts the first worker and waits until it is ready; the limits are then its device's. Errors: no
// or wrong device (5), interrupted (130).
ReadyWorker ready_first_worker(run::LoopConfig& config, run::SignalFd& signals);

// "llvmpipe (LLVM 15.0.6, 256 bits)" -> "llvmpipe-llvm-15.0.6-256-bits", for a folder's name.
std::string file_name_of(const std::string& device);

}  // namespace cli
