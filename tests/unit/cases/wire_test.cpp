// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <bit>

#include "cases/wire/case_bytes.hpp"

namespace cases {

namespace {

Case sample() {
    const auto nan = std::bit_cast<float>(0x7fc12345U);
    const auto signalling = std::bit_cast<float>(0xff800001U);
    Case c;
    c.id = "family/name:k=1";
    c.target = {37, 5, 1};
    Draw draw;
    draw.topology = Topology::triangle_fan;
    draw.positions = {{-0.0F, 0.0F, nan, signalling}, {1, 2, 3, 4}, {0x1p-149F, -0x1p127F, 0, 1}};
    draw.indices = std::vector<uint32_t>{0, 1, kRestartIndex, 2};
    draw.primitive_restart = true;
    draw.attributes = {{"colour", Interpolation::flat, 3, {{1, 2, 3, 0}, {4, 5, 6, 0}, {}}},
                       {"n", Interpolation::noperspective, 1, {{nan, 0, 0, 0}, {}, {}}}};
    draw.viewport = {0.5F, 8, 7, -8, 0.25F, 0.75F};
    draw.scissor = {1, 2, 3, 4};
    draw.cull = CullMode::back;
    draw.front_face = FrontFace::clockwise;
    draw.attributes[0].auxiliary = Auxiliary::sample;
    draw.attributes[1].probe = Probe::at_offset;
    draw.attributes[1].probe_offset = {-0.5F, 0.4375F};
    draw.attributes[1].probe_sample = 3;
    draw.attributes[1].texture_size = {64, 32};
    Attribute weights;
    weights.name = "weights";
    weights.components = 3;
    weights.source = Source::barycentric;
    draw.attributes.push_back(weights);
    draw.provoking = ProvokingVertex::last;
    draw.rasterizer_discard = true;
    draw.conservative = cases::Conservative::overestimate;
    draw.conservative_extra = 0.75F;
    draw.fragment_size = {4, 2};
    draw.discard = cases::Discard::negative;
    draw.discard_attribute = 1;
    draw.discard_by = cases::DiscardBy::terminate;
    draw.early_tests = true;
    draw.frag_depth = FragDepth{false, 0.25F, 0.5F, Discard::odd_rows, DepthLayout::less};
    draw.query = Query::occlusion_precise;
    draw.depth.compare = CompareOp::less_or_equal;
    draw.depth.write = false;
    draw.depth.bounds = DepthBounds{0.125F, 0.75F};
    draw.depth.bias = DepthBias{2, -0.25F, 1.5F, DepthBiasRepresentation::force_unorm, true};
    draw.depth.clamp = true;
    draw.depth.clip = true;
    draw.depth.negative_one_to_one = true;
    draw.distances = {2, 1, {{1, 2, 0, 0}, {3, 4, 0, 0}, {}}, {{-1, 0, 0, 0}, {}, {}}};
    draw.multisample = {0x5, 0x6, 0.5F};
    draw.color.value = {0.25F, 0.5F, 0.75F, 1};
    draw.color.attribute = 1;
    draw.color.blend = Blend{{BlendFactor::src_alpha, BlendFactor::one, BlendOp::max},
                             {BlendFactor::zero, BlendFactor::src_alpha_saturate, BlendOp::min},
                             {0.1F, 0.2F, 0.3F, 0.4F},
                             {0.5F, 0.6F, 0.7F, 0.8F}};
    draw.color.from = ColorFrom::mask;
    draw.matrix = true;
    draw.color.alpha_to_one = true;
    draw.color.alpha_to_coverage = true;
    draw.color.write_mask = 0x5;
    draw.layer = 2;
    draw.viewport_index = 1;
    c.target.samples = 2;
    c.target.layers = 3;
    c.target.depth_format = DepthFormat::d16_unorm;
    c.target.sample_locations = {{1, 15}, {8, 0}};
    c.target.color = ColorTarget{ColorFormat::rgba16_float, {1, 2, 3, 4}};
    c.target.has_instruments = false;
    c.target.has_depth = false;
    c.target.depth_clear = 0.75F;
    c.target.color_resolve = Resolve::average;
    c.target.depth_resolve = Resolve::max;
    c.target.stencil_resolve = Resolve::min;
    c.target.has_stencil = true;
    c.target.stencil_clear = 77;
    c.target.frame = Frame::second;
    c.target.other_colors = {{ColorFormat::r32_uint, {5, 0, 0, 0}}};
    c.target.judged_color = 1;
    draw.other_colors = {draw.color};
    draw.other_colors[0].write_mask = 0x3;
    c.draws = {draw, Draw{}};
    c.draws[1].other_colors.resize(1);
    c.relations = {{RelationKind::scissor_tiles, {7, 3}}, {RelationKind::more_attributes, {}}};
    c.blit = Blit{ColorFormat::rgb10a2_unorm,
                  5,
                  9,
                  BlitPattern::ramp,
                  77,
                  BlitFilter::linear,
                  {4, 3, 0, 1},
                  {-1, 2, 8, 6}};
    return c;
}

uint32_t bits(float f) {
    return std::bit_cast<uint32_t>(f);
}

void expect_same(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
        for (glm::vec4::length_type k = 0; k < 4; ++k) {
            EXPECT_EQ(bits(a[i][k]), bits(b[i][k])) << i << " " << k;
        }
    }
}

}  // namespace

TEST(Wire, RoundTripKeepsEveryBit) {
    const Case c = sample();
    const Expected<Case> back = from_bytes(to_bytes(c));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->id, c.id);
    EXPECT_EQ(back->target, c.target);
    EXPECT_EQ(back->relations, c.relations);
    EXPECT_EQ(back->blit, c.blit);
    ASSERT_EQ(back->draws.size(), 2U);
    for (size_t d = 0; d < 2; ++d) {
        const Draw& a = c.draws[d];
        const Draw& b = back->draws[d];
        EXPECT_EQ(a.topology, b.topology);
        expect_same(a.positions, b.positions);
        EXPECT_EQ(a.indices, b.indices);
        EXPECT_EQ(a.primitive_restart, b.primitive_restart);
        EXPECT_EQ(a.viewport, b.viewport);
        EXPECT_EQ(a.scissor.x, b.scissor.x);
        EXPECT_EQ(a.scissor.y, b.scissor.y);
        EXPECT_EQ(a.scissor.width, b.scissor.width);
        EXPECT_EQ(a.scissor.height, b.scissor.height);
        EXPECT_EQ(a.cull, b.cull);
        EXPECT_EQ(a.front_face, b.front_face);
        ASSERT_EQ(a.attributes.size(), b.attributes.size());
        for (size_t i = 0; i < a.attributes.size(); ++i) {
            EXPECT_EQ(a.attributes[i].name, b.attributes[i].name);
            EXPECT_EQ(a.attributes[i].interpolation, b.attributes[i].interpolation);
            EXPECT_EQ(a.attributes[i].components, b.attributes[i].components);
            expect_same(a.attributes[i].values, b.attributes[i].values);
            EXPECT_EQ(a.attributes[i].auxiliary, b.attributes[i].auxiliary);
            EXPECT_EQ(a.attributes[i].source, b.attributes[i].source);
            EXPECT_EQ(a.attributes[i].probe, b.attributes[i].probe);
            EXPECT_EQ(a.attributes[i].probe_offset, b.attributes[i].probe_offset);
            EXPECT_EQ(a.attributes[i].probe_sample, b.attributes[i].probe_sample);
            EXPECT_EQ(a.attributes[i].texture_size, b.attributes[i].texture_size);
        }
        EXPECT_EQ(a.provoking, b.provoking);
        EXPECT_EQ(a.rasterizer_discard, b.rasterizer_discard);
        EXPECT_EQ(a.discard, b.discard);
        EXPECT_EQ(a.conservative, b.conservative);
        EXPECT_EQ(a.conservative_extra, b.conservative_extra);
        EXPECT_EQ(a.fragment_size, b.fragment_size);
        EXPECT_EQ(a.discard_attribute, b.discard_attribute);
        EXPECT_EQ(a.discard_by, b.discard_by);
        EXPECT_EQ(a.early_tests, b.early_tests);
        EXPECT_EQ(a.frag_depth, b.frag_depth);
        EXPECT_EQ(a.query, b.query);
        EXPECT_EQ(a.depth, b.depth);
        EXPECT_EQ(a.distances, b.distances);
        EXPECT_EQ(a.multisample, b.multisample);
        EXPECT_EQ(a.color, b.color);
        EXPECT_EQ(a.other_colors, b.other_colors);
        EXPECT_EQ(a.layer, b.layer);
        EXPECT_EQ(a.viewport_index, b.viewport_index);
    }
    EXPECT_EQ(to_bytes(*back), to_bytes(c));
}

TEST(Wire, EveryCutIsRejected) {
    const std::string bytes = to_bytes(sample());
    for (size_t length = 0; length < bytes.size(); ++length) {
        const Expected<Case> back = from_bytes(std::span(bytes.data(), length));
        ASSERT_FALSE(back) << length;
        EXPECT_EQ(to_string(back.error()),
                  length < 4 ? "error: these bytes are not a case of this program"
                             : "error: the bytes of a case are cut short or damaged");
    }
    EXPECT_EQ(to_string(from_bytes(bytes + "x").error()),
              "error: more bytes follow than the case has");
}

TEST(Wire, FragmentsThatNothingCanNumberAreRejected) {
    for (const std::array<uint32_t, 2>& size :
         {std::array{0U, 1U}, {1U, 3U}, {8U, 1U}, {1U, 1U << 31U}}) {
        Case c = sample();
        c.draws[0].fragment_size = size;
        EXPECT_FALSE(from_bytes(to_bytes(c))) << size[0] << " x " << size[1];
    }
    Case c = sample();
    c.target.samples = 4;
    c.draws[0].fragment_size = {4, 4};  // 64 samples
    EXPECT_FALSE(from_bytes(to_bytes(c)));
    c.draws[0].fragment_size = {4, 2};
    EXPECT_TRUE(from_bytes(to_bytes(c)));
}

// Damage anywhere yields a case or an error, never a crash or a huge allocation.
TEST(Wire, DamageIsHarmless) {
    const std::string bytes = to_bytes(sample());
    size_t rejected = 0;
    for (size_t i = 0; i < bytes.size(); ++i) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(~damaged[i]);
        rejected += from_bytes(damaged) ? 0U : 1U;
    }
    EXPECT_GT(rejected, bytes.size() / 4);
}

}  // namespace cases
