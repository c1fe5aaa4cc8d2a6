// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// All numbers that are right for what a function of the shader makes of an input: interpolateAt*,
// derivatives, textureQueryLod. ref/value judges such numbers; a reproducer needs their bounds.
#pragma once

#include <array>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/triangle.hpp"
#include "ref/position/limits.hpp"
#include "ref/value/fragment/fragment_coverage.hpp"
#include "ref/value/reference.hpp"

namespace cli {

// Bounds of what ref/value accepts for one fragment: from the least to the largest number of any
// quad, any alternative place and any set-up, so that they hold some that no device may have.
class ProbeRanges {
  public:
    // All must outlive this object.
    ProbeRanges(const cases::Case& c, const ref::Limits& limits, cases::Profile profile,
                const std::vector<cases::Triangle>& triangles)
        : case_(c),
          limits_(limits),
          profile_(profile),
          triangles_(triangles),
          coverage_(c, limits, profile, triangles) {}

    // Of all components of an attribute with a probe, of triangle t at the sample.
    std::array<ref::ValueRange, 4> of(uint32_t t, cases::SampleId sample, size_t attribute);

    const ref::PixelCoverage& coverage(uint32_t t, cases::SampleId sample) {
        return coverage_.of(t, sample.x, sample.y);
    }

  private:
    template <class T>
    bool add(uint32_t t, cases::SampleId sample, size_t attribute,
             std::array<ref::ValueRange, 4>& out);

    const cases::Case& case_;
    ref::Limits limits_;
    cases::Profile profile_;
    const std::vector<cases::Triangle>& triangles_;
    ref::FragmentCoverage coverage_;
};

}  // namespace cli
