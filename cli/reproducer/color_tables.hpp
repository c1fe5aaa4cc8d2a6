// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a colour target may hold, as rows of a reproducer's table kColors.
#pragma once

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

    // Triangles whose fragments show on a path, in drawing order.
    using Sequence = std::vector<uint32_t>;
    // Those of every path; none where there are too many for the tables: nothing is promised then.
    static constexpr size_t kMostSets = 1024;
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
// written as it is interpolated.
bool judges_bare_depth(const cases::Case& c);

}  // namespace cli
