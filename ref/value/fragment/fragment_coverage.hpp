// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the fragment of a triangle in a pixel, or in a block of pixels, may be: the samples that it
// covers, and the part of the pixels that lies in the primitive. Centroid interpolation and
// gl_SampleMaskIn depend on it.
#pragma once

#include <gmpxx.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/number/plane_budget.hpp"
#include "ref/position/limits.hpp"

namespace ref {

// Bit s stands for sample s, in a block for the sample with coverage index s; the first 32 of them.
// Scissor and viewport have been applied, sample masks have not.
struct PixelCoverage {
    uint32_t must = 0, may = 0;
    // False: the triangle is clipped, and devices may make several fragments of its pieces.
    bool is_one_fragment = true;
};

// Corners of the intersection of a block of pixels with the convex hull of the positions that a
// device may use, in pixels, exact. The whole block where the positions have no bounds (w <= 0).
// May be empty.
std::vector<value::Point<mpq_class>> pixel_region(const TriangleSetup& setup,
                                                  const cases::PixelBlock& block);

// The part of a convex polygon where a x + b y + c >= 0 (Sutherland and Hodgman 1974).
std::vector<value::Point<mpq_class>> cut(const std::vector<value::Point<mpq_class>>& polygon,
                                         const value::Form<mpq_class>& inside);

// What was answered last, of a triangle and a fragment.
template <class Answer>
struct LastFragmentAnswer {
    uint32_t t = 0;
    cases::PixelBlock block;
    Answer answer;
    bool is_of(uint32_t triangle, const cases::PixelBlock& other) const {
        return t == triangle && block == other;
    }
};

// Sets each triangle up once, when first asked, and keeps the last fragment. Fragments are named by
// any of their pixels.
class FragmentCoverage {
  public:
    FragmentCoverage(const cases::Case& c, const Limits& limits, cases::Profile profile,
                     const std::vector<cases::Triangle>& triangles);

    const PixelCoverage& of(uint32_t t, uint32_t x, uint32_t y);
    // pixel_region() of the triangle's set-up; valid until the next call.
    const std::vector<value::Point<mpq_class>>& region(uint32_t t, uint32_t x, uint32_t y);
    // As of(), from rationals alone.
    PixelCoverage exact(uint32_t t, uint32_t x, uint32_t y);
    const TriangleSetup& setup(uint32_t t) { return setups_[t]; }

  private:
    const cases::Case& case_;
    const std::vector<cases::Triangle>& triangles_;
    TriangleSetups setups_;  // without alpha to coverage, which comes after the shader
    cases::PixelBlock block_of(uint32_t t, uint32_t x, uint32_t y) const {
        return cases::fragment_block(case_.draws[triangles_[t].draw], x, y);
    }
    std::optional<LastFragmentAnswer<PixelCoverage>> last_;
    std::optional<LastFragmentAnswer<std::vector<value::Point<mpq_class>>>> last_region_;
};

}  // namespace ref
