// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/sample.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <sstream>

#include "cases/base/counted.hpp"

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

std::string to_text(std::span<const SampleLocations> lists) {
    std::string text;
    for (const SampleLocations& list : lists) {
        for (size_t s = 0; s < list.size(); ++s) {
            text += fmt::format("{}{},{}",
                                s > 0          ? ";"
                                : text.empty() ? ""
                                               : " ",
                                list[s][0], list[s][1]);
        }
    }
    return text;
}

Expected<std::vector<SampleLocations>> parse_sample_locations(std::string_view text) {
    std::vector<SampleLocations> lists;
    std::istringstream words{std::string(text)};
    for (std::string word; words >> word;) {
        SampleLocations& list = lists.emplace_back();
        std::istringstream pairs(word);
        for (std::string pair; std::getline(pairs, pair, ';');) {
            unsigned x = 0, y = 0;
            char comma = 0;
            std::istringstream numbers(pair);
            if (!(numbers >> x >> comma >> y) || comma != ',' || numbers.peek() != EOF || x > 15 ||
                y > 15) {
                return failure("'{}' is no sample location: write x,y in 1/16 pixel, 0 to 15",
                               pair);
            }
            list.push_back({static_cast<uint8_t>(x), static_cast<uint8_t>(y)});
        }
        if (list.size() != 2 && list.size() != 4 && list.size() != 8 && list.size() != 16) {
            return failure("'{}' has {}: write the locations of 2, 4, 8 or 16 samples", word,
                           counted(list.size(), "location"));
        }
    }
    return lists;
}

std::span<const std::array<uint8_t, 2>> sample_locations(const Target& target) {
    return target.sample_locations.empty() ? standard_sample_locations(target.samples)
                                           : std::span(target.sample_locations);
}

bool is_in_mask(const Multisample& state, uint32_t s) {
    return (((state.sample_mask & state.shader_mask.value_or(0xffffffffU)) >> s) & 1U) != 0;
}

AlphaCoverage alpha_coverage(const Draw& draw, const Target& target, Profile profile) {
    const ColorOutput& color = draw.color;
    const bool is_of_integers = target.color && is_integer(target.color->format);
    if (!color.alpha_to_coverage || is_of_integers) {
        return AlphaCoverage::all;
    }
    const bool is_told = profile == Profile::direct3d && color.attribute < 0 &&
                         target.samples > 1 && !draw.multisample.shader_mask;
    const float alpha = color.value.w;
    if (is_told && !(alpha > 0)) {
        return AlphaCoverage::none;
    }
    return is_told && alpha >= 1 ? AlphaCoverage::all : AlphaCoverage::any;
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
