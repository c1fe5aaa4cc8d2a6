// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether two implementations of the reference expect the same of every sample.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "ref/expectation/expectation.hpp"

namespace ref::test {

inline std::string describe(const Expectation& e, size_t index) {
    const SampleExpectation& s = e.samples[index];
    const HitBounds& b = s.hits;
    std::string text = "front " + std::to_string(b.front_min) + ".." + std::to_string(b.front_max) +
                       " back " + std::to_string(b.back_min) + ".." + std::to_string(b.back_max) +
                       " signed " + std::to_string(b.signed_min) + ".." +
                       std::to_string(b.signed_max) + " total " + std::to_string(b.total_min) +
                       ".." + std::to_string(b.total_max) + " writers";
    for (const uint32_t t : e.writers_of(s)) {
        text += " " + std::to_string(t);
    }
    text += " depth writers";
    for (const uint32_t t : e.depth_writers_of(s)) {
        text += " " + std::to_string(t);
    }
    text += s.depth_may_be_clear ? ", clear" : "";
    text += s.is_free ? ", free" : "";
    return text + ", " + std::to_string(e.stencils_of(s).size()) + " stencils, " +
           std::to_string(e.fragments_of(s).size()) + " fragments";
}

// Hits, writers, depths, fragments of the colour, what queries count, and the counts of samples.
inline testing::AssertionResult same_expectations(const Expectation& fast,
                                                  const Expectation& slow) {
    if (fast.samples.size() != slow.samples.size()) {
        return testing::AssertionFailure() << "other numbers of samples";
    }
    for (size_t k = 0; k < fast.samples.size(); ++k) {
        if (!is_same(fast, slow, k) || !std::ranges::equal(fast.fragments_of(fast.samples[k]),
                                                           slow.fragments_of(slow.samples[k]))) {
            return testing::AssertionFailure() << "sample " << k << ": fast " << describe(fast, k)
                                               << ", oracle " << describe(slow, k);
        }
    }
    if (fast.must_samples != slow.must_samples || fast.either_samples != slow.either_samples) {
        return testing::AssertionFailure() << "other counts of samples";
    }
    return testing::AssertionSuccess();
}

}  // namespace ref::test
