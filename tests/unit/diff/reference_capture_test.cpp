// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The reference as a device: what it draws is accepted, and what became of a sample may happen as a
// whole.
#include <gtest/gtest.h>

#include <string>

#include "cases/load/loader.hpp"
#include "diff/verdict.hpp"
#include "rasterizers/captures.hpp"
#include "tests/unit/diff/perfect_capture.hpp"

namespace diff {
namespace {

cases::Case case_of(const std::string& text) {
    const auto loaded = cases::load_text(
        "format = 1\ndescription = \"A case.\"\nrules = [\"cover.inside\"]\n" + text, "case.toml",
        "case");
    EXPECT_TRUE(loaded) << (loaded ? "" : loaded.error().front().message);
    return loaded ? loaded->front() : cases::Case{};
}

Verdict judged(const cases::Case& c) {
    return compare(c, ref::expect(c, {}, cases::Profile::direct3d),
                   rasterizers::draw_by_reference(c));
}

// A triangle around the pixel, and one of which an edge runs by its sample 0, (3/8, 1/8): from
// (9/2, -31/4) to (-105/16, 107/8), E = -177/16 * 63/8 + 169/8 * 33/8 = 3/128, which is 1/1018 of
// a pixel. It leaves the target, and the corners that cutting makes are snapped by more. So the
// sample must be hit, and may be hit twice.
cases::Case open_case() {
    cases::Case c =
        pixel_case(1, 1, {{4, 12}, {4, -8}, {-2, 2}, {4.5, -7.75}, {-6.5625, 13.375}, {-2, 2}});
    c.target.samples = 4;
    c.target.color = cases::ColorTarget{};
    c.draws[0].color.value = {0, 0, 0, 1};
    return c;
}

TEST(ReferenceCapture, AnOpenTriangleIsNotDrawnInPlaceOfACertainOne) {
    for (const bool has_instruments : {true, false}) {
        cases::Case c = open_case();
        c.target.has_instruments = has_instruments;
        const Verdict verdict = judged(c);
        EXPECT_TRUE(verdict.ok()) << verdict.error;
    }
}

TEST(ReferenceCapture, TheLastWriterGoesWithTheHits) {
    const cases::Case c = open_case();
    const ref::Expectation e = ref::expect(c, {}, cases::Profile::direct3d);
    const ref::SampleExpectation& sample = e.samples[0];
    ASSERT_EQ(sample.hits.total_min, 1U);
    ASSERT_EQ(sample.hits.total_max, 2U);
    ASSERT_EQ(sample.writers_count, 2U);
    const capture::Capture drawn = rasterizers::draw_by_reference(c);
    EXPECT_EQ(drawn.hits[0].x + drawn.hits[0].y, 1.0F);
    EXPECT_EQ(drawn.writers[0].primitive, 0U);
    EXPECT_EQ(drawn.color[0][3], 255U);
}

// Overestimated and cut by the target's border, so that values are free, and so is their sign: the
// nearest value at (1/2, 1/2) is negative, and drawn with it would be what a shader that discards
// negative values takes away. Whether the second triangle is drawn hangs on the stencil of the
// first.
TEST(ReferenceCapture, WhatMayBeDiscardedIsNotDrawnNegative) {
    const cases::Case c = case_of(R"(
[target]
size = [1, 1]
stencil = true
[[draw]]
conservative = "overestimate"
discard = "negative"
vertices = [[-8, -8], [-4, 16], [2, 0]]
[[draw.attribute]]
values = [0, 0, -1]
[[draw]]
stencil = { back = { compare = "greater", reference = 1 } }
vertices = [[2, 1], [0, 1], [0, 0]]
)");
    const Verdict verdict = judged(c);
    EXPECT_TRUE(verdict.ok()) << verdict.error;
}

// Where nobody counts hits, a stencil has none to be held to, and the first finding is a colour's.
TEST(ReferenceCapture, TheFirstFindingOfAColourBesideAStencil) {
    const cases::Case c = case_of(R"(
[target]
size = [4, 4]
stencil = true
attachments = "color"
[target.color]
format = "rgba8-unorm"
[[draw]]
stencil = { pass = "increment-wrap" }
color = { value = [1, 0, 0, 1] }
vertices = [[0, 0], [8, 0], [0, 8]]
)");
    const ref::Expectation e = ref::expect(c, {}, cases::Profile::vulkan);
    capture::Capture drawn = rasterizers::draw_by_reference(c);
    EXPECT_TRUE(compare(c, e, drawn, Wanted::first_finding).ok());
    drawn.color[5] = {0, 0, 0, 0};
    drawn.hits = decltype(drawn.hits)();  // no memory is left of them
    const Verdict verdict = compare(c, e, drawn, Wanted::first_finding);
    EXPECT_EQ(verdict.error, "");
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].x, 1U);
    EXPECT_EQ(verdict.findings[0].y, 1U);
}

}  // namespace
}  // namespace diff
