// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// From the coverage of single triangles to the hits that a sample may show.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/depth/outcome.hpp"
#include "ref/expectation/discards.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/fixed_sets.hpp"
#include "ref/stencil/outcome.hpp"

namespace ref {

// Holds what judge() rests on, for those who tell it.
struct JudgeReasons {
    std::vector<FixedSet> sets;
    DepthResolution depth;             // of each hit; empty if the case tests no depth
    std::vector<stencil::Fate> fates;  // of each hit; empty if the case follows no courses
};

// What judge() appends to: of an expectation, or of an explanation.
struct JudgedLists {
    std::vector<uint32_t>& writers;        // that may have written last
    std::vector<uint32_t>& depth_writers;  // whose depth may be stored
    std::vector<stencil::Outcome>& stencils;
};

// Whether what a sample shows hangs on the whole course of its fragments (ref/stencil/outcome.hpp):
// the stencil of each fragment or the depth that is stored chooses, or some store depth or stencil
// and do not show, or queries count what becomes of each.
inline bool follows_courses(const cases::Case& c) {
    return stencil::is_needed(c) || stores_discarded(c) || tests_bounds(c) || counts_fragments(c);
}

// Keeps the hits of a sample for the colour target, if the case has one. `fates`: of each hit, if
// the case follows courses.
inline void add_fragments(Expectation& out, const cases::Case& c, std::span<const Hit> hits,
                          std::span<const stencil::Fate> fates, SampleExpectation& sample) {
    if (!out.target.color) {
        return;
    }
    sample.fragments_begin = static_cast<uint32_t>(out.fragments.size());
    for (size_t k = 0; k < fates.size(); ++k) {
        if (fates[k].passes) {
            out.fragments.push_back({hits[k].triangle, fates[k].always_passes()});
        }
    }
    sample.fragments_count = static_cast<uint32_t>(out.fragments.size()) - sample.fragments_begin;
    if (follows_courses(c)) {
        return;
    }
    sample.fragments_count = static_cast<uint32_t>(hits.size());
    for (const Hit& hit : hits) {
        // A depth test or a mask may still take it away; the bounds of the sample know how many.
        const cases::Draw& draw = c.draws[out.triangles[hit.triangle].draw];
        const bool is_tested =
            out.target.has_depth && draw.depth.compare != cases::CompareOp::always;
        const bool passes = !is_tested && draw.multisample.sample_mask == 0xffffffffU &&
                            !draw.multisample.shader_mask;
        out.fragments.push_back({hit.triangle, passes && hit.coverage == Coverage::must});
    }
}

// Keeps what queries may count of the hits of a sample, if a draw of the case has one.
void add_counted(Expectation& out, const cases::Case& c, std::span<const Hit> hits,
                 std::span<const stencil::Fate> fates, SampleExpectation& sample);

class Narrowing {
  public:
    Narrowing(const cases::Case& c, cases::Profile profile,
              const std::vector<cases::Triangle>& triangles, TriangleSetups& setups,
              Predicates predicates, DepthTest* depth, ValueDiscards& discards);

    // Bounds for sample `s` of a pixel, at p, from the triangles that must or may cover it, in
    // drawing order; appends to `lists` what it says of them. Fills `reasons`, unless it is null.
    SampleExpectation judge(const FixedPoint& p, uint32_t s, std::span<const Hit> hits,
                            const JudgedLists& lists, JudgeReasons* reasons = nullptr);
    // What may have become of each hit of the last judge(), if the case follows courses.
    std::span<const stencil::Fate> fates() const { return fates_; }
    // Whether judge() says the same wherever the sample lies that these triangles touch.
    bool is_anywhere(std::span<const Hit> hits) const;

  private:
    DepthResolution resolve_depth(const FixedPoint& p, std::span<const Hit> hits,
                                  const std::vector<FixedHits>& sets);
    // Takes the fragments away that fail the depth test.
    void apply_depth(const FixedPoint& p, std::span<const Hit> hits, std::vector<FixedHits>& sets,
                     std::vector<Coverage>& coverage, std::vector<uint32_t>& depth_writers,
                     SampleExpectation& out, JudgeReasons* reasons);
    // Adds what the hits come to; returns the first of them that may have written last.
    uint32_t add_hits(std::span<const Hit> hits, const std::vector<FixedHits>& sets,
                      std::vector<Coverage>& coverage, HitBounds& out);
    // Does so by stencil and depth test together, where the case follows courses.
    stencil::Question stencil_question(const FixedPoint& p, std::span<const Hit> hits,
                                       const std::vector<FixedHits>& sets,
                                       std::vector<ReasonKind>& depth_reasons);
    SampleExpectation judge_by_stencil(const FixedPoint& p, std::span<const Hit> hits,
                                       const std::vector<FixedHits>& sets, const JudgedLists& lists,
                                       JudgeReasons* reasons);
    const cases::Case& case_;
    cases::Profile profile_;
    const std::vector<cases::Triangle>& triangles_;
    TriangleSetups& setups_;
    Predicates predicates_;
    uint32_t sample_ = 0;  // of the pixel, the one at hand
    DepthTest* depth_;     // null: every fragment passes and writes
    ValueDiscards& discards_;
    bool follows_courses_;
    bool stores_discarded_;
    std::vector<stencil::Fate> fates_;  // of the hits at hand
    FixedSets fixed_sets_;
};

}  // namespace ref
