// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Hand cases on a real device, bit by bit where Vulkan or the common practice makes them exact.
#include <gmock/gmock.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "hand_case.hpp"

namespace vk_harness::testing {
namespace {

constexpr cases::Target k64 = {64, 64, 1};

uint32_t bits(float value) {
    return std::bit_cast<uint32_t>(value);
}

cases::Attribute attribute(cases::Interpolation interpolation, std::vector<glm::vec4> values) {
    cases::Attribute a;
    a.name = "a";
    a.interpolation = interpolation;
    a.components = 4;
    a.values = std::move(values);
    return a;
}

TEST(Render, HalfSquareHas136Pixels) {
    const capture::Capture capture = draw(make_case(k64, half_square()));
    const Count n = count(capture);
    EXPECT_EQ(n.front + n.back, 136U);
    EXPECT_EQ(n.clear, 64U * 64U - 136U);
    EXPECT_EQ(n.inconsistent, 0U);
    EXPECT_EQ(n.not_copied, 0U);
    for (uint32_t y = 0; y < 64; ++y) {
        for (uint32_t x = 0; x < 64; ++x) {
            const bool inside = x >= 4 && y >= 4 && x + y < 24;
            const glm::vec4& hits = capture.hits[index(capture, x, y)];
            ASSERT_EQ(hits.x + hits.y, inside ? 1.0F : 0.0F) << x << "," << y;
        }
    }
}

// 136 pixels in the layer of the draw, and the clear value of every plane in the others.
TEST(Render, ADrawGoesToItsLayer) {
    for (const uint32_t samples : {1U, 4U}) {
        for (const uint32_t layer : {0U, 1U, 2U}) {
            cases::Case c = make_case({64, 32, samples, 3}, {{4, 4}, {20, 4}, {4, 20}});
            c.draws[0].layer = layer;
            c.draws[0].attributes = {attribute(cases::Interpolation::smooth,
                                               {glm::vec4(1), glm::vec4(1), glm::vec4(1)})};
            const Rendered rendered = renderer().render({&c, 1}).front();
            ASSERT_EQ(rendered.status, Rendered::Status::drawn) << rendered.reason;
            const capture::Capture& capture = rendered.capture;
            const size_t count = size_t{64} * 32 * samples;
            ASSERT_EQ(capture.hits.size(), 3 * count);
            uint64_t hits = 0;
            for (size_t k = 0; k < capture.hits.size(); ++k) {
                const capture::SampleState state = capture::sample_state(capture, k);
                if (k / count == layer && state == capture::SampleState::drawn) {
                    ++hits;
                    continue;
                }
                ASSERT_EQ(state, capture::SampleState::clear) << "layer " << k / count;
            }
            // Inside are the samples with x + y < 24; the diagonal runs through none of four.
            EXPECT_EQ(hits, samples == 1 ? 120U : 512U);
        }
    }
}

TEST(Render, EverySampleSaysWhoWroteIt) {
    const capture::Capture capture = draw(make_case(k64, half_square()));
    const size_t inside = index(capture, 7, 9);
    EXPECT_EQ(capture.writers[inside].draw, 0U);
    EXPECT_EQ(capture.writers[inside].provoking_vertex, 0U);
    EXPECT_EQ(capture.writers[inside].primitive,
              capture.has_primitive ? 0U : capture::kNoPrimitive);
    EXPECT_EQ(capture.writers[inside].spare, capture::kClearId);
    EXPECT_EQ(capture.frag_coord[inside], glm::vec4(7.5F, 9.5F, 0.5F, 1.0F));
    EXPECT_EQ(capture.depth[inside], 0.5F);
    const size_t outside = index(capture, 30, 30);
    EXPECT_EQ(capture.writers[outside], capture::Writer{});
    EXPECT_EQ(bits(capture.frag_coord[outside].x), bits(capture::kClearValue));
    EXPECT_EQ(capture.depth[outside], capture::kClearDepth);
    EXPECT_EQ(capture.hits[outside], glm::vec4(0, 0, capture::kHitGuard, capture::kHitGuard));
}

TEST(Render, FacingFollowsWindingAndFrontFace) {
    // (4.5,4.5) (20.5,4.5) (4.5,20.5) turns clockwise on the screen (y down). Vulkan's area has the
    // opposite sign of the mathematical one in y-down coordinates: clockwise on screen is
    // clockwise.
    cases::Case c = make_case(k64, half_square());
    EXPECT_EQ(count(draw(c)).back, 136U);
    c.draws[0].front_face = cases::FrontFace::clockwise;
    EXPECT_EQ(count(draw(c)).front, 136U);
    std::swap(c.draws[0].positions[1], c.draws[0].positions[2]);
    EXPECT_EQ(count(draw(c)).back, 136U);
}

TEST(Render, CullingAgreesWithFacing) {
    cases::Case c = make_case(k64, half_square());  // a back face
    const auto drawn = [&c](cases::CullMode mode) {
        c.draws[0].cull = mode;
        const Count n = count(draw(c));
        EXPECT_EQ(n.inconsistent + n.not_copied, 0U);
        return n.front + n.back;
    };
    EXPECT_EQ(drawn(cases::CullMode::none), 136U);
    EXPECT_EQ(drawn(cases::CullMode::front), 136U);
    EXPECT_EQ(drawn(cases::CullMode::back), 0U);
    EXPECT_EQ(drawn(cases::CullMode::front_and_back), 0U);
}

TEST(Render, ScissorIsHalfOpen) {
    cases::Case c = make_case(k64, half_square());
    c.draws[0].scissor = {5, 6, 3, 2};
    const capture::Capture capture = draw(c);
    EXPECT_EQ(count(capture).back, 6U);
    EXPECT_EQ(capture.hits[index(capture, 5, 6)].y, 1.0F);
    EXPECT_EQ(capture.hits[index(capture, 7, 7)].y, 1.0F);
    EXPECT_EQ(capture.hits[index(capture, 8, 7)].y, 0.0F);
    EXPECT_EQ(capture.hits[index(capture, 7, 8)].y, 0.0F);
}

TEST(Render, NegativeHeightMirrorsAndTurnsFacing) {
    cases::Case c = make_case(k64, half_square());
    c.draws[0].viewport = {0, 64, 64, -64, 0, 1};
    const capture::Capture capture = draw(c);
    const Count n = count(capture);
    // Mirrored to (4.5,59.5) (20.5,59.5) (4.5,43.5); the tie rule stays top-left, so row 59 is a
    // bottom edge and not covered: 15 + 14 + ... + 1 pixels and the row of the left edge's top
    // vertex none.
    EXPECT_EQ(n.front, 120U);
    EXPECT_EQ(n.back, 0U);
    EXPECT_EQ(capture.hits[index(capture, 4, 59)].x, 0.0F);
    EXPECT_EQ(capture.hits[index(capture, 4, 58)].x, 1.0F);
}

TEST(Render, FractionalViewport) {
    // A covering triangle in a viewport of (4.5,4.5) 10 x 10: columns and rows 4..13.
    cases::Case c = make_case({32, 32, 1}, {{-32, -32}, {96, -32}, {-32, 96}});
    c.draws[0].viewport = {4.5F, 4.5F, 10, 10, 0, 1};
    const capture::Capture capture = draw(c);
    EXPECT_EQ(count(capture).back, 100U);
    EXPECT_EQ(capture.hits[index(capture, 4, 4)].y, 1.0F);
    EXPECT_EQ(capture.hits[index(capture, 14, 13)].y, 0.0F);
}

// More than kMaxPackedHits, of both kinds.
TEST(Render, ManyHits) {
    const std::array<glm::vec2, 6> both = {
        {{-1, -1}, {9, -1}, {-1, 9}, {-1, -1}, {-1, 9}, {9, -1}}};
    std::vector<glm::vec2> vertices;
    for (uint32_t k = 0; k < 3000; ++k) {
        vertices.insert(vertices.end(), both.begin(), both.end());
    }
    vertices.insert(vertices.end(), both.begin(), both.begin() + 3);
    cases::Case c = make_case({2, 2, 1}, vertices);
    const capture::Capture capture = draw(c);
    const glm::vec4& hits = capture.hits[0];
    EXPECT_EQ(std::max(hits.x, hits.y), 3001.0F);
    EXPECT_EQ(std::min(hits.x, hits.y), 3000.0F);
    EXPECT_EQ(hits.w, capture::kHitGuard + 6001);
    EXPECT_EQ(count(capture).inconsistent, 0U);
}

TEST(Render, SecondDrawWritesLast) {
    cases::Case c = make_case(k64, {{4.5F, 4.5F}, {20.5F, 4.5F}, {4.5F, 20.5F}});
    cases::Draw second =
        make_draw(k64, std::vector<glm::vec2>{{0, 0}, {8, 0}, {8, 8}, {0, 0}, {8, 8}, {0, 8}});
    for (glm::vec4& p : second.positions) {
        p.z = 0.25F;
    }
    c.draws.push_back(second);
    const capture::Capture capture = draw(c);
    const size_t both = index(capture, 5, 6);
    EXPECT_EQ(capture.hits[both].y, 2.0F);
    EXPECT_EQ(capture.hits[both].w, capture::kHitGuard + 2);
    EXPECT_EQ(capture.writers[both].draw, 1U);
    EXPECT_EQ(capture.depth[both], 0.25F);
    const size_t first_only = index(capture, 10, 6);
    EXPECT_EQ(capture.writers[first_only].draw, 0U);
    EXPECT_EQ(capture.depth[first_only], 0.5F);
    EXPECT_EQ(count(capture).inconsistent, 0U);
}

// Four quarters of a 32 x 32 square by strips and fans: which triangle drew a pixel, which vertex
// decides.
struct Origin {
    uint32_t primitive, vertex;
};
void expect_origin(const capture::Capture& capture, uint32_t x, uint32_t y, Origin origin) {
    const capture::Writer& writer = capture.writers[index(capture, x, y)];
    EXPECT_EQ(writer.provoking_vertex, origin.vertex) << x << "," << y;
    EXPECT_EQ(writer.primitive, capture.has_primitive ? origin.primitive : capture::kNoPrimitive)
        << x << "," << y;
}

TEST(Render, StripProvokingVertices) {
    // 0 2 4 above, 1 3 5 below: triangle i is provoked by vertex i.
    cases::Case c = make_case(k64, {{0, 0}, {0, 16}, {16, 0}, {16, 16}, {32, 0}, {32, 16}});
    c.draws[0].topology = cases::Topology::triangle_strip;
    const capture::Capture capture = draw(c);
    const Count n = count(capture);
    EXPECT_EQ(n.front, 512U);  // counter-clockwise on screen, every one
    expect_origin(capture, 2, 2, {0, 0});
    expect_origin(capture, 13, 13, {1, 1});
    expect_origin(capture, 18, 2, {2, 2});
    expect_origin(capture, 29, 13, {3, 3});
}

TEST(Render, FanProvokingVertices) {
    // Hub 0 in the middle of a square; triangle i is provoked by vertex i + 1, never by the hub.
    cases::Case c = make_case(k64, {{16, 16}, {0, 0}, {32, 0}, {32, 32}, {0, 32}, {0, 0}});
    c.draws[0].topology = cases::Topology::triangle_fan;
    const capture::Capture capture = draw(c);
    EXPECT_EQ(count(capture).back, 1024U);
    expect_origin(capture, 16, 2, {0, 1});
    expect_origin(capture, 29, 16, {1, 2});
    expect_origin(capture, 16, 29, {2, 3});
    expect_origin(capture, 2, 16, {3, 4});
}

TEST(Render, IndicesAndRestart) {
    cases::Case c = make_case(k64, {{0, 0}, {0, 16}, {16, 0}, {16, 16}, {32, 0}, {32, 16}});
    c.draws[0].topology = cases::Topology::triangle_strip;
    c.draws[0].indices = {{0, 1, 2, cases::kRestartIndex, 3, 5, 4}};
    c.draws[0].primitive_restart = true;
    const capture::Capture capture = draw(c);
    // Upper left half of the first square; lower right half of the second.
    const Count n = count(capture);
    EXPECT_EQ(n.front + n.back, 256U);
    expect_origin(capture, 2, 2, {0, 0});
    expect_origin(capture, 29, 13, {1, 3});
    EXPECT_EQ(capture.hits[index(capture, 13, 13)].x, 0.0F);
}

TEST(Render, FlatAttributesKeepEveryBit) {
    const std::vector<glm::vec4> values = {
        {0.1F, -0x1.234566p-90F, 0x1.fffffep125F, 1e-30F}, {1, 2, 3, 4}, {5, 6, 7, 8}};
    cases::Case c = make_case(k64, half_square());
    c.draws[0].attributes.push_back(attribute(cases::Interpolation::flat, values));
    const capture::Capture capture = draw(c);
    ASSERT_EQ(capture.attribute_count, 1U);
    for (uint32_t y = 4; y < 20; ++y) {
        for (uint32_t x = 4; x + y < 24; ++x) {
            for (int k = 0; k < 4; ++k) {
                ASSERT_EQ(bits(capture.attributes[0][index(capture, x, y)][k]), bits(values[0][k]));
            }
        }
    }
    EXPECT_EQ(bits(capture.attributes[0][index(capture, 40, 40)].z), bits(capture::kClearValue));
}

// A square of two triangles whose right side is 4 times as far away (w = 4).
cases::Case perspective_square(cases::Interpolation interpolation) {
    cases::Case c;
    c.id = "perspective";
    c.target = k64;
    c.draws.push_back(make_draw(k64, {}));
    c.draws[0].positions = {at(k64, 0, 0), at(k64, 64, 0, 0.5F, 4),  at(k64, 64, 64, 0.5F, 4),
                            at(k64, 0, 0), at(k64, 64, 64, 0.5F, 4), at(k64, 0, 64)};
    const std::vector<glm::vec4> values = {{0, 1, 0, 0}, {1, 1, 0, 0}, {1, 1, 0, 0},
                                           {0, 1, 0, 0}, {1, 1, 0, 0}, {0, 1, 0, 0}};
    c.draws[0].attributes.push_back(attribute(interpolation, values));
    return c;
}

TEST(Render, PerspectiveAndLinearInterpolation) {
    const auto captures = draw_all({perspective_square(cases::Interpolation::smooth),
                                    perspective_square(cases::Interpolation::noperspective)});
    for (uint32_t x = 0; x < 64; ++x) {
        const size_t k = index(captures[0], x, 40);
        const double t = (x + 0.5) / 64;  // linear on screen
        // 1/w is linear: 1 on the left, 1/4 on the right; f/w: 0 and 1/4.
        const double inverse_w = 1 - t + t / 4;
        EXPECT_NEAR(static_cast<double>(captures[0].attributes[0][k].x), t / 4 / inverse_w, 1e-5);
        EXPECT_NEAR(static_cast<double>(captures[1].attributes[0][k].x), t, 1e-5);
        EXPECT_NEAR(static_cast<double>(captures[0].frag_coord[k].w), inverse_w, 1e-5);
    }
    EXPECT_EQ(count(captures[0]).back, 4096U);
}

TEST(Render, FourAttributesOfAllModes) {
    using cases::Interpolation;
    cases::Case c = perspective_square(Interpolation::smooth);
    const std::vector<glm::vec4> values = c.draws[0].attributes[0].values;
    c.draws[0].attributes.push_back(attribute(Interpolation::flat, values));
    c.draws[0].attributes.push_back(attribute(Interpolation::noperspective, values));
    c.draws[0].attributes.push_back(attribute(Interpolation::smooth, values));
    const capture::Capture capture = draw(c);
    ASSERT_EQ(capture.attribute_count, 4U);
    const size_t k = index(capture, 31, 40);
    EXPECT_NEAR(static_cast<double>(capture.attributes[2][k].x), 31.5 / 64, 1e-5);
    EXPECT_EQ(capture.attributes[1][k], values[0]);
    EXPECT_EQ(capture.attributes[0][k], capture.attributes[3][k]);
    EXPECT_LT(capture.attributes[0][k].x, 0.25F);
}

// A large case that is alone is read back piece by piece; beside another one, in one piece.
TEST(Render, ALargeCaseIsTheSameInPieces) {
    using cases::Interpolation;
    cases::Case c = perspective_square(Interpolation::smooth);
    c.target.width = 1000;
    c.target.height = 999;
    std::vector<glm::vec4> values = c.draws[0].attributes[0].values;
    for (const uint32_t components : {1U, 2U, 3U}) {
        for (glm::vec4& value : values) {
            for (uint32_t k = components; k < 4; ++k) {
                value[static_cast<int>(k)] = 0;
            }
        }
        cases::Attribute a = attribute(Interpolation::noperspective, values);
        a.components = components;
        c.draws[0].attributes.push_back(a);
        values = c.draws[0].attributes[0].values;
    }
    c.draws[0].viewport.width = 900;
    c.draws[0].viewport.height = 950;
    c.draws[0].scissor = {0, 0, 1000, 999};
    for (const cases::DepthFormat depth :
         {cases::DepthFormat::d32_float, cases::DepthFormat::d16_unorm}) {
        c.target.depth_format = depth;
        c.target.color = cases::ColorTarget{cases::ColorFormat::rgba8_unorm, {}};
        const capture::Capture alone = draw(c);
        const capture::Capture beside = draw_all({make_case(k64, half_square()), c}).back();
        EXPECT_GT(count(alone).back + count(alone).front, 800'000U);
        EXPECT_GT(count(alone).clear, 100'000U);
        capture::for_each_plane(
            [](const capture::Plane& plane, const auto& a, const auto& b) {
                ASSERT_EQ(a.size(), plane.entries) << plane.name;
                const auto size = plane.entries * sizeof(a[0]);
                EXPECT_TRUE(size == 0 || std::memcmp(a.data(), b.data(), size) == 0) << plane.name;
            },
            alone, alone, beside);
    }
}

TEST(Render, DrawsWithFewerAttributesLeaveTheClearValue) {
    // In perspective, so that only a flat input keeps the bits.
    cases::Case c = perspective_square(cases::Interpolation::smooth);
    cases::Draw second = make_draw(k64, {});
    second.positions = {at(k64, 4.5F, 4.5F, 0.5F, 3), at(k64, 20.5F, 4.5F, 0.5F, 7),
                        at(k64, 4.5F, 20.5F, 0.5F, 0.25F)};
    c.draws.push_back(second);
    const capture::Capture capture = draw(c);
    uint32_t of_second = 0;
    for (size_t k = 0; k < capture.sample_count(); ++k) {
        const bool cleared = bits(capture.attributes[0][k].x) == bits(capture::kClearValue);
        ASSERT_EQ(cleared, capture.writers[k].draw == 1U) << k;
        of_second += cleared ? 1 : 0;
    }
    EXPECT_GT(of_second, 100U);
}

TEST(Render, DepthRange) {
    cases::Case c = make_case(k64, half_square());
    for (glm::vec4& p : c.draws[0].positions) {
        p.z = 0.25F;
    }
    c.draws[0].viewport.min_depth = 0.25F;
    c.draws[0].viewport.max_depth = 0.75F;
    cases::Case reversed = c;
    std::swap(reversed.draws[0].viewport.min_depth, reversed.draws[0].viewport.max_depth);
    const auto captures = draw_all({c, reversed});
    const size_t k = index(captures[0], 5, 5);
    EXPECT_EQ(captures[0].depth[k], 0.375F);
    EXPECT_EQ(captures[0].frag_coord[k].z, 0.375F);
    EXPECT_EQ(captures[1].depth[k], 0.625F);
    EXPECT_EQ(captures[1].frag_coord[k].z, 0.625F);
}

TEST(Render, CasesOfABatchDoNotTouch) {
    // The same target again and again, other sizes between them.
    std::vector<cases::Case> batch;
    for (uint32_t k = 0; k < 40; ++k) {
        const cases::Target target = {k % 3 == 0 ? 64U : 32U, k % 5 == 0 ? 16U : 32U, 1};
        const float side = static_cast<float>(1 + k % 8);
        batch.push_back(
            make_case(target, {{0, 0}, {side, 0}, {side, side}, {0, 0}, {side, side}, {0, side}}));
    }
    const auto captures = draw_all(batch);
    for (uint32_t k = 0; k < 40; ++k) {
        const uint64_t side = 1 + k % 8;
        const Count n = count(captures[k]);
        EXPECT_EQ(n.back, side * side);
        EXPECT_EQ(n.clear, captures[k].sample_count() - side * side);
    }
}

TEST(Render, EmptyCasesAreClear) {
    cases::Case none = make_case(k64, {});
    const Count n = count(draw(none));
    EXPECT_EQ(n.clear, 64U * 64U);
    cases::Case no_draw = none;
    no_draw.draws.clear();
    EXPECT_EQ(count(draw(no_draw)).clear, 64U * 64U);
}

TEST(Render, FourSamplesAreReadOneByOne) {
    // The interior square (10.125..10.875)^2 of a pixel holds samples 0 and 2 of the standard four;
    // right and bottom edges are excluded.
    const cases::Target target = {32, 32, 4};
    cases::Case c = make_case(target, {{10.125F, 10.125F},
                                       {10.875F, 10.125F},
                                       {10.125F, 10.875F},
                                       {10.875F, 10.125F},
                                       {10.875F, 10.875F},
                                       {10.125F, 10.875F}});
    c.draws[0].attributes.push_back(attribute(
        cases::Interpolation::flat, std::vector<glm::vec4>(6, glm::vec4(0.1F, -7, 1e-30F, 3))));
    const capture::Capture capture = draw(c);
    const Count n = count(capture);
    EXPECT_EQ(n.inconsistent + n.not_copied, 0U);
    EXPECT_EQ(n.front + n.back, 2U);
    EXPECT_EQ(n.clear, 32U * 32U * 4U - 2U);
    const size_t pixel = (size_t{10} * 32 + 10) * 4;
    for (size_t s = 0; s < 4; ++s) {
        const bool covered = s == 0 || s == 2;
        EXPECT_EQ(capture.hits[pixel + s].y, covered ? 1.0F : 0.0F) << s;
        EXPECT_EQ(bits(capture.attributes[0][pixel + s].z),
                  bits(covered ? 1e-30F : capture::kClearValue));
        EXPECT_EQ(capture.depth[pixel + s], covered ? 0.5F : capture::kClearDepth);
    }
}

TEST(Render, LargestSidesOfTheDevice) {
    const DeviceInfo& info = renderer().device();
    const cases::Target wide = {info.max_target_size, 2, 1};
    const cases::Target high = {2, info.max_target_size, 1};
    const auto captures = draw_all(
        {make_case(wide, {{-1, 0}, {static_cast<float>(2 * info.max_target_size), 0}, {-1, 9}}),
         make_case(high, {{0, -1}, {9, -1}, {0, static_cast<float>(2 * info.max_target_size)}})});
    for (const capture::Capture& capture : captures) {
        const Count n = count(capture);
        EXPECT_EQ(n.back, 2U * info.max_target_size);
        EXPECT_EQ(n.inconsistent + n.not_copied, 0U);
    }
}

TEST(Render, StepsComeInOrder) {
    std::vector<std::string> steps;
    const std::vector<cases::Case> batch = {make_case(k64, half_square())};
    renderer().render(batch, capture::kEveryPlane,
                      [&steps](std::string_view s) { steps.emplace_back(s); }, {});
    EXPECT_THAT(steps, ::testing::ElementsAre("pipeline", "record", "submit", "readback"));
}

// Some drivers blend all that comes behind it in its submission as the first colour.
TEST(Render, WhatDrawsToNoColourEndsItsSubmission) {
    const cases::Case colors = make_case(k64, half_square());
    cases::Case depth = colors;
    depth.target.has_instruments = false;
    const auto submissions = [](const std::vector<cases::Case>& batch) {
        size_t count = 0;
        const auto drawn = renderer().render(
            batch, capture::kEveryPlane,
            [&count](std::string_view s) { count += s == "submit" ? 1U : 0U; }, {});
        for (const capture::Rendered& one : drawn) {
            EXPECT_EQ(one.status, capture::Rendered::Status::drawn) << one.reason;
        }
        return count;
    };
    EXPECT_EQ(submissions({colors, colors}), 1U);
    EXPECT_EQ(submissions({colors, depth, depth}), 1U);
    EXPECT_EQ(submissions({depth, colors, depth, colors}), 3U);
}

TEST(Render, BareDrawsTheSameCases) {
    std::vector<cases::Case> batch = {make_case(k64, half_square())};
    const Rendered bare = render_bare(renderer(), batch).front();
    EXPECT_EQ(bare.status, Rendered::Status::drawn);
    EXPECT_TRUE(bare.capture.hits.empty());
    batch.push_back(batch[0]);
    batch[0].target.width = 1U << 20;
    std::vector<Rendered> results = render_bare(renderer(), batch);
    EXPECT_EQ(results[0].status, Rendered::Status::unsupported);
    EXPECT_EQ(results[1].status, Rendered::Status::drawn);
    batch[1].draws[0].indices = {{0, 1, 3}};
    results = render_bare(renderer(), batch);
    EXPECT_EQ(results[1].status, Rendered::Status::error);
    EXPECT_EQ(results[1].reason, "index 3 is beyond the 3 vertices of its draw");
}

TEST(Render, RejectedCasesStandBesideDrawnOnes) {
    std::vector<cases::Case> batch = {make_case(k64, half_square()), make_case(k64, half_square()),
                                      make_case(k64, half_square())};
    batch[0].target.width = 1U << 20;
    batch[1].draws[0].indices = {{0, 1, 3}};
    const auto results = renderer().render(batch);
    ASSERT_EQ(results.size(), 3U);
    EXPECT_EQ(results[0].status, Rendered::Status::unsupported);
    EXPECT_THAT(results[0].reason, ::testing::HasSubstr("1048576 x 64 pixels"));
    EXPECT_EQ(results[1].status, Rendered::Status::error);
    EXPECT_EQ(results[1].reason, "index 3 is beyond the 3 vertices of its draw");
    EXPECT_EQ(results[2].status, Rendered::Status::drawn);
    EXPECT_EQ(count(results[2].capture).back, 136U);
}

}  // namespace
}  // namespace vk_harness::testing
