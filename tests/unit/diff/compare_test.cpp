// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The comparison must see one planted wrong sample of each class, name its rule and the loosest
// profile that it breaks, and must not see anything in a right picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diff/verdict.hpp"
#include "perfect_capture.hpp"

namespace {

using cases::Profile;
using diff::FindingKind;

constexpr ref::Limits kLimits{8};

// Two triangles that share the diagonal of an 8x8 square, through pixel centres.
cases::Case diagonal() {
    return pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}, {8, 0}, {8, 8}, {0, 8}});
}

struct Checked {
    cases::Case c;
    ref::Expectation e;
    capture::Capture capture;
    explicit Checked(cases::Case built, Profile profile = Profile::direct3d)
        : c(std::move(built)),
          e(ref::expect(c, kLimits, profile)),
          capture(perfect_capture(c, e)) {}
    size_t at(uint32_t x, uint32_t y) const { return size_t{y} * c.target.width + x; }
    diff::Verdict verdict() const { return diff::compare(c, e, capture); }
};

const diff::Finding& only(const diff::Verdict& v) {
    static const diff::Finding kNone;
    EXPECT_EQ(v.error, "");
    EXPECT_EQ(v.findings.size(), 1U);
    return v.findings.empty() ? kNone : v.findings[0];
}

TEST(Compare, RightPicturePassesAtEveryProfile) {
    for (const Profile profile : cases::kProfiles) {
        const Checked k(diagonal(), profile);
        const diff::Verdict v = k.verdict();
        EXPECT_TRUE(v.ok()) << v.error << (v.findings.empty() ? "" : v.findings[0].why);
        EXPECT_EQ(v.compared_samples, 64U);
        EXPECT_GE(v.must_samples, 28U);
        EXPECT_EQ(v.compared_values, 64U * 4);
    }
}

TEST(Compare, BlackPictureFails) {
    Checked k(diagonal());
    for (size_t i = 0; i < 64; ++i) {
        clear_sample(k.capture, i);
    }
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(v.counts[static_cast<size_t>(FindingKind::missing)], 64U);
    EXPECT_EQ(v.level, Profile::vulkan);
}

TEST(Compare, MissingInsideBreaksVulkan) {
    Checked k(diagonal());
    clear_sample(k.capture, k.at(1, 1));
    const diff::Verdict v = k.verdict();
    const diff::Finding& f = only(v);
    EXPECT_EQ(f.kind, FindingKind::missing);
    EXPECT_EQ(f.rule, "cover.inside");
    EXPECT_EQ(f.level, Profile::vulkan);
    EXPECT_EQ(f.expected, "1");
    EXPECT_EQ(f.got, "0");
    EXPECT_EQ(f.x, 1U);
    EXPECT_EQ(f.y, 1U);
    EXPECT_EQ(v.min_x, 1U);
    EXPECT_EQ(v.max_y, 1U);
}

TEST(Compare, GapOnSharedEdgeBreaksVulkan) {
    Checked k(diagonal());
    clear_sample(k.capture, k.at(3, 4));
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).kind, FindingKind::missing);
    EXPECT_EQ(only(v).rule, "cover.shared-edge");
    EXPECT_EQ(only(v).level, Profile::vulkan);
}

TEST(Compare, DoubleHitOnSharedEdgeBreaksVulkan) {
    Checked k(diagonal());
    set_hits(k.capture, k.at(3, 4), k.capture.hits[k.at(3, 4)].x * 2,
             k.capture.hits[k.at(3, 4)].y * 2);
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).kind, FindingKind::double_hit);
    EXPECT_EQ(only(v).rule, "cover.shared-edge");
    EXPECT_EQ(only(v).level, Profile::vulkan);
}

TEST(Compare, OtherOwnerOfATieBreaksDirect3dAlone) {
    // A single triangle: samples on its unshared hypotenuse are free in Vulkan.
    const cases::Case c = pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}});
    Checked k(c);
    const size_t tie = k.at(3, 4);
    ASSERT_EQ(k.e.samples[tie].hits.total_max, 0U);
    ref::ValueReference values(k.c, kLimits, Profile::direct3d);
    set_hits(k.capture, tie, 0, 1);
    write_fragment(k.capture, k.c, k.e, values, 0, {3, 4, 0});
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).kind, FindingKind::extra);
    EXPECT_EQ(only(v).rule, "tie.top-left");
    EXPECT_EQ(only(v).level, Profile::direct3d);
    EXPECT_NE(only(v).why.find("= 0 exactly"), std::string::npos) << only(v).why;
    // The same picture is right where the rule is not asked for.
    const ref::Expectation loose = ref::expect(k.c, kLimits, Profile::vulkan);
    EXPECT_TRUE(diff::compare(k.c, loose, k.capture).ok());
}

TEST(Compare, ExtraOutsideBreaksVulkan) {
    Checked k(pixel_case(8, 8, {{0, 0}, {4, 0}, {0, 4}}));
    ref::ValueReference values(k.c, kLimits, Profile::direct3d);
    set_hits(k.capture, k.at(6, 6), 0, 1);
    write_fragment(k.capture, k.c, k.e, values, 0, {6, 6, 0});
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).kind, FindingKind::extra);
    EXPECT_EQ(only(v).rule, "cover.outside");
    EXPECT_EQ(only(v).level, Profile::vulkan);
}

TEST(Compare, ExtraOutsideScissorNamesTheScissor) {
    cases::Case c = diagonal();
    c.draws[0].scissor = {0, 0, 4, 8};
    Checked k(c);
    set_hits(k.capture, k.at(5, 1), 0, 1);
    k.capture.writers[k.at(5, 1)] = k.capture.writers[k.at(1, 1)];
    k.capture.frag_coord[k.at(5, 1)] = {5.5F, 1.5F, 0.5F, 1.0F};
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).rule, "scissor.half-open");
    EXPECT_EQ(only(v).level, Profile::vulkan);
}

TEST(Compare, CulledTriangleThatShowsNamesTheCulling) {
    cases::Case c = diagonal();
    // Reverse the second triangle, then cull one face: only one of the two remains.
    std::swap(c.draws[0].positions[4], c.draws[0].positions[5]);
    c.draws[0].cull = cases::CullMode::back;
    Checked k(c);
    size_t culled = 64;
    for (size_t i = 0; i < 64; ++i) {
        const uint32_t x = static_cast<uint32_t>(i % 8), y = static_cast<uint32_t>(i / 8);
        if (k.e.samples[i].hits.total_max == 0 && x + y != 7) {
            culled = i;
        }
    }
    ASSERT_LT(culled, 64U);
    set_hits(k.capture, culled, 1, 0);
    k.capture.writers[culled] = {0, 0, 0, capture::kClearId};
    k.capture.frag_coord[culled] = {0.5F, 0.5F, 0.5F, 1.0F};
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).rule, "face.cull");
}

TEST(Compare, WrongFaceIsAFacingFinding) {
    Checked k(diagonal());
    const glm::vec4 h = k.capture.hits[k.at(1, 1)];
    set_hits(k.capture, k.at(1, 1), h.y, h.x);
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).kind, FindingKind::value);
    EXPECT_EQ(only(v).rule, "face.area-sign");
    EXPECT_EQ(only(v).quantity, "facing");
    EXPECT_EQ(only(v).level, Profile::vulkan);
}

TEST(Compare, WrongLastWriterIsAnOrderFinding) {
    Checked k(pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}, {0, 0}, {8, 0}, {0, 8}}));
    const size_t i = k.at(1, 1);
    ASSERT_EQ(k.capture.writers[i].primitive, 1U);
    k.capture.writers[i].primitive = 0;
    k.capture.writers[i].provoking_vertex = 0;
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).kind, FindingKind::order);
    EXPECT_EQ(only(v).rule, "order.primitive");
    EXPECT_EQ(only(v).level, Profile::vulkan);
}

TEST(Compare, LastWriterFarFromTheSampleIsACoverageFinding) {
    // (1,1) lies well inside triangle 0; triangle 1, which is beyond the diagonal, must not cover
    // it.
    Checked k(diagonal());
    const size_t i = k.at(1, 1);
    ASSERT_EQ(k.capture.writers[i].primitive, 0U);
    ref::ValueReference values(k.c, kLimits, Profile::direct3d);
    write_fragment(k.capture, k.c, k.e, values, 1, {1, 1, 0});
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).kind, FindingKind::order);
    EXPECT_EQ(only(v).rule, "cover.outside");
    EXPECT_EQ(only(v).level, Profile::vulkan);
    EXPECT_NE(only(v).why.find("triangle 1 of draw 0"), std::string::npos) << only(v).why;
}

TEST(Compare, OtherOwnerOfASharedEdgeIsATieNotAnOrder) {
    // The sample (3,4) lies on the diagonal: one hit by either triangle is right in Vulkan.
    Checked k(diagonal());
    const size_t i = k.at(3, 4);
    const uint32_t owner = k.capture.writers[i].primitive;
    ref::ValueReference values(k.c, kLimits, Profile::direct3d);
    write_fragment(k.capture, k.c, k.e, values, 1 - owner, {3, 4, 0});
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).kind, FindingKind::order);
    EXPECT_EQ(only(v).rule, "tie.top-left");
    EXPECT_EQ(only(v).level, Profile::direct3d);
    for (const Profile profile : {Profile::vulkan, Profile::practice}) {
        EXPECT_TRUE(diff::compare(k.c, ref::expect(k.c, kLimits, profile), k.capture).ok());
    }
}

TEST(Compare, OtherOwnerWithOppositeWindingIsATieNotAFacing) {
    Checked k(pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}, {8, 0}, {0, 8}, {8, 8}}));
    const size_t i = k.at(3, 4);
    const uint32_t owner = k.capture.writers[i].primitive;
    const glm::vec4 h = k.capture.hits[i];
    set_hits(k.capture, i, h.y, h.x);
    ref::ValueReference values(k.c, kLimits, Profile::direct3d);
    write_fragment(k.capture, k.c, k.e, values, 1 - owner, {3, 4, 0});
    EXPECT_EQ(only(k.verdict()).rule, "tie.top-left");
    EXPECT_EQ(only(k.verdict()).level, Profile::direct3d);
}

// A square over the whole target, then a triangle that must not show, doubling a hit at (1,1).
cases::Case over_background() {
    cases::Case c = pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}, {8, 0}, {8, 8}, {0, 8}});
    cases::Case front = pixel_case(8, 8, {{0, 0}, {4, 0}, {0, 4}});
    c.draws.push_back(front.draws[0]);
    return c;
}

std::string rule_of_double_hit(const cases::Case& c) {
    Checked k(c);
    const glm::vec4 h = k.capture.hits[k.at(1, 1)];
    set_hits(k.capture, k.at(1, 1), h.x * 2, h.y * 2);
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).kind, FindingKind::double_hit);
    EXPECT_EQ(only(v).level, Profile::vulkan);
    return only(v).rule;
}

TEST(Compare, WhatMustNotShowOverABackgroundNamesItsRule) {
    cases::Case c = over_background();
    c.draws[1].scissor = {4, 4, 4, 4};
    EXPECT_EQ(rule_of_double_hit(c), "scissor.half-open");
    c = over_background();
    c.draws[1].cull = cases::CullMode::front_and_back;
    EXPECT_EQ(rule_of_double_hit(c), "face.cull");
    c = over_background();
    for (glm::vec4& p : c.draws[1].positions) {
        p.z = -0.5F;
    }
    EXPECT_EQ(rule_of_double_hit(c), "clip.volume");
}

TEST(Compare, LevelCountsBeyondTheCap) {
    // 1,000 findings that break direct3d alone, then one that breaks Vulkan, in sample order.
    cases::Case c = pixel_case(64, 64, {{0, 0}, {64, 0}, {0, 64}, {64, 0}, {64, 64}, {0, 64}});
    // Triangles without area along rows of centres, all free in Vulkan, behind the others.
    std::vector<glm::vec4> flat;
    for (int n = 0; n < 40; ++n) {
        const float y = (static_cast<float>(n) + 0.5F) * 2 / 64 - 1;
        flat.emplace_back(-1.0F, y, 0.5F, 1.0F);
        flat.emplace_back(1.0F, y, 0.5F, 1.0F);
        flat.emplace_back(0.0F, y, 0.5F, 1.0F);
    }
    c.draws[0].positions.insert(c.draws[0].positions.begin(), flat.begin(), flat.end());
    Checked k(c);
    for (uint32_t y = 0; y < 40; ++y) {
        for (uint32_t x = 0; x < 60; ++x) {
            const glm::vec4 h = k.capture.hits[k.at(x, y)];
            set_hits(k.capture, k.at(x, y), h.x, h.y + 1);
        }
    }
    diff::Verdict v = k.verdict();
    EXPECT_GT(v.counts[static_cast<size_t>(FindingKind::double_hit)], diff::kMaxFindings);
    EXPECT_EQ(v.level, Profile::direct3d);
    clear_sample(k.capture, k.at(50, 60));
    v = k.verdict();
    EXPECT_EQ(v.findings.size(), diff::kMaxOfGroup + 1);  // and the one that is of another group
    EXPECT_EQ(v.findings.back().y, 60U);
    EXPECT_EQ(v.level, Profile::vulkan);
}

TEST(Compare, WrongProvokingVertexIsNamed) {
    Checked k(diagonal());
    k.capture.writers[k.at(1, 1)].provoking_vertex = 2;
    EXPECT_EQ(only(k.verdict()).rule, "provoking.first");
    k.capture.has_primitive = false;
    for (capture::Writer& w : k.capture.writers) {
        w.primitive = w.draw == capture::kClearId ? capture::kClearId : capture::kNoPrimitive;
    }
    EXPECT_EQ(only(k.verdict()).rule, "provoking.first");
}

TEST(Compare, WrongAttributeIsAValueFinding) {
    cases::Case c = diagonal();
    add_attribute(c, cases::Interpolation::smooth, {0, 1, 0, 1, 1, 0});
    Checked k(c);
    EXPECT_TRUE(k.verdict().ok());
    k.capture.attributes[0][k.at(2, 2)].x += 1e-4F;
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).kind, FindingKind::value);
    EXPECT_EQ(only(v).quantity, "attribute 0.x");
    EXPECT_GT(only(v).ratio, 2.0);
    EXPECT_EQ(v.worst_ratio, only(v).ratio);
    EXPECT_EQ(v.worst_quantity, "attribute 0.x at pixel (2, 2)");
}

TEST(Compare, TheLargestErrorHasItsValueAndSample) {
    cases::Case c = diagonal();
    c.target.samples = 2;
    add_attribute(c, cases::Interpolation::smooth, {0, 1, 0, 1, 1, 0});
    c.draws[0].attributes[0].auxiliary = cases::Auxiliary::sample;
    Checked k(c);
    EXPECT_EQ(k.verdict().worst_quantity, "");  // all w are 1
    float& w = k.capture.frag_coord[2 * k.at(5, 3) + 1].w;
    w = std::nextafter(w, 2.0F);
    const diff::Verdict v = k.verdict();
    EXPECT_TRUE(v.ok()) << only(v).why;
    EXPECT_EQ(v.worst_quantity, "frag_coord.w at pixel (5, 3), sample 1");
}

TEST(Compare, NanIsWrongUnderEveryProfile) {
    cases::Case c = diagonal();
    add_attribute(c, cases::Interpolation::smooth, {0, 1, 0, 1, 1, 0});
    for (const Profile profile : cases::kProfiles) {
        Checked k(c, profile);
        k.capture.attributes[0][k.at(2, 2)].x = std::nanf("");
        const diff::Verdict v = k.verdict();
        EXPECT_EQ(only(v).rule, "interp.hull");
        EXPECT_EQ(only(v).level, Profile::vulkan);
    }
}

TEST(Compare, PoisonIsAnErrorNeverAPass) {
    Checked k(diagonal());
    k.capture.depth[k.at(7, 7)] = std::bit_cast<float>(capture::kPoison);
    const diff::Verdict v = k.verdict();
    EXPECT_FALSE(v.ok());
    EXPECT_EQ(
        v.error,
        "sample 0 of pixel (7, 7) was not copied from the device: it still holds the read-back "
        "memory's fill pattern");
}

TEST(Compare, ContradictingAttachmentsAreAFinding) {
    Checked k(diagonal());
    k.capture.hits[k.at(0, 0)].w += 1;
    EXPECT_EQ(only(k.verdict()).rule, "write.consistent");
    Checked guard(diagonal());
    guard.capture.hits[guard.at(0, 0)].z += 1;
    EXPECT_EQ(only(guard.verdict()).rule, "write.consistent");
    Checked ghost(pixel_case(8, 8, {{0, 0}, {4, 0}, {0, 4}}));
    ghost.capture.depth[ghost.at(7, 7)] = 0.5F;  // depth written without a hit
    EXPECT_EQ(only(ghost.verdict()).rule, "write.consistent");
}

TEST(Compare, ContradictionsAreToldByPlane) {
    const auto told = [](const auto& change) {
        Checked k(pixel_case(8, 8, {{0, 0}, {4, 0}, {0, 4}}));
        change(k);
        return only(k.verdict()).got;
    };
    EXPECT_EQ(told([](Checked& k) { set_hits(k.capture, k.at(7, 7), 193, 0); }),
              "hits 193 front, 0 back; writer: nothing drawn; FragCoord: nothing drawn");
    EXPECT_EQ(told([](Checked& k) { k.capture.depth[k.at(7, 7)] = 0.5F; }),
              "hits: nothing drawn; depth: 0.5");
    EXPECT_EQ(told([](Checked& k) {
                  k.capture.writers[k.at(7, 7)].draw = 3;
                  k.capture.frag_coord[k.at(7, 7)] = {7.5F, 7.5F, 0.0F, 1.0F};
              }),
              "hits: nothing drawn; writer: draw 3, triangle none, provoking vertex none; "
              "FragCoord: (7.5, 7.5, 0, 1)");
    EXPECT_EQ(told([](Checked& k) { k.capture.hits[k.at(7, 7)].z += 1; }),
              "hit counter (0, 0, 4097, 4096), which no fragments leave; writer: nothing drawn; "
              "FragCoord: nothing drawn; depth: nothing drawn");
}

TEST(Compare, OneTriangleThatHitsTwiceIsNotSaidToBeElsewhere) {
    Checked k(pixel_case(8, 8, {{0, 0}, {8, 0}, {0, 8}}));
    set_hits(k.capture, k.at(1, 1), 0, 2);
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(only(v).kind, FindingKind::double_hit);
    EXPECT_EQ(only(v).rule, "cover.outside");
    EXPECT_EQ(only(v).why, "triangle 0 of draw 0 alone may cover the sample, and only once");
}

TEST(Compare, WrongSamplesAreCountedOnceEach) {
    Checked k(diagonal());
    EXPECT_EQ(k.verdict().count_wrong_samples(), 0U);
    k.capture.frag_coord[k.at(1, 1)].x += 1;
    k.capture.frag_coord[k.at(1, 1)].y += 1;
    clear_sample(k.capture, k.at(2, 2));
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(v.findings.size(), 3U);
    EXPECT_EQ(v.count_wrong_samples(), 2U);
}

TEST(Compare, AFractionIsToldWhereItSaysMore) {
    Checked k(diagonal());
    k.capture.frag_coord[k.at(1, 1)].w = 2;
    EXPECT_TRUE(only(k.verdict()).expected.starts_with("1 within ")) << only(k.verdict()).expected;
    Checked depth(diagonal());
    depth.capture.depth[depth.at(1, 1)] += 0.25F;
    EXPECT_NE(only(depth.verdict()).expected.find(" = 1/2 within "), std::string::npos)
        << only(depth.verdict()).expected;
}

TEST(Compare, CaseWithoutControlIsAnError) {
    const Checked k(pixel_case(8, 8, {{0.6, 0.6}, {1.4, 0.6}, {1, 1.4}}));
    EXPECT_NE(k.verdict().error.find("no sample that must be covered"), std::string::npos);
}

TEST(Compare, CaptureOfAnotherSizeIsAnError) {
    Checked k(diagonal());
    k.capture.depth.pop_back();
    EXPECT_NE(k.verdict().error.find("another size"), std::string::npos);
    Checked attributes(diagonal());
    add_attribute(attributes.c, cases::Interpolation::smooth, {0, 1, 0, 1, 1, 0});
    EXPECT_EQ(attributes.verdict().error, "the capture lacks attribute 0 of the case");
}

TEST(Compare, FindingsAreCappedButCounted) {
    Checked k(pixel_case(64, 64, {{0, 0}, {64, 0}, {0, 64}, {64, 0}, {64, 64}, {0, 64}}));
    for (size_t i = 0; i < 64 * 64; ++i) {
        clear_sample(k.capture, i);
    }
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(v.findings.size(), diff::kMaxOfGroup);
    EXPECT_EQ(v.counts[static_cast<size_t>(FindingKind::missing)], 4096U);
}

TEST(Compare, ValuesBeyondTheCapAreCounted) {
    cases::Case c = pixel_case(64, 64, {{0, 0}, {64, 0}, {0, 64}, {64, 0}, {64, 64}, {0, 64}});
    add_attribute(c, cases::Interpolation::smooth, {0, 1, 0, 1, 1, 0});
    Checked k(c);
    for (glm::vec4& value : k.capture.attributes[0]) {
        value.x += 4;  // outside of the vertices' values: wrong at every profile
    }
    const diff::Verdict v = k.verdict();
    EXPECT_EQ(v.findings.size(), diff::kMaxOfGroup);
    EXPECT_EQ(v.counts[static_cast<size_t>(FindingKind::value)], 4096U);
    EXPECT_EQ(v.level, Profile::vulkan);
    EXPECT_EQ(v.findings.back().rule, "interp.hull");
    ASSERT_EQ(v.groups.size(), 1U);  // each with its own rule and level, told or not
    EXPECT_EQ(v.groups[0].rule, "interp.hull");
    EXPECT_EQ(v.groups[0].level, Profile::vulkan);
    EXPECT_EQ(v.groups[0].count, 4096U);
    EXPECT_TRUE(std::all_of(v.findings.begin(), v.findings.end(), [](const diff::Finding& f) {
        return !f.expected.empty() && !f.got.empty() && !f.why.empty();
    }));
    EXPECT_TRUE(std::all_of(v.marks.begin(), v.marks.end(),
                            [](diff::SampleMark m) { return m == diff::SampleMark::value; }));
    EXPECT_TRUE(std::all_of(v.error_ratios.begin(), v.error_ratios.end(),
                            [](float ratio) { return ratio > 2; }));
}

}  // namespace
