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
#include "probe/base/vote.hpp"
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
    void add(Property property) const { sheet.properties.push_back(std::move(property)); }
    // The answer is the vote's.
    void add(Property property, const Vote& vote) const {
        vote.settle(property);
        add(std::move(property));
    }
    // Says of a property that the device could not draw what it needs.
    void add_unknown(Property property, const std::string& why) const {
        property.why = why;
        add(std::move(property));
    }
    // Draws the one case that a property is found by. If that cannot be drawn, the property is
    // added, and nothing is returned.
    std::optional<capture::Capture> picture_of(cases::Case c, Property& property) const {
        Drawn drawn = draw_one(std::move(c));
        if (!drawn.picture) {
            add_unknown(std::move(property), drawn.why_not);
        }
        return std::move(drawn.picture);
    }
};

}  // namespace probe
