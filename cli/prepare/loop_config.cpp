// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/loop_config.hpp"

#include <fmt/format.h>

#include <chrono>

#include "cases/model/device.hpp"
#include "run/worker/derived.hpp"

namespace cli {

run::LoopConfig loop_config(const Program& program, const RunOptions& options) {
    run::LoopConfig config;
    config.command = worker_command(program);
    config.worker.device = options.device;
    config.timeout = std::chrono::milliseconds(static_cast<int64_t>(options.device.timeout * 1000));
    // A worker that has lost its parent ends by itself, though later than one that has not.
    config.worker.device.longest_wait_ms = static_cast<uint64_t>(config.timeout.count()) * 2;
    if (options.gpu_budget > 0) {
        config.gpu_budget = std::chrono::milliseconds(options.gpu_budget);
    }
    config.schedule.lanes = options.jobs;
    config.schedule.batch = options.batch;
    config.schedule.repeat = options.repeat;
    config.schedule.retries = options.retries;
    config.schedule.suspects_first = options.fail_fast;
    config.requires_support = options.require_support;
    config.judging.profile = options.profile;
    config.judging.pictures = options.capture;
    return config;
}

JudgedDevice judged_device(const capture::DeviceInfo& device) {
    return {cases::judged_subpixel_bits(device.subpixel_bits), device.sample_locations,
            device.depth_beside_stencil};
}

ref::Limits limits_of(const JudgedDevice& device) {
    return ref::limits_of(device.subpixel_bits, device.sample_locations,
                          device.depth_beside_stencil);
}

void warn_of_limits(const capture::DeviceInfo& device) {
    for (const capture::WrongLimit& limit : device.wrong_limits) {
        complain(fmt::format("warning: the device's {} is {}, and Vulkan requires {} {}",
                             limit.name, limit.claimed, limit.required, limit.of));
    }
}

ReadyWorker ready_first_worker(run::LoopConfig& config, run::SignalFd& signals) {
    ReadyWorker first = await_first_worker(start_first_worker(config), config, signals);
    config.judging.limits = run::limits_of(first.device);
    warn_of_limits(first.device);
    return first;
}

std::string file_name_of(const std::string& device) {
    std::string name;
    for (const char c : device) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || c == '.';
        const bool upper = c >= 'A' && c <= 'Z';
        if (plain || upper) {
            name += upper ? static_cast<char>(c - 'A' + 'a') : c;
        } else if (!name.empty() && name.back() != '-') {
            name += '-';
        }
    }
    while (!name.empty() && name.back() == '-') {
        name.pop_back();
    }
    return name.substr(0, 48);
}

}  // namespace cli
