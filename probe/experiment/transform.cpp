// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How a vertex gets into the framebuffer: x / w or x times 1/w, and the viewport's product and sum
// rounded once or twice. The last bit of it shows where it decides to which side a vertex snaps, so
// vertices are looked for that do.
#include <array>
#include <cmath>

#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"
#include "probe/experiment/snapping.hpp"
#include "probe/experiment/vernier.hpp"

namespace probe {

namespace {

constexpr uint32_t kRows = 96;  // half of it is no power of two, so that products are rounded
constexpr float kHalf = kRows / 2.0F;

// The ways, in binary32 but for the last.
struct Way {
    const char* divide;
    const char* viewport;
    double (*at)(float y, float w);
};
constexpr const char* kWider = "in more than binary32";
constexpr const char* kDivides = "x / w";
constexpr const char* kMultiplies = "x times 1/w";
constexpr const char* kApart = "the product is rounded, then the sum";
constexpr const char* kFused = "fused multiply-add";
double apart(float v) {
    const volatile float product = v * kHalf;  // no compiler may fuse it with the sum
    return static_cast<double>(product + kHalf);
}
double fused(float v) {
    return static_cast<double>(std::fma(v, kHalf, kHalf));
}
float times_inverse(float y, float w) {
    const volatile float inverse = 1.0F / w;
    return y * inverse;
}
constexpr auto kWays = std::to_array<Way>({
    {kDivides, kApart, [](float y, float w) { return apart(y / w); }},
    {kDivides, kFused, [](float y, float w) { return fused(y / w); }},
    {kMultiplies, kApart, [](float y, float w) { return apart(times_inverse(y, w)); }},
    {kMultiplies, kFused, [](float y, float w) { return fused(times_inverse(y, w)); }},
    {kWider, kWider,
     [](float y, float w) {
         return static_cast<double>(y) / static_cast<double>(w) * static_cast<double>(kHalf) +
                static_cast<double>(kHalf);
     }},
});

// A coordinate as S47.16; one beside what decides its side stays on that side.
int64_t snapped(const Snapping& snap, double at) {
    const double scaled = std::ldexp(at, snap.bits);
    const double low = std::floor(scaled);
    const double rest = scaled - low;
    const auto even = std::fmod(low, 2) < 0.5;
    bool is_up = false;
    switch (snap.rounding) {
        case Rounding::nearest_even:
            is_up = rest > 0.5 || (rest >= 0.5 && !even);
            break;
        case Rounding::nearest_up:
            is_up = rest >= 0.5;
            break;
        case Rounding::nearest_down:
            is_up = rest > 0.5;
            break;
        case Rounding::floor:
            break;
        case Rounding::ceil:
            is_up = rest > 0;
            break;
    }
    return static_cast<int64_t>(low + (is_up ? 1U : 0U)) *
           (int64_t{1} << (ref::kFixedBits - snap.bits));
}

struct Vertex {
    float y = 0, w = 1;
    std::array<int64_t, kWays.size()> at{};  // by each way
};
// A vertex beside a place where snapping changes side, that the ways put on different sides.
Vertex find_vertex(Dice& dice, const Snapping& snap, uint32_t row) {
    const double unit = std::ldexp(1.0, -snap.bits);
    const double offset = snap.rounding <= Rounding::nearest_down ? 0.5 : 0;
    const int64_t units = std::max<int64_t>((int64_t{1} << snap.bits) / 16, 1);
    Vertex v;
    for (int attempt = 0; attempt < 100000; ++attempt) {
        const double place =
            row + 0.5 - (static_cast<double>(dice.whole(0, units - 1)) + offset) * unit;
        v.w = static_cast<float>(dice.real(1, 4));
        v.y =
            static_cast<float>((place / static_cast<double>(kHalf) - 1) * static_cast<double>(v.w));
        bool differs = false;
        for (size_t k = 0; k < kWays.size(); ++k) {
            v.at[k] = snapped(snap, kWays[k].at(v.y, v.w));
            differs = differs || v.at[k] != v.at[0];
        }
        if (differs) {
            return v;
        }
    }
    return v;  // tells nothing
}

}  // namespace

void measure_transform(const Bench& bench) {
    Property divide;
    divide.id = "setup.divide";
    divide.question = "How vertices are divided by w";
    divide.experiment =
        "vertices beside the places where snapping changes side, which one bit more or less puts "
        "on another: where their edges cross a row";
    Property viewport = divide;
    viewport.id = "setup.viewport";
    viewport.question = "How the viewport transform is rounded";
    const Grid grid = grid_of(bench.sheet, bench.promises.limits.subpixel_bits);
    if (!grid.is_known) {
        bench.add_unknown(std::move(divide), "the grid could not be told");
        bench.add_unknown(std::move(viewport), "the grid could not be told");
        return;
    }
    std::vector<std::string> names(kWays.size());
    Vote vote(names);
    Scene scene("transform", kVernierLength, kRows);
    scene.target().has_depth = false;
    Dice dice(53);
    const double unit = std::ldexp(1.0, -grid.y.bits);
    const double aside = grid.y.rounding <= Rounding::nearest_down ? 0 : unit / 2;
    std::vector<Edge> edges;
    std::vector<Vertex> vertices;
    for (uint32_t row = 0; row < kRows; ++row) {
        const Vertex v = find_vertex(dice, grid.y, row);
        const Edge edge{0, 0, kVernierLength, row + 0.5625 + aside, {0, row + 1.0 + aside}, row};
        const float x = -v.w;  // the left border
        scene.add(Corner{}, {edge.along_b, edge.across_b}, edge.third);
        scene.draw().positions[3 * size_t{row}] = {x, v.y, 0.5F * v.w, v.w};
        edges.push_back(edge);
        vertices.push_back(v);
    }
    const Drawn drawn = bench.draw_one(scene.take());
    if (!drawn.picture) {
        bench.add_unknown(std::move(divide), drawn.why_not);
        bench.add_unknown(std::move(viewport), drawn.why_not);
        return;
    }
    for (uint32_t row = 0; row < kRows; ++row) {
        const int64_t count = count_row(*drawn.picture, row, false);
        const int64_t b = snapped(grid.y, edges[row].across_b);
        std::array<bool, kWays.size()> explains{};
        for (size_t k = 0; k < kWays.size(); ++k) {
            explains[k] = counts_of(edges[row], vertices[row].at[k], b).has(count);
        }
        vote.add([&](size_t k) { return explains[k]; });
    }
    vote.settle(divide, [](size_t k) { return std::string(kWays.at(k).divide); });
    vote.settle(viewport, [](size_t k) { return std::string(kWays.at(k).viewport); });
    bench.add(std::move(divide));
    bench.add(std::move(viewport));
}

}  // namespace probe
