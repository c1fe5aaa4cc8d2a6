// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "scene.hpp"

#include <utility>

namespace histories {

namespace {

using Kind = ColorFormat::Kind;

// Vulkan specification, "Multisampling": the standard sample locations, in pixels.
constexpr std::array<std::array<double, 2>, 1> kOne = {{{0.5, 0.5}}};
constexpr std::array<std::array<double, 2>, 2> kTwo = {{{0.75, 0.75}, {0.25, 0.25}}};
constexpr std::array<std::array<double, 2>, 4> kFour = {
    {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};

}  // namespace

const std::array<ColorFormat, 12> kColorFormats = {{
    {"rgba8-unorm", {8, 8, 8, 8}, Kind::unorm},
    {"bgra8-unorm", {8, 8, 8, 8}, Kind::unorm},
    {"rgba8-srgb", {8, 8, 8, 8}, Kind::srgb},
    {"rgb10a2-unorm", {10, 10, 10, 2}, Kind::unorm},
    {"r5g6b5-unorm", {5, 6, 5, 0}, Kind::unorm},
    {"rgba16-unorm", {16, 16, 16, 16}, Kind::unorm},
    {"rgba16-float", {16, 16, 16, 16}, Kind::floating},
    {"rg16-float", {16, 16, 0, 0}, Kind::floating},
    {"rgba32-float", {32, 32, 32, 32}, Kind::floating},
    {"r32-float", {32, 0, 0, 0}, Kind::floating},
    {"r32-uint", {32, 0, 0, 0}, Kind::integer},
    {"rgba8-uint", {8, 8, 8, 8}, Kind::integer},
}};

Place place_of(const Scene& scene, size_t index) {
    Place place;
    place.sample = static_cast<uint32_t>(index % scene.samples);
    index /= scene.samples;
    place.x = static_cast<uint32_t>(index % scene.width);
    index /= scene.width;
    place.y = static_cast<uint32_t>(index % scene.height);
    place.layer = static_cast<uint32_t>(index / scene.height);
    const auto& at = scene.samples == 4   ? kFour[place.sample]
                     : scene.samples == 2 ? kTwo[place.sample]
                                          : kOne[0];
    place.at_x = place.x + at[0];
    place.at_y = place.y + at[1];
    return place;
}

std::array<std::array<double, 2>, 3> corners_of(const Triangle& triangle) {
    const double e = triangle.shape.edge;
    const bool is_beyond = triangle.shape.is_beyond;
    std::array<std::array<double, 2>, 3> corners = {{{-2, -2}, {10, -2}, {-2, 10}}};
    if (triangle.shape.cut == Shape::Cut::x) {
        corners = {{{e, -8}, {e, 10}, {is_beyond ? e + 8 : e - 8, 1}}};
    } else if (triangle.shape.cut == Shape::Cut::y) {
        corners = {{{-6, e}, {10, e}, {2.5, is_beyond ? e + 8 : e - 8}}};
    }
    if (triangle.is_reversed) {
        std::swap(corners[1], corners[2]);
    }
    return corners;
}

// Vulkan specification, "Basic Polygon Rasterization": a = -1/2 sum (x_i y_i+1 - x_i+1 y_i), whose
// positive sign is a counter-clockwise front face.
bool is_front(const Draw& draw, const Triangle& triangle) {
    const auto c = corners_of(triangle);
    double sum = 0;
    for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3;
        sum += c[i][0] * c[j][1] - c[j][0] * c[i][1];
    }
    return (-sum / 2 > 0) != draw.clockwise;
}

double value_of(size_t draw, size_t triangle) {
    return static_cast<double>(1 + 8 * draw + triangle);
}

}  // namespace histories
