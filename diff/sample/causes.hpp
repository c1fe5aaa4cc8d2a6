// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which of a sample's reasons a wrong number of hits, or a wrong writer, breaks.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "ref/expectation/explain.hpp"
#include "ref/reason/reason.hpp"

namespace diff {

// What is broken, and the sentence that says it, which is made when it is asked for.
struct Cause {
    std::string_view rule;
    std::function<std::string()> words;
};

// The reasons of one sample at one level. The causes that it gives refer to it.
class Causes {
  public:
    Causes(ref::Explainer& explainer, const cases::Case& c, cases::SampleId sample,
           cases::Profile level)
        : explainer_(explainer),
          case_(c),
          sample_(sample),
          level_(level),
          reasons_(explainer.explain(sample, ref::Detail::reasons)) {}
    Causes(const Causes&) = delete;
    Causes& operator=(const Causes&) = delete;

    // Of too many hits at a sample that no triangle may cover.
    Cause of_extra() const;
    // Of `total` hits, which are too few, or too many where some hits are allowed.
    Cause of_count(uint32_t total, bool is_missing) const;
    // Of a fragment that is not there, and must be; nothing where the triangle may be absent.
    std::optional<Cause> of_lost(uint32_t triangle) const;
    // Of a fragment too many that looks like one of this triangle: another one of the same draw,
    // whose colour is a constant, that must not be there. Nothing if there is none.
    std::optional<Cause> of_another(uint32_t triangle) const;
    // Of a hit too many of a triangle that must fail the depth test, or one too few of a triangle
    // that must pass it; the number alone does not tell which, so the last one that fits is named.
    // A fragment that is missing, or too many, by the stencil test.
    std::optional<Cause> of_bounds(bool is_missing) const;
    std::optional<Cause> of_stencil(bool is_missing) const;
    std::optional<Cause> of_depth(bool is_missing) const;
    // Of a sample that was written last by a triangle that must not cover it; nothing if one of
    // those that may have written it may.
    std::optional<Cause> of_stray_writer(
        const std::function<bool(const cases::Triangle&)>& wrote) const;
    // Of hits too many, of which the sample says who was the last (`wrote`): why that triangle must
    // not have hit it. Nothing if one of those that may be it may hit it, or if it is a question of
    // positions that a looser profile allows.
    std::optional<Cause> of_last_hit(
        const std::function<bool(const cases::Triangle&)>& wrote) const;
    // Of several hits too many, the last of them by this draw: a triangle of an earlier draw that
    // would cover the sample but for its draw's state. Nothing if there is none.
    std::optional<Cause> of_earlier_hit(uint32_t draw) const;
    // Of the right number of hits by the wrong face.
    Cause of_facing() const;
    // A triangle that the top-left rule decides, if there is one: better one that it gives the
    // sample to.
    std::optional<Cause> of_tie() const;

  private:
    using Fits = std::function<bool(const ref::TriangleExplanation&)>;

    Cause of(const ref::TriangleExplanation& t) const;
    Cause of(const ref::FixedSet& set) const;
    std::optional<Cause> told(const ref::TriangleExplanation* t) const;
    // Of the depth bounds or the stencil test, else of the depth test.
    Cause of_test(ref::ReasonKind why, const ref::TriangleExplanation& t) const;
    // A reason of the sample as a whole: `triangle` and `number` are those that its sentence names.
    Cause of(ref::ReasonKind why, const std::string& triangle = "", uint32_t number = 0) const;
    std::optional<Cause> of_suppressed(const Fits& fits) const;
    const ref::TriangleExplanation* first_that(const Fits& fits) const;
    const ref::TriangleExplanation* last_that(const Fits& fits) const;
    const ref::TriangleExplanation* first_with(ref::Coverage coverage) const;
    const ref::TriangleExplanation* first_tie(bool is_given) const;

    ref::Explainer& explainer_;
    const cases::Case& case_;
    cases::SampleId sample_;
    cases::Profile level_;
    ref::SampleExplanation reasons_;
};

}  // namespace diff
