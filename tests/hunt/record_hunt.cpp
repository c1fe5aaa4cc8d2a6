// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
//     record_hunt layer|software|poses [--seed N] [--first N] [--cases N] [--jobs N] [FAULT...]
//     record_hunt poses [--seed N] [--first N] [--cases N]
//
// Prints a line for each fault: its name, the number of the first case that shows it ("-": none),
// what is wrong with that case, and how often the layer altered anything. "poses" prints a line for
// each pose: how many of its cases are judged, fail, have nothing to judge, are not supported by
// lavapipe, or could not be drawn, and the seconds of processor time.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "hunt/hunt.hpp"

int main(int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty() || (words[0] != "layer" && words[0] != "software" && words[0] != "poses")) {
        std::fputs(
            "usage: record_hunt layer|software|poses [--seed N] [--first N] [--cases N] [--jobs N] "
            "[FAULT...]\n",
            stderr);
        return 2;
    }
    const bool is_layer = words[0] == "layer";
    hunt::Plan plan;
    for (size_t k = 1; k < words.size(); ++k) {
        const auto number = [&] {
            return ++k < words.size() ? std::strtoull(words[k].c_str(), nullptr, 10) : 0ULL;
        };
        if (words[k] == "--seed") {
            plan.seed = number();
        } else if (words[k] == "--first") {
            plan.first = number();
        } else if (words[k] == "--cases") {
            plan.cases = number();
        } else if (words[k] == "--jobs") {
            plan.jobs = std::max(1U, static_cast<unsigned>(number()));
        } else {
            plan.faults.push_back(words[k]);
        }
    }
    if (words[0] == "poses") {
        hunt::count_cases(plan, [](const hunt::PoseCounts& c) {
            fmt::print("{}\t{}\t{}\t{}\t{}\t{:.2f}\t{}\n", c.judged, c.failed, c.empty,
                       c.unsupported, c.wrong, c.seconds, c.pose);
            std::fflush(stdout);
        });
        return 0;
    }
    const std::vector<std::string> all = is_layer ? hunt::layer_faults() : hunt::software_faults();
    for (const std::string& fault : plan.faults) {
        if (std::find(all.begin(), all.end(), fault) == all.end()) {
            fmt::print(stderr, "record_hunt: error: there is no fault '{}'\n", fault);
            return 2;
        }
    }
    if (plan.faults.empty()) {
        plan.faults = all;
    }
    const auto tell = [](const hunt::Find& find) {
        fmt::print("{}\t{}\t{}\t{}\n", find.fault, find.number ? std::to_string(*find.number) : "-",
                   find.symptom, find.alterations);
        std::fflush(stdout);
    };
    (is_layer ? hunt::hunt_layer : hunt::hunt_software)(plan, tell);
    return 0;
}
