// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the tests of the table know of a case.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/exercise/shown.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/expectation/onlooker.hpp"
#include "ref/value/fragment/quantities.hpp"
#include "ref/value/reference.hpp"

namespace ref {

// What tests know of a case beside the sample; most of it is made when it is asked for.
class CaseFacts {
  public:
    // Keeps references. `shown`: what the attachments show, of a target without instruments; else
    // null.
    CaseFacts(const cases::Case& c, const Limits& limits, Shown* shown);

    const cases::Case& of() const { return case_; }
    Shown* shown() const { return shown_; }
    const std::vector<cases::Triangle>& triangles() const { return triangles_; }
    const cases::Draw& draw_of(uint32_t t) const { return case_.draws[triangles_[t].draw]; }
    // What a fragment of a draw carries.
    const std::vector<value::Quantity>& quantities(uint32_t draw);
    // Whether a position or an attribute is NaN, infinite, beyond what is promised, denormal or a
    // negative zero.
    bool has_bad_number();
    // A triangle alone at a sample, and why, at profile direct3d.
    Decision decide(uint32_t t, const JudgedSample& sample);
    // Whether the depth of a triangle lies outside its viewport's range before it is clamped.
    bool is_beyond_range(uint32_t t, const JudgedSample& sample);

  private:
    const cases::Case& case_;
    Limits limits_;
    Shown* shown_;
    std::vector<cases::Triangle> triangles_;
    std::vector<std::vector<value::Quantity>> quantities_;
    std::optional<bool> has_bad_number_;
    std::unique_ptr<Explainer> explainer_;
    static double depth_of(ValueReference& values, uint32_t t, const JudgedSample& sample);
    // The case without clamp, in binary32; with and without its bias.
    std::unique_ptr<cases::Case> biased_, plain_;
    std::optional<ValueReference> biased_values_, plain_values_;
};

}  // namespace ref
