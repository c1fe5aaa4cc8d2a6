// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Why a value of a fragment is wrong, and at which level.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "ref/value/drawn_fragment.hpp"

namespace ref::value {

// What is wrong with a quantity and why, without the texts.
ValueMismatch mismatch_of(const Quantity& q, ReasonKind reason, cases::Profile level);

// Why a value must not be what it is.
ReasonKind reason_of(const DrawnFragment& f, size_t index);

// Of a quantity of a draw that is wrong for some reason: how many values have been asked, and the
// loosest level of them (ValueReference::tell_loosest_levels).
class LoosestLevels {
  public:
    // DrawnFragment::levels_of(), or what is known of others if that is enough.
    std::vector<cases::Profile> of(const DrawnFragment& f, const std::vector<size_t>& failing,
                                   const std::vector<ReasonKind>& reasons);

  private:
    struct Asked {
        size_t values = 0;
        cases::Profile loosest = cases::Profile::direct3d;
        bool is_enough() const;
    };
    std::map<std::tuple<uint32_t, size_t, ReasonKind>, Asked> asked_;
};

}  // namespace ref::value
