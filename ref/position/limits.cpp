// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/position/limits.hpp"

#include <utility>

#include "cases/model/derive.hpp"
#include "cases/model/device.hpp"
#include "cases/model/words.hpp"

namespace ref {

namespace {

// Nothing if the case has its own locations, or the device has the standard ones.
const cases::SampleLocations* own_locations(const cases::Target& target, const Limits& limits) {
    if (!target.sample_locations.empty()) {
        return nullptr;
    }
    for (const cases::SampleLocations& own : limits.sample_locations) {
        if (own.size() == target.samples) {
            return &own;
        }
    }
    return nullptr;
}

}  // namespace

cases::DepthFormat depth_beside_stencil(std::string_view word) {
    using enum cases::DepthFormat;
    return word == cases::word_of(d24_unorm) ? d24_unorm : d32_float;
}

Limits limits_of(uint32_t subpixel_bits, std::string_view sample_locations,
                 std::string_view beside_stencil) {
    Limits limits{static_cast<int>(cases::judged_subpixel_bits(subpixel_bits))};
    if (auto lists = cases::parse_sample_locations(sample_locations)) {
        limits.sample_locations = std::move(*lists);
    }
    limits.beside_stencil = depth_beside_stencil(beside_stencil);
    return limits;
}

std::optional<cases::Case> as_drawn(const cases::Case& c, const Limits& limits) {
    const cases::SampleLocations* own = own_locations(c.target, limits);
    const bool has_other_depth = cases::takes_depth_beside_stencil(c.target, limits.beside_stencil);
    if (own == nullptr && !has_other_depth) {
        return std::nullopt;
    }
    cases::Case drawn = c;
    if (own != nullptr) {
        drawn.target.sample_locations = *own;
    }
    if (has_other_depth) {
        drawn.target.depth_format = limits.beside_stencil;
    }
    return drawn;
}

}  // namespace ref
