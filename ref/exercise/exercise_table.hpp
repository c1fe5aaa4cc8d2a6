// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The table of what exercises each rule, and what its tests see of a sample.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/expectation/onlooker.hpp"
#include "ref/value/fragment/quantities.hpp"
#include "ref/value/value.hpp"

namespace ref {

// What tests know of a case beside the sample; most of it is made when it is asked for.
class CaseFacts {
  public:
    // Keeps a reference to the case.
    CaseFacts(const cases::Case& c, const Limits& limits);

    const cases::Case& of() const { return case_; }
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
    std::vector<cases::Triangle> triangles_;
    std::vector<std::vector<value::Quantity>> quantities_;
    std::optional<bool> has_bad_number_;
    std::unique_ptr<Explainer> explainer_;
    static double depth_of(ValueReference& values, uint32_t t, const JudgedSample& sample);
    // The case without clamp, in binary32; with and without its bias.
    std::unique_ptr<cases::Case> biased_, plain_;
    std::optional<ValueReference> biased_values_, plain_values_;
};

// One sample as a test sees it; the set-ups are those of the profile at which it looks.
struct View {
    CaseFacts& facts;
    const JudgedSample& sample;
    TriangleSetups& setups;
    const cases::Case& of() const { return facts.of(); }
};

// One way to exercise a rule: by a test at the samples of a profile, by another answer of the case
// without what the rule is about, or, of a blit, in texels inside or outside its region.
struct Way {
    cases::Profile profile = cases::Profile::direct3d;
    bool (*test)(const View& view, std::string_view rule) = nullptr;
    void (*take_away)(cases::Case& c) = nullptr;
    enum class Texels : uint8_t { none, inside, outside } texels = Texels::none;
};

struct ExerciseRow {
    std::string_view rule;
    std::string_view how;  // as exercise_of
    std::array<Way, 3> ways{};
    // Texels of blits: whether the case's blit is one that the rule is about.
    bool (*is_about)(const cases::Blit& blit) = nullptr;
};

const ExerciseRow* find_exercise(std::string_view rule);

}  // namespace ref
