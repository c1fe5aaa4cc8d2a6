// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// With which of the fuzzer's cases a planted fault shows first. Time is counted in cases: their
// number is the same on every machine, however busy it is.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hunt {

struct Plan {
    uint64_t seed = 1;
    uint64_t first = 0;      // numbers below are not drawn
    uint64_t cases = 32768;  // numbers from here on are not drawn
    unsigned jobs = 2;
    std::vector<std::string> faults;
};

// The first case that fails with the fault as it does not without it.
struct Find {
    std::string fault;
    std::optional<uint64_t> number;  // nothing: none of the plan's cases
    std::string symptom;             // "missing of cover.inside [vulkan]"
    uint64_t alterations = 0;        // of the layer: how often the fault was reached at all
};
using OnFind = std::function<void(const Find&)>;

// Hunts the faults of the breaking layer on lavapipe, and those of the software device. Each fault
// is told once.
void hunt_layer(const Plan& plan, const OnFind& tell);
void hunt_software(const Plan& plan, const OnFind& tell);

// What becomes of a pose's cases on lavapipe; for whoever works on the generator.
struct PoseCounts {
    std::string pose;
    uint64_t judged = 0, failed = 0, empty = 0, unsupported = 0, wrong = 0;
    double seconds = 0;  // of processor time
};
void count_cases(const Plan& plan, const std::function<void(const PoseCounts&)>& tell);

// Names of all of them; of the layer those that leave the device alive.
std::vector<std::string> layer_faults();
std::vector<std::string> software_faults();

}  // namespace hunt
