// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which rule a wrong number of hits breaks, at which profile, and why.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "diff/sample/causes.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/reason/reason.hpp"

namespace diff {

// Who hit a sample last, as the sample says: whether a triangle is one of those that it may mean,
// and its draw. Empty where nobody says it.
struct LastHit {
    std::function<bool(const cases::Triangle&)> wrote;
    uint32_t draw = 0;
};

// Finds the loosest profile at which hits are wrong; computes the looser expectations when they
// are asked, as far as they are.
class Attribution {
  public:
    // Explaining a sample costs as much as judging thousands, and more with each triangle of the
    // case. After `most` findings, or kTriangles set up for them, one that looks like an earlier
    // one (same kind, level, draw that hit last and numbers) takes over its rule, and after
    // kTimesAlike as many one of the same kind, level and draw: a driver that breaks everything is
    // judged in seconds, too.
    static constexpr size_t kExplained = 16, kBrief = 2;
    Attribution(const cases::Case& c, const ref::Expectation& expectation, size_t most = kExplained)
        : case_(c),
          expectation_(expectation),
          explains_(std::clamp(kTriangles / std::max(expectation.triangles.size(), size_t{1}),
                               size_t{2}, most)),
          most_explained_(kTimesAlike * most) {}

    // Fills rule, level, expected, got and why of a finding whose kind and sample are set, for a
    // sample whose hits are wrong, as far as they are known.
    void attribute_hits(Finding& finding, const ref::path::SeenHits& seen,
                        const LastHit& last = {});
    // The same of a sample whose colour is wrong at `level` at the loosest, and tells of so many
    // fragments, whichever faces they are of; `triangle`: of which it lacks one, or has one more.
    // Where so many are allowed, that one is what is wrong. An empty rule where nothing says why.
    void attribute_color(Finding& finding, uint32_t hits, cases::Profile level,
                         const std::optional<uint32_t>& triangle);

    // Finds the loosest profile at which no triangle for which `wrote` holds may have written a
    // sample last, and sets level; rule and why as well where a looser profile allows it (a tie's
    // owner or a snapping, not the order of drawing) or where these triangles must not cover the
    // sample in the first place.
    void attribute_writer(Finding& finding,
                          const std::function<bool(const cases::Triangle&)>& wrote);

    // The expectation of the case at a profile that is not stricter than the asked one.
    const ref::Expectation& at(cases::Profile profile);
    // The same for one sample, in less time: the samples that were never asked for need not be
    // right. Always the same object of a profile.
    const ref::Expectation& at(cases::Profile profile, size_t index);

  private:
    size_t index_of(const Finding& finding) const;
    ref::Explainer& explainer(cases::Profile level);
    // attribute_hits() of a finding whose level is set.
    void attribute_at_level(Finding& finding, const ref::path::SeenHits& seen, const LastHit& last);
    // Rule and why of a fragment of this triangle that is missing, or of one more that looks so.
    void attribute_triangle(Finding& finding, uint32_t triangle);
    // Fills rule and why from the story of the sample.
    void explain_hits(Finding& finding, const ref::HitBounds& asked, uint32_t total,
                      const LastHit& last);

    static constexpr size_t kTimesAlike = 4;
    static constexpr size_t kTriangles = 1024;

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    std::optional<ref::Expectation> looser_[2];
    std::optional<ref::Explainer> explainers_[3];  // by profile, made when first asked for
    size_t explains_;  // how many findings are explained before one takes over another's rule
    size_t most_explained_;
    size_t explained_ = 0;
    std::map<std::string, Finding> like_;  // by kind, level, draw, expected and got
    std::map<std::tuple<FindingKind, cases::Profile, uint32_t>, Finding> alike_;
    std::map<cases::Profile, Finding> like_writer_;  // wrong writers, by level
    // Of single triangles: by kind, level and the triangle's draw.
    std::map<std::tuple<FindingKind, cases::Profile, uint32_t>, Finding> like_triangle_;
};

// Sets rule and why to those of a cause, or of a reason that needs no more words.
void tell(Finding& finding, const Cause& cause);
void tell(Finding& finding, ref::ReasonKind why);

// Writes "1", "0 or 1" or "1 to 3", and "1 front, 0 back" if both faces play a part.
std::string to_text(const ref::HitBounds& bounds);
// The kind of a wrong number of hits.
FindingKind kind_of(const ref::HitBounds& bounds, const ref::path::SeenHits& seen);

}  // namespace diff
