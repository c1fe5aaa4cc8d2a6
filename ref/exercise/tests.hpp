// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The tests of the table: whether a rule decides what a sample may show. `rule` is that of the row.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "cases/format/color_format.hpp"
#include "cases/model/case.hpp"
#include "ref/exercise/view.hpp"

namespace ref {

using ExerciseTest = bool (*)(const View& view, std::string_view rule);

// Whether something must be drawn there: where nothing need be, a device may leave it out.
inline bool is_surely_hit(const View& view) {
    return view.sample.bounds.total_min > 0;
}
// Some triangle must have written last; any that may have is one for which the test holds, and the
// attachments show some.
template <class Test>
bool is_written_by(const View& view, const Test& test) {
    return is_surely_hit(view) && std::ranges::all_of(view.sample.writers, test) &&
           std::ranges::any_of(view.sample.writers, [&](uint32_t t) { return view.shows(t); });
}
template <class Test>
bool is_written_by_draw(const View& view, const Test& test) {
    return is_written_by(view, [&](uint32_t t) { return test(view.facts.draw_of(t)); });
}

// With instruments, which tell the provoking vertex of what was written last.
template <cases::ProvokingVertex convention>
bool is_provoked_by(const View& view, std::string_view) {
    return view.of().target.has_instruments &&
           is_written_by_draw(view,
                              [](const cases::Draw& draw) { return draw.provoking == convention; });
}

template <cases::ComponentKind... kinds>
bool is_stored_as(const View& view, std::string_view) {
    const std::optional<cases::ColorTarget>& color = view.of().target.color;
    return color && ((cases::row_of(color->format).kind == kinds) || ...) &&
           is_written_by(view, [](uint32_t) { return true; });
}

template <auto... modes>
bool is_resolved(const View& view, std::string_view) {
    const cases::Target& target = view.of().target;
    return ((target.color_resolve == modes || target.depth_resolve == modes ||
             target.stencil_resolve == modes) ||
            ...) &&
           is_written_by(view, [](uint32_t) { return true; });
}

template <cases::RelationKind kind>
bool is_repeated(const View& view, std::string_view) {
    return is_surely_hit(view) &&
           std::ranges::any_of(view.of().relations,
                               [](const cases::Relation& r) { return r.kind == kind; });
}

inline bool goes_through_door(const View& view, std::string_view rule) {
    return is_surely_hit(view) &&
           std::ranges::any_of(view.of().relations, [rule](const cases::Relation& r) {
               return r.kind == cases::RelationKind::door && cases::row_of(r.door).rule == rule;
           });
}

}  // namespace ref
