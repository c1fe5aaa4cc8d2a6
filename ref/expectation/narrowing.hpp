// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// From the coverage of single triangles to the hits that a sample may show.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
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
#include "ref/path/path.hpp"

namespace ref {

// Holds what judge() rests on, for those who tell it.
struct JudgeReasons {
    std::vector<FixedSet> sets;
    std::vector<path::Fate> fates;          // of each hit
    std::vector<ReasonKind> depth_reasons;  // why its depth test comes to that
};

// Whether queries, what is stored of fragments that do not show, the stencil or depth bounds ask
// for the whole path of a sample's fragments.
inline bool follows_paths(const cases::Case& c) {
    return stencil::is_needed(c) || stores_discarded(c) || tests_bounds(c) || counts_fragments(c);
}

class Narrowing {
  public:
    Narrowing(const cases::Case& c, cases::Profile profile,
              const std::vector<cases::Triangle>& triangles, TriangleSetups& setups,
              Predicates predicates, DepthTest* depth, ValueDiscards& discards);

    // Bounds for sample `s` of a pixel, at p, from the triangles that must or may cover it, in
    // drawing order; appends to `lists` what it says of them. Fills `reasons`, unless it is null.
    SampleExpectation judge(const FixedPoint& p, uint32_t s, std::span<const Hit> hits,
                            Lists& lists, JudgeReasons* reasons = nullptr);
    // Whether judge() says the same wherever the sample lies that these triangles touch.
    bool is_anywhere(std::span<const Hit> hits) const;

  private:
    path::Question question(const FixedPoint& p, std::span<const Hit> hits,
                            const std::vector<FixedHits>& sets);
    void add_tests(path::Question& question, const FixedPoint& p, std::span<const Hit> hits);
    path::Resolution resolution_of(const path::Question& question);
    SampleExpectation judge_by_paths(const FixedPoint& p, std::span<const Hit> hits,
                                     const std::vector<FixedHits>& sets, Lists& lists,
                                     JudgeReasons* reasons);
    // Keeps the fragments of a sample of which something is open, or those that pass all tests.
    void keep_paths(const path::Question& question, SampleExpectation& out, Lists& lists) const;
    void keep_passed(const path::Question& question, SampleExpectation& out, Lists& lists) const;

    const cases::Case& case_;
    cases::Profile profile_;
    const std::vector<cases::Triangle>& triangles_;
    TriangleSetups& setups_;
    Predicates predicates_;
    uint32_t sample_ = 0;  // of the pixel, the one at hand
    DepthTest* depth_;     // null: every fragment passes and writes
    ValueDiscards& discards_;
    bool stores_discarded_;
    std::map<std::pair<uint32_t, int>, TestedDepth> tests_;  // of the sample at hand
    std::vector<ReasonKind> depth_reasons_;                  // of the hits at hand
    std::vector<path::Fate> fates_;                          // of the hits at hand
    FixedSets fixed_sets_;
    // The last question without depth tests, and its answer.
    struct Resolved {
        std::vector<path::Fragment> fragments;
        std::vector<path::FragmentSet> sets;
        path::Resolution resolution;
    };
    std::optional<Resolved> last_;
};

}  // namespace ref
