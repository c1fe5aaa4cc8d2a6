// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Fragments with several samples: coverage of a pixel, places of evaluation, sample masks.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "ref/expectation/expectation.hpp"
#include "ref/number/fixed_point.hpp"
#include "ref/value/accept/one_point.hpp"
#include "ref/value/fragment/fragment_coverage.hpp"
#include "ref/value/places.hpp"
#include "ref/value/reference.hpp"
#include "tests/unit/ref/multisample_fixture.hpp"
#include "tests/unit/ref/same_expectations.hpp"

namespace ref::test {
namespace {

using P = value::Point<mpq_class>;

TEST(PixelCoverage, IsThatOfTheTriangleAlone) {
    const cases::Case c = triangle(Auxiliary::none);
    const std::vector<cases::Triangle> triangles = assemble(c);
    FragmentCoverage coverage(c, {8}, Profile::direct3d, triangles);
    EXPECT_EQ(coverage.of(0, 2, 2).must, 0b1111U);
    EXPECT_EQ(coverage.of(0, 4, 3).must, 0b0101U);
    EXPECT_EQ(coverage.of(0, 4, 3).may, 0b0101U);
    EXPECT_EQ(coverage.of(0, 6, 6).may, 0U);
    EXPECT_TRUE(coverage.of(0, 4, 3).is_one_fragment);
}

TEST(ExhaustivePixelCoverage, FastIsExact) {
    std::mt19937_64 random(7);
    const auto coordinate = [&] {
        return static_cast<double>(random() % 4096) / 256 - 4 + 0.37 * (random() % 2 ? 1 : 0);
    };
    for (int round = 0; round < 60; ++round) {
        const uint32_t samples = 1U << random() % 5;
        const cases::Case c = pixels(8, 8,
                                     {{coordinate(), coordinate()},
                                      {coordinate(), coordinate()},
                                      {coordinate(), coordinate()}},
                                     samples);
        const std::vector<cases::Triangle> triangles = assemble(c);
        for (const Profile profile : cases::kProfiles) {
            FragmentCoverage coverage(c, {8}, profile, triangles);
            for (uint32_t k = 0; k < 64; ++k) {
                const PixelCoverage& fast = coverage.of(0, k % 8, k / 8);
                const PixelCoverage exact = coverage.exact(0, k % 8, k / 8);
                ASSERT_EQ(fast.must, exact.must) << round;
                ASSERT_EQ(fast.may, exact.may) << round;
            }
        }
    }
}

TEST(PixelRegion, IsPixelAndTriangle) {
    const cases::Case c = triangle(Auxiliary::none);
    const std::vector<cases::Triangle> triangles = assemble(c);
    FragmentCoverage coverage(c, {8}, Profile::direct3d, triangles);
    EXPECT_EQ(pixel_region(coverage.setup(0), {2, 2, 1, 1}).size(), 4U);
    // Below x + y = 8: the corner (5,4) is cut off between (5,3) and (4,4).
    const std::vector<P> part = pixel_region(coverage.setup(0), {4, 3, 1, 1});
    EXPECT_GE(part.size(), 3U);
    for (const P& p : part) {
        EXPECT_LE(p.x + p.y, 8);
        EXPECT_TRUE(p.x >= 4 && p.x <= 5 && p.y >= 3 && p.y <= 4);
    }
    EXPECT_TRUE(
        std::any_of(part.begin(), part.end(), [](const P& p) { return p.x == 5 && p.y == 3; }));
    EXPECT_TRUE(pixel_region(coverage.setup(0), {7, 7, 1, 1}).empty());
}

// Two distances each leave a corner of their own, and together nothing: the polygon has no points.
// Devices that test distances sample by sample may draw near by, and then the whole pixel counts.
TEST(PixelRegion, OfATriangleOfWhichDistancesLeaveNothingIsThePixel) {
    cases::Case c = triangle(Auxiliary::none);
    cases::Draw& draw = c.draws[0];
    draw.distances.clip_count = 2;
    draw.distances.clip = {{1, -2, 0, 0}, {-2, 1, 0, 0}, {-2, -2, 0, 0}};
    const std::vector<cases::Triangle> triangles = assemble(c);
    for (const Profile profile : cases::kProfiles) {
        FragmentCoverage coverage(c, {8}, profile, triangles);
        ASSERT_TRUE(coverage.setup(0).unclipped.vertices().empty());
        EXPECT_EQ(coverage.region(0, 2, 2).size(), 4U);
    }
}

// The last region is kept: another triangle, column or row has its own.
TEST(PixelRegion, IsThatOfTheTriangleAndPixelAskedFor) {
    const cases::Case c =
        pixels(8, 8, {{1, 1}, {7, 1}, {1, 7}, {7.25, 1.5}, {7.25, 7.5}, {1.5, 7.25}}, 4);
    const Expectation e = expect(c, {8}, Profile::vulkan);
    ASSERT_EQ(e.triangles.size(), 2U);
    FragmentCoverage coverage(c, {8}, Profile::vulkan, e.triangles);
    size_t parts = 0;
    const auto check = [&](uint32_t t, uint32_t x, uint32_t y) {
        const std::vector<P> right = pixel_region(coverage.setup(t), {x, y, 1, 1});
        const std::vector<P>& kept = coverage.region(t, x, y);
        ASSERT_TRUE(std::equal(kept.begin(), kept.end(), right.begin(), right.end(),
                               [](const P& a, const P& b) { return a.x == b.x && a.y == b.y; }))
            << t << " at " << x << "," << y;
        parts += right.size() > 4 || right.size() == 3 ? 1U : 0U;
    };
    for (uint32_t y = 0; y < 8; ++y) {
        for (uint32_t x = 0; x < 8; ++x) {
            for (const uint32_t t : {0U, 0U, 1U}) {
                check(t, x, y);
            }
            check(1, x, 7 - y);  // another row, and then another column alone
            check(1, 7 - x, 7 - y);
        }
    }
    EXPECT_GT(parts, 20U);
}

TEST(Places, WithoutDecorationTheCentreOrAnywhere) {
    const cases::Case c = triangle(Auxiliary::none);
    const Point centre{2.5, 2.5}, corner{2, 3}, sample{2.875, 2.375};
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, centre, centre)), "vpd");
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, corner, corner)), "vp-");
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, sample, sample)), "vp-");
    // Every input has its own place: practice asks for one.
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, centre, sample)), "v--");
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, {3.25, 2.5}, {3.25, 2.5})), "---");
}

TEST(Places, SampleIsExact) {
    const cases::Case c = triangle(Auxiliary::sample);
    const Point sample{2.875, 2.375};
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, sample, sample)), "vpd");
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, {2.5, 2.5}, {2.5, 2.5})), "---");
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, sample, {2.875, 2.4375})), "---");
}

TEST(Places, CentroidIsInsideThePrimitive) {
    const cases::Case c = triangle(Auxiliary::centroid);
    // A pixel that is covered as a whole: the centre, or anywhere inside.
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, {2.5, 2.5}, {2.5, 2.5})), "vpd");
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, {2.375, 2.125}, {2.375, 2.125})), "vp-");
    // One that is covered in part: the first covered sample, or anywhere inside.
    const Point first{4.375, 3.125}, own{4.125, 3.625}, outside{4.75, 3.75};
    EXPECT_EQ(accepted(c, kPart, fragment(kPart, first, first)), "vpd");
    EXPECT_EQ(accepted(c, kPart, fragment(kPart, own, own)), "vp-");
    EXPECT_EQ(accepted(c, kPart, fragment(kPart, first, own)), "v--");
    EXPECT_EQ(accepted(c, kPart, fragment(kPart, outside, outside)), "---");
}

TEST(Places, CentroidComesAfterTheSampleMask) {
    cases::Case c = triangle(Auxiliary::centroid);
    c.draws[0].multisample.sample_mask = 0b1110;
    const Point own{4.125, 3.625};  // sample 2, the first that is left
    EXPECT_EQ(accepted(c, kPart, fragment(kPart, own, own)), "vpd");
    EXPECT_EQ(accepted(c, kPart, fragment(kPart, {4.375, 3.125}, {4.375, 3.125})), "vp-");
}

TEST(Places, SampleShadingMovesInputs) {
    cases::Case c = triangle(Auxiliary::none);
    c.draws[0].multisample.min_sample_shading = 1.0F;
    FragmentValues v = fragment(kWhole, {2.875, 2.375}, {2.875, 2.375});
    v.frag_coord.x = 2.875F;
    v.frag_coord.y = 2.375F;
    EXPECT_EQ(accepted(c, kWhole, v), "vpd");
    // Another sample's place, which Vulkan does not forbid in words.
    v.frag_coord.x = 2.375F;
    v.frag_coord.y = 2.125F;
    EXPECT_EQ(accepted(c, kWhole, v), "v--");
    // x of one sample, y of another.
    v.frag_coord.y = 2.375F;
    EXPECT_EQ(accepted(c, kWhole, v), "---");
    v.frag_coord.x = 2.5F;
    v.frag_coord.y = 2.5F;
    EXPECT_EQ(accepted(c, kWhole, v), "---");
}

// FragCoord.z of a fragment that stands for some of its samples: at the centre or one of the
// samples at direct3d, between them at practice, anywhere at vulkan, whose text says nothing of its
// place. With two samples that list is as long as that of the pixel's corners, where practice lets
// inputs be evaluated.
TEST(Places, FragCoordStaysAmongTheSamples) {
    for (const uint32_t samples : {2U, 4U}) {
        cases::Case c = pixels(8, 8, {{1, 1}, {7, 1}, {1, 7}}, samples);
        c.draws[0].multisample.min_sample_shading = 1.0F / static_cast<float>(samples);
        // z = (x - 1) / 8 + (y - 1) / 16
        c.draws[0].positions[0].z = 0;
        c.draws[0].positions[1].z = 0.75F;
        c.draws[0].positions[2].z = 0.375F;
        const cases::SampleId id{2, 2, 1};
        const FixedPoint own = sample_position(id.x, id.y, id.sample, c.target);
        const auto z = [](double x, double y) {
            return static_cast<float>((x - 1) / 8 + (y - 1) / 16);
        };
        const auto at = [&](float frag_coord_z) {
            FragmentValues v;
            v.frag_coord = {2.5F, 2.5F, frag_coord_z, 1};
            v.depth = z(static_cast<double>(own.x) / 65536, static_cast<double>(own.y) / 65536);
            return v;
        };
        EXPECT_EQ(accepted(c, id, at(z(2.5, 2.5))), "vpd") << samples;
        const double x = static_cast<double>(own.x) / 65536, y = static_cast<double>(own.y) / 65536;
        EXPECT_EQ(accepted(c, id, at(z(x, y))), "vpd") << samples;
        // Direct3D has it at a place: not between two of them, however near to one.
        EXPECT_EQ(accepted(c, id, at(z((2.5 + x) / 2, (2.5 + y) / 2))), "vp-") << samples;
        EXPECT_EQ(accepted(c, id, at(z((40 + x) / 17, (40 + y) / 17))), "vp-") << samples;
        EXPECT_EQ(accepted(c, id, at(z(3, 3))), "v--") << samples;
        EXPECT_EQ(accepted(c, id, at(z(2, 2))), "v--") << samples;
        EXPECT_EQ(accepted(c, id, at(z(4, 3))), "---") << samples;
    }
}

TEST(Places, OwnLocationsDecide) {
    cases::Case c = triangle(Auxiliary::sample);
    c.target.sample_locations = {{0, 0}, {3, 5}, {15, 15}, {8, 8}};
    const Point own{2 + 3 / 16.0, 2 + 5 / 16.0};
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, own, own)), "vpd");
    EXPECT_EQ(accepted(c, kWhole, fragment(kWhole, {2.875, 2.375}, {2.875, 2.375})), "---");
}

// Where a sample lies at the centre there is one place to tell of.
TEST(Places, ASampleAtTheCentreIsNoOtherPlace) {
    cases::Case c = triangle(Auxiliary::none);
    c.target.sample_locations = {{1, 2}, {14, 3}, {2, 13}, {8, 8}};
    const auto z = [](uint32_t sample, cases::Profile profile, const cases::Case& of) {
        return ValueReference(of, Limits{}, profile)
            .range(0, {2, 2, sample}, QuantityId::of_frag_coord(2));
    };
    for (const cases::Profile profile : cases::kProfiles) {
        EXPECT_FALSE(z(3, profile, c).is_of_places);
        EXPECT_EQ(z(0, profile, c).is_of_places, profile == cases::Profile::direct3d);
    }
}

TEST(SampleMask, LeavesOnlyItsSamplesInBothImplementations) {
    cases::Case c = pixels(8, 8, {{1, 1}, {7, 1}, {1, 7}, {7, 1}, {7, 7}, {1, 7}}, 4);
    c.draws.push_back(c.draws[0]);
    c.draws[0].multisample.sample_mask = 0b0110;
    c.draws[1].multisample.shader_mask = 0b0011;
    for (const Profile profile : cases::kProfiles) {
        const Expectation fast = expect(c, {8}, profile);
        const Expectation exact = exact::expect(c, {8}, profile);
        EXPECT_TRUE(same_expectations(fast, exact));
        const uint32_t hits[] = {1, 2, 1, 0};
        for (uint32_t s = 0; s < 4; ++s) {
            EXPECT_EQ(hits_at(fast, 3, 3, s).total_min, hits[s]) << s;
            EXPECT_EQ(hits_at(fast, 3, 3, s).total_max, hits[s]) << s;
        }
    }
}

// A masked partner must not settle who owns a shared edge.
TEST(SampleMask, MaskedPartnerLeavesTheEdgeOpen) {
    cases::Case c = pixels(8, 8, {{0, 0}, {8, 0}, {0, 8}}, 4);
    c.target.sample_locations = {{8, 8}, {4, 4}, {12, 12}, {8, 4}};  // sample 0 is on the diagonal
    cases::Draw other = pixels(8, 8, {{8, 0}, {8, 8}, {0, 8}}, 4).draws[0];
    other.multisample.sample_mask = 0b1110;
    c.draws.push_back(other);
    const Expectation alone = expect(c, {8}, Profile::vulkan);
    const HitBounds& open = hits_at(alone, 3, 4, 0);
    EXPECT_EQ(open.total_min, 0U);
    EXPECT_EQ(open.total_max, 1U);
    c.draws[1].multisample.sample_mask = 0b1111;
    const Expectation both = expect(c, {8}, Profile::vulkan);
    EXPECT_EQ(hits_at(both, 3, 4, 0).total_min, 1U);
    EXPECT_EQ(hits_at(both, 3, 4, 0).total_max, 1U);
}

}  // namespace
}  // namespace ref::test
