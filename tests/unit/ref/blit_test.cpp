// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The blit reference: coordinates by hand, what is exact and what is free, the filter before the
// rationals against the rationals.
#include "ref/blit/blit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <utility>

namespace ref {
namespace {

using cases::BlitFilter;
using cases::ColorFormat;
using cases::Corners;
using cases::Profile;
using cases::TexelCodes;

constexpr std::array<Profile, 3> kProfiles = {Profile::vulkan, Profile::practice,
                                              Profile::direct3d};

cases::Case blit_case(uint32_t source, uint32_t target, const Corners& from, const Corners& to,
                      BlitFilter filter = BlitFilter::nearest,
                      ColorFormat format = ColorFormat::r32_uint) {
    cases::Case c;
    c.target = {target, target, 1};
    c.target.color = cases::ColorTarget{format, {}};
    c.target.has_instruments = false;
    c.target.has_depth = false;
    cases::Blit blit;
    blit.source_format = format;
    blit.source_width = source;
    blit.source_height = source;
    blit.filter = filter;
    blit.source = from;
    blit.destination = to;
    c.blit = blit;
    return c;
}

TexelCodes source_at(const cases::Case& c, int64_t x, int64_t y) {
    return cases::blit_source(*c.blit)[static_cast<size_t>(y * c.blit->source_width + x)];
}

}  // namespace

TEST(BlitReference, CoordinatesByHand) {
    const auto u = [](int32_t i, int32_t s0, int32_t s1, int32_t d0, int32_t d1) {
        const BlitCoordinate c = blit_coordinate(i, s0, s1, d0, d1);
        EXPECT_GT(c.denominator, 0);
        mpq_class v(c.numerator, static_cast<unsigned long>(c.denominator));
        v.canonicalize();
        return v;
    };
    EXPECT_EQ(u(0, 0, 8, 0, 8), mpq_class(1, 2));  // 1:1
    EXPECT_EQ(u(3, 0, 8, 0, 8), mpq_class(7, 2));
    EXPECT_EQ(u(0, 8, 0, 0, 8), mpq_class(15, 2));   // mirrored at the source
    EXPECT_EQ(u(0, 0, 8, 8, 0), mpq_class(15, 2));   // at the destination
    EXPECT_EQ(u(0, 8, 0, 8, 0), mpq_class(1, 2));    // at both: not mirrored
    EXPECT_EQ(u(5, 2, 4, 4, 12), mpq_class(19, 8));  // (5.5 - 4) * 2 / 8 + 2
    EXPECT_EQ(u(4, 0, 16, 4, 12), mpq_class(1));     // 2:1 down: on a border of texels
    EXPECT_EQ(u(0, 3, 10, 1, 4), mpq_class(11, 6));  // outside on the left: 3 - 7/6
}

TEST(BlitReference, OneToOneAndMirroredAllowOneTexelAtEveryProfile) {
    for (const Corners& from :
         {Corners{1, 2, 7, 6}, Corners{7, 2, 1, 6}, Corners{1, 6, 7, 2}, Corners{7, 6, 1, 2}}) {
        const cases::Case c = blit_case(8, 10, from, {3, 1, 9, 5});
        const BlitReference reference(c);
        for (const Profile profile : kProfiles) {
            for (uint32_t y = 0; y < 10; ++y) {
                for (uint32_t x = 0; x < 10; ++x) {
                    const bool inside = x >= 3 && x < 9 && y >= 1 && y < 5;
                    ASSERT_EQ(reference.is_inside(x, y), inside);
                    size_t allowed = reference.allows(x, y, {0, 0, 0, 0}, profile) ? 1U : 0U;
                    for (const TexelCodes& texel : cases::blit_source(*c.blit)) {
                        allowed += reference.allows(x, y, texel, profile) ? 1U : 0U;
                    }
                    EXPECT_EQ(allowed, 1U) << x << "," << y;
                    EXPECT_TRUE(reference.allows(x, y, reference.nominal(x, y), profile));
                }
            }
        }
        const int32_t i = from.x0 < from.x1 ? from.x0 : from.x0 - 1;
        const int32_t j = from.y0 < from.y1 ? from.y0 : from.y0 - 1;
        EXPECT_EQ(reference.nominal(3, 1), source_at(c, i, j));
    }
}

TEST(BlitReference, WholeUpscalesAllowOneTexel) {
    const cases::Case c = blit_case(5, 40, {0, 0, 5, 5}, {0, 5, 40, 40});
    const BlitReference reference(c);
    for (const Profile profile : kProfiles) {
        for (uint32_t y = 5; y < 40; ++y) {
            for (uint32_t x = 0; x < 40; ++x) {
                size_t allowed = 0;
                for (const TexelCodes& texel : cases::blit_source(*c.blit)) {
                    allowed += reference.allows(x, y, texel, profile) ? 1U : 0U;
                }
                ASSERT_EQ(allowed, 1U) << x << "," << y;
                ASSERT_EQ(reference.nominal(x, y), source_at(c, x / 8, (y - 5) / 7));
            }
        }
    }
}

TEST(BlitReference, HalvingAllowsTheTexelsOnBothSidesOfTheBorder) {
    const cases::Case c = blit_case(8, 4, {0, 0, 8, 8}, {0, 0, 4, 4});
    const BlitReference reference(c);
    for (const Profile profile : kProfiles) {
        EXPECT_TRUE(reference.has_freedom(1, 1, profile));
        for (int64_t j = 0; j < 8; ++j) {
            for (int64_t i = 0; i < 8; ++i) {
                // u = v = 3: texels 2 and 3
                EXPECT_EQ(reference.allows(1, 1, source_at(c, i, j), profile),
                          (i == 2 || i == 3) && (j == 2 || j == 3));
            }
        }
    }
}

TEST(BlitReference, LinearFiltersBetweenTexelCentresAndClampsAtTheEdge) {
    cases::Case c =
        blit_case(4, 16, {0, 0, 4, 4}, {0, 0, 16, 16}, BlitFilter::linear, ColorFormat::r32_float);
    c.blit->pattern = cases::BlitPattern::ramp;
    const BlitReference reference(c);
    const auto number = [](const TexelCodes& codes) {
        return static_cast<double>(std::bit_cast<float>(codes[0]));
    };
    const double a = number(source_at(c, 1, 1));
    const double right = number(source_at(c, 2, 1)) - a;
    const double down = number(source_at(c, 1, 2)) - a;
    // u = 6.5 / 4 = 1 + 5/8, minus 1/2: 1/8 of the way from texel 1 to 2; v alike.
    EXPECT_DOUBLE_EQ(number(reference.nominal(6, 6)), a + right / 8 + down / 8);
    EXPECT_EQ(reference.nominal(0, 0), source_at(c, 0, 0));  // u - 1/2 = -3/8: clamped
    const auto bits = [](double v) {
        return TexelCodes{std::bit_cast<uint32_t>(static_cast<float>(v)), 0, 0, 0};
    };
    for (const Profile profile : kProfiles) {
        const double v = number(reference.nominal(6, 6));
        const double step = (right + down) / 16;  // one step of 4-bit weights
        EXPECT_TRUE(reference.allows(6, 6, bits(v + 0.9 * step), profile));
        EXPECT_TRUE(reference.allows(6, 6, bits(v - 0.9 * step), profile));
        EXPECT_FALSE(reference.allows(6, 6, bits(v + 2 * step), profile));
        EXPECT_FALSE(reference.allows(6, 6, bits(v - 2 * step), profile));
        EXPECT_FALSE(reference.allows(6, 6, source_at(c, 1, 1), profile)) << "nearest";
    }
}

TEST(BlitReference, LinearMayClampAtTheImageOrAtTheRegion) {
    const cases::Case c =
        blit_case(4, 8, {1, 1, 3, 3}, {0, 0, 8, 8}, BlitFilter::linear, ColorFormat::rgba8_unorm);
    const BlitReference reference(c);
    // u = 1 + 1/8: 3/8 of the way from texel 1 to texel 0, outside the region.
    const TexelCodes by_region = source_at(c, 1, 1);
    EXPECT_TRUE(reference.allows(0, 0, by_region, Profile::practice));
    EXPECT_TRUE(reference.allows(0, 0, reference.nominal(0, 0), Profile::practice));
    EXPECT_NE(by_region, reference.nominal(0, 0));
    EXPECT_FALSE(reference.allows(0, 0, source_at(c, 0, 0), Profile::practice));
}

TEST(BlitReference, NaNAndInfinityAreNeverRight) {
    for (const BlitFilter filter : {BlitFilter::nearest, BlitFilter::linear}) {
        const cases::Case c =
            blit_case(4, 8, {0, 0, 4, 4}, {0, 0, 8, 8}, filter, ColorFormat::rgba16_float);
        const BlitReference reference(c);
        for (const uint32_t code : {0x7c00U, 0xfc00U, 0x7e00U}) {
            TexelCodes codes = reference.nominal(3, 3);
            codes[1] = code;
            EXPECT_FALSE(reference.allows(3, 3, codes, Profile::vulkan));
        }
    }
}

TEST(BlitReference, OutsideTheClearValueStaysAndItsZerosHaveEitherSign) {
    cases::Case c =
        blit_case(1, 2, {0, 0, 1, 1}, {0, 0, 1, 1}, BlitFilter::nearest, ColorFormat::rgba16_float);
    c.target.color->clear = {0.0F, -0.0F, 1.0F, -2.0F};
    const BlitReference reference(c);
    for (const Profile profile : kProfiles) {
        for (const uint32_t zero : {0x0000U, 0x8000U}) {
            EXPECT_TRUE(reference.allows(1, 1, {zero, zero, 0x3c00, 0xc000}, profile));
        }
        EXPECT_FALSE(reference.allows(1, 1, {0x0001, 0x8000, 0x3c00, 0xc000}, profile));
        EXPECT_FALSE(reference.allows(1, 1, {0x0000, 0x8000, 0x3c00, 0x4000}, profile));
    }
}

TEST(BlitReference, ConversionsAllowNeighbours) {
    cases::Case c =
        blit_case(4, 4, {0, 0, 4, 4}, {0, 0, 4, 4}, BlitFilter::nearest, ColorFormat::rgba8_unorm);
    c.blit->source_format = ColorFormat::rgba16_unorm;
    const BlitReference reference(c);
    const TexelCodes source = source_at(c, 2, 1);
    const double r = source[0] * 255.0 / 65535.0;
    TexelCodes codes = reference.nominal(2, 1);
    EXPECT_TRUE(reference.allows(2, 1, codes, Profile::direct3d));
    codes[0] = static_cast<uint32_t>(std::floor(r));
    EXPECT_TRUE(reference.allows(2, 1, codes, Profile::practice));
    codes[0] = static_cast<uint32_t>(std::ceil(r));
    EXPECT_TRUE(reference.allows(2, 1, codes, Profile::practice));
    codes[0] = static_cast<uint32_t>(std::floor(r)) - 1;
    EXPECT_FALSE(reference.allows(2, 1, codes, Profile::vulkan));
    codes[0] = static_cast<uint32_t>(std::ceil(r)) + 1;
    EXPECT_FALSE(reference.allows(2, 1, codes, Profile::vulkan));
}

TEST(ExhaustiveBlitReference, TheFilterAgreesWithTheRationals) {
    std::mt19937_64 random(7);
    const auto below = [&](uint64_t n) { return static_cast<int32_t>(random() % n); };
    size_t accepted = 0;
    for (int round = 0; round < 60; ++round) {
        const int32_t side = 2 + below(6);
        const int32_t target = 2 + below(12);
        Corners from{below(2), below(2), side - below(1), side};
        if (below(2) == 0) {
            std::swap(from.x0, from.x1);
        }
        const cases::Case c =
            blit_case(static_cast<uint32_t>(side), static_cast<uint32_t>(target), from,
                      {0, 0, target, target}, BlitFilter::linear, ColorFormat::rgba8_unorm);
        const BlitReference reference(c);
        for (int trial = 0; trial < 20; ++trial) {
            const auto x = static_cast<uint32_t>(below(static_cast<uint64_t>(target)));
            const auto y = static_cast<uint32_t>(below(static_cast<uint64_t>(target)));
            TexelCodes codes = reference.nominal(x, y);
            for (uint32_t& code : codes) {
                const uint32_t off = trial % 2 == 0 ? 2 : 20;
                code = std::min(255U, code + static_cast<uint32_t>(below(2 * off + 1)));
                code = code < off ? 0 : code - off;
            }
            for (const Profile profile : kProfiles) {
                const bool allowed = reference.allows_exact(x, y, codes, profile);
                ASSERT_EQ(reference.allows(x, y, codes, profile), allowed);
                accepted += allowed ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(accepted, 1000U);
    EXPECT_LT(accepted, 3300U);
}

namespace {

// Along one axis, by itself: the texels that a linear filter may read of destination texel i, a
// step of its weights more or less, clamped at the image.
std::pair<int64_t, int64_t> texels_read(int64_t i, int64_t source, int64_t target) {
    const double at =
        (static_cast<double>(i) + 0.5) * static_cast<double>(source) / static_cast<double>(target) -
        0.5;
    constexpr double kReach = 1.0 / 16 + 1e-3;
    const auto clamped = [&](double texel) {
        return std::clamp<int64_t>(static_cast<int64_t>(texel), 0, source - 1);
    };
    return {clamped(std::floor(at - kReach)), clamped(std::ceil(at + kReach))};
}

double linear_of(double code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace

// A device that keeps codes: each lerp goes to the codes on either side, with weights of 16ths.
TEST(BlitReference, AFilterOfCodesIsRightWhateverWayItRounds) {
    std::mt19937_64 random(11);
    for (int round = 0; round < 40; ++round) {
        const auto side = 2 + static_cast<int64_t>(random() % 6);
        const auto target = side + static_cast<int64_t>(random() % 12);
        const cases::Case c =
            blit_case(static_cast<uint32_t>(side), static_cast<uint32_t>(target),
                      {0, 0, static_cast<int32_t>(side), static_cast<int32_t>(side)},
                      {0, 0, static_cast<int32_t>(target), static_cast<int32_t>(target)},
                      BlitFilter::linear, ColorFormat::rgba8_unorm);
        const BlitReference reference(c);
        const auto split = [&](int64_t i) {
            const double at = (static_cast<double>(i) + 0.5) * static_cast<double>(side) /
                                  static_cast<double>(target) -
                              0.5;
            const double sixteenths = random() % 2 == 0 ? std::floor(at * 16) : std::ceil(at * 16);
            return std::pair(static_cast<int64_t>(std::floor(sixteenths / 16)),
                             sixteenths / 16 - std::floor(sixteenths / 16));
        };
        const auto lerp = [&](double a, double b, double t) {
            const double exact = a + (b - a) * t;
            return random() % 2 == 0 ? std::floor(exact) : std::ceil(exact);
        };
        for (int64_t y = 0; y < target; ++y) {
            for (int64_t x = 0; x < target; ++x) {
                const auto [i, alpha] = split(x);
                const auto [j, beta] = split(y);
                TexelCodes codes{};
                for (uint32_t k = 0; k < 4; ++k) {
                    const auto at = [&](int64_t column, int64_t row) {
                        return static_cast<double>(
                            source_at(c, std::clamp<int64_t>(column, 0, side - 1),
                                      std::clamp<int64_t>(row, 0, side - 1))[k]);
                    };
                    codes[k] = static_cast<uint32_t>(
                        lerp(lerp(at(i, j), at(i + 1, j), alpha),
                             lerp(at(i, j + 1), at(i + 1, j + 1), alpha), beta));
                }
                for (const Profile profile : kProfiles) {
                    ASSERT_TRUE(reference.allows(static_cast<uint32_t>(x), static_cast<uint32_t>(y),
                                                 codes, profile));
                }
            }
        }
    }
}

// What is stored lies among the texels, or a code beside them, which storing may take; of sRGB
// among their linear numbers, each right to a code, as codes of 8 bits.
TEST(BlitReference, NothingBeyondAllTexelsIsRight) {
    for (const ColorFormat format : {ColorFormat::rgba8_unorm, ColorFormat::rgba8_srgb}) {
        const bool is_srgb = format == ColorFormat::rgba8_srgb;
        uint64_t refused = 0;
        for (int64_t side = 2; side <= 5; ++side) {
            const int64_t target = 7 * side;
            const cases::Case c =
                blit_case(static_cast<uint32_t>(side), static_cast<uint32_t>(target),
                          {0, 0, static_cast<int32_t>(side), static_cast<int32_t>(side)},
                          {0, 0, static_cast<int32_t>(target), static_cast<int32_t>(target)},
                          BlitFilter::linear, format);
            const BlitReference reference(c);
            for (int64_t y = 0; y < target; y += 5) {
                for (int64_t x = 0; x < target; x += 3) {
                    const auto [left, right] = texels_read(x, side, target);
                    const auto [top, bottom] = texels_read(y, side, target);
                    TexelCodes codes =
                        reference.nominal(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
                    uint32_t least = 255, most = 0;
                    for (int64_t j = top; j <= bottom; ++j) {
                        for (int64_t i = left; i <= right; ++i) {
                            least = std::min(least, source_at(c, i, j)[0]);
                            most = std::max(most, source_at(c, i, j)[0]);
                        }
                    }
                    ASSERT_TRUE(codes[0] >= least && codes[0] <= most);
                    for (uint32_t code = 0; code < 256; ++code) {
                        // Far from the texels every eighth code is enough.
                        if (code % 8 != 0 && (code + 12 < least || code > most + 12)) {
                            continue;
                        }
                        const bool is_beyond =
                            is_srgb ? linear_of(code + 1) <
                                              std::floor(linear_of(static_cast<double>(least) - 1) *
                                                         255) /
                                                      255 -
                                                  1e-4 ||
                                          linear_of(code - (code > 0 ? 1 : 0)) >
                                              std::ceil(linear_of(static_cast<double>(most) + 1) *
                                                        255) /
                                                      255 +
                                                  1e-4
                                    : code + 1 < least || code > most + 1;
                        codes[0] = code;
                        for (const Profile profile : kProfiles) {
                            if (is_beyond) {
                                ++refused;
                                ASSERT_FALSE(reference.allows(static_cast<uint32_t>(x),
                                                              static_cast<uint32_t>(y), codes,
                                                              profile))
                                    << code << " of " << least << " to " << most;
                            }
                        }
                    }
                }
            }
        }
        EXPECT_GT(refused, 10000U);
    }
}

}  // namespace ref
