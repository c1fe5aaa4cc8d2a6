// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A software device: what a specification leaves free is a field of Device; what an author may get
// wrong is a Fault.
#pragma once

#include <cstdint>

#include "cases/fault/fault.hpp"

namespace software {

using cases::Fault;
using cases::kNoFault;
using cases::operator""_fault;

enum class Rounding : uint8_t { nearest_even, half_up, floor, ceil, truncate };

// Which edges of a clockwise (on screen) triangle own a sample that lies on them. The last two
// decide by the vertical edge first: a left (top) edge is the exactly vertical (horizontal) one.
enum class TieRule : uint8_t { top_left, top_right, bottom_left, bottom_right, left_top };

// How a value is computed at a fragment from the three vertices' values.
enum class PlaneForm : uint8_t {
    origin,       // a0 + x dadx + y dady, a0 at framebuffer (0,0); llvmpipe
    vertex,       // relative to the first vertex
    barycentric,  // sum of edge functions times values
};

// From which positions the planes are set up.
enum class PlaneBasis : uint8_t { unsnapped, snapped };

enum class ClipMethod : uint8_t {
    geometric,   // against all six planes
    guard_band,  // near, far and a wide band; the viewport's rectangle is a scissor
};

// Where an input decorated with Centroid is evaluated in a pixel that is covered in part.
enum class Centroid : uint8_t { first_sample, mean };  // Direct3D's; the mean of what is covered

// How a number becomes a code of UNORM; nearest_down: a number half-way between two takes the lower
// one (NVIDIA's Hopper). Down is left to a device by Vulkan, not by Direct3D; sRGB
// and what was blended in binary32 are rounded to nearest all the same.
enum class UnormRounding : uint8_t { nearest, nearest_even, nearest_down, down };
// What blends targets of 8 bits of fixed point; all others are blended in binary32. cut: in fixed
// point, and the source is cut to a multiple of 2^-12 before it becomes a code (NVIDIA's Hopper).
// one_product: all in binary32, and where the factors are f and 1 - f with one product, as
// d + f (s - d) (lavapipe).
enum class BlendMath : uint8_t { fixed, binary32, cut, one_product };
// A product of 8-bit numbers over 255: (x y + 127) / 255, or t = x y + 128, (t + (t >> 8)) >> 8.
enum class FixedMultiply : uint8_t { divide, shifts };

// Which samples alpha to coverage keeps: as many of the first ones as are nearest to alpha times
// their number, or more or fewer by the pixel, or as many of the last ones; or none or all,
// whatever alpha is, which Direct3D does not allow.
enum class AlphaMask : uint8_t { ordered, dithered, last, none, all };

// Where a linear filter that reaches beyond the blitted region is clamped.
enum class BlitEdge : uint8_t { image, region };

// By how much overestimation enlarges a triangle (primitiveOverestimationSize): not at all, by a
// unit of the subpixel grid, or by half a pixel.
enum class Overestimation : uint8_t { none, unit, half_pixel };

// What a device is free to choose. The default is llvmpipe's way.
struct Device {
    int subpixel_bits = 8;  // 4..12
    Rounding rounding = Rounding::nearest_even;
    TieRule ties = TieRule::top_left;
    PlaneForm planes = PlaneForm::origin;
    PlaneBasis basis = PlaneBasis::unsnapped;
    bool depth_has_other_basis = false;  // than all else; with planes of the form `origin`
    ClipMethod clip = ClipMethod::geometric;
    bool piece_planes = true;  // clipped triangles: planes of each piece, not of the whole triangle
    bool tests_distances = false;  // clip distances at each sample, not by cutting the polygon
    // The depth at each sample, not by cutting: of triangles before the eye that a depth plane
    // cuts.
    bool tests_depth = false;
    bool fused = false;         // a * b + c rounded once
    bool reciprocal_w = false;  // x * (1/w) instead of x / w
    bool near_reciprocal =
        false;                  // positions: that 1/w is often a unit in the last place too small
    bool scales_first = false;  // the viewport's scale is multiplied before the division
    Centroid centroid = Centroid::first_sample;
    bool inputs_follow_samples = true;     // with sample shading inputs are evaluated at the sample
    bool corner_inputs = false;            // with several samples undecorated ones near a corner
    bool coarse_inputs_at_sample = false;  // of several pixels: at the first covered sample
    bool facing_unsnapped = false;         // the sign of the area comes from unsnapped positions
    bool odd_quads = false;                // quads of derivatives begin at odd pixels
    int viewport_bits = 0;                 // viewportSubPixelBits
    bool keeps_viewport_grid = false;      // bounds of viewports are rounded to it, halves up
    // Barycentrics of strips in the first convention's order, with the last convention, too.
    bool first_strip_order = false;
    Overestimation overestimation = Overestimation::none;
    bool counts_borders = false;  // a triangle covers pixels that its border alone touches or fills
    bool mitres_corners = false;  // edges are moved, and meet where they do, however far away
    bool covers_by_piece = false;  // conservative draws: each piece of a clipped triangle by itself
    bool rasterizes_degenerates = true;  // degenerateTrianglesRasterized
    UnormRounding unorm = UnormRounding::nearest;
    bool narrow_through_eight = false;  // UNORM of fewer bits is the high bits of an 8-bit code
    BlendMath blend = BlendMath::fixed;
    FixedMultiply multiply = FixedMultiply::shifts;
    AlphaMask alpha_mask = AlphaMask::ordered;
    bool half_toward_zero = false;       // binary16 is rounded towards zero
    bool resolve_truncates = false;      // averages of codes are rounded down
    bool srgb_resolved_encoded = false;  // averages of sRGB are taken of the codes
    bool short_levels = false;           // levels of detail are kept from -16 to 31
    BlitEdge blit_edge = BlitEdge::image;
    bool blit_steps = false;  // coordinates of a blit are summed up from texel to texel
    // Pipeline statistics: vertices of incomplete primitives, each vertex of each primitive, whole
    // quads of fragments, whatever becomes of them. Else as little as must be counted.
    bool counts_most = false;
    Fault fault = kNoFault;
    // An error with a size: depths and inputs are evaluated so many pixels right of and below where
    // they should be.
    float place_x = 0, place_y = 0;
};

// primitiveOverestimationSize, pixels.
inline float overestimation(const Device& device) {
    switch (device.overestimation) {
        case Overestimation::none:
            return 0;
        case Overestimation::unit:
            return 1.0F / static_cast<float>(1 << device.subpixel_bits);
        case Overestimation::half_pixel:
            return 0.5F;
    }
    return 0;
}

}  // namespace software
