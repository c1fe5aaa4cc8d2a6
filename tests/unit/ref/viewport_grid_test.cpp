// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/position/viewport_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "ref/position/position.hpp"

namespace ref {

namespace {

using Bounds = std::tuple<float, float, float, float>;

cases::Case with_viewport(float x, float y, float width, float height) {
    cases::Case c;
    c.draws.resize(1);
    cases::Viewport& v = c.draws[0].viewport;
    v.x = x;
    v.y = y;
    v.width = width;
    v.height = height;
    return c;
}

std::set<Bounds> kept(const cases::Case& c, int bits) {
    Limits limits;
    limits.viewport_bits = bits;
    std::set<Bounds> all;
    for (const cases::Case& other : on_viewport_grids(c, limits)) {
        const cases::Viewport& v = other.draws[0].viewport;
        EXPECT_TRUE(all.emplace(v.x, v.y, v.width, v.height).second) << "told twice";
    }
    return all;
}

TEST(viewport_grid, viewports_on_the_grid_are_left_alone) {
    EXPECT_TRUE(kept(with_viewport(0, 0, 8, 8), 0).empty());
    EXPECT_TRUE(kept(with_viewport(0.25F, 0.5F, 7.75F, -8.25F), 2).empty());
    EXPECT_FALSE(kept(with_viewport(0.25F, 0.5F, 7.75F, 8), 1).empty());
    EXPECT_TRUE(is_on_viewport_grid(0.25F, 7.75F, 2));
    EXPECT_FALSE(is_on_viewport_grid(0.25F, 7.75F, 1));
    EXPECT_FALSE(is_on_viewport_grid(0, 7.75F, 1));
    // However little it is off.
    EXPECT_FALSE(is_on_viewport_grid(4, 0x1p-126F, 0));
    EXPECT_THAT(kept(with_viewport(0, 4, 8, 0x1p-126F), 0),
                testing::UnorderedElementsAre(Bounds{0, 4, 8, 1}));
}

TEST(viewport_grid, each_bound_moves_to_a_neighbour) {
    // Low bounds at 0.25 and 0, high ones at 6.75 and 8.
    EXPECT_THAT(kept(with_viewport(0.25F, 0, 6.5F, 8), 0),
                testing::UnorderedElementsAre(Bounds{0, 0, 6, 8}, Bounds{0, 0, 7, 8},
                                              Bounds{1, 0, 5, 8}, Bounds{1, 0, 6, 8}));
    // Nearest rounds the two axes apart where floor and ceil do not: 0.25 to 0, 0.75 to 1.
    EXPECT_THAT(
        kept(with_viewport(0.25F, 0.75F, 7.75F, 7.25F), 0),
        testing::UnorderedElementsAre(Bounds{0, 0, 8, 8}, Bounds{0, 1, 8, 7}, Bounds{1, 1, 7, 7}));
}

TEST(viewport_grid, a_negative_height_keeps_its_sign) {
    EXPECT_THAT(kept(with_viewport(0, 8.5F, 8, -8), 0),
                testing::UnorderedElementsAre(Bounds{0, 8, 8, -8}, Bounds{0, 8, 8, -7},
                                              Bounds{0, 9, 8, -9}, Bounds{0, 9, 8, -8}));
}

TEST(viewport_grid, nothing_is_kept_of_a_viewport_that_becomes_empty) {
    EXPECT_THAT(kept(with_viewport(0.25F, 0, 0.5F, 8), 0),
                testing::UnorderedElementsAre(Bounds{0, 0, 1, 8}));
}

TEST(viewport_grid, at_vulkan_a_position_moves_with_the_step_of_the_grid) {
    const auto width_of = [](float x, int bits) {
        Limits limits;
        limits.viewport_bits = bits;
        const cases::Case c = with_viewport(x, 0, 8, 8);
        const auto box =
            position_box({0, 0, 0, 1}, c.draws[0].viewport, limits, cases::Profile::vulkan);
        EXPECT_TRUE(box);
        return box ? static_cast<double>(box->x1 - box->x0) / (1 << 16) : 0;
    };
    const double on_grid = width_of(0.25F, 2);
    EXPECT_LT(on_grid, 0.02);
    EXPECT_DOUBLE_EQ(width_of(0.25F, 1), on_grid + 2 * 0.5);
    EXPECT_DOUBLE_EQ(width_of(0.25F, 0), on_grid + 2 * 1.0);
}

}  // namespace

}  // namespace ref
