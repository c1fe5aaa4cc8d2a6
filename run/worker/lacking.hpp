// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a device lacks for each case, asked of a worker that draws nothing.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "cases/base/error.hpp"
#include "cases/model/case.hpp"
#include "run/process/process.hpp"
#include "run/process/signal_fd.hpp"
#include "run/worker/message.hpp"

namespace run {

// Why the device that the options choose cannot draw each of the cases, one sentence each; empty
// where it can. What a run finds out only by drawing (doors that it lacks) is not among them. An
// error: the worker does not answer.
cases::Expected<std::vector<std::string>> ask_what_is_lacking(
    const Command& command, WorkerOptions options, std::chrono::milliseconds timeout,
    const std::vector<const cases::Case*>& asked, SignalFd& signals);

// What share of the asked cases a device can draw.
struct SuiteShare {
    size_t cases = 0, drawn = 0;
    std::vector<std::pair<std::string, size_t>> lacking;  // reasons and their cases, most first
};
SuiteShare share_of(const std::vector<std::string>& reasons);

}  // namespace run
