// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth test, bias, clamp and store worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "ref/expectation/expectation.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/value/reference.hpp"
#include "tests/unit/ref/value_case.hpp"

namespace ref::test {
namespace {

using cases::CompareOp;
using cases::DepthFormat;
using cases::Profile;

// A triangle over the whole 4x4 target whose depth is z + gx x + gy y.
cases::Draw plane(double z, double gx = 0, double gy = 0) {
    cases::Draw d;
    const auto vertex = [&](double x, double y) {
        return value_test::clip_of(x, y, z + gx * x + gy * y, 1, 4);
    };
    d.positions = {vertex(-8, -8), vertex(16, -8), vertex(-8, 16)};
    d.viewport = {0, 0, 4, 4, 0, 1};
    d.scissor = {0, 0, 4, 4};
    return d;
}

// The same within the target, so that nothing is clipped.
cases::Draw half_plane(double z, double gx = 0, double gy = 0) {
    cases::Draw d = plane(z, gx, gy);
    const auto vertex = [&](double x, double y) {
        return value_test::clip_of(x, y, z + gx * x + gy * y, 1, 4);
    };
    d.positions = {vertex(0, 0), vertex(4, 0), vertex(0, 4)};
    return d;
}

cases::Case case_of(std::vector<cases::Draw> draws, DepthFormat format = DepthFormat::d32_float) {
    cases::Case c;
    c.id = "depth";
    c.target = {4, 4, 1};
    c.target.depth_format = format;
    c.draws = std::move(draws);
    return c;
}

constexpr size_t kSample = 0;  // pixel (0, 0), inside all of them

uint32_t hits(const cases::Case& c, Profile profile, uint32_t* most = nullptr) {
    const Expectation e = expect(c, Limits{}, profile);
    const HitBounds& b = e.samples[kSample].hits;
    if (most != nullptr) {
        *most = b.total_max;
    }
    return b.total_min;
}

void expect_hits(const cases::Case& c, uint32_t low, uint32_t high) {
    for (const Profile profile : cases::kProfiles) {
        uint32_t most = 0;
        EXPECT_EQ(hits(c, profile, &most), low) << cases::to_string(profile);
        EXPECT_EQ(most, high) << cases::to_string(profile);
    }
}

// Whether triangle 0 may leave this depth at pixel (0, 0).
bool accepts(const cases::Case& c, double depth, Profile profile) {
    ValueReference values(c, Limits{}, profile);
    FragmentValues device;
    device.depth = static_cast<float>(depth);
    return values.judge(0, {0, 0, 0}, device, FragmentPart::depth).ok;
}

TEST(DepthHand, EveryCompareOperation) {
    struct Row {
        CompareOp op;
        bool in_front, behind;
    };
    for (const Row& row :
         {Row{CompareOp::never, false, false}, Row{CompareOp::less, true, false},
          Row{CompareOp::equal, false, false}, Row{CompareOp::less_or_equal, true, false},
          Row{CompareOp::greater, false, true}, Row{CompareOp::not_equal, true, true},
          Row{CompareOp::greater_or_equal, false, true}, Row{CompareOp::always, true, true}}) {
        for (const DepthFormat format :
             {DepthFormat::d32_float, DepthFormat::d24_unorm, DepthFormat::d16_unorm}) {
            for (const double z : {0.25, 0.75}) {
                cases::Case c = case_of({half_plane(0.5), half_plane(z)}, format);
                c.draws[1].depth.compare = row.op;
                const bool passes = z < 0.5 ? row.in_front : row.behind;
                SCOPED_TRACE(static_cast<int>(row.op));
                expect_hits(c, passes ? 2 : 1, passes ? 2 : 1);
            }
        }
    }
}

// c = (-1, 0, 0, 0) is the direction to the left, so the triangle is a strip of depth 1/2, behind
// the plane of depth 1/4. Devices set depths up from 1/w of the vertices, and that of c has no
// value: no profile asks for a depth (value/fragment/promise.cpp), so none may ask for a test of it
// either.
TEST(DepthHand, NothingIsAskedOfATestOfADepthWithoutANumber) {
    cases::Case c = case_of({half_plane(0.25), half_plane(0.5)});
    c.draws[1].positions = {{0, -1, 0.5, 1}, {0, 0.5, 0.5, 1}, {-1, 0, 0, 0}};
    c.draws[1].depth.compare = CompareOp::less;
    expect_hits(c, 1, 2);
    c.draws[1].positions[2] = {-0x1p20F, 0, 0x1p-2F, 0x1p-1F};  // one that has
    expect_hits(c, 1, 1);
}

// Both planes are clamped to 1: equal in every format, by no interpolation.
TEST(DepthHand, ClampedDepthsAreEqual) {
    struct Row {
        CompareOp op;
        bool equal;
    };
    for (const Row& row :
         {Row{CompareOp::less, false}, Row{CompareOp::equal, true},
          Row{CompareOp::less_or_equal, true}, Row{CompareOp::greater, false},
          Row{CompareOp::not_equal, false}, Row{CompareOp::greater_or_equal, true}}) {
        for (const DepthFormat format :
             {DepthFormat::d32_float, DepthFormat::d24_unorm, DepthFormat::d16_unorm}) {
            cases::Case c = case_of({half_plane(0.5), half_plane(0.5)}, format);
            for (cases::Draw& d : c.draws) {
                d.viewport.max_depth = 0.25F;
                d.viewport.min_depth = 0.25F;  // an empty range: every depth is 1/4
                d.depth.clamp = true;
            }
            if (format != DepthFormat::d32_float) {
                // 65535/4 and 16777215/4 are no whole numbers of steps: 1 is.
                for (cases::Draw& d : c.draws) {
                    d.viewport.max_depth = d.viewport.min_depth = 1;
                }
            }
            c.draws[1].depth.compare = row.op;
            expect_hits(c, row.equal ? 2 : 1, row.equal ? 2 : 1);
        }
    }
}

TEST(DepthHand, EqualPlanesOfDifferentTrianglesAreOpen) {
    for (const CompareOp op : {CompareOp::equal, CompareOp::less, CompareOp::greater_or_equal}) {
        cases::Case c = case_of({half_plane(0.5, 0.01), plane(0.5, 0.01)});
        c.draws[1].depth.compare = op;
        expect_hits(c, 1, 2);
    }
}

// 1/4 + 0.4 steps and 1/4 + 0.9 steps of D16 have a code in common.
TEST(DepthHand, WithinAStepOfFixedPointIsOpen) {
    cases::Case c =
        case_of({half_plane(16384.4 / 65535), half_plane(16384.9 / 65535)}, DepthFormat::d16_unorm);
    c.draws[1].depth.compare = CompareOp::greater;
    uint32_t most = 0;
    EXPECT_EQ(hits(c, Profile::direct3d, &most), 1U);
    EXPECT_EQ(most, 2U);
    // Two steps apart they have none.
    c.draws[1] = half_plane(16386.9 / 65535);
    c.draws[1].depth.compare = CompareOp::greater;
    EXPECT_EQ(hits(c, Profile::direct3d, &most), 2U);
}

TEST(DepthHand, TheSameTriangleAgainIsEqual) {
    for (const CompareOp op : {CompareOp::less_or_equal, CompareOp::less}) {
        cases::Draw d = half_plane(0.3, 0.013, 0.007);
        d.depth.compare = op;
        cases::Case c = case_of({d, d});
        c.target.depth_clear = 1;
        const uint32_t count = op == CompareOp::less ? 1 : 2;
        expect_hits(c, count, count);
        // With fixed point the stored depth is rounded; devices round what is compared, too, and
        // Direct3D says so.
        c.target.depth_format = DepthFormat::d16_unorm;
        for (const Profile profile : cases::kProfiles) {
            const bool is_rounded = profile != Profile::vulkan;
            uint32_t most = 0;
            EXPECT_EQ(hits(c, profile, &most), is_rounded ? count : 1);
            EXPECT_EQ(most, is_rounded ? count : 2);
        }
        // Nothing is promised if another state differs.
        c.target.depth_format = DepthFormat::d32_float;
        c.draws[1].fragment_size = {2, 2};
        expect_hits(c, 1, 2);
    }
}

// Masks must not matter (Invariance, Rule 2, "Required"), and comparisons, stencils and other
// shaders do not in practice.
TEST(DepthHand, APrepassHasTheDepthsOfWhatFollows) {
    struct Row {
        const char* what;
        void (*change)(cases::Draw&);
        bool at_vulkan;
    };
    const Row rows[] = {
        {"nothing else", [](cases::Draw&) {}, true},
        {"depth write", [](cases::Draw& d) { d.depth.write = false; }, true},
        {"colour", [](cases::Draw& d) { d.color.write_mask = 0; }, true},
        {"comparison", [](cases::Draw& d) { d.depth.compare = CompareOp::equal; }, false},
        {"stencil", [](cases::Draw& d) { d.stencil.front.reference = 7; }, false},
        {"attributes",
         [](cases::Draw& d) {
             d.attributes.emplace_back();
             d.attributes.back().values.assign(3, {1, 2, 3, 4});
         },
         false},
    };
    for (const DepthFormat format :
         {DepthFormat::d32_float, DepthFormat::d24_unorm, DepthFormat::d16_unorm}) {
        for (const Row& row : rows) {
            cases::Draw d = half_plane(0.3, 0.013, 0.007);
            d.depth.compare = CompareOp::less_or_equal;
            cases::Case c = case_of({d, d}, format);
            c.target.depth_clear = 1;
            row.change(c.draws[1]);
            for (const Profile profile : cases::kProfiles) {
                const bool is_held = profile != Profile::vulkan ||
                                     (row.at_vulkan && format == DepthFormat::d32_float);
                uint32_t most = 0;
                EXPECT_EQ(hits(c, profile, &most), is_held ? 2U : 1U) << row.what;
                EXPECT_EQ(most, 2U) << row.what;
            }
        }
    }
}

// A depth that the shader writes may be gl_FragCoord.z of another place, where inputs are
// interpolated at the samples.
TEST(DepthHand, APrepassOfWrittenDepthsIsHeldWhereThereIsOnePlace) {
    for (const uint32_t samples : {1U, 4U}) {
        cases::Draw d = half_plane(0.3, 0.013, 0.007);
        d.depth.compare = CompareOp::less_or_equal;
        d.frag_depth.emplace();
        d.frag_depth->is_coord = true;
        cases::Case c = case_of({d, d});
        c.target.samples = samples;
        c.target.depth_clear = 1;
        c.draws[1].depth.compare = CompareOp::equal;
        EXPECT_EQ(hits(c, Profile::practice), 2U) << samples;
        c.draws[1].attributes.emplace_back();
        c.draws[1].attributes.back().values.assign(3, {1, 2, 3, 4});
        EXPECT_EQ(hits(c, Profile::practice), samples == 1 ? 2U : 1U) << samples;
    }
}

TEST(DepthHand, PlanesThatAreRApartAreDistinct) {
    for (const float constant : {-2.0F, 2.0F}) {
        for (const DepthFormat format : {DepthFormat::d32_float, DepthFormat::d16_unorm}) {
            cases::Draw d = half_plane(0.3, 0.013, 0.007);
            cases::Case c = case_of({d, d}, format);
            c.draws[1].depth.bias = cases::DepthBias{constant, 0, 0};
            c.draws[1].depth.compare = CompareOp::less;
            const uint32_t count = constant < 0 ? 2 : 1;
            expect_hits(c, count, count);
            c.draws[1].depth.bias->clamp = 0x1p-30F;  // then nothing is known of the distance
            c.draws[1].depth.bias->constant = 2;
            expect_hits(c, 1, 2);
        }
    }
}

// z = 5/8, e = -1: r = 2^-24. 2^16 of them are 2^-8.
TEST(DepthHand, UnitOfBinary32) {
    cases::Case c = case_of({half_plane(0.625)});
    c.draws[0].depth.bias = cases::DepthBias{65536, 0, 0};
    for (const Profile profile : cases::kProfiles) {
        EXPECT_TRUE(accepts(c, 0.625 + 0x1p-8, profile));
        EXPECT_FALSE(accepts(c, 0.625, profile));
        EXPECT_FALSE(accepts(c, 0.625 - 0x1p-8, profile));
        EXPECT_FALSE(accepts(c, 0.625 + 0x1p-7, profile));
        EXPECT_FALSE(accepts(c, 0.625 + 0x1p-9, profile));
    }
}

// D16: r in (0, 2 2^-16].
TEST(DepthHand, UnitOfFixedPoint) {
    cases::Case c = case_of({half_plane(0.5)}, DepthFormat::d16_unorm);
    c.draws[0].depth.bias = cases::DepthBias{1000, 0, 0};
    const auto step = [](double code) { return code / 65535; };
    for (const Profile profile : cases::kProfiles) {
        EXPECT_TRUE(accepts(c, step(32768 + 1000), profile));
        EXPECT_TRUE(accepts(c, step(32768 + 2000), profile));
        // A few steps; at profile vulkan 1e-5 for each of some operations is tens of them.
        const double slack = profile == Profile::vulkan ? 100 : 3;
        EXPECT_FALSE(accepts(c, step(32768 + 2000 + slack), profile));
        EXPECT_FALSE(accepts(c, step(32768 - slack), profile));
    }
}

// VK_EXT_depth_bias_control: r is 1; 2^-24 or up to twice that for binary32 forced to UNORM; 2^-n
// exactly.
TEST(DepthHand, UnitsThatTheApplicationChooses) {
    using Representation = cases::DepthBiasRepresentation;
    cases::Case c = case_of({half_plane(0.015625)});
    std::optional<cases::DepthBias>& bias = c.draws[0].depth.bias;
    for (const Profile profile : cases::kProfiles) {
        bias = cases::DepthBias{0.25F, 0, 0, Representation::floating, false};
        EXPECT_TRUE(accepts(c, 0.015625 + 0.25, profile));
        EXPECT_FALSE(accepts(c, 0.015625, profile));
        EXPECT_FALSE(accepts(c, 0.015625 + 0.5, profile));
        bias = cases::DepthBias{0x1p16F, 0, 0, Representation::force_unorm, true};
        EXPECT_TRUE(accepts(c, 0.015625 + 0x1p-8, profile));
        EXPECT_FALSE(accepts(c, 0.015625 + 0x1p-7, profile));
        EXPECT_FALSE(accepts(c, 0.015625 + 0x1p-13, profile));  // 2^(e-23)
        bias->is_exact = false;
        EXPECT_TRUE(accepts(c, 0.015625 + 0x1p-7, profile));
        EXPECT_FALSE(accepts(c, 0.015625 + 0x1p-6, profile));
    }
    c.target.depth_format = DepthFormat::d16_unorm;
    bias = cases::DepthBias{0x1p12F, 0, 0, Representation::format, true};
    EXPECT_TRUE(
        accepts(c, 5120.0 / 65535, Profile::direct3d));  // (2^-6 + 2^-4) (2^16 - 1) = 5119.9
    EXPECT_FALSE(accepts(c, 9215.0 / 65535, Profile::direct3d));
    bias->is_exact = false;
    EXPECT_TRUE(
        accepts(c, 9216.0 / 65535, Profile::direct3d));  // (2^-6 + 2^-3) (2^16 - 1) = 9215.9
}

// With an exact r nothing is promised of planes r apart.
TEST(DepthHand, ExactUnitsNeedNotBeDistinct) {
    const cases::Draw d = half_plane(0.3, 0.013, 0.007);
    cases::Case c = case_of({d, d});
    c.draws[1].depth.bias = cases::DepthBias{2, 0, 0};
    c.draws[1].depth.compare = CompareOp::less;
    expect_hits(c, 1, 1);
    c.draws[1].depth.bias->is_exact = true;
    expect_hits(c, 1, 2);
}

// Gradients 3/64 and 4/64: the larger is 1/16, the Euclidean norm 5/64.
TEST(DepthHand, SlopeBetweenTheNorms) {
    cases::Case c = case_of({half_plane(0.25, 3.0 / 64, 4.0 / 64)});
    c.draws[0].depth.bias = cases::DepthBias{0, 0, 2};
    const double z = 0.25 + 3.5 / 64;  // at (1/2, 1/2)
    for (const Profile profile : cases::kProfiles) {
        const bool is_strict = profile == Profile::direct3d;
        EXPECT_TRUE(accepts(c, z + 2.0 / 16, profile));
        EXPECT_EQ(accepts(c, z + 10.0 / 64, profile), !is_strict);
        EXPECT_EQ(accepts(c, z + 9.0 / 64, profile), !is_strict);
        EXPECT_FALSE(accepts(c, z + 14.0 / 64, profile));  // the sum
        EXPECT_FALSE(accepts(c, z + 6.0 / 64, profile));   // x alone
    }
    c.draws[0].depth.bias->clamp = 1.0F / 32;
    for (const Profile profile : cases::kProfiles) {
        EXPECT_TRUE(accepts(c, z + 1.0 / 32, profile));
        EXPECT_FALSE(accepts(c, z + 2.0 / 16, profile));
    }
    c.draws[0].depth.bias->clamp = -1.0F / 32;  // from below: no limit here
    EXPECT_TRUE(accepts(c, z + 2.0 / 16, Profile::direct3d));
    EXPECT_FALSE(accepts(c, z - 1.0 / 32, Profile::direct3d));
}

TEST(DepthHand, ClampIsExactAndAfterTheBias) {
    cases::Case c = case_of({half_plane(0.4)});  // 3/4 - 0.4/2 = 0.55: e = -1
    c.draws[0].viewport.min_depth = 0.75F;
    c.draws[0].viewport.max_depth = 0.25F;
    c.draws[0].depth.clamp = true;
    c.draws[0].depth.bias = cases::DepthBias{0x1p23F, 0, 0};  // 2^23 2^-24 = 1/2: beyond 3/4
    for (const Profile profile : cases::kProfiles) {
        EXPECT_TRUE(accepts(c, 0.75, profile));
        EXPECT_FALSE(accepts(c, std::nextafter(0.75F, 0.0F), profile));
        EXPECT_FALSE(accepts(c, std::nextafter(0.75F, 1.0F), profile));
        EXPECT_FALSE(accepts(c, 1, profile));
    }
}

// What is told of a depth is what is accepted: a bias of 1000 2^-24 on 1/2, and a clamp.
TEST(DepthHand, ToldDepthIsBiasedAndClamped) {
    const auto told = [](const cases::Case& c, Profile profile) {
        ValueReference values(c, Limits{}, profile);
        for (const ExpectedValue& e : values.expected(0, {0, 0, 0})) {
            if (e.quantity.is_depth()) {
                return e;
            }
        }
        return ExpectedValue{};
    };
    cases::Case c = case_of({half_plane(0.5)});
    c.draws[0].depth.bias = cases::DepthBias{1000, 0, 0};
    for (const Profile profile : cases::kProfiles) {
        EXPECT_EQ(told(c, profile).exact, mpq_class(0.5 + 1000 * 0x1p-24).get_str());
        EXPECT_DOUBLE_EQ(told(c, profile).nearest, 0.5 + 1000 * 0x1p-24);
    }
    c.draws[0].viewport.max_depth = 0.25F;
    c.draws[0].depth.clamp = true;
    c.draws[0].depth.bias->constant = 0x1p24F;
    EXPECT_EQ(told(c, Profile::direct3d).exact, "1/4");
    c.target.depth_format = DepthFormat::d16_unorm;  // 16383.75 steps
    EXPECT_EQ(told(c, Profile::direct3d).exact, mpq_class(16384, 65535).get_str());
}

// 1/4 is exact at a vertex with w = 1, and r is 2^-25: no device has an exponent less.
TEST(DepthHand, AnExactDepthHasOneUnitOfBias) {
    cases::Case c = case_of({half_plane(0.25)});
    c.draws[0].depth.bias = cases::DepthBias{0x1p15F, 0, 0};
    for (const Profile profile : {Profile::practice, Profile::direct3d}) {
        EXPECT_TRUE(accepts(c, 0.25 + 0x1p-10, profile));
        EXPECT_FALSE(accepts(c, 0.25 + 0x1p-11, profile));  // r = 2^-26
        EXPECT_FALSE(accepts(c, 0.25 + 0x1p-9, profile));
        EXPECT_FALSE(accepts(c, 0.25, profile));
    }
    // 1/w of 3 is rounded, so that 3/4 over 3 may be just below.
    for (glm::vec4& v : c.draws[0].positions) {
        v *= 3.0F;
    }
    EXPECT_TRUE(accepts(c, 0.25 + 0x1p-11, Profile::direct3d));
}

// The bounds that are told hold exactly the stored depths that are accepted, in every format.
TEST(DepthHand, ToldRangeIsWhatIsAccepted) {
    cases::Case c = case_of({half_plane(0.25)}, DepthFormat::d16_unorm);
    for (const Profile profile : {Profile::practice, Profile::direct3d}) {
        for (const bool is_biased : {false, true}) {
            c.draws[0].depth.bias.reset();
            if (is_biased) {
                c.draws[0].depth.bias = cases::DepthBias{7, 0, 0};
            }
            ValueReference values(c, Limits{}, profile);
            const ValueRange range = values.range(0, {0, 0, 0}, QuantityId{});
            ASSERT_TRUE(range.is_promised);
            for (uint32_t code = 16370; code < 16410; ++code) {
                const double depth = cases::depth_of_code(code, DepthFormat::d16_unorm);
                EXPECT_EQ(depth >= range.low && depth <= range.high, accepts(c, depth, profile))
                    << code;
            }
        }
    }
    c = case_of({half_plane(0.5)});
    c.draws[0].viewport.max_depth = 0.25F;
    c.draws[0].depth.clamp = true;
    // 1/8 after the viewport; r is 2^-26 or, just below 1/8, 2^-27: the bias is 1/2 at least.
    c.draws[0].depth.bias = cases::DepthBias{0x1p26F, 0, 0};
    for (const Profile profile : cases::kProfiles) {
        ValueReference values(c, Limits{}, profile);
        const ValueRange range = values.range(0, {0, 0, 0}, QuantityId{});
        EXPECT_EQ(range.low, 0.25);
        EXPECT_EQ(range.high, 0.25);
    }
}

// z = 1/4 is 16383.75 steps of D16: 16383 or 16384, and within 0.6 only the latter.
TEST(DepthHand, EitherNeighbourIsStored) {
    const cases::Case c = case_of({half_plane(0.25)}, DepthFormat::d16_unorm);
    EXPECT_TRUE(accepts(c, 16384.0 / 65535, Profile::direct3d));
    EXPECT_FALSE(accepts(c, 16383.0 / 65535, Profile::direct3d));
    EXPECT_TRUE(accepts(c, 16383.0 / 65535, Profile::practice));
    EXPECT_FALSE(accepts(c, 16382.0 / 65535, Profile::practice));
    EXPECT_FALSE(accepts(c, 16385.0 / 65535, Profile::practice));
}

TEST(DepthHand, AWriteThatIsOffKeepsTheOlderDepth) {
    cases::Case c = case_of({half_plane(0.5), half_plane(0.25), half_plane(0.375)});
    c.draws[1].depth.write = false;
    c.draws[2].depth.compare = CompareOp::less;
    expect_hits(c, 3, 3);
    const Expectation e = expect(c, Limits{}, Profile::vulkan);
    ASSERT_EQ(e.samples[kSample].depth_count, 1U);
    EXPECT_EQ(e.depth_writers[e.samples[kSample].depth_begin], 2U);
    EXPECT_FALSE(e.samples[kSample].depth_may_be_clear);
    c.draws[1].depth.write = true;
    expect_hits(c, 2, 2);
}

TEST(DepthHand, ExplanationNamesTheTest) {
    cases::Case c = case_of({half_plane(0.5), half_plane(0.75)});
    c.draws[1].depth.compare = CompareOp::less;
    const SampleExplanation s = explain_sample(c, Limits{}, Profile::direct3d, {0, 0, 0});
    ASSERT_EQ(s.triangles.size(), 2U);
    ASSERT_EQ(s.triangles[1].decision.coverage, Coverage::must) << s.triangles[1].sentence;
    EXPECT_EQ(s.triangles[1].depth, DepthOutcome::fails);
    EXPECT_EQ(s.triangles[1].depth_text.rfind("fails the depth test LESS, depth 0.7", 0), 0U)
        << s.triangles[1].depth_text;
}

}  // namespace
}  // namespace ref::test
