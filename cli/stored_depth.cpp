// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/stored_depth.hpp"

#include <algorithm>
#include <span>

#include "ref/depth/outcome.hpp"

namespace cli {

namespace {

std::span<const uint32_t> writers_at(const ref::Expectation& expectation, size_t index) {
    const ref::SampleExpectation& s = expectation.samples[index];
    return std::span(expectation.writers).subspan(s.writers_begin, s.writers_count);
}

}  // namespace

bool has_own_depth(const cases::Case& c, const ref::Expectation& expectation, size_t index) {
    if (!ref::DepthTest::is_needed(c)) {
        return false;
    }
    const ref::SampleExpectation& s = expectation.samples[index];
    const auto writers = writers_at(expectation, index);
    return s.depth_may_be_clear ? s.depth_count > 0 || !writers.empty()
                                : !std::ranges::equal(expectation.depth_writers_of(s), writers);
}

bool may_hold_depth(const cases::Case& c, const ref::Expectation& expectation, size_t index,
                    uint32_t triangle) {
    const auto all = ref::DepthTest::is_needed(c)
                         ? expectation.depth_writers_of(expectation.samples[index])
                         : writers_at(expectation, index);
    return std::ranges::find(all, triangle) != all.end();
}

}  // namespace cli
