// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fault_table.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace breaking {

namespace {

struct Choice {
    const Fault* fault = nullptr;
    uint64_t parameter = 1;
};

Choice choose() {
    static constexpr Fault kNone{"", "Nothing is altered.", {}};
    const char* text = std::getenv("EDGECASE_BREAK");
    const std::string_view wanted = text != nullptr ? text : "";
    if (wanted.empty()) {
        return {&kNone, 1};
    }
    const size_t colon = wanted.find(':');
    const std::string_view name = wanted.substr(0, colon);
    Choice choice;
    for (const Fault* fault : all_faults()) {
        choice.fault = fault->name == name ? fault : choice.fault;
    }
    if (choice.fault == nullptr) {
        std::fprintf(stderr,
                     "breaking layer: error: EDGECASE_BREAK names no fault of the layer: '%s'; "
                     "tests/breaking_layer/catches.json and unseen.json list them\n",
                     text);
        return {};
    }
    if (colon != std::string_view::npos) {
        const std::string_view digits = wanted.substr(colon + 1);
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), choice.parameter);
        if (error != std::errc() || end != digits.data() + digits.size() || choice.parameter == 0) {
            std::fprintf(stderr,
                         "breaking layer: error: the parameter in EDGECASE_BREAK is no number from "
                         "1 up: '%s'\n",
                         text);
            return {};
        }
    }
    return choice;
}

const Choice& choice() {
    static const Choice kChoice = choose();
    return kChoice;
}

}  // namespace

const Fault* chosen_fault() {
    return choice().fault;
}

uint64_t parameter() {
    return choice().parameter;
}

std::vector<const Fault*> all_faults() {
    std::vector<const Fault*> out;
    for (const auto table :
         {viewport_faults(), draw_faults(), assembly_faults(), shader_faults(),
          multisample_faults(), depth_faults(), color_faults(), target_faults(), query_faults(),
          transfer_faults(), device_faults(), door_faults(), recording_door_faults(),
          target_door_faults(), clear_faults(), bare_faults()}) {
        for (const Fault& fault : table) {
            out.push_back(&fault);
        }
    }
    return out;
}

void count_alteration() {
    static const int kFile = [] {
        const char* path = std::getenv("EDGECASE_BREAK_COUNT");
        return path == nullptr ? -1 : ::open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    }();
    if (kFile >= 0 && ::write(kFile, "+", 1) != 1) {
        std::fprintf(stderr, "breaking layer: error: an alteration could not be counted\n");
        std::abort();
    }
}

}  // namespace breaking

// The table for scripts: "name\tsentence\trow\n" of each fault; "-" for a row of the layer's own.
extern "C" __attribute__((visibility("default"))) const char* edgecase_breaking_faults() {
    static const std::string kText = [] {
        std::string text;
        for (const breaking::Fault* fault : breaking::all_faults()) {
            const cases::Fault row = fault->says.row;
            text.append(fault->name).append("\t").append(fault->says.sentence).append("\t");
            text.append(row == cases::kNoFault ? "-" : cases::to_string(row)).append("\n");
        }
        return text;
    }();
    return kText.c_str();
}
