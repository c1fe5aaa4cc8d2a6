// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The colour plane of a capture against what the reference allows.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "capture/capture.hpp"
#include "diff/attribution.hpp"
#include "diff/verdict.hpp"
#include "ref/color/color.hpp"

namespace diff {

class ColorComparison {
  public:
    // What the other planes tell of a sample at a profile.
    using WitnessAt = std::function<ref::ColorWitness(cases::Profile profile)>;

    // All must outlive this object; the case has a colour target.
    ColorComparison(const cases::Case& c, const ref::Expectation& expectation,
                    const capture::CaptureView& capture, Attribution& attribution)
        : case_(c),
          expectation_(expectation),
          capture_(capture),
          attribution_(attribution),
          unit_{c.target.color->format, expectation.profile},
          cleared_(unit_.cleared(*c.target.color)) {}

    // The finding at a sample, if any.
    std::optional<Finding> judge(size_t index, cases::SampleId id, const WitnessAt& witness);

    // The reference at a profile; a looser one knows this sample and those that were asked for
    // before.
    ref::ColorReference& reference(cases::Profile profile, size_t index);

    // How often a sample was hit, as far as its colour tells: 0 if it holds what it was cleared to.
    // Pictures of targets without instruments show it.
    uint8_t hits_for_pictures(size_t index);
    // Whether what is found of a colour depends on the sample's expectation, its codes and its
    // witness alone: every draw writes one colour.
    bool is_uniform() { return reference(expectation_.profile, 0).is_uniform(); }

  private:
    Finding finding_of(size_t index, cases::SampleId id, const ref::ColorVerdict& verdict,
                       const WitnessAt& witness);

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    Attribution& attribution_;
    ref::color::Unit unit_;
    ref::color::Color cleared_;
    std::array<std::unique_ptr<ref::ColorReference>, 3> references_;  // by profile
    // Neighbours mostly hold the same: the last colours that were the clear colour, and that were
    // not.
    std::optional<std::array<uint32_t, 4>> last_clear_, last_drawn_;
};

// Whether a target without instruments in which nothing is drawn may pass: every sample may hold
// the clear colour, and the clear depth if it has depth. `expectation`: that of the case.
bool may_stay_clear(const cases::Case& c, const ref::Expectation& expectation);

// Whether a device that draws nothing of a case with triangles fails at a profile: some sample must
// be covered, and of a target without instruments one may not stay as it was. It looks at no more
// samples than it takes to tell, so it costs less than the whole expectation.
bool fails_if_empty(const cases::Case& c, cases::Profile profile);

}  // namespace diff
