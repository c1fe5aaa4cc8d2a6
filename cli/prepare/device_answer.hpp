// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The first worker's answer: a device, or sentences that say what is missing and what to do.
#pragma once

#include <vector>

#include "cli/options/options.hpp"
#include "cli/prepare/suite.hpp"
#include "run/run_loop.hpp"

namespace cli {

struct ReadyWorker {
    run::WorkerClient client;
    capture::DeviceInfo device;
};
// Starts the first worker, which then gets its device ready while the parent does something else.
run::WorkerClient start_first_worker(const run::LoopConfig& config);
// Waits until it is ready. One that dies before is started again after a pause, as later ones are,
// but three deaths alike, or two time-outs, say that the driver is broken. Errors: no or wrong
// device (5), interrupted (130).
ReadyWorker await_first_worker(run::WorkerClient client, const run::LoopConfig& config,
                               run::SignalFd& signals);

// The first lines of what a worker printed, each for itself.
std::vector<std::string> printed_lines(const std::string& output);
// What a failed start looks like to the user; `output` is what the worker printed.
Stop explain_failure(const capture::Failure& failure, const std::string& output);
Stop explain_death(const run::Death& death);

}  // namespace cli
