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
    // All must outlive this object; the case has a colour target. `witnesses`: of targets without
    // instruments, as compare_colors() has them.
    ColorComparison(const cases::Case& c, const ref::Expectation& expectation,
                    const capture::CaptureView& capture, Attribution& attribution,
                    std::span<const ref::ColorWitness> witnesses)
        : case_(c),
          expectation_(expectation),
          capture_(capture),
          attribution_(attribution),
          witnesses_(witnesses),
          unit_{c.target.color->format, expectation.profile},
          cleared_(unit_.cleared(*c.target.color)) {}

    // The finding at a sample that was drawn, if any. `writer`: with instruments, the triangle that
    // wrote last (any value if there are no hits).
    std::optional<Finding> judge(size_t index, cases::SampleId id, std::optional<uint32_t> writer);

    // How often a sample was hit, as far as its colour tells: 0 if it holds what it was cleared to.
    // Pictures of targets without instruments show it.
    uint8_t hits_for_pictures(size_t index);
    // Whether what is found of a colour depends on the sample's expectation, its codes and its
    // witness alone: every draw writes one colour.
    bool is_uniform() { return at(expectation_.profile, 0).is_uniform(); }

  private:
    // The reference at a profile; a looser one knows this sample and those that were asked for
    // before.
    ref::ColorReference& at(cases::Profile profile, size_t index);
    // The loosest profile at which a sample is wrong that is wrong at the asked one. The loosest
    // are asked first: what is wrong there needs no expectation of the profiles in between.
    cases::Profile loosest_wrong(size_t index,
                                 const std::function<bool(ref::ColorReference&)>& is_wrong);
    std::optional<ref::ColorWitness> witness_of(size_t index, std::optional<uint32_t> writer) const;
    Finding finding_of(size_t index, cases::SampleId id, const ref::ColorVerdict& verdict,
                       const std::optional<ref::ColorWitness>& witness);

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::CaptureView& capture_;
    Attribution& attribution_;
    std::span<const ref::ColorWitness> witnesses_;
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
