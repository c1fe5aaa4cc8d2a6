// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What vkCmdBlitImage may leave in the destination, texel by texel. [Vulkan, copies-imagescaling]
// The source coordinate of destination texel i is u = (i + 1/2 - d0) * (s1 - s0) / (d1 - d0) + s0,
// exactly; what a device may add to it is derived at BlitReference::error_of.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cases/model/blit_source.hpp"
#include "cases/model/profile.hpp"
#include "ref/color/blend.hpp"
#include "ref/color/component.hpp"

namespace ref {

// VkPhysicalDeviceLimits::subTexelPrecisionBits is at least 4.
inline constexpr unsigned kSubTexelBits = 4;

// A rational source coordinate, in texels: numerator / denominator, denominator > 0.
struct BlitCoordinate {
    int64_t numerator = 0;    // below 2^31: (2 * 2^14) * 2^15 and s0 * 2 * 2^14
    int64_t denominator = 1;  // at most 2^15
};
// u of a destination texel along one axis: `s0`, `s1`, `d0`, `d1` are the corners' coordinates.
BlitCoordinate blit_coordinate(int32_t i, int32_t s0, int32_t s1, int32_t d0, int32_t d1);

class BlitReference {
  public:
    // The case has a blit, and a colour target that it writes to.
    explicit BlitReference(const cases::Case& c);

    // True if the blit writes texel (x, y).
    bool is_inside(uint32_t x, uint32_t y) const;
    // The codes nearest to what the target is cleared to.
    const cases::TexelCodes& clear_codes() const { return clear_; }
    // True if a clear may leave these codes: a zero of either sign, and of a number between two
    // codes what a store may make of it.
    bool is_clear(const cases::TexelCodes& got, cases::Profile profile) const;

    // True if these codes are allowed at texel (x, y).
    bool allows(uint32_t x, uint32_t y, const cases::TexelCodes& got, cases::Profile profile) const;
    // The same by rationals alone, without the shortcuts: the oracle.
    bool allows_exact(uint32_t x, uint32_t y, const cases::TexelCodes& got,
                      cases::Profile profile) const;
    // True if some codes are allowed beside the nominal ones (at texels inside).
    bool has_freedom(uint32_t x, uint32_t y, cases::Profile profile) const;

    // What a device without rounding errors stores: nearest codes, the lower texel at a border.
    cases::TexelCodes nominal(uint32_t x, uint32_t y) const;
    // One sentence: where the texel's value comes from.
    std::string explain(uint32_t x, uint32_t y) const;

  private:
    // Texel numbers along an axis, first to last, that a coordinate within the error may name.
    struct TexelRange {
        int64_t first = 0, last = 0;
    };
    struct Axis {
        int32_t s0, s1, d0, d1;
        uint32_t size;  // of the source
        BlitCoordinate at(uint32_t i) const;
    };

    // By how much a device's coordinate along an axis may differ from u, in texels of the source.
    // One operation loses `unit`: 2^-24 in binary32, 1e-5 where only Vulkan's own bound counts.
    //
    // A device evaluates (i + 1/2 - d0) * scale + s0 directly, or draws a rectangle whose corners
    // carry s0 / W and s1 / W and multiplies by W again, or steps from texel to texel. The first
    // loses one division (2.5 ULP = 5 units), one product, one sum, each of magnitude at most W:
    // 7 W units; two more for W: 9 W. The second loses what an interpolated value may lose
    // (docs/precision.md): with |value| <= W, sum D_i <= 4 (X / D + Y / H) over the rectangle's two
    // triangles, and K = 2: 2 W (1 + 2 * 4 (X / D + Y / H)) units. Both together bound the third as
    // well, which is the first with a sum of at most X / D scales.
    mpq_class error_of(const Axis& axis, cases::Profile profile) const;
    bool allows_nearest(uint32_t x, uint32_t y, const cases::TexelCodes& got,
                        cases::Profile profile) const;
    bool allows_linear(uint32_t x, uint32_t y, const cases::TexelCodes& got, cases::Profile profile,
                       bool by_region) const;
    bool surely_linear(uint32_t x, uint32_t y, const cases::TexelCodes& got) const;
    std::vector<TexelRange> spans_of(const Axis& axis, uint32_t size, const mpq_class& error) const;
    bool converts(const cases::TexelCodes& texel, const cases::TexelCodes& got,
                  cases::Profile profile) const;
    // Component k of a texel, clamped at the image; only if the filter is linear.
    double number_at(int64_t x, int64_t y, uint32_t k) const;
    const cases::TexelCodes& texel(int64_t x, int64_t y, bool by_region) const;

    cases::Blit blit_;
    cases::ColorFormat format_;
    uint32_t width_, height_;  // of the target
    Axis across_, down_;
    std::array<color::Color, 3> cleared_;  // of each profile
    cases::TexelCodes clear_{};            // the nearest codes
    std::vector<cases::TexelCodes> texels_;
    std::vector<std::array<double, 4>> numbers_;
    // Of each profile, texel by texel: what a nearest filter may read.
    std::array<std::vector<TexelRange>, 3> columns_, rows_;
};

}  // namespace ref
