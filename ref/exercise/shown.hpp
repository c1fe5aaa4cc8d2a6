// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a target without instruments shows of the fragments: its colours, depths and stencils. What
// is drawn in the colour that is there already is not seen, nor is the order of two fragments of
// one colour, or of what a stencil counts.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/sample.hpp"
#include "ref/color/color.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace ref {

class Shown {
  public:
    // Keeps references. The expectation is the case's, whose target has a colour or no instruments.
    Shown(const cases::Case& c, const Expectation& expectation);

    // Fragments that a device may have drawn at a sample, in drawing order; none where too many are
    // free.
    std::vector<uint32_t> drawn(size_t index) const;
    // Whether the attachments tell these triangles of `other`, a like case, drawn in this order,
    // from all that may be drawn there.
    bool tells(size_t index, cases::SampleId id, std::span<const uint32_t> theirs, Shown& other);
    // Whether they tell if a triangle is drawn there or not.
    bool shows(size_t index, cases::SampleId id, uint32_t t);
    // Whether they tell if it is drawn there once or twice.
    bool shows_twice(size_t index, cases::SampleId id, uint32_t t);
    // Whether it alone leaves another colour than the clear one, or depth or stencil.
    bool leaves_a_mark(cases::SampleId id, uint32_t t);
    // Whether they tell the fragments from the same in the opposite order.
    bool shows_order(size_t index, cases::SampleId id);
    // Whether the last of them has a logical operation that the target's format does not take, and
    // another colour would be left if it did.
    bool shows_passed_logic(size_t index, cases::SampleId id);

  private:
    bool tells_depth(size_t index, cases::SampleId id, std::span<const uint32_t> triangles,
                     Shown& of);
    // The depth and the stencil that these triangles, which pass all tests where they did in the
    // picture, most likely leave, in this order.
    float depth_after(std::span<const uint32_t> triangles, cases::SampleId id);
    uint32_t stencil_after(std::span<const uint32_t> triangles);
    // Whether a sample may hold a depth.
    bool explains_depth(size_t index, cases::SampleId id, float depth);
    // The depth that a triangle most likely has there.
    float depth_of(uint32_t t, cases::SampleId id);

    const cases::Case& case_;
    const Expectation& expectation_;
    std::optional<ColorReference> colors_;
    ValueReference values_;
    std::optional<TriangleSetups> setups_;  // if there is a stencil
};

// Whether the attachments of a case show a quantity of a draw's fragments.
bool is_shown(const cases::Case& c, const cases::Draw& draw, const QuantityId& id);

}  // namespace ref
