// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Cases that a device draws in parts, by made-up capabilities; no device.
#include "vk_harness/parts.hpp"

#include <gmock/gmock.h>

#include "hand_case.hpp"
#include "vk_harness/target/attachments.hpp"

namespace vk_harness::testing {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// As V3DV: four attachments, 16-bit blending.
Capabilities small() {
    Capabilities c;
    c.info.max_color_attachments = 4;
    c.sample_counts = VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT;
    c.narrow_sample_counts = c.sample_counts;
    c.blends_wide = c.blends_narrow = false;
    return c;
}

cases::Case with_attributes(uint32_t count, uint32_t samples = 1) {
    cases::Case c = make_case({64, 64, samples}, half_square());
    for (uint32_t k = 0; k < count; ++k) {
        cases::Attribute a;
        a.name = "attribute " + std::to_string(k);
        a.components = 3;
        a.values.resize(3, glm::vec4(static_cast<float>(k), 1, 2, 0));
        c.draws[0].attributes.push_back(a);
    }
    return c;
}

void add_triangles(cases::Case& c, size_t count) {
    cases::Draw& draw = c.draws[0];
    const std::vector<glm::vec4> one = draw.positions;
    for (size_t k = 1; k < count; ++k) {
        draw.positions.insert(draw.positions.end(), one.begin(), one.end());
    }
    for (cases::Attribute& a : draw.attributes) {
        a.values.resize(draw.positions.size());
    }
}

std::vector<std::string> names_of(const cases::Draw& draw) {
    std::vector<std::string> out;
    for (const cases::Attribute& a : draw.attributes) {
        out.push_back(a.name);
    }
    return out;
}

uint32_t colors_of(const Capabilities& capabilities, const cases::Case& c) {
    return color_count(attachments_of(c, target_layout(capabilities, c)));
}

TEST(Parts, AreNoneWhereOneRenderingHasRoom) {
    EXPECT_THAT(parts_of(small(), with_attributes(0)), IsEmpty());
    EXPECT_THAT(parts_of(small(), with_attributes(2)), IsEmpty());
    Capabilities large = small();
    large.info.max_color_attachments = 8;
    cases::Case c = with_attributes(4);
    c.target.color.emplace();
    EXPECT_THAT(parts_of(large, c), IsEmpty());
}

TEST(Parts, AttributesAndColoursAreDivided) {
    cases::Case c = with_attributes(4);
    c.target.color.emplace();
    c.target.color_resolve = cases::Resolve::average;
    c.target.depth_resolve = cases::Resolve::max;
    c.target.has_stencil = true;
    c.target.stencil_resolve = cases::Resolve::min;
    c.draws[0].color.attribute = 3;
    c.draws[0].query = cases::Query::occlusion;
    // Hits, and attributes 1 and 2.
    c.variation.masked = 1U << capture::kHitsPlane | 1U << (capture::kAttributePlane + 1) |
                         1U << (capture::kAttributePlane + 2);
    const std::vector<Part> parts = parts_of(small(), c);
    ASSERT_THAT(parts, SizeIs(3));
    for (const Part& part : parts) {
        EXPECT_LE(colors_of(small(), part.test), 4U);
    }
    EXPECT_TRUE(parts[0].has_fragments);
    EXPECT_FALSE(parts[0].has_color);
    EXPECT_THAT(parts[0].taken, ElementsAre(0, 1));
    EXPECT_THAT(names_of(parts[0].test.draws[0]), ElementsAre("attribute 0", "attribute 1"));
    EXPECT_FALSE(parts[0].test.target.color.has_value());
    EXPECT_EQ(parts[0].test.target.color_resolve, cases::Resolve::none);
    EXPECT_EQ(parts[0].test.target.depth_resolve, cases::Resolve::max);
    EXPECT_EQ(parts[0].test.target.stencil_resolve, cases::Resolve::min);
    EXPECT_EQ(parts[0].test.draws[0].query, cases::Query::occlusion);
    EXPECT_EQ(parts[0].test.variation.masked,
              1U << capture::kHitsPlane | 1U << (capture::kAttributePlane + 1));
    EXPECT_FALSE(parts[1].has_fragments);
    EXPECT_EQ(parts[1].test.variation.masked,
              1U << capture::kHitsPlane | 1U << capture::kAttributePlane);
    EXPECT_THAT(parts[1].taken, ElementsAre(2, 3));
    EXPECT_THAT(names_of(parts[1].test.draws[0]), ElementsAre("attribute 2", "attribute 3"));
    EXPECT_EQ(parts[1].test.draws[0].query, cases::Query::none);
    EXPECT_TRUE(parts[2].has_color);
    EXPECT_FALSE(parts[2].test.target.has_instruments);
    EXPECT_EQ(parts[2].test.draws[0].color.attribute, 3);
    EXPECT_THAT(names_of(parts[2].test.draws[0]), SizeIs(4));
}

// A fragment that one part discards has to be discarded by all.
TEST(Parts, WhatDiscardsIsAnInputOfEveryPart) {
    cases::Case c = with_attributes(4);
    c.draws[0].discard = cases::Discard::negative;
    c.draws[0].discard_attribute = 2;
    const std::vector<Part> parts = parts_of(small(), c);
    ASSERT_THAT(parts, SizeIs(3));
    EXPECT_THAT(parts[0].attributes, ElementsAre(0, 2));
    EXPECT_THAT(parts[0].taken, ElementsAre(2, 0));
    EXPECT_THAT(parts[1].attributes, ElementsAre(1, 2));
    EXPECT_THAT(parts[1].taken, ElementsAre(1));
    EXPECT_THAT(parts[2].attributes, ElementsAre(2, 3));
    EXPECT_THAT(parts[2].taken, ElementsAre(3));
    EXPECT_EQ(parts[1].test.draws[0].discard_attribute, 1U);
    EXPECT_EQ(parts[2].test.draws[0].discard_attribute, 0U);
    EXPECT_EQ(parts[2].test.draws[0].discard, cases::Discard::negative);
}

// Sample shading decides where the other inputs are evaluated, too.
TEST(Parts, WhatMayAskForSampleShadingIsAnInputOfEveryPart) {
    cases::Case c = with_attributes(3, 4);
    c.draws[0].attributes[1].auxiliary = cases::Auxiliary::sample;
    const std::vector<Part> parts = parts_of(small(), c);
    ASSERT_THAT(parts, SizeIs(2));
    EXPECT_THAT(parts[0].attributes, ElementsAre(0, 1));
    EXPECT_THAT(parts[1].attributes, ElementsAre(1, 2));
    EXPECT_THAT(parts[1].taken, ElementsAre(2));
    // A colour that does not come from it would be drawn without it.
    c.target.color.emplace();
    EXPECT_THAT(parts_of(small(), c), IsEmpty());
    c.draws[0].color.attribute = 1;
    EXPECT_THAT(parts_of(small(), c), SizeIs(3));
    // With one sample it decides nothing.
    c.target.samples = 1;
    c.draws[0].color.attribute = 0;
    EXPECT_THAT(parts_of(small(), c), SizeIs(3));
}

// A draw with fewer attributes lacks the last ones of every part.
TEST(Parts, DrawsKeepTheNumbersOfTheirAttributes) {
    cases::Case c = with_attributes(4);
    c.draws.push_back(c.draws[0]);
    c.draws[1].attributes.resize(1);
    c.draws[0].discard = cases::Discard::negative;
    c.draws[0].discard_attribute = 3;
    const std::vector<Part> parts = parts_of(small(), c);
    ASSERT_THAT(parts, SizeIs(3));
    EXPECT_THAT(names_of(parts[0].test.draws[0]), ElementsAre("attribute 0", "attribute 3"));
    EXPECT_THAT(names_of(parts[0].test.draws[1]), ElementsAre("attribute 0"));
    EXPECT_THAT(names_of(parts[1].test.draws[1]), IsEmpty());
    EXPECT_EQ(parts[0].test.draws[1].discard_attribute, 0U);
}

// 40 hits are told apart where both faces have a number of their own, which leaves no room for an
// attribute.
TEST(Parts, HitsThatAreManyHaveAPartOfTheirOwn) {
    cases::Case c = with_attributes(1);
    add_triangles(c, 40);
    const std::vector<Part> parts = parts_of(small(), c);
    ASSERT_THAT(parts, SizeIs(2));
    EXPECT_THAT(parts[0].attributes, IsEmpty());
    EXPECT_TRUE(target_layout(small(), parts[0].test).split);
    EXPECT_THAT(parts[1].taken, ElementsAre(0));
    // Fewer are counted beside it, and too many nowhere.
    cases::Case few = with_attributes(1);
    add_triangles(few, 31);
    EXPECT_THAT(parts_of(small(), few), IsEmpty());
    add_triangles(c, 30);  // 1,200
    EXPECT_THAT(parts_of(small(), c), IsEmpty());
}

TEST(Parts, ACaptureTakesOfAPartWhatThatTells) {
    cases::Case c = with_attributes(3);
    c.target.width = c.target.height = 2;
    c.target.color.emplace();
    const std::vector<Part> parts = parts_of(small(), c);
    ASSERT_THAT(parts, SizeIs(3));
    capture::Capture whole;
    whole.target = c.target;
    whole.attribute_count = 3;
    const auto make = [](capture::Capture& to) {
        capture::for_each_plane(
            [](const capture::Plane& plane, auto& entries) { entries.resize(plane.entries); }, to,
            to);
    };
    make(whole);
    float number = 1;
    for (const Part& part : parts) {
        capture::Capture drawn;
        drawn.target = part.test.target;
        drawn.attribute_count =
            part.test.target.has_instruments ? static_cast<uint32_t>(part.attributes.size()) : 0;
        make(drawn);
        std::ranges::fill(drawn.hits, glm::vec4(number));
        std::ranges::fill(drawn.depth, number);
        for (auto& plane : drawn.attributes) {
            std::ranges::fill(plane, glm::vec4(number));
        }
        std::ranges::fill(drawn.color, capture::ColorCodes{static_cast<uint32_t>(number), 0, 0, 0});
        take_part(part, drawn, capture::PlaneSpans(whole));
        number *= 2;
    }
    EXPECT_THAT(whole.hits, Each(glm::vec4(1)));
    EXPECT_THAT(whole.depth, Each(1.0F));
    EXPECT_THAT(whole.attributes[0], Each(glm::vec4(1)));
    EXPECT_THAT(whole.attributes[1], Each(glm::vec4(1)));
    EXPECT_THAT(whole.attributes[2], Each(glm::vec4(2)));
    EXPECT_THAT(whole.color, Each(capture::ColorCodes{4, 0, 0, 0}));
}

}  // namespace
}  // namespace vk_harness::testing
