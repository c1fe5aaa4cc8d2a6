// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What an experiment works with: something that draws cases, what the device promises, and the
// datasheet that is filled.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/renderer.hpp"
#include "cases/model/case.hpp"
#include "probe/base/datasheet.hpp"
#include "ref/position/limits.hpp"

namespace probe {

using capture::Draw;
using capture::Drawn;

// What a device says of itself that the experiments have to know.
struct Promises {
    ref::Limits limits;
    uint32_t max_target_size = 4096;
    bool has_primitive_id = false;
};

struct Bench {
    Draw draw;
    Promises promises;
    Datasheet& sheet;

    // Draws one case.
    Drawn draw_one(cases::Case c) const {
        std::vector<cases::Case> cases;
        cases.push_back(std::move(c));
        std::vector<Drawn> drawn = draw(std::move(cases));
        return drawn.empty() ? Drawn{{}, "nothing was drawn"} : std::move(drawn.front());
    }
    // Draws the one case that a property is found by; if that cannot be drawn, the property says
    // why.
    std::optional<capture::Capture> picture_of(cases::Case c, Property& property) const {
        Drawn drawn = draw_one(std::move(c));
        if (!drawn.picture) {
            property.why = drawn.why_not;
        }
        return std::move(drawn.picture);
    }
};

// A property that is being looked for: as it is at the end, it goes to the datasheet.
struct Finding : Property {
    Finding(const Bench& bench, std::string its_id, std::string its_question, std::string how)
        : sheet(bench.sheet) {
        id = std::move(its_id);
        question = std::move(its_question);
        experiment = std::move(how);
    }
    Finding(const Finding&) = delete;
    Finding& operator=(const Finding&) = delete;
    using Property::operator=;
    ~Finding() { sheet.properties.push_back(std::move(static_cast<Property&>(*this))); }

    Datasheet& sheet;
};

}  // namespace probe
