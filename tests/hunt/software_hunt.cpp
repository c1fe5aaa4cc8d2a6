// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <mutex>

#include "cases/base/parallel.hpp"
#include "cases/fault/fault.hpp"
#include "fuzz/cause.hpp"
#include "fuzz/entry.hpp"
#include "hunt/hunt.hpp"
#include "hunt/sequence.hpp"
#include "rasterizers/strength/strength.hpp"
#include "run/judge.hpp"

namespace hunt {

namespace {

constexpr size_t kPosesOfChunk = 8;

// What a hunt says of a case that a device has drawn.
report::CaseRecord judged(const cases::Case& c, const software::Device& device) {
    report::CaseRecord record = run::planned_case(c);
    const capture::Capture drawn = software::captured(c, device);
    run::judge(record, c, capture::CaptureView(drawn), {}, {}, cases::Profile::direct3d,
               run::KeepPictures::none);
    return record;
}

}  // namespace

std::vector<std::string> software_faults() {
    std::vector<std::string> names;
    for (const cases::FaultRow& info : cases::kFaults) {
        names.emplace_back(info.name);
    }
    return names;
}

void hunt_software(const Plan& plan, const OnFind& tell) {
    std::map<cases::Fault, Find> finds;
    for (const cases::FaultRow& info : cases::kFaults) {
        if (std::find(plan.faults.begin(), plan.faults.end(), info.name) != plan.faults.end()) {
            finds[info.fault].fault = info.name;
        }
    }
    std::mutex mutex;
    const auto is_open = [&](const Find& find, uint64_t number) {
        return !find.number || number < *find.number;
    };
    Sequence sequence(plan.seed, plan.first, plan.cases);
    while (sequence.next_case() < plan.cases) {
        const std::vector<Numbered> chunk = sequence.next(kPosesOfChunk);
        cases::for_each_index(chunk.size(), [&](size_t k) {
            const uint64_t number = chunk[k].number;
            const cases::Case& data = chunk[k].data;
            std::vector<cases::Fault> open;
            {
                const std::lock_guard lock(mutex);
                for (const auto& [fault, find] : finds) {
                    if (is_open(find, number)) {
                        open.push_back(fault);
                    }
                }
            }
            const auto alarm =
                software::try_faults(data, open, [&](cases::Fault fault, const auto&) {
                    software::Device device;
                    device.fault = fault;
                    const report::CaseRecord record = judged(data, device);
                    const auto symptom = fuzz::symptom_of(record);
                    const std::lock_guard lock(mutex);
                    if (Find& find = finds.at(fault); symptom && is_open(find, number)) {
                        find.number = number;
                        find.symptom = fuzz::to_text(*symptom);
                    }
                });
            if (alarm && alarm->error.empty()) {
                const diff::Finding& first = alarm->findings.front();
                fmt::print(stderr,
                           "false alarm: case {} of seed {} fails without a fault: {} [{}] at "
                           "({}, {}), {}: expected {}, got {}\n",
                           number, plan.seed, first.rule, cases::to_string(first.level), first.x,
                           first.y, first.quantity, first.expected, first.got);
            }
        });
        for (auto find = finds.begin(); find != finds.end();) {
            if (find->second.number) {
                tell(find->second);
                find = finds.erase(find);
            } else {
                ++find;
            }
        }
        if (finds.empty()) {
            return;
        }
    }
    for (const auto& [fault, find] : finds) {
        tell(find);
    }
}

}  // namespace hunt
