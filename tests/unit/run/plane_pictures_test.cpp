// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Depths of the reference beside those of a device.
#include "run/plane_pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "capture/capture.hpp"
#include "cases/load/loader.hpp"
#include "ref/expectation/expectation.hpp"

namespace {

// z = x / 8 over a triangle that covers the centres x + y < 8, and 1/16 wherever the device draws.
report::Pictures pictures_of(const std::string& quantity, const std::string& more = "") {
    const auto loaded = cases::load_text(
        "format = 1\ndescription = \"A case.\"\nrules = [\"depth.linear\"]\n[target]\n"
        "size = [8, 8]\n[[draw]]\nvertices = [[0,0,0], [8,0,1], [0,8,0]]\n" +
            more,
        "case.toml", "case");
    EXPECT_TRUE(loaded);
    const cases::Case& c = loaded->front();
    const ref::Expectation expectation = ref::expect(c, {}, cases::Profile::direct3d);
    capture::Capture capture;
    capture.target = c.target;
    capture.depth.assign(64, c.target.depth_clear);
    for (size_t k = 0; k < 64; ++k) {
        if (expectation.samples[k].hits.total_min > 0) {
            capture.depth[k] = 0.0625F;
        }
    }
    diff::Verdict verdict;
    verdict.findings.resize(1);
    verdict.findings.front().quantity = quantity;
    const run::PictureWindow window(verdict, c.target);
    report::Pictures out = window.frame();
    run::add_depths(out, window, c, verdict, expectation, capture);
    return out;
}

// In row 0 columns 0 to 6 are covered; their depths, 1/16 to 13/16, are the whole scale.
TEST(DepthPicture, TheReferenceHasItsOwnDepths) {
    const report::Pictures p = pictures_of("depth");
    EXPECT_NEAR(p.depth_low, 0.0625, 1e-6);
    EXPECT_NEAR(p.depth_high, 0.8125, 1e-6);
    ASSERT_EQ(p.expected_depths.size(), 64U);
    ASSERT_EQ(p.device_depths.size(), 64U);
    for (size_t x = 0; x < 7; ++x) {
        EXPECT_EQ(p.expected_depths[x],
                  static_cast<uint8_t>(std::lround(1 + 254 * static_cast<double>(x) / 6)));
        EXPECT_EQ(p.device_depths[x], 1U);
    }
    EXPECT_EQ(p.expected_depths[7], 0U);  // nothing is drawn there
    EXPECT_EQ(p.device_depths[7], 0U);
}

// What leaves no depth has none to show: the scale is that of the device alone, which is no scale.
TEST(DepthPicture, WhatIsNotWrittenIsNotShown) {
    const report::Pictures p = pictures_of("frag_coord.z", "depth = { write = false }\n");
    EXPECT_TRUE(p.expected_depths.empty());
    EXPECT_TRUE(p.device_depths.empty());
}

// The reference's depths take time, and nobody asks for them where another number is wrong.
TEST(DepthPicture, DepthsOfTheReferenceAreOfWrongDepths) {
    EXPECT_TRUE(pictures_of("attribute 0.x").expected_depths.empty());
    EXPECT_EQ(pictures_of("frag_coord.z").expected_depths.size(), 64U);
}

}  // namespace
