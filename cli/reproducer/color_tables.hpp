// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a colour target may hold, as rows of a reproducer's table kColors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "ref/color/blend.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace cli {

class ColorRows {
  public:
    // All must outlive this object; the case has a colour target.
    ColorRows(const cases::Case& c, const ref::Expectation& expectation,
              ref::ValueReference& values)
        : case_(c),
          expectation_(expectation),
          values_(values),
          unit_{c.target.color->format, expectation.profile},
          cleared_(unit_.cleared(*c.target.color)) {}

    // Triangles whose fragments may be there, in drawing order. Without instruments as many as the
    // bounds of the hits allow, with them any number, since the program knows it.
    using Sequence = std::vector<uint32_t>;
    // Every set that may be there; none where there are more than a run tries out: nothing is
    // promised then.
    std::vector<Sequence> sets_at(size_t index) const;
    // A row a colour, each once.
    std::vector<std::string> rows(size_t index, const std::vector<Sequence>& sets);

  private:
    std::string row(const Sequence& sequence, cases::SampleId id);
    ref::color::Color source_of(uint32_t triangle, cases::SampleId id);
    const cases::ColorOutput& output_of(uint32_t triangle) const {
        return case_.draws[expectation_.triangles[triangle].draw].color;
    }

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    ref::ValueReference& values_;
    ref::color::Unit unit_;
    ref::color::Color cleared_;
};

// Whether what a draw leaves in the depth of a target without instruments is judged: only what is
// written as it is interpolated (ref::ColorReference::explains_depth).
bool judges_bare_depth(const cases::Case& c);

}  // namespace cli
