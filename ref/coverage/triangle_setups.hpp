// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The set-ups of a case's triangles. Most triangles of a mesh at scale lie between the samples:
// they are never set up. What was set up is kept, until forget_last() gives it up.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/position/limits.hpp"

namespace ref {

class TriangleSetups {
  public:
    // Keeps references to the case and its assembled triangles. `is_told`: as of set_up.
    // `has_alpha`: what alpha to coverage takes away is taken away, too.
    TriangleSetups(const cases::Case& c, const std::vector<cases::Triangle>& triangles,
                   const Limits& limits, cases::Profile profile, bool is_told = false,
                   bool has_alpha = true);

    // The set-up of triangle t, made when first asked for; valid as long as this object, or until
    // it is forgotten.
    const TriangleSetup& operator[](uint32_t t);

    // Gives up the set-up that was made last, that of triangle t. It depends on nothing but the
    // triangle, so it is made again, the same, if it is asked for again.
    void forget_last(uint32_t t);

    // False only if it is proven that no sample lies in the closed rectangle around the boxes of
    // the triangle's vertices, within which everything stays that a device may draw of a triangle
    // inside the view volume. Such a triangle must not cover anything.
    bool may_touch_a_sample(uint32_t t);

    // The triangles that have been set up, in the order in which they were asked for first.
    const std::vector<uint32_t>& known() const { return known_; }

  private:
    static constexpr uint32_t kUnknown = 0, kForgotten = 0xffffffffU;

    const cases::Case& case_;
    const std::vector<cases::Triangle>& triangles_;
    Limits limits_;
    cases::Profile profile_;
    bool is_told_;
    VertexBoxes boxes_;
    std::vector<Window> windows_;     // by draw
    std::vector<uint32_t> slot_;      // 1 + place in kept_, by triangle; or one of the two above
    std::deque<TriangleSetup> kept_;  // stable addresses
    std::vector<uint32_t> known_;
    std::vector<FixedPoint> samples_;  // of a pixel
};

}  // namespace ref
