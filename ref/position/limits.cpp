// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/position/limits.hpp"

#include <utility>

namespace ref {

Limits limits_of(uint32_t subpixel_bits, std::string_view sample_locations) {
    Limits limits{static_cast<int>(subpixel_bits)};
    if (auto lists = cases::parse_sample_locations(sample_locations)) {
        limits.sample_locations = std::move(*lists);
    }
    return limits;
}

std::optional<cases::Case> with_own_samples(const cases::Case& c, const Limits& limits) {
    if (!c.target.sample_locations.empty()) {
        return std::nullopt;
    }
    for (const cases::SampleLocations& own : limits.sample_locations) {
        if (own.size() == c.target.samples) {
            cases::Case placed = c;
            placed.target.sample_locations = own;
            return placed;
        }
    }
    return std::nullopt;
}

}  // namespace ref
