// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a blend unit may compute in place of the equation as the text has it: where the factors are
// f and 1 - f, as one and zero are, or f twice, drivers save a product, as d + f (s - d). Source:
// Vulkan specification, "Blending", which does not order the computation; Direct3D 11.3 functional
// specification, 17.5, "operations are considered to be fused, and reordering is permitted". All
// numbers are rationals.
#pragma once

#include <cstddef>
#include <optional>

#include "cases/model/case.hpp"
#include "ref/color/component.hpp"

namespace ref::color {

// What the unit may hold of a value: either neighbour, and 0 for a denormal number of binary32,
// since nothing is said of the numbers that it works with ("Floating-Point Computation"). NVIDIA's
// takes such sources for 0.
Interval held(const Component& component, const Interval& v);

// What state makes 1 of a factor, or 0, so that a device may take it for that: the alpha of a
// target without one and of a source that alpha to one replaces, and the saturated alpha of an
// alpha.
struct KnownFactors {
    bool is_source_alpha_one = false, is_target_alpha_one = false;

    // The factor, or one or zero in its place. `k`: the component, 3 alpha.
    cases::BlendFactor operator()(cases::BlendFactor factor, size_t k) const;
};

// What an equation may give if it is computed with one product; f and g are its factors. Of numbers
// s and d each step is either neighbour. Of intervals the exact result is least and greatest at
// ends, since it is of degree 1 in each variable, and rounding moves it by the sum's unit, times
// the factor, and the product's; a denormal number of binary32 may be taken for 0. Nothing where
// the sum overflows: the dynamic range is to be that of the target or more.
std::optional<Interval> reordered(const Component& component, const cases::BlendEquation& equation,
                                  size_t k, const KnownFactors& known, const Interval& source,
                                  const Interval& destination, const Interval& f,
                                  const Interval& g);

}  // namespace ref::color
