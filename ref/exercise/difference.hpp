// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a case shows that a device is wrong about something: where what that device draws, the case
// as it takes it (cases/fault/change.hpp), is not what the case must show.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/sample.hpp"
#include "ref/exercise/exercise.hpp"
#include "ref/exercise/shown.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/fragment/quantities.hpp"
#include "ref/value/reference.hpp"

namespace ref {

// By what the two are told apart. Without instruments it is always the colour and the plain depth,
// and of hits the stencil.
enum class Differ : uint8_t {
    hits,    // hits, writers, whose depth is stored, the stencil
    depths,  // these and the depth
    values,  // the values that the rule is about, of the same fragments
    colors,  // the colour target
};

// A case and what it must show, for all comparisons; the dear parts are made when they are asked
// for.
class Original {
  public:
    // Keeps references. The expectation is the case's.
    Original(const cases::Case& c, const Expectation& expected) : case_(c), expected_(expected) {}
    const cases::Case& of() const { return case_; }
    const Expectation& expected() const { return expected_; }
    // The target has a colour.
    Shown& shown();
    ValueReference& values();

  private:
    const cases::Case& case_;
    const Expectation& expected_;
    std::unique_ptr<Shown> shown_;
    std::unique_ptr<ValueReference> values_;
};

class Difference {
  public:
    // Keeps a reference to the original; `other`: what the wrong device makes of its case.
    Difference(Original& original, cases::Case other, Differ differ, std::string_view rule);

    // Whether the device would have a finding at a decided sample.
    bool shows(size_t index);

  private:
    // The quantities of a draw that are compared.
    std::vector<value::Quantity> asked(const cases::Draw& draw) const;
    bool shows_values(const SampleExpectation& sample, cases::SampleId id);
    bool shows_value(uint32_t t, cases::SampleId id);
    std::optional<bool> differs_by_range(uint32_t t, cases::SampleId id, const value::Quantity& q);
    bool shows_likely_value(uint32_t t, cases::SampleId id);
    bool shows_colors_of(size_t index, cases::SampleId id);

    Original& original_;
    cases::Case other_;
    Differ differ_;
    std::string_view rule_;
    std::optional<Expectation> without_;  // of the other case; where only values differ: none
    std::vector<std::vector<value::Quantity>> asked_;  // by draw
    std::unique_ptr<Shown> other_shown_;
    std::unique_ptr<ValueReference> other_values_;
};

// What can be seen of each draw of a case without instruments.
std::vector<Sight> sights_of_draws(Original& original);

}  // namespace ref
