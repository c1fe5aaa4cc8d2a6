// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Right and wrong colour planes: what is accepted, what is told, at which level.
#include "ref/color/color.hpp"

#include <gmock/gmock.h>

#include "diff/verdict.hpp"
#include "perfect_capture.hpp"

namespace diff {
namespace {

using cases::ColorFormat;
using cases::Profile;

// Two overlapping triangles in two draws; colours of draws are set by the caller.
cases::Case two_draws(ColorFormat format, glm::vec4 clear) {
    cases::Case c = pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}});
    cases::Case other = pixel_case(8, 8, {{0, 0}, {8, 8}, {0, 8}});
    c.draws.push_back(other.draws[0]);
    c.target.color = {format, clear};
    c.target.has_instruments = false;
    c.target.has_depth = false;
    return c;
}

struct Drawn {
    cases::Case c;
    ref::Expectation expectation;
    capture::Capture capture;

    explicit Drawn(cases::Case the_case, Profile profile = Profile::direct3d)
        : c(std::move(the_case)), expectation(ref::expect(c, ref::Limits{8}, profile)) {
        ref::ColorReference reference(c, expectation);
        capture.target = c.target;
        capture.color.resize(capture.sample_count());
        for (uint32_t y = 0; y < 8; ++y) {
            for (uint32_t x = 0; x < 8; ++x) {
                capture.color[y * 8 + x] = reference.codes(y * 8 + x, {x, y, 0});
            }
        }
    }
    Verdict judge() const { return compare(c, expectation, capture); }
    capture::ColorCodes& at(uint32_t x, uint32_t y) { return capture.color[y * 8 + x]; }
};

cases::Case additive() {
    cases::Case c = two_draws(ColorFormat::rgba8_unorm, {0, 0, 0, 0});
    for (cases::Draw& draw : c.draws) {
        draw.color.value = {0.25F, 1, 0, 0.5F};
        draw.color.blend =
            cases::Blend{{cases::BlendFactor::one, cases::BlendFactor::one, cases::BlendOp::add},
                         {cases::BlendFactor::one, cases::BlendFactor::one, cases::BlendOp::add}};
    }
    return c;
}

TEST(Color, TheReferenceItselfIsRight) {
    const Drawn drawn(additive());
    const Verdict verdict = drawn.judge();
    EXPECT_TRUE(verdict.ok()) << verdict.error;
    EXPECT_EQ(drawn.capture.color[0 * 8 + 5][1], 255U);  // first alone
    EXPECT_GE(drawn.capture.color[5 * 8 + 1][3], 254U);  // both: 0.5 twice
    EXPECT_EQ(drawn.capture.color[5 * 8 + 6], (capture::ColorCodes{0, 0, 0, 0}));
}

TEST(Color, ALogicalOperationIsJudgedByItsRule) {
    cases::Case c = two_draws(ColorFormat::rgba8_uint, {170, 85, 0, 255});
    for (cases::Draw& draw : c.draws) {
        draw.color.value = {204, 240, 165, 60};
        draw.color.logic = cases::LogicOp::nand;
    }
    const Drawn drawn(c);
    EXPECT_TRUE(drawn.judge().ok()) << drawn.judge().error;
    // By hand: ~(170 & 204) = 119 once, ~(119 & 204) = 187 twice.
    EXPECT_EQ(drawn.capture.color[0 * 8 + 5][0], 119U);
    EXPECT_EQ(drawn.capture.color[5 * 8 + 1][0], 187U);
    // A copy, which is what a device leaves that has no such operations.
    Drawn wrong(c);
    wrong.at(5, 0) = {204, 240, 165, 60};
    const Verdict verdict = wrong.judge();
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].rule, "logic.operation");
    EXPECT_EQ(verdict.findings[0].level, Profile::vulkan);
    EXPECT_THAT(verdict.findings[0].expected, testing::HasSubstr("r 119"));
}

// "If there is no depth attachment then the depth test is skipped."
TEST(Color, NothingIsTestedWithoutADepthAttachment) {
    cases::Case c = additive();
    c.draws[1].depth.compare = cases::CompareOp::greater;  // than the first one's, which is as deep
    const ref::Expectation expectation = ref::expect(c, ref::Limits{8}, Profile::direct3d);
    const size_t both = 5 * 8 + 1;
    EXPECT_EQ(expectation.samples[both].hits.total_min, 2U);
    EXPECT_EQ(expectation.samples[both].hits.total_max, 2U);
    c.draws[1].depth.compare = cases::CompareOp::never;
    EXPECT_EQ(ref::expect(c, ref::Limits{8}, Profile::vulkan).samples[both].hits.total_min, 2U);
}

// Where alpha to coverage leaves the number of fragments open, the colour tells which one is
// missing, and each draw's are told by what holds of that draw, however many were told before.
TEST(Color, OfEachDrawThatIsMissingItsOwnRuleIsTold) {
    cases::Case c = pixel_case(32, 32, {{0, 0}, {64, 0}, {0, 64}});
    c.draws.push_back(pixel_case(32, 32, {{0, 0}, {32, 0}, {0, 12}}).draws[0]);
    // Its left edge goes through sample 0 of column 10, at 6/16 pixel.
    c.draws.push_back(pixel_case(32, 32, {{10.375F, 20}, {32, 26}, {10.375F, 32}}).draws[0]);
    c.target.samples = 4;
    c.target.color = {ColorFormat::rgba8_unorm, {0, 0, 0, 0}};
    c.target.has_instruments = false;
    c.target.has_depth = false;
    c.draws[0].color.value = {0.25F, 0, 0, 0.5F};
    c.draws[1].color.value = {0, 0.25F, 0, 1};
    c.draws[2].color.value = {0, 0, 0.25F, 0};
    for (cases::Draw& draw : c.draws) {
        draw.color.blend =
            cases::Blend{{cases::BlendFactor::one, cases::BlendFactor::one, cases::BlendOp::add},
                         {cases::BlendFactor::one, cases::BlendFactor::one, cases::BlendOp::add}};
        draw.color.alpha_to_coverage = &draw != &c.draws[2];
    }
    // The device keeps all of the first draw and nothing of the second; the third loses its edge.
    cases::Case device = c;
    for (cases::Draw& draw : device.draws) {
        draw.color.alpha_to_coverage = false;
    }
    for (const size_t left : {0U, 2U}) {
        device.draws[2].positions[left].x =
            pixel_case(32, 32, {{10.375F + 1 / 256.0F, 20}}).draws[0].positions[0].x;
    }
    device.draws.erase(device.draws.begin() + 1);
    const ref::Expectation of_device = ref::expect(device, ref::Limits{8}, Profile::direct3d);
    ref::ColorReference reference(device, of_device);
    capture::Capture capture;
    capture.target = c.target;
    capture.color.resize(capture.sample_count());
    for (size_t k = 0; k < capture.color.size(); ++k) {
        capture.color[k] = reference.codes(k, cases::sample_at(c.target, k));
    }
    const ref::Expectation expectation = ref::expect(c, ref::Limits{8}, Profile::direct3d);
    const Verdict verdict = compare(c, expectation, capture);
    size_t above = 0, on_edge = 0;
    for (const Finding& f : verdict.findings) {
        EXPECT_EQ(f.kind, FindingKind::missing);
        EXPECT_EQ(f.level, Profile::direct3d);
        above += f.y < 12 ? 1U : 0U;
        on_edge += f.x == 10 && f.y >= 20 ? 1U : 0U;
        EXPECT_EQ(f.rule, f.y < 12 ? "sample.alpha-to-coverage" : "tie.top-left") << f.y << f.why;
    }
    EXPECT_GE(above, 16U);
    EXPECT_GE(on_edge, 8U);
}

TEST(Color, ABlackPictureFails) {
    Drawn drawn(additive());
    std::fill(drawn.capture.color.begin(), drawn.capture.color.end(), capture::ColorCodes{});
    const Verdict verdict = drawn.judge();
    EXPECT_GT(verdict.counts[static_cast<size_t>(FindingKind::missing)], 20U);
    EXPECT_EQ(verdict.level, Profile::vulkan);
}

TEST(Color, PoisonIsAnError) {
    Drawn drawn(additive());
    drawn.at(3, 3) = {capture::kPoison, capture::kPoison, capture::kPoison, capture::kPoison};
    EXPECT_THAT(drawn.judge().error, testing::HasSubstr("was not copied"));
}

TEST(Color, MissingExtraTwiceAndOtherColours) {
    const auto only = [](Drawn& drawn) {
        const Verdict verdict = drawn.judge();
        EXPECT_EQ(verdict.findings.size(), 1U);
        return verdict.findings.empty() ? Finding() : verdict.findings[0];
    };
    {
        Drawn drawn(additive());
        drawn.at(5, 0) = {0, 0, 0, 0};
        EXPECT_EQ(only(drawn).kind, FindingKind::missing);
        EXPECT_EQ(only(drawn).rule, "cover.inside");
    }
    {
        Drawn drawn(additive());
        drawn.at(6, 5) = drawn.at(5, 0);
        EXPECT_EQ(only(drawn).kind, FindingKind::extra);
        EXPECT_EQ(only(drawn).rule, "cover.outside");
    }
    {
        Drawn drawn(additive());
        drawn.at(5, 0) = {128, 255, 0, 255};
        EXPECT_EQ(only(drawn).kind, FindingKind::double_hit);
    }
    {
        Drawn drawn(additive());
        drawn.at(5, 0)[2] = 9;
        const Finding finding = only(drawn);
        EXPECT_EQ(finding.kind, FindingKind::value);
        EXPECT_EQ(finding.rule, "blend.equation");
        EXPECT_EQ(finding.expected, "r 63 to 64, g 255, b 0, a 127 to 128");
        EXPECT_EQ(finding.level, Profile::vulkan);
    }
}

TEST(Color, AWrongOrderIsToldAsOne) {
    cases::Case c = two_draws(ColorFormat::rgba32_float, {0, 0, 0, 0});
    c.draws[0].color.value = {1, 0, 0, 1};
    c.draws[1].color.value = {0, 1, 0, 1};
    Drawn drawn(c);
    EXPECT_TRUE(drawn.judge().ok());
    drawn.at(1, 5) = drawn.at(5, 0);
    const Verdict verdict = drawn.judge();
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].kind, FindingKind::missing);  // without blending it looks so
    for (cases::Draw& draw : c.draws) {
        draw.color.value.w = 0.5F;
        draw.color.blend =
            cases::Blend{{cases::BlendFactor::src_alpha, cases::BlendFactor::one_minus_src_alpha,
                          cases::BlendOp::add},
                         {cases::BlendFactor::one, cases::BlendFactor::zero, cases::BlendOp::add}};
    }
    Drawn blended(c);
    EXPECT_TRUE(blended.judge().ok());
    std::swap(blended.at(1, 5)[0], blended.at(1, 5)[1]);
    ASSERT_EQ(blended.judge().findings.size(), 1U);
    EXPECT_EQ(blended.judge().findings[0].kind, FindingKind::order);
    EXPECT_EQ(blended.judge().findings[0].rule, "order.primitive");
}

TEST(Color, TruncationIsAFindingAtDirect3dAlone) {
    cases::Case c = two_draws(ColorFormat::rgba8_unorm, {0, 0, 0, 0});
    c.draws[0].color.value = {0.25F, 1, 0, 1};  // r = 63.75
    c.draws[1].color.value = {0.25F, 1, 0, 1};
    Drawn drawn(c);
    EXPECT_EQ(drawn.at(5, 0)[0], 64U);
    drawn.at(5, 0)[0] = 63;
    const Verdict verdict = drawn.judge();
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].rule, "store.unorm");
    EXPECT_EQ(verdict.findings[0].level, Profile::direct3d);
    drawn.at(5, 0)[0] = 62;
    EXPECT_EQ(drawn.judge().findings[0].level, Profile::vulkan);
}

// The colour alone fits another order; the writer that a device delivers denies it.
TEST(ColorJudge, AWriterDeniesAnotherOrder) {
    cases::Case c = two_draws(ColorFormat::r32_uint, {170, 0, 0, 0});
    c.draws[0].color.value = {51, 0, 0, 0};
    c.draws[1].color.value = {204, 0, 0, 0};
    c.draws[1].color.logic = cases::LogicOp::and_reverse;
    const ref::Expectation expectation = ref::expect(c, ref::Limits{8}, Profile::direct3d);
    ref::ColorReference reference(c, expectation);
    // Operands exchanged: 51 & ~204 = 51; in another order 204 & ~170 = 68, and then 51.
    const std::array<uint32_t, 4> codes = {51, 0, 0, 0};
    const cases::SampleId id{1, 2, 0};
    ref::ColorWitness witness;
    witness.paths.hits = {ref::path::SeenHits::Detail::total, 2, 0};
    witness.knows_fragments = true;
    EXPECT_EQ(reference.judge(17, id, codes, witness).kind, ref::ColorVerdict::Kind::value);
    EXPECT_NE(reference.judge(17, id, codes).kind, ref::ColorVerdict::Kind::value);
}

// The story of pixel (1, 2), which both triangles cover.
std::vector<std::string> steps_of(const cases::Case& c) {
    const ref::Expectation expectation = ref::expect(c, ref::Limits{8}, Profile::direct3d);
    std::vector<std::string> out;
    for (const ref::ColorStep& step : ref::ColorReference(c, expectation).steps(17, {1, 2, 0})) {
        out.push_back(step.sentence);
    }
    return out;
}

TEST(ColorSteps, ALogicalOperationIsTold) {
    cases::Case c = two_draws(ColorFormat::rgba8_uint, {170, 85, 0, 255});
    c.draws[0].color.value = {51, 15, 204, 1};
    c.draws[1].color.value = {204, 240, 165, 60};
    c.draws[1].color.logic = cases::LogicOp::and_reverse;
    c.draws[1].color.write_mask = 0x7;
    EXPECT_THAT(
        steps_of(c),
        ::testing::ElementsAre(
            "the target is cleared to r 170, g 85, b 0, a 255",
            "writes r 51, g 15, b 204, a 1; that leaves r 51, g 15, b 204, a 1",
            "writes r 204, g 240, b 165, a 60, of which the mask lets through r, g, b alone, and "
            "does the logical operation and-reverse: r 204 & ~51 = 204, g 240 & ~15 = 240, "
            "b 165 & ~204 = 33; that leaves r 204, g 240, b 33, a 1"));
}

TEST(ColorSteps, ASecondSourceAndAlphaToOneAreTold) {
    cases::Case c = two_draws(ColorFormat::rgba32_float, {0.5F, 0, 0, 0});
    c.draws[0].color.value = {0.25F, 0, 0, 0.5F};
    c.draws[0].color.blend = cases::Blend{
        {cases::BlendFactor::src1_alpha, cases::BlendFactor::zero, cases::BlendOp::add}, {}, {}};
    c.draws[0].color.blend->second = {0, 0, 0, 0.75F};
    c.draws[0].color.alpha_to_one = true;
    EXPECT_EQ(steps_of(c)[1],
              "writes r 0.25, g 0, b 0, a 0.5, whose alpha becomes 1, and blends it (colour source "
              "x src1-alpha + stored x zero; alpha source x one + stored x zero) with the second "
              "source (0, 0, 0, 0.75); that leaves r 0.1875, g 0, b 0, a 1");
}

TEST(ColorSteps, BlendingIsTold) {
    cases::Case c = two_draws(ColorFormat::r32_float, {0.5F, 0, 0, 0});
    c.draws[0].color.value = {0.25F, 0, 0, 0.5F};
    c.draws[0].color.blend = cases::Blend{
        {cases::BlendFactor::src_alpha, cases::BlendFactor::constant_color, cases::BlendOp::add},
        {},
        {0.75F, 0, 0, 0}};
    c.draws[1].color.value = {1, 0, 0, 0};
    c.draws[1].color.logic = cases::LogicOp::clear;
    const std::vector<std::string> steps = steps_of(c);
    ASSERT_EQ(steps.size(), 3U);
    // 0.25 x 0.5 + 0.5 x 0.75
    EXPECT_EQ(steps[1],
              "writes r 0.25, and blends it (colour source x src-alpha + stored x constant-color; "
              "alpha source x one + stored x zero) with the constants (0.75, 0, 0, 0); that leaves "
              "r 0.5");
    EXPECT_EQ(steps[2],
              "writes r 1, to a format that has no logical operations; that leaves "
              "r 1");
}

}  // namespace
}  // namespace diff
