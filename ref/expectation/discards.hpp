// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Fragments that the shader discards by the sign of an attribute (cases::Discard::negative), as the
// values of ref/value leave it. Samples of one fragment are asked one by one: that they share an
// invocation leaves less open than is said here.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/sample.hpp"
#include "ref/position/limits.hpp"
#include "ref/value/reference.hpp"

namespace ref {

class ValueDiscards {
  public:
    // `exact_only`: by rationals alone, for the oracle.
    ValueDiscards(const cases::Case& c, const Limits& limits, cases::Profile profile,
                  bool exact_only)
        : is_exact_(exact_only) {
        if (discards_by_value(c)) {
            values_.emplace(c, limits, profile);
        }
    }

    // The sign of what the shader tests, of a triangle whose draw discards so.
    // A sample's are kept until another one is asked for, since each of its sets asks again.
    Sign at(uint32_t triangle, const cases::SampleId& sample) {
        if (!(at_ == sample)) {
            known_.clear();
            at_ = sample;
        }
        const auto [sign, is_new] = known_.try_emplace(triangle, Sign::open);
        if (is_new) {
            sign->second = values_->sign(triangle, sample, is_exact_);
        }
        return sign->second;
    }

  private:
    bool is_exact_;
    cases::SampleId at_;
    std::map<uint32_t, Sign> known_;  // by triangle, at at_
    std::optional<ValueReference> values_;
};

}  // namespace ref
