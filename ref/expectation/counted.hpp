// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What queries of fragments may count. Occlusion queries: "the occlusion query sample counter
// increments by one for each sample with a coverage value of 1 in each fragment that survives all
// the per-fragment tests" (Vulkan specification, "Sample Counting").
//
// With early tests, fragment shading "should" come after the counting, "but may be performed
// before" ("Fragment Operations"): what is discarded then may be counted at profile vulkan, and is
// from practice on.
//
// What is counted of a sample are fragments of its paths (ref/path/path.hpp), of those that the
// device's planes allow: so a count has to go with all that the device shows. The counts of several
// draws are not held against each other, nor those of several samples.
//
// Where a device's hits are wrong, or not known, any triangle of a draw may have been counted, but
// no more than have hit or ought to have: the samples that are right still bound the whole number.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "cases/model/profile.hpp"
#include "ref/expectation/expectation.hpp"

namespace ref {

struct CountBounds {
    uint64_t least = 0, most = 0;
    friend bool operator==(const CountBounds&, const CountBounds&) = default;
};

// What a device shows at a sample.
struct ShownSample {
    bool is_right = true;  // else any of the triangles may have been counted
    path::Observed paths;
    std::optional<uint32_t> hits = {};  // how many, if that is known
    // Whether the colour is that of some path that satisfies what was observed; empty: any is.
    std::function<bool(const path::Observed&)> has_color = {};
};

// How many of a draw's fragments pass all tests at a sample, on the paths that a device's planes
// allow: those that show, and, `with_discarded`, those that are discarded then.
CountBounds passed_at(const Expectation& e, const cases::Case& c, size_t index, uint32_t draw,
                      const ShownSample& shown, bool with_discarded);
// How many of them a query counts.
CountBounds counted_at(const Expectation& e, const cases::Case& c, size_t index, uint32_t draw,
                       const ShownSample& shown);
using ShownAt = std::function<ShownSample(size_t index)>;

// What the queries of a case may count, one entry a draw, with what a device shows. `shown` empty:
// whatever a device may show.
std::vector<CountBounds> count_bounds(const Expectation& expectation, const cases::Case& c,
                                      const ShownAt& shown);

}  // namespace ref
