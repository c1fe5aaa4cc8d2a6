// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Fragments with several samples: coverage of a pixel, places of evaluation, built-ins. Attributes
// are planes whose values are positions, so that expectations can be written down.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "ref/expectation.hpp"
#include "ref/fragment_coverage.hpp"
#include "ref/one_point.hpp"
#include "ref/sample.hpp"
#include "ref/value.hpp"
#include "ref/value_places.hpp"
#include "tests/unit/ref/coverage_fixture.hpp"

namespace ref::test {
namespace {

using cases::Auxiliary;
using cases::Profile;
using cases::Source;
using P = value::Point<mpq_class>;

// The triangle (1,1) (7,1) (1,7) of 8x8 pixels with four samples.
cases::Case triangle(Auxiliary auxiliary) {
    cases::Case c = pixels(8, 8, {{1, 1}, {7, 1}, {1, 7}}, 4);
    cases::Attribute position;  // x, y
    position.interpolation = cases::Interpolation::noperspective;
    position.components = 2;
    position.auxiliary = auxiliary;
    position.values = {{1, 1, 0, 0}, {7, 1, 0, 0}, {1, 7, 0, 0}};
    cases::Attribute sum;  // x + 2 y
    sum.auxiliary = auxiliary;
    sum.values = {{3, 0, 0, 0}, {9, 0, 0, 0}, {15, 0, 0, 0}};
    c.draws[0].attributes = {position, sum};
    return c;
}

// A device that evaluates the first attribute at p, the second at q.
FragmentValues fragment(SampleId id, Point p, Point q) {
    FragmentValues v;
    v.frag_coord = {static_cast<float>(id.x) + 0.5F, static_cast<float>(id.y) + 0.5F, 0.5F, 1};
    v.depth = 0.5F;
    v.attributes[0] = {static_cast<float>(p[0]), static_cast<float>(p[1]), 0, 0};
    v.attributes[1] = {static_cast<float>(q[0] + 2 * q[1]), 0, 0, 0};
    return v;
}

// The profiles that accept a fragment, as letters; the oracle has to agree.
std::string accepted(const cases::Case& c, SampleId id, const FragmentValues& v) {
    std::string out;
    for (const Profile profile : cases::kProfiles) {
        ValueReference values(c, {8}, profile);
        const FragmentVerdict fast = values.judge(0, id, v);
        const FragmentVerdict exact = values.judge_exact(0, id, v);
        EXPECT_EQ(fast.ok, exact.ok) << cases::to_string(profile);
        out += fast.ok ? cases::to_string(profile).substr(0, 1) : "-";
        if (!fast.ok) {
            // The level of a finding is the loosest profile that forbids it.
            const auto first = out.find('-');
            for (const ValueMismatch& m : fast.mismatches) {
                EXPECT_LE(m.level, profile);
                EXPECT_GE(m.level, cases::kProfiles[first]);
            }
        }
    }
    return out;
}

constexpr SampleId kWhole{2, 2, 1};  // all four samples are covered
// Pixel (4,3) is cut by x + y = 8: samples 0 (4.375,3.125) and 2 (4.125,3.625) are covered, the
// centre lies on the edge.
constexpr SampleId kPart{4, 3, 2};

TEST(PixelCoverage, IsThatOfTheTriangleAlone) {
    const cases::Case c = triangle(Auxiliary::none);
    const std::vector<Triangle> triangles = assemble(c);
    FragmentCoverage coverage(c, {8}, Profile::direct3d, triangles);
    EXPECT_EQ(coverage.of(0, 2, 2).must, 0b1111U);
    EXPECT_EQ(coverage.of(0, 4, 3).must, 0b0101U);
    EXPECT_EQ(coverage.of(0, 4, 3).may, 0b0101U);
    EXPECT_EQ(coverage.of(0, 6, 6).may, 0U);
    EXPECT_TRUE(coverage.of(0, 4, 3).is_one_fragment);
}

TEST(PixelCoverage, FastIsExact) {
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
        const std::vector<Triangle> triangles = assemble(c);
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
    const std::vector<Triangle> triangles = assemble(c);
    FragmentCoverage coverage(c, {8}, Profile::direct3d, triangles);
    EXPECT_EQ(pixel_region(coverage.setup(0), 2, 2).size(), 4U);
    // Below x + y = 8: the corner (5,4) is cut off between (5,3) and (4,4).
    const std::vector<P> part = pixel_region(coverage.setup(0), 4, 3);
    EXPECT_GE(part.size(), 3U);
    for (const P& p : part) {
        EXPECT_LE(p.x + p.y, 8);
        EXPECT_TRUE(p.x >= 4 && p.x <= 5 && p.y >= 3 && p.y <= 4);
    }
    EXPECT_TRUE(
        std::any_of(part.begin(), part.end(), [](const P& p) { return p.x == 5 && p.y == 3; }));
    EXPECT_TRUE(pixel_region(coverage.setup(0), 7, 7).empty());
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
        const std::vector<P> right = pixel_region(coverage.setup(t), x, y);
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

// FragCoord.z of a fragment that stands for some of its samples: between the centre and the samples
// at every profile but vulkan, whose text says nothing of its place. With two samples that list is
// as long as that of the pixel's corners, where practice lets inputs be evaluated.
TEST(Places, FragCoordStaysAmongTheSamples) {
    for (const uint32_t samples : {2U, 4U}) {
        cases::Case c = pixels(8, 8, {{1, 1}, {7, 1}, {1, 7}}, samples);
        c.draws[0].multisample.min_sample_shading = 1.0F / static_cast<float>(samples);
        // z = (x - 1) / 8 + (y - 1) / 16
        c.draws[0].positions[0].z = 0;
        c.draws[0].positions[1].z = 0.75F;
        c.draws[0].positions[2].z = 0.375F;
        const SampleId id{2, 2, 1};
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

cases::Case with_source(Source source, uint32_t components) {
    cases::Case c = triangle(Auxiliary::none);
    cases::Attribute a;
    a.source = source;
    a.components = components;
    c.draws[0].attributes = {a};
    return c;
}

FragmentValues built_in(SampleId id, glm::vec4 value, bool is_shaded) {
    FragmentValues v = fragment(id, {0, 0}, {0, 0});
    v.attributes[0] = value;
    if (is_shaded) {
        const auto& at = standard_sample_locations(4)[id.sample];
        v.frag_coord.x = static_cast<float>(id.x) + static_cast<float>(at[0]) / 16;
        v.frag_coord.y = static_cast<float>(id.y) + static_cast<float>(at[1]) / 16;
    }
    return v;
}

TEST(BuiltIns, SampleMaskInIsTheCoverage) {
    cases::Case c = with_source(Source::sample_mask_in, 1);
    const auto mask = [&](float m, bool is_shaded = false) {
        return accepted(c, kPart, built_in(kPart, {m, 0, 0, 0}, is_shaded));
    };
    EXPECT_EQ(mask(5), "vpd");
    EXPECT_EQ(mask(4), "---");   // sample 0 is covered, too
    EXPECT_EQ(mask(7), "---");   // sample 1 is not
    EXPECT_EQ(mask(1), "---");   // the sample itself is missing
    EXPECT_EQ(mask(21), "---");  // there is no sample 4
    EXPECT_EQ(mask(5.5F), "---");
    c.draws[0].multisample.sample_mask = 0b0100;
    EXPECT_EQ(mask(4), "vpd");
    EXPECT_EQ(mask(5), "---");
    c.draws[0].multisample = {};
    c.draws[0].multisample.min_sample_shading = 1.0F;
    EXPECT_EQ(mask(4, true), "vpd");
    EXPECT_EQ(mask(5, true), "v--");
    c.draws[0].multisample.min_sample_shading = 0.5F;
    EXPECT_EQ(mask(4, true), "vpd");
    EXPECT_EQ(mask(5, true), "vpd");
}

TEST(BuiltIns, SampleIdAndPosition) {
    const cases::Case id = with_source(Source::sample_id, 1);
    EXPECT_EQ(accepted(id, kPart, built_in(kPart, {2, 0, 0, 0}, true)), "vpd");
    EXPECT_EQ(accepted(id, kPart, built_in(kPart, {0, 0, 0, 0}, true)), "v--");
    EXPECT_EQ(accepted(id, kPart, built_in(kPart, {4, 0, 0, 0}, true)), "---");
    const cases::Case at = with_source(Source::sample_position, 2);
    EXPECT_EQ(accepted(at, kPart, built_in(kPart, {0.125F, 0.625F, 0, 0}, true)), "vpd");
    EXPECT_EQ(accepted(at, kPart, built_in(kPart, {0.375F, 0.125F, 0, 0}, true)), "v--");
    EXPECT_EQ(accepted(at, kPart, built_in(kPart, {0.375F, 0.625F, 0, 0}, true)), "---");
}

// Numbers of a quantity that a profile accepts, tried one by one; `put` writes one into a fragment.
template <class Put>
std::set<float> accepted_numbers(ValueReference& values, SampleId id, const std::string& quantity,
                                 const std::vector<float>& numbers, Put put) {
    std::set<float> out;
    for (const float n : numbers) {
        for (const float other : numbers) {
            FragmentValues v = fragment(id, {0, 0}, {0, 0});
            put(v, n, other);
            const FragmentVerdict verdict = values.judge(0, id, v);
            const auto blamed = std::count_if(
                verdict.mismatches.begin(), verdict.mismatches.end(), [&](const auto& m) {
                    return m.quantity.substr(0, m.quantity.find('.')) ==
                           quantity.substr(0, quantity.find('.'));
                });
            if (blamed == 0) {
                out.insert(n);
            }
        }
    }
    return out;
}

// What explain and the report say besides the likeliest number is what judging accepts.
TEST(BuiltIns, OtherNumbersThatAreRightAreTold) {
    std::vector<float> places;  // in the pixel
    for (const uint32_t k : {2U, 6U, 8U, 10U, 14U}) {
        places.push_back(static_cast<float>(k) / 16);
    }
    const std::vector<float> whole = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    size_t several = 0;
    size_t single = 0;
    const auto check = [&](const cases::Case& c, const std::string& name,
                           const std::vector<float>& numbers, bool is_in_framebuffer, auto put) {
        for (const Profile profile : cases::kProfiles) {
            for (const SampleId id : {kWhole, kPart, SampleId{4, 3, 0}}) {
                if (id.sample >= c.target.samples ||
                    (c.draws[0].multisample.sample_mask >> id.sample & 1U) == 0) {
                    continue;  // nothing is written there
                }
                ValueReference values(c, {8}, profile);
                const std::set<float> right = accepted_numbers(
                    values, id, name, numbers,
                    [&](FragmentValues& v, float a, float b) { put(v, id, a, b); });
                for (const ExpectedValue& e : values.expected(0, id)) {
                    if (e.quantity != name) {
                        continue;
                    }
                    EXPECT_TRUE(e.is_flat);
                    EXPECT_EQ(e.also.empty(), right.size() == 1) << e.also;
                    (e.also.empty() ? single : several) += 1;
                    const float base = is_in_framebuffer ? static_cast<float>(id.x) : 0;
                    EXPECT_EQ(right.count(static_cast<float>(e.nearest) - base), 1U);
                    if (e.also.find_first_not_of("or ,.0123456789") == std::string::npos) {
                        std::set<float> told = {static_cast<float>(e.nearest) - base};
                        std::istringstream list(e.also.empty() ? "" : e.also.substr(3));
                        for (std::string number; std::getline(list, number, ',');) {
                            told.insert(std::stof(number) - base);
                        }
                        EXPECT_EQ(told, right) << e.also;
                    }
                }
            }
        }
    };
    const auto at_x = [](FragmentValues& v, SampleId id, float x, float y) {
        v.frag_coord.x = static_cast<float>(id.x) + x;
        v.frag_coord.y = static_cast<float>(id.y) + y;
    };
    for (const Auxiliary auxiliary : {Auxiliary::none, Auxiliary::sample}) {
        for (const float least : {0.0F, 0.25F, 0.5F, 1.0F}) {
            cases::Case c = triangle(auxiliary);
            if (least > 0) {
                c.draws[0].multisample.min_sample_shading = least;
            }
            check(c, "frag_coord.x", places, true, at_x);
        }
    }
    const auto in_attribute = [](FragmentValues& v, SampleId, float x, float y) {
        v.attributes[0] = {x, y, 0, 0};
    };
    check(with_source(Source::sample_position, 2), "attribute 0.x", places, false, in_attribute);
    check(with_source(Source::sample_id, 1), "attribute 0.x", {0, 1, 2, 3, 4}, false, in_attribute);
    for (const float least : {0.0F, 0.5F, 1.0F}) {
        cases::Case c = with_source(Source::sample_mask_in, 1);
        if (least > 0) {
            c.draws[0].multisample.min_sample_shading = least;
        }
        check(c, "attribute 0.x", whole, false, in_attribute);
        for (const uint32_t mask : {0b0101U, 0b0100U, 0b0001U}) {
            c.draws[0].multisample.sample_mask = mask;
            check(c, "attribute 0.x", whole, false, in_attribute);
        }
    }
    cases::Case one = with_source(Source::sample_id, 1);
    one.target.samples = 1;
    check(one, "attribute 0.x", {0, 1, 2}, false, in_attribute);
    EXPECT_GT(several, 20U);
    EXPECT_GT(single, 20U);
}

TEST(BuiltIns, InvocationsAreCountedUp) {
    cases::Draw draw;
    EXPECT_EQ(value::least_invocations(draw, 8), 1U);
    draw.multisample.min_sample_shading = 0.0F;
    EXPECT_EQ(value::least_invocations(draw, 8), 1U);
    draw.multisample.min_sample_shading = 0.26F;
    EXPECT_EQ(value::least_invocations(draw, 8), 3U);
    EXPECT_EQ(value::shading_rate(draw, 8), value::ShadingRate::some);
    EXPECT_EQ(value::shading_rate(draw, 1), value::ShadingRate::fragment);
    draw.attributes.emplace_back().source = Source::sample_id;
    EXPECT_EQ(value::least_invocations(draw, 8), 8U);
}

TEST(SampleMask, LeavesOnlyItsSamplesInBothImplementations) {
    cases::Case c = pixels(8, 8, {{1, 1}, {7, 1}, {1, 7}, {7, 1}, {7, 7}, {1, 7}}, 4);
    c.draws.push_back(c.draws[0]);
    c.draws[0].multisample.sample_mask = 0b0110;
    c.draws[1].multisample.shader_mask = 0b0011;
    for (const Profile profile : cases::kProfiles) {
        const Expectation fast = expect(c, {8}, profile);
        const Expectation exact = exact::expect(c, {8}, profile);
        EXPECT_EQ(fast.samples, exact.samples);
        EXPECT_EQ(fast.writers, exact.writers);
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
