// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/shown.hpp"

#include <algorithm>

#include "cases/base/float_bits.hpp"
#include "cases/format/color_format.hpp"
#include "ref/color/logic.hpp"
#include "ref/depth/compare.hpp"
#include "ref/expectation/stored_depths.hpp"
#include "ref/stencil/operation.hpp"

namespace ref {

using Triangles = std::vector<uint32_t>;

Shown::Shown(const cases::Case& c, const Expectation& expectation)
    : case_(c), expectation_(expectation), values_(c, expectation.limits, expectation.profile) {
    if (c.target.color) {
        colors_.emplace(c, expectation);
    }
    if (c.target.has_stencil) {
        setups_.emplace(c, expectation.triangles, expectation.limits, expectation.profile);
    }
}

Triangles Shown::drawn(size_t index) const {
    const SampleExpectation& expected = expectation_.samples[index];
    return colors_            ? colors_->drawn(index)
           : expected.is_open ? Triangles()
                              : shown_at(expectation_, expected);
}

float Shown::depth_of(uint32_t t, cases::SampleId id) {
    for (const ExpectedValue& value : values_.expected(t, id)) {
        if (value.quantity.is_depth()) {
            return static_cast<float>(value.nearest);
        }
    }
    return std::nanf("");
}

float Shown::depth_after(std::span<const uint32_t> triangles, cases::SampleId id) {
    float stored = case_.target.depth_clear;
    for (const uint32_t t : triangles) {
        const cases::DepthState& state = case_.draws[expectation_.triangles[t].draw].depth;
        const float depth = depth_of(t, id);
        const int sign = depth < stored ? -1 : depth > stored ? 1 : 0;
        if (state.write && value::compare_sign(state.compare, sign) == DepthOutcome::passes) {
            stored = depth;
        }
    }
    return stored;
}

uint32_t Shown::stencil_after(std::span<const uint32_t> triangles) {
    uint32_t stored = case_.target.stencil_clear;
    for (const uint32_t t : triangles) {
        const cases::StencilState& state = case_.draws[expectation_.triangles[t].draw].stencil;
        const cases::StencilFace& face = (*setups_)[t].can_be_front ? state.front : state.back;
        const bool passes = stencil::passes(face, stored);
        stored = stencil::updated(passes ? face.pass : face.fail, face, stored);
    }
    return stored;
}

bool Shown::tells_depth(size_t index, cases::SampleId id, std::span<const uint32_t> triangles,
                        Shown& of) {
    return case_.target.has_depth && !explains_depth(index, id, of.depth_after(triangles, id));
}

bool Shown::explains_depth(size_t index, cases::SampleId id, float depth) {
    return StoredDepths(expectation_, values_)
        .allows(expectation_.samples[index], id, depth,
                cases::same_bits(depth, case_.target.depth_clear));
}

bool Shown::tells(size_t index, cases::SampleId id, std::span<const uint32_t> theirs,
                  Shown& other) {
    const bool tells_color =
        colors_ && !colors_->explains(index, id, other.colors_->codes_after(theirs, id));
    return tells_color || tells_depth(index, id, theirs, other) ||
           (case_.target.has_stencil &&
            !stencils_at(expectation_, expectation_.samples[index], std::nullopt)
                 .test(other.stencil_after(theirs)));
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
    return (colors_ && colors_->codes_after({&t, 1}, id) != colors_->codes_after({}, id)) ||
           (!colors_ &&
            ((case_.target.has_depth &&
              !cases::same_bits(depth_after({&t, 1}, id), depth_after({}, id))) ||
             (case_.target.has_stencil && stencil_after({&t, 1}) != stencil_after({}))));
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
    const auto after = colors_->codes_after(all, id);
    const auto before = colors_->codes_after(std::span(all).first(all.size() - 1), id);
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
