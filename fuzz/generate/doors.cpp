// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/generate/doors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "cases/load/loader.hpp"
#include "cases/model/door.hpp"

namespace fuzz {

namespace {

template <class Predicate>
bool any_draw(const cases::Case& c, Predicate holds) {
    return std::ranges::any_of(c.draws, holds);
}

bool is_restarted(const cases::Case& c) {
    return any_draw(c, [](const cases::Draw& draw) { return draw.primitive_restart; });
}

bool has_bare_strip(const cases::Case& c) {
    return any_draw(c, [](const cases::Draw& draw) {
        return draw.topology != cases::Topology::triangle_list && !draw.indices;
    });
}

// State that a pipeline may hold, and that few draws have.
bool has_rare_state(const cases::Case& c) {
    return any_draw(c, [](const cases::Draw& draw) {
        return draw.rasterizer_discard || draw.depth.bias || draw.cull != cases::CullMode::none ||
               draw.front_face != cases::FrontFace::counter_clockwise;
    });
}

bool has_rare_output(const cases::Case& c) {
    return any_draw(c, [](const cases::Draw& draw) {
        return draw.color.alpha_to_coverage || draw.color.alpha_to_one;
    });
}

bool is_any(const cases::Case&) {
    return true;
}

// What shows what a door may get wrong, and what is seldom drawn together with it by chance.
struct Suited {
    cases::Door door;
    bool (*suits)(const cases::Case&);
};
constexpr std::array<Suited, 14> kSuited = {{
    {cases::Door::index_8, is_restarted},
    {cases::Door::index_8_largest, is_restarted},
    {cases::Door::index_16, is_restarted},
    {cases::Door::index_16_largest, is_restarted},
    {cases::Door::restart_extra, is_restarted},
    {cases::Door::state_unused, has_bare_strip},
    {cases::Door::clear_draw, has_bare_strip},
    {cases::Door::state_static, has_rare_state},
    {cases::Door::state_output, has_rare_output},
    {cases::Door::instance_rate, is_any},  // these take few cases
    {cases::Door::instance_divisor, is_any},
    {cases::Door::instance_divisor_zero, is_any},
    {cases::Door::exact_formats, is_any},
    {cases::Door::target_last_tile, is_any},
}};

}  // namespace

std::string through_doors(std::string text, Dice dice) {
    const auto c = cases::load_text(text, "fuzz", "fuzz");
    if (!c || c->size() != 1) {
        return text;
    }
    const cases::Case& test = c->front();
    std::vector<std::string> words;
    const auto add = [&](const cases::DoorRow& row) {
        const std::string word = fmt::format("\"{}\"", row.word);
        if (cases::can_take(row.door, test) && std::ranges::find(words, word) == words.end()) {
            words.push_back(word);
        }
    };
    // A door that came after the measurement of hunts (tests/hunt) is asked at the end, so that
    // other cases keep their doors.
    constexpr std::array kLater = {cases::Door::state_rasterization, cases::Door::multiview_all,
                                   cases::Door::geometry_strip};
    for (uint64_t k = 0; k < 2; ++k) {
        const std::span<const cases::DoorRow> rows = cases::all_doors();
        uint64_t number = dice.below(rows.size() - kLater.size());
        for (const cases::Door door : kLater) {  // in the order of the rows
            const auto later = static_cast<uint64_t>(&cases::row_of(door) - rows.data());
            number += number >= later ? 1 : 0;
        }
        add(rows[number]);
    }
    std::vector<cases::Door> suited;
    for (const auto& [door, suits] : kSuited) {
        if (cases::can_take(door, test) && suits(test)) {
            suited.push_back(door);
        }
    }
    if (!suited.empty() && dice.one_in(2)) {
        add(cases::row_of(suited[dice.below(suited.size())]));
    }
    for (const cases::Door door : kLater) {
        if (dice.one_in(8)) {
            add(cases::row_of(door));
        }
    }
    if (!words.empty()) {
        text.insert(text.find("\n[target]"),
                    fmt::format("relations = [{{ doors = [{}] }}]\n", fmt::join(words, ", ")));
    }
    return text;
}

}  // namespace fuzz
