// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/shown.hpp"

#include <algorithm>

#include "cases/base/float_bits.hpp"
#include "cases/format/color_format.hpp"
#include "ref/color/logic.hpp"
#include "ref/expectation/stored_depths.hpp"

namespace ref {

using Triangles = std::vector<uint32_t>;

Shown::Shown(const cases::Case& c, const Expectation& expectation)
    : case_(c),
      expectation_(expectation),
      colors_(c, expectation),
      values_(c, expectation.limits, expectation.profile) {}

float Shown::depth_of(uint32_t t, cases::SampleId id) {
    for (const ExpectedValue& value : values_.expected(t, id)) {
        if (value.quantity.is_depth()) {
            return static_cast<float>(value.nearest);
        }
    }
    return std::nanf("");
}

bool Shown::tells_depth(size_t index, cases::SampleId id, std::span<const uint32_t> triangles,
                        Shown& of) {
    // Whose depth is stored is plain only where every fragment stores its own.
    const bool is_plain = std::all_of(case_.draws.begin(), case_.draws.end(),
                                      [](const auto& d) { return d.depth == cases::DepthState{}; });
    const float clear = case_.target.depth_clear;
    return is_plain && case_.target.has_depth &&
           !explains_depth(index, id,
                           triangles.empty() ? clear : of.depth_of(triangles.back(), id));
}

bool Shown::explains_depth(size_t index, cases::SampleId id, float depth) {
    return StoredDepths(expectation_, values_)
        .allows(expectation_.samples[index], id, depth,
                cases::same_bits(depth, case_.target.depth_clear));
}

bool Shown::tells(size_t index, cases::SampleId id, std::span<const uint32_t> theirs,
                  Shown& other) {
    return !colors_.explains(index, id, other.colors_.codes_after(theirs, id)) ||
           tells_depth(index, id, theirs, other);
}

bool Shown::shows(size_t index, cases::SampleId id, uint32_t t) {
    Triangles changed = drawn(index);
    const auto at = std::ranges::lower_bound(changed, t);
    if (at != changed.end() && *at == t) {
        changed.erase(at);
    } else {
        changed.insert(at, t);
    }
    return tells(index, id, changed, *this);
}

bool Shown::shows_twice(size_t index, cases::SampleId id, uint32_t t) {
    Triangles changed = drawn(index);
    changed.insert(std::ranges::lower_bound(changed, t), t);
    return tells(index, id, changed, *this);
}

bool Shown::leaves_a_mark(cases::SampleId id, uint32_t t) {
    return colors_.codes_after({&t, 1}, id) != colors_.codes_after({}, id);
}

bool Shown::shows_order(size_t index, cases::SampleId id) {
    Triangles changed = drawn(index);
    std::ranges::reverse(changed);
    return changed.size() > 1 && tells(index, id, changed, *this);
}

bool Shown::shows_passed_logic(size_t index, cases::SampleId id) {
    const Triangles all = drawn(index);
    const cases::ColorFormat format = case_.target.color->format;
    if (all.empty() || color::takes_logic(format)) {
        return false;
    }
    const cases::ColorOutput& output = case_.draws[expectation_.triangles[all.back()].draw].color;
    const auto after = colors_.codes_after(all, id);
    const auto before = colors_.codes_after(std::span(all).first(all.size() - 1), id);
    for (uint32_t k = 0; output.logic && k < after.size(); ++k) {
        const uint32_t bits = cases::component_of(format, k).bits;
        if (bits > 0 && (output.write_mask >> k & 1U) != 0 &&
            color::operated(*output.logic, after.at(k), before.at(k), bits) != after.at(k)) {
            return true;
        }
    }
    return false;
}

bool is_shown(const cases::Case& c, const cases::Draw& draw, const QuantityId& id) {
    return c.target.has_instruments || (id.is_depth() && c.target.has_depth) ||
           (id.is_attribute() && c.target.color && draw.color.attribute == id.attribute);
}

}  // namespace ref
