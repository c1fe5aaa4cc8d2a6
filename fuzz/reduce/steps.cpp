// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/steps.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fuzz {

std::vector<Step> steps_of(const Document& document, Stage stage) {
    constexpr std::array kAdd = {
        add_draw_steps,   add_triangle_steps, add_topology_steps, add_feature_steps,
        add_input_steps,  add_key_steps,      add_source_steps,   add_space_steps,
        add_target_steps, add_position_steps, add_value_steps,
    };
    static_assert(kAdd.size() == kStages.size());
    std::vector<Step> steps;
    kAdd.at(static_cast<size_t>(stage))(document, steps);
    for (Step& step : steps) {
        step.stage = stage;
    }
    return steps;
}

size_t draw_count(const Document& document) {
    const Document* draws = document.find("draw");
    return draws == nullptr ? 0 : draws->array.size();
}

Document* draw_at(Document& document, size_t draw) {
    Document* draws = find(document, "draw");
    return draws == nullptr || draw >= draws->array.size() ? nullptr : &draws->array[draw];
}

void name_in_draw(const Document& document, size_t draw, const std::string& what, Step& step) {
    const bool is_alone = draw_count(document) == 1;
    step.words = is_alone ? what : fmt::format("draw {} {}", draw, what);
    step.need = is_alone ? "not " + what : fmt::format("not {} in draw {}", what, draw);
}

Step& add_in_draw(const Document& document, size_t draw, const std::string& what,
                  std::function<bool(Document&)> apply, std::vector<Step>& steps) {
    Step& step = steps.emplace_back();
    name_in_draw(document, draw, what, step);
    step.draw = draw;
    step.apply = std::move(apply);
    return step;
}

std::vector<Range> parts_of(size_t count) {
    std::vector<Range> parts;
    for (size_t size = count; size > 1;) {
        size = (size + 1) / 2;
        for (size_t begin = 0; begin < count; begin += size) {
            parts.push_back({begin, std::min(begin + size, count)});
        }
    }
    return parts;
}

}  // namespace fuzz
