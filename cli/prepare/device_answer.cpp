// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/device_answer.hpp"

#include <poll.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "cases/base/limits.hpp"
#include "cases/base/printable.hpp"
#include "cli/renderers/renderers.hpp"

namespace cli {

std::vector<std::string> printed_lines(const std::string& output) {
    constexpr size_t kMostLines = 20;
    std::vector<std::string> out;
    std::istringstream lines(cases::printable(output));
    for (std::string line; out.size() < kMostLines && std::getline(lines, line);) {
        out.push_back(std::move(line));
    }
    return out;
}

Stop explain_failure(const capture::Failure& failure, const std::string& output) {
    Stop stop{report::kExitDevice, {cases::printable(failure.message)}};
    if (!failure.code.empty()) {
        stop.lines.push_back("  " + failure.code + " at stage '" +
                             std::string(capture::to_string(failure.stage)) + "'");
    }
    for (const std::string& reason : failure.reasons) {
        stop.lines.push_back("  " + cases::printable(reason));
    }
    for (const std::string& line : printed_lines(output)) {
        stop.lines.push_back("  printed: " + line);
    }
    if (const std::string limits = cases::tight_limits(); !limits.empty()) {
        stop.lines.push_back("  " + limits);
    }
    if (failure.stage <= capture::Stage::device) {
        stop.lines.emplace_back("  'edgecase doctor' says what is installed and what is missing");
    }
    return stop;
}

Stop explain_death(const run::Death& death) {
    Stop stop{report::kExitDevice,
              {"no device: " + describe(death) + "; the driver or its environment is broken"}};
    for (const std::string& line : printed_lines(death.output)) {
        stop.lines.push_back("  " + line);
    }
    stop.lines.emplace_back("  choose another driver with --icd, or see 'edgecase doctor'");
    return stop;
}

run::WorkerClient start_first_worker(const run::LoopConfig& config) {
    const capture::RendererOptions& device = config.worker.device;
    if (std::string wrong = device.icd.empty() ? "" : find_drivers(device).problem;
        !wrong.empty()) {
        throw stop_with(report::kExitDevice, wrong);
    }
    cases::Expected<run::WorkerClient> client =
        run::WorkerClient::start(config.command, config.worker, config.timeout);
    if (!client) {
        throw stop_with(report::kExitInternal, client.error().message);
    }
    return std::move(*client);
}

namespace {

// False if a signal came before that time.
bool sleep_until(run::Clock::time_point time, run::SignalFd& signals) {
    while (!signals.has_come() && run::Clock::now() < time) {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(time - run::Clock::now()).count();
        pollfd fd{signals.fd(), POLLIN, 0};
        ::poll(&fd, 1, static_cast<int>(std::max<int64_t>(left, 0)));
    }
    return !signals.has_come();
}

const Stop kInterrupted{report::kExitInterrupted, {"interrupted before any case was run"}};

}  // namespace

ReadyWorker await_first_worker(run::WorkerClient client, const run::LoopConfig& config,
                               run::SignalFd& signals) {
    constexpr size_t kMostAlike = 3, kMostTimeouts = 2;  // each of which takes the time limit
    std::optional<run::WorkerClient> worker(std::move(client));
    run::StartPauses pauses;
    std::string last;
    for (size_t alike = 1;;) {
        const std::optional<run::WorkerEvent> answer = run::wait_for_answer(*worker, signals);
        if (!answer) {
            throw kInterrupted;
        }
        if (const auto* device = std::get_if<capture::DeviceInfo>(&*answer); device != nullptr) {
            return ReadyWorker{std::move(*worker), *device};
        }
        if (const auto* failure = std::get_if<capture::Failure>(&*answer); failure != nullptr) {
            throw explain_failure(*failure, worker->output_since_batch());
        }
        const auto& death = std::get<run::Death>(*answer);
        const std::string how = describe(death);
        alike = how == last ? alike + 1 : 1;
        last = how;
        pauses.failed();
        if (alike >= (death.timed_out ? kMostTimeouts : kMostAlike) || pauses.is_over()) {
            throw explain_death(death);
        }
        complain(how + "; it is started again");
        worker.reset();
        if (!sleep_until(pauses.next(), signals)) {
            throw kInterrupted;
        }
        worker.emplace(start_first_worker(config));
    }
}

}  // namespace cli
