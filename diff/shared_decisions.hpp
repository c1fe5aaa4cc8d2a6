// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the samples of a pixel share: where the fragment shader runs once for them, one decision to
// discard is that of all. At profile direct3d it runs once, unless sample shading is on. Vulkan
// lets a device run it more often ("at least"), and each invocation may come to its own answer
// where the value is open: there samples are judged one by one.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/observers.hpp"
#include "diff/verdict.hpp"
#include "ref/color/color.hpp"
#include "ref/expectation/expectation.hpp"

namespace diff {

class SharedDecisions {
  public:
    // All must outlive this object.
    SharedDecisions(const cases::Case& c, const ref::Expectation& expectation,
                    const capture::CaptureView& capture, Observers& observers)
        : case_(c), expectation_(expectation), capture_(capture), observers_(observers) {}

    // Whether a case has any at the expectation's profile.
    static bool are_in(const cases::Case& c, cases::Profile profile);

    // The finding of a pixel whose samples are right one by one, but not by one decision. `seen`:
    // of each sample; nothing where it has a finding of its own. `colors`: null if no colour was
    // delivered.
    std::optional<Finding> judge(const cases::SampleId& pixel,
                                 const std::vector<std::optional<SeenPlanes>>& seen,
                                 ref::ColorReference* colors);

  private:
    // More decisions of a pixel than these are not tried out together.
    static constexpr size_t kMostDecisions = 8;

    std::vector<uint32_t> triangles_of(size_t first) const;
    bool is_right(size_t index, const SeenPlanes& seen, const std::set<uint32_t>& discarded,
                  const std::vector<uint32_t>& decided, ref::ColorReference* colors);

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    Observers& observers_;
};

}  // namespace diff
