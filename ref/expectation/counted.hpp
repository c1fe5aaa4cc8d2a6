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
// The fragments that show at a sample are as many as its hits. So where the hits of a device are
// known, the count of each draw has to go with them, and of a sample that is open nothing is left
// open that one draw alone may have hit. More is left open than need be in two places: the counts
// of several draws that may own one hit are not held against each other, and of fragments that are
// discarded after early tests each is open by itself, also where a shared edge has exactly one.
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

// How many of a sample's fragments of the k-th of these draws are counted, where between `least`
// and `most` fragments of all draws show.
CountBounds counted_at(std::span<const CountedDraw> draws, size_t k, uint32_t least, uint32_t most,
                       cases::Profile profile);

// How many of them pass all tests at least, whether they are then discarded or not.
uint64_t passed_least(std::span<const CountedDraw> draws, size_t k, uint32_t least, uint32_t most);

// The hits of a device at a sample; nothing where they are not known.
using HitsAt = std::function<std::optional<uint32_t>(size_t index)>;

// What the queries of a case may count, one entry a draw, with the hits that a device shows.
// `hits` empty: whatever a device may show.
std::vector<CountBounds> count_bounds(const Expectation& expectation, size_t draws,
                                      const HitsAt& hits);

}  // namespace ref
