// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The software device by itself, against counts that were worked out by hand or by an exact
// rational model, so that its verdict counts when it and the reference disagree.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "mutants/software.hpp"
#include "rasterizers/software/render.hpp"

namespace mutants {
namespace {

using Pixels = std::vector<std::array<double, 2>>;

cases::Case make_case(uint32_t size, const Pixels& pixels, uint32_t samples = 1) {
    cases::Case c;
    c.target = {size, size, samples};
    cases::Draw draw;
    const auto side = static_cast<float>(size);
    draw.viewport = {0, 0, side, side, 0, 1};
    draw.scissor = {0, 0, size, size};
    for (const auto& p : pixels) {
        const double half = static_cast<double>(size) / 2;
        draw.positions.emplace_back(static_cast<float>((p[0] - half) / half),
                                    static_cast<float>((p[1] - half) / half), 0.5F, 1.0F);
    }
    c.draws.push_back(draw);
    return c;
}

// How many samples have how many hits; without the zeros.
std::map<int, int> histogram(const capture::Capture& capture) {
    std::map<int, int> counts;
    for (const glm::vec4& h : capture.hits) {
        const int hits = static_cast<int>(h.x + h.y);
        if (hits > 0) {
            ++counts[hits];
        }
    }
    return counts;
}

std::map<int, int> count(uint32_t size, const Pixels& pixels, uint32_t samples = 1,
                         const Device& device = {}) {
    return histogram(render(make_case(size, pixels, samples), device));
}

using Histogram = std::map<int, int>;

TEST(Device, HalfSquares) {
    EXPECT_EQ(count(64, {{4.5, 4.5}, {20.5, 4.5}, {4.5, 20.5}}), (Histogram{{1, 136}}));
    EXPECT_EQ(count(64, {{20.5, 4.5}, {20.5, 20.5}, {4.5, 20.5}}), (Histogram{{1, 120}}));
    EXPECT_EQ(
        count(64, {{4.5, 4.5}, {20.5, 4.5}, {4.5, 20.5}, {20.5, 4.5}, {20.5, 20.5}, {4.5, 20.5}}),
        (Histogram{{1, 256}}));
}

// 136 pixels, in the layer of the draw alone.
TEST(Device, Layers) {
    cases::Case c = make_case(64, {{4.5, 4.5}, {20.5, 4.5}, {4.5, 20.5}});
    c.target.layers = 3;
    c.draws[0].layer = 2;
    const auto hits_by_layer = [&](Fault fault) {
        Device device;
        device.fault = fault;
        const capture::Capture capture = render(c, device);
        EXPECT_EQ(capture.hits.size(), 3U * 64 * 64);
        std::array<int, 3> counts{};
        for (size_t k = 0; k < capture.hits.size(); ++k) {
            counts.at(k / (size_t{64} * 64)) +=
                static_cast<int>(capture.hits[k].x + capture.hits[k].y);
        }
        return counts;
    };
    EXPECT_EQ(hits_by_layer(cases::kNoFault), (std::array<int, 3>{0, 0, 136}));
    EXPECT_EQ(hits_by_layer("layer-ignored"_fault), (std::array<int, 3>{136, 0, 0}));
    EXPECT_EQ(hits_by_layer("all-layers-written"_fault), (std::array<int, 3>{136, 136, 136}));
}

TEST(Device, SlopeThroughCentres) {
    EXPECT_EQ(count(64, {{1.5, 1.5}, {29.5, 13.5}, {29.5, 1.5}}), (Histogram{{1, 178}}));
    EXPECT_EQ(count(64, {{1.5, 1.5}, {29.5, 13.5}, {1.5, 13.5}}), (Histogram{{1, 158}}));
    EXPECT_EQ(count(64, {{29.5, 1.5}, {1.5, 13.5}, {1.5, 1.5}}), (Histogram{{1, 186}}));
    EXPECT_EQ(count(64, {{29.5, 1.5}, {1.5, 13.5}, {29.5, 13.5}}), (Histogram{{1, 150}}));
}

TEST(Device, EveryTieRuleTilesTheFanOnce) {
    const Pixels ring = {{14.5, 10.5}, {14.5, 14.5}, {10.5, 14.5}, {6.5, 14.5},
                         {6.5, 10.5},  {6.5, 6.5},   {10.5, 6.5},  {14.5, 6.5}};
    Pixels fan;
    for (size_t k = 0; k < ring.size(); ++k) {
        fan.push_back({10.5, 10.5});
        fan.push_back(ring[k]);
        fan.push_back(ring[(k + 1) % ring.size()]);
    }
    for (const TieRule rule : {TieRule::top_left, TieRule::top_right, TieRule::bottom_left,
                               TieRule::bottom_right, TieRule::left_top}) {
        Device device;
        device.ties = rule;
        EXPECT_EQ(count(64, fan, 1, device), (Histogram{{1, 64}}));
    }
}

TEST(Device, Slivers) {
    const double u = 1.0 / 256;
    EXPECT_EQ(count(64, {{1, 10.5}, {61, 10.5}, {61, 10.5 + u}}), (Histogram{{1, 60}}));
    EXPECT_EQ(count(64, {{1, 10.5}, {61, 10.5}, {61, 10.5 - u}}), Histogram{});
    EXPECT_EQ(count(64, {{1.5, 1.5}, {61.5, 61.5}, {61.5 + u, 61.5}}), (Histogram{{1, 59}}));
    EXPECT_EQ(count(64, {{10.5, 10.5}, {10.5 + u, 10.5}, {10.5, 10.5 + u}}), (Histogram{{1, 1}}));
    EXPECT_EQ(count(64, {{2, 10.51}, {62, 10.51}, {2, 11.49}}), Histogram{});
    EXPECT_EQ(count(64, {{1.5, 1.5}, {31.5, 31.5}, {61.5, 61.5}}), Histogram{});
}

// Pixel (10,16) under nearest-even, half-up, floor, ceil: which roundings cover it.
TEST(Device, RoundingIsWhatItsNameSays) {
    struct Row {
        double a, b;
        std::array<bool, 4> covered;
    };
    const Row rows[] = {
        {-.5, 1, {false, false, true, false}},  {.5, 0, {true, false, true, false}},
        {1.5, -1, {false, false, true, false}}, {2.5, -2, {true, false, true, false}},
        {.75, 0, {false, false, true, false}},  {.25, 0, {true, true, true, false}}};
    const Rounding roundings[] = {Rounding::nearest_even, Rounding::half_up, Rounding::floor,
                                  Rounding::ceil};
    for (const int bits : {4, 8}) {
        const double u = std::ldexp(1.0, -bits);
        for (const Row& row : rows) {
            const cases::Case c =
                make_case(32, {{10.5 + row.a * u, 2.5}, {10.5 + row.b * u, 30.5}, {30, 16}});
            for (size_t k = 0; k < 4; ++k) {
                Device device;
                device.subpixel_bits = bits;
                device.rounding = roundings[k];
                const capture::Capture capture = render(c, device);
                const glm::vec4& h = capture.hits[16 * 32 + 10];
                EXPECT_EQ(h.x + h.y > 0, row.covered[k]) << row.a << " " << bits << " " << k;
            }
        }
    }
}

TEST(Device, SizesAroundTiles) {
    EXPECT_EQ(count(128, {{63.4, 0}, {64.6, 0}, {63.4, 128}, {64.6, 0}, {64.6, 128}, {63.4, 128}}),
              (Histogram{{1, 256}}));
    EXPECT_EQ(count(256, {{64, 64}, {192, 64}, {64, 192}}), (Histogram{{1, 8128}}));
    EXPECT_EQ(count(256, {{192, 64}, {192, 192}, {64, 192}}), (Histogram{{1, 8256}}));
    EXPECT_EQ(count(256, {{.5, .5},
                          {128.5, .5},
                          {.5, 128.5},
                          {128.5, .5},
                          {128.5 + 1.0 / 256, 128.5},
                          {.5, 128.5}}),
              (Histogram{{1, 16511}}));
}

TEST(Device, CoveringTriangles) {
    for (const double s : {1e2, 1e3, 1e4, 1e5, 1e6}) {
        for (const ClipMethod clip : {ClipMethod::geometric, ClipMethod::guard_band}) {
            Device device;
            device.clip = clip;
            EXPECT_EQ(count(64, {{-3 * s, -s}, {3 * s, -s}, {.1 * s, 4 * s}}, 1, device),
                      (Histogram{{1, 4096}}));
        }
    }
}

TEST(Device, MultisampleTies) {
    EXPECT_EQ(count(64, {{10.375, 10.125}, {10.875, 10.375}, {10.125, 10.625}}, 4), Histogram{});
    EXPECT_EQ(count(64,
                    {{10.125, 10.125},
                     {10.875, 10.125},
                     {10.125, 10.875},
                     {10.875, 10.125},
                     {10.875, 10.875},
                     {10.125, 10.875}},
                    4),
              (Histogram{{1, 2}}));
    EXPECT_EQ(count(64, {{10.46, 10.40}, {10.56, 10.45}, {10.49, 10.60}}, 4), Histogram{});
    EXPECT_EQ(count(64, {{10.8, 10.3}, {10.95, 10.35}, {10.85, 10.45}}, 4), (Histogram{{1, 1}}));
}

TEST(Device, TJunctions) {
    EXPECT_EQ(
        count(
            128,
            {{8, 8}, {72, 40}, {70, 2}, {8, 8}, {20, 60}, {40, 24}, {40, 24}, {20, 60}, {72, 40}}),
        (Histogram{{1, 2656}}));
    EXPECT_EQ(count(64, {{10.5, 10.5},
                         {30.5, 10.5},
                         {10.5, 30.5},
                         {30.5, 10.5},
                         {10.5, 30.5},
                         {30.5, 30.5},
                         {10.5, 10.5},
                         {30.5, 30.5},
                         {30.5, 10.5}}),
              (Histogram{{1, 190}, {2, 210}}));
}

// One or two vertices behind the eye; the counts are those of the exact model.
TEST(Device, BehindTheEye) {
    const auto clip = [](std::array<glm::vec4, 3> v, const Device& device) {
        cases::Case c = make_case(64, {});
        c.draws[0].positions.assign(v.begin(), v.end());
        return histogram(render(c, device));
    };
    for (const ClipMethod method : {ClipMethod::geometric, ClipMethod::guard_band}) {
        Device device;
        device.clip = method;
        cases::Case c = make_case(32, {});
        c.draws[0].positions = {{-.5F, -.5F, .5F, 1}, {.5F, -.5F, .5F, 1}, {0, .9F, .5F, 1}};
        EXPECT_EQ(histogram(render(c, device)).size(), 1U);
        EXPECT_EQ(clip({{{-1, -1, .5F, -1}, {1, -1, .5F, -1}, {0, 1, .5F, -1}}}, device),
                  Histogram{});
    }
}

// A random mesh of shared vertices, clipped on all sides: every pixel exactly once.
TEST(Device, ClippedMeshIsClosed) {
    constexpr int kCells = 12;
    for (const double scale : {1.3, 50.0, 1000.0, 1e5}) {
        std::mt19937 random(7);
        const auto real = [&](double lo, double hi) {
            return lo + (hi - lo) * static_cast<double>(random()) / 4294967296.0;
        };
        std::vector<glm::vec4> points;
        for (int y = 0; y <= kCells; ++y) {
            for (int x = 0; x <= kCells; ++x) {
                const double w = real(.5, 4);
                const double nx = (x + real(-.3, .3)) * 2 / kCells - 1;
                const double ny = (y + real(-.3, .3)) * 2 / kCells - 1;
                points.emplace_back(static_cast<float>(nx * scale * w),
                                    static_cast<float>(ny * scale * w), static_cast<float>(w * .5),
                                    static_cast<float>(w));
            }
        }
        cases::Case c = make_case(64, {});
        std::vector<uint32_t> indices;
        for (uint32_t y = 0; y < kCells; ++y) {
            for (uint32_t x = 0; x < kCells; ++x) {
                const uint32_t v = y * (kCells + 1) + x;
                for (const uint32_t k :
                     {v, v + 1, v + kCells + 1, v + 1, v + kCells + 2, v + kCells + 1}) {
                    indices.push_back(k);
                }
            }
        }
        c.draws[0].positions = points;
        c.draws[0].indices = indices;
        for (const ClipMethod method : {ClipMethod::geometric, ClipMethod::guard_band}) {
            for (const Rounding rounding : {Rounding::nearest_even, Rounding::floor}) {
                Device device;
                device.clip = method;
                device.rounding = rounding;
                const Histogram h = histogram(render(c, device));
                if (scale > 1.5) {  // the outline lies outside the target
                    EXPECT_EQ(h, (Histogram{{1, 4096}})) << scale;
                } else {
                    EXPECT_EQ(h.size(), 1U);
                }
            }
        }
    }
}

TEST(Device, NegativeHeightKeepsTheTieRule) {
    cases::Case c = make_case(32, {{4.5, 4.5}, {20.5, 4.5}, {4.5, 20.5}});
    c.draws[0].viewport = {0, 32, 32, -32, 0, 1};
    const capture::Capture capture = render(c, {});
    int row = 0;
    int column = 0;
    for (size_t k = 0; k < 32; ++k) {
        row += static_cast<int>(capture.hits[27 * 32 + k].x + capture.hits[27 * 32 + k].y);
        column += static_cast<int>(capture.hits[k * 32 + 4].x + capture.hits[k * 32 + 4].y);
    }
    EXPECT_EQ(row, 0);
    EXPECT_EQ(column, 15);
}

TEST(Device, DegenerateStripKeepsParity) {
    const Pixels strip = {{4, 4}, {4, 40}, {30, 6}, {30, 6}, {34, 50}, {34, 50}, {60, 8}, {58, 60}};
    cases::Case c = make_case(64, strip);
    c.draws[0].topology = cases::Topology::triangle_strip;
    const Histogram h = histogram(render(c, {}));
    EXPECT_EQ(h, (Histogram{{1, 1101}}));
}

// Every form of the planes gives the same plane x/64 + y/128, perspective or not, to binary32.
TEST(Device, PlaneFormsAgree) {
    for (const PlaneForm form : {PlaneForm::origin, PlaneForm::vertex, PlaneForm::barycentric}) {
        for (const bool fused : {false, true}) {
            cases::Case c = make_case(64, {{4, 4}, {60, 8}, {20, 56}});
            cases::Attribute linear;
            linear.interpolation = cases::Interpolation::noperspective;
            linear.values = {{4 / 64.F, 0, 0, 0}, {60 / 64.F, 0, 0, 0}, {20 / 64.F, 0, 0, 0}};
            cases::Attribute smooth;
            smooth.values = {{4, 1, 0, 0}, {60 * 2, 2, 0, 0}, {20 * .5F, .5F, 0, 0}};
            c.draws[0].attributes = {linear, smooth};
            c.draws[0].positions[1] *= 2.0F;
            c.draws[0].positions[2] *= 0.5F;
            Device device;
            device.planes = form;
            device.fused = fused;
            const capture::Capture capture = render(c, device);
            const size_t at = 20 * 64 + 24;
            ASSERT_GT(capture.hits[at].x + capture.hits[at].y, 0);
            EXPECT_NEAR(capture.attributes[0][at].x, 24.5F / 64, 1e-6F);
            // f = x w and g = w: the quotient is x wherever perspective is done right
            EXPECT_NEAR(capture.attributes[1][at].x / capture.attributes[1][at].y, 24.5F, 2e-4F);
        }
    }
}

}  // namespace
}  // namespace mutants
