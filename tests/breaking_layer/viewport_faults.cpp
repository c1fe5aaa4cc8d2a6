// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Viewport and scissor rectangles, moved, scaled, rounded, mixed up.
#include <array>
#include <cmath>

#include "fault.hpp"

namespace breaking {

namespace {

// Half a subpixel of 8 subPixelPrecisionBits, in pixels: what viewports are moved by so many of.
constexpr float kHalfSubpixel = 0x1p-9F;
constexpr int kSubpixel = 2, kHalfPixel = 256;
constexpr float kScale = 1.0F + 0x1p-16F;

// A fault of each viewport by itself.
template <bool (*alter)(VkViewport&)>
bool each(std::span<VkViewport> viewports) {
    bool altered = false;
    for (VkViewport& v : viewports) {
        altered = alter(v) || altered;
    }
    return altered;
}

template <bool (*alter)(VkRect2D&)>
bool each(std::span<VkRect2D> scissors) {
    bool altered = false;
    for (VkRect2D& s : scissors) {
        altered = alter(s) || altered;
    }
    return altered;
}

template <int by>
bool move_x(VkViewport& v) {
    return change(v.x, v.x + by * kHalfSubpixel);
}
template <int by>
bool move_y(VkViewport& v) {
    return change(v.y, v.y + by * kHalfSubpixel);
}
bool scale_x(VkViewport& v) {
    return change(v.width, v.width * kScale);
}
bool scale_y(VkViewport& v) {
    return change(v.height, v.height * kScale);
}
bool round_down(VkViewport& v) {
    const bool x = change(v.x, std::floor(v.x));
    const bool y = change(v.y, std::floor(v.y));
    const bool width = change(v.width, std::floor(v.width));
    const bool height = change(v.height, std::floor(v.height));
    return x || y || width || height;
}
bool positive_height(VkViewport& v) {
    if (v.height >= 0) {
        return false;
    }
    v.y += v.height;
    v.height = -v.height;
    return true;
}
bool mirror_y(VkViewport& v) {
    v.y += v.height;
    v.height = -v.height;
    return true;
}
bool whole_depth(VkViewport& v) {
    const bool least = change(v.minDepth, 0);
    return change(v.maxDepth, 1) || least;
}
bool swap_depth(VkViewport& v) {
    const float least = v.minDepth;
    const bool altered = change(v.minDepth, v.maxDepth);
    v.maxDepth = least;
    return altered;
}
bool ordered_depth(VkViewport& v) {
    return v.minDepth > v.maxDepth && swap_depth(v);
}
bool scale_depth(VkViewport& v) {
    return change(v.maxDepth, v.maxDepth * (1.0F - 0x1p-16F));
}

bool all_as_first(std::span<VkViewport> viewports) {
    for (VkViewport& v : viewports) {
        v = viewports[0];
    }
    return viewports.size() > 1;
}
bool scissors_as_first(std::span<VkRect2D> scissors) {
    for (VkRect2D& s : scissors) {
        s = scissors[0];
    }
    return scissors.size() > 1;
}

bool move_scissor_x(VkRect2D& s) {
    return s.offset.x < 0x7fff && change(s.offset.x, s.offset.x + 1);
}
bool move_scissor_y(VkRect2D& s) {
    return s.offset.y < 0x7fff && change(s.offset.y, s.offset.y + 1);
}
bool widen_scissor(VkRect2D& s) {
    return s.extent.width < 0x7fff && change(s.extent.width, s.extent.width + 1);
}
bool heighten_scissor(VkRect2D& s) {
    return s.extent.height < 0x7fff && change(s.extent.height, s.extent.height + 1);
}
bool shorten_scissor(VkRect2D& s) {
    return s.extent.height > 0 && change(s.extent.height, s.extent.height - 1);
}
bool no_scissor(VkRect2D& s) {
    constexpr VkRect2D kAll = {{0, 0}, {0x7fff, 0x7fff}};
    const bool altered = s.offset.x != 0 || s.offset.y != 0 || s.extent.width < 0x7fff;
    s = kAll;
    return altered;
}

constexpr std::array kViewportFaults = {
    Fault{"viewport-x-256th",
          "The viewport lies 1/256 pixel too far right.",
          {.viewports = each<move_x<kSubpixel>>}},
    Fault{"viewport-y-256th",
          "The viewport lies 1/256 pixel too low.",
          {.viewports = each<move_y<kSubpixel>>}},
    Fault{"viewport-x-minus-256th",
          "The viewport lies 1/256 pixel too far left.",
          {.viewports = each<move_x<-kSubpixel>>}},
    Fault{"viewport-x-512th",
          "The viewport lies half a subpixel too far right.",
          {.viewports = each<move_x<1>>}},
    Fault{"viewport-x-half",
          "The viewport lies half a pixel too far right.",
          {.viewports = each<move_x<kHalfPixel>>}},
    Fault{"viewport-y-half",
          "The viewport lies half a pixel too low.",
          {.viewports = each<move_y<kHalfPixel>>}},
    Fault{"viewport-width-scaled",
          "The viewport is wider by the factor 1 + 2^-16.",
          {.viewports = each<scale_x>}},
    Fault{"viewport-height-scaled",
          "The viewport is higher by the factor 1 + 2^-16.",
          {.viewports = each<scale_y>}},
    Fault{"viewport-whole-pixels", "viewport-rounded"_fault, {.viewports = each<round_down>}},
    Fault{"viewport-positive-height",
          "height-sign-ignored"_fault,
          {.viewports = each<positive_height>}},
    Fault{"viewport-mirrored", "viewport-mirrored-y"_fault, {.viewports = each<mirror_y>}},
    Fault{"viewport-first-for-all", "viewport-first-for-all"_fault, {.viewports = all_as_first}},
    Fault{"depth-range-ignored", "depth-range-ignored"_fault, {.viewports = each<whole_depth>}},
    Fault{"depth-range-swapped", "depth-range-swapped"_fault, {.viewports = each<swap_depth>}},
    Fault{"depth-range-ordered", "depth-range-ordered"_fault, {.viewports = each<ordered_depth>}},
    Fault{"depth-range-scaled",
          "The far end of the depth range is smaller by the factor 1 - 2^-16.",
          {.viewports = each<scale_depth>}},
    Fault{"scissor-x-moved", "scissor-right"_fault, {.scissors = each<move_scissor_x>}},
    Fault{"scissor-y-moved", "scissor-low"_fault, {.scissors = each<move_scissor_y>}},
    Fault{"scissor-wider", "scissor-wider"_fault, {.scissors = each<widen_scissor>}},
    Fault{"scissor-higher", "scissor-higher"_fault, {.scissors = each<heighten_scissor>}},
    Fault{"scissor-lower", "scissor-row-lost"_fault, {.scissors = each<shorten_scissor>}},
    Fault{"scissor-ignored", "scissor-ignored"_fault, {.scissors = each<no_scissor>}},
    Fault{"scissor-first-for-all", "scissor-first-for-all"_fault, {.scissors = scissors_as_first}},
};

}  // namespace

std::span<const Fault> viewport_faults() {
    return kViewportFaults;
}

}  // namespace breaking
