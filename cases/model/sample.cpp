// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/sample.hpp"

#include <fmt/format.h>

namespace cases {

namespace {

using Location = std::array<uint8_t, 2>;
constexpr Location kLocations1[] = {{8, 8}};
constexpr Location kLocations2[] = {{12, 12}, {4, 4}};
constexpr Location kLocations4[] = {{6, 2}, {14, 6}, {2, 10}, {10, 14}};
constexpr Location kLocations8[] = {{9, 5},  {7, 11}, {13, 9},  {5, 3},
                                    {3, 13}, {1, 7},  {11, 15}, {15, 1}};
constexpr Location kLocations16[] = {{9, 9},   {7, 5},  {5, 10},  {12, 7}, {3, 6}, {10, 13},
                                     {13, 11}, {11, 3}, {6, 14},  {8, 1},  {4, 2}, {2, 12},
                                     {0, 8},   {15, 4}, {14, 15}, {1, 0}};

}  // namespace

std::span<const std::array<uint8_t, 2>> standard_sample_locations(uint32_t samples) {
    switch (samples) {
        case 2:
            return kLocations2;
        case 4:
            return kLocations4;
        case 8:
            return kLocations8;
        case 16:
            return kLocations16;
        default:
            return kLocations1;
    }
}

std::span<const std::array<uint8_t, 2>> sample_locations(const Target& target) {
    return target.sample_locations.empty() ? standard_sample_locations(target.samples)
                                           : std::span(target.sample_locations);
}

bool is_in_mask(const Multisample& state, uint32_t s) {
    return (((state.sample_mask & state.shader_mask.value_or(0xffffffffU)) >> s) & 1U) != 0;
}

std::string pixel_text(const Target& target, const SampleId& id) {
    const std::string layer = target.layers > 1 ? fmt::format("layer {}, ", id.layer) : "";
    return fmt::format("{}pixel ({}, {})", layer, id.x, id.y);
}

std::string sample_text(const Target& target, const SampleId& id) {
    return pixel_text(target, id) +
           (target.samples > 1 ? fmt::format(", sample {}", id.sample) : std::string());
}

}  // namespace cases
