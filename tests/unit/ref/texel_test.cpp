// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which texels coordinates may choose, and colours that are texels, against computations of their
// own.
#include "ref/value/texel.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "cases/model/texels.hpp"
#include "ref/color/color.hpp"
#include "ref/number/rational.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

using cases::Profile;
using value_test::Random;

// By trying each texel, in rationals.
TEST(Texel, IsAllowedUpToAStepFromItsCell) {
    Random random(1);
    uint64_t several = 0, edges = 0;
    for (int k = 0; k < 4000; ++k) {
        const uint32_t size = random.one_in(2) ? 4 : 64;
        const double grid = random.one_in(2) ? 16.0 : 4096.0;
        const double low = (random.below(4000) - 1000.0) / 2000 + random.below(16) / (grid * size);
        const double high = low + random.below(64) / (grid * size);
        for (const Profile profile : cases::kProfiles) {
            const mpq_class step(profile == Profile::vulkan ? mpq_class(1, 16) : mpq_class(1, 256));
            const auto [first, last] = value::texels_of(low, high, size, profile);
            ASSERT_LE(first, last);
            for (uint32_t i = 0; i < size; ++i) {
                const mpq_class from = mpq_class(low) * size, to = mpq_class(high) * size;
                const bool begins = i == 0 || to >= i - step;
                const bool ends = i + 1 == size || from < i + 1 + step;
                EXPECT_EQ(begins && ends, i >= first && i <= last)
                    << i << " of " << size << " for " << low << " to " << high;
            }
            several += first < last ? 1U : 0U;
            edges += low * size < 0 || high * size > size ? 1U : 0U;
        }
    }
    EXPECT_GT(several, 1000U);
    EXPECT_GT(edges, 1000U);
}

struct Corner {
    int x, y;  // pixels
    int w;
    mpq_class s, t;
};

// Half of the target, leaning: at (8, 0) w is 1, at (0, 8) it is 3.
const std::array<Corner, 3> kCorners = {{{0, 0, 1, mpq_class(5, 128), mpq_class(3, 128)},
                                         {8, 0, 1, mpq_class(121, 128), mpq_class(3, 128)},
                                         {0, 8, 3, mpq_class(5, 128), mpq_class(123, 128)}}};

cases::Case leaning(cases::ColorFormat format) {
    std::array<glm::vec4, 3> clip{}, at{};
    for (size_t v = 0; v < 3; ++v) {
        const Corner& c = kCorners.at(v);
        clip.at(v) = value_test::clip_of(c.x, c.y, 0.5, c.w, 8);
        at.at(v) = {c.s.get_d(), c.t.get_d(), 0, 0};
    }
    cases::Case c = value_test::make_case(8, clip);
    value_test::add_attribute(c, cases::Interpolation::smooth, 2, at);
    c.target.has_instruments = c.target.has_depth = false;
    c.target.color.emplace().format = format;
    c.draws[0].color.attribute = 0;
    c.draws[0].color.from = cases::ColorFrom::texels;
    return c;
}

// The texel at the centre of a pixel, by the formulas of perspective and of linear interpolation.
uint32_t texel_by_hand(uint32_t x, uint32_t y, mpq_class Corner::*which, bool is_perspective) {
    const mpq_class right(2 * x + 1, 16), down(2 * y + 1, 16);
    const std::array<mpq_class, 3> weights = {1 - right - down, right, down};
    mpq_class above = 0, below = 0;
    for (size_t v = 0; v < 3; ++v) {
        const mpq_class weight = weights.at(v) / (is_perspective ? kCorners.at(v).w : 1);
        above += weight * (kCorners.at(v).*which);
        below += weight;
    }
    return static_cast<uint32_t>(floor_of(mpq_class(above / below * cases::kTexels)).get_ui());
}

TEST(Texel, IsTheColourByHand) {
    const cases::Case c = leaning(cases::ColorFormat::rgba8_unorm);
    for (const Profile profile : cases::kProfiles) {
        const Expectation expectation = expect(c, Limits{8}, profile);
        ColorReference reference(c, expectation);
        uint64_t linear = 0, next = 0;
        for (uint32_t y = 0; y < 8; ++y) {
            for (uint32_t x = 0; x + y < 7; ++x) {
                const cases::SampleId id{x, y, 0};
                const size_t index = cases::index_of(c.target, id);
                const auto explains = [&](uint32_t i, uint32_t j, uint32_t blue = 255) {
                    return reference.explains(
                        index, id, {cases::texel_code(i), cases::texel_code(j), blue, 255});
                };
                const uint32_t i = texel_by_hand(x, y, &Corner::s, true);
                const uint32_t j = texel_by_hand(x, y, &Corner::t, true);
                EXPECT_TRUE(explains(i, j)) << x << ", " << y;
                EXPECT_FALSE(explains(i, j, 254));
                EXPECT_FALSE(explains(i + 2, j)) << x << ", " << y;
                EXPECT_FALSE(explains(i, j - std::min(j, 2U)) && j > 1) << x << ", " << y;
                next += explains(i + 1, j) || explains(i, j + 1) ? 1U : 0U;
                const uint32_t far = texel_by_hand(x, y, &Corner::t, false);
                if (far > j + 1) {
                    EXPECT_FALSE(explains(i, far)) << x << ", " << y;
                    ++linear;
                }
            }
        }
        EXPECT_GT(linear, 15U);  // pixels whose colour tells perspective
        EXPECT_LT(next, profile == Profile::vulkan ? 14U : 4U);
    }
}

// A number beside c / 255 is stored in binary32 as it is read.
TEST(Texel, MayBeReadBesideItsNumber) {
    const cases::Case c = leaning(cases::ColorFormat::rgba32_float);
    const Expectation expectation = expect(c, Limits{8}, Profile::direct3d);
    ColorReference reference(c, expectation);
    const cases::SampleId id{3, 2, 0};
    const auto bits = [](float v) { return std::bit_cast<uint32_t>(v); };
    const float red =
        static_cast<float>(cases::texel_code(texel_by_hand(3, 2, &Corner::s, true))) / 255;
    const float green =
        static_cast<float>(cases::texel_code(texel_by_hand(3, 2, &Corner::t, true))) / 255;
    const auto explains = [&](float r) {
        return reference.explains(cases::index_of(c.target, id), id,
                                  {bits(r), bits(green), bits(1), bits(1)});
    };
    EXPECT_TRUE(explains(red));
    EXPECT_TRUE(explains(std::nextafter(red, 1.0F)));
    EXPECT_FALSE(explains(red + 0x1p-16F));
}

// The formula and its copy for rasterizers, at the edges.
TEST(Texel, IsClampedToTheEdge) {
    EXPECT_EQ(cases::texel_at({-3, 2, 0, 0}).x, 32 / 255.0F);
    EXPECT_EQ(cases::texel_at({-3, 2, 0, 0}).y, (32 + 3 * 63) / 255.0F);
    EXPECT_EQ(cases::texel_at({1 / 64.0F, 0, 0, 0}).x, 35 / 255.0F);
    EXPECT_TRUE(std::isnan(cases::texel_at({std::nanf(""), 0, 0, 0}).x));
}

}  // namespace
}  // namespace ref::test
