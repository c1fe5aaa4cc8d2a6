// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How a vertex gets into the framebuffer: x / w or x times 1/w, and the viewport's product and sum
// rounded once or twice, the product after the division or before it. The last bit of it shows
// where it decides to which side a vertex snaps, so vertices are looked for that do.
//
// Where none of these explains what was drawn, 1/w may be off by a unit in the last place, as the
// reciprocals of graphics processors are. That is asked apart, since it explains whatever an exact
// 1/w does, too.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"
#include "probe/experiment/snapping.hpp"
#include "probe/experiment/vernier.hpp"

namespace probe {

namespace {

constexpr uint32_t kRows = 96;  // half of it is no power of two, so that products are rounded
constexpr uint32_t kScenes = 16;
constexpr float kHalf = kRows / 2.0F;

// Where a way may put a vertex.
using Places = std::vector<double>;

// The ways, in binary32 but for one.
struct Way {
    const char* divide;
    const char* viewport;
    bool is_near;  // 1/w within a unit in the last place
    Places (*at)(float y, float w);
};
constexpr const char* kWider = "in more than binary32";
constexpr const char* kDivides = "x / w";
constexpr const char* kMultiplies = "x times 1/w";
constexpr const char* kNearly = "x times 1/w, which is off by a unit in the last place at most";
constexpr const char* kApart = "the product is rounded, then the sum";
constexpr const char* kFused = "fused multiply-add";
constexpr const char* kScaledFirst = "the product before the division, then the sum, each rounded";

// No compiler may fuse a product with a sum.
float product(float a, float b) {
    const volatile float out = a * b;
    return out;
}
double plus_half(float v) {
    return static_cast<double>(v + kHalf);
}
double apart(float v) {
    return plus_half(product(v, kHalf));
}
double fused(float v) {
    return static_cast<double>(std::fma(v, kHalf, kHalf));
}
// 1/w, and its neighbours.
template <class Place>
Places with_inverses(float w, bool is_near, const Place& place) {
    const float inverse = 1.0F / w;
    Places out{place(inverse)};
    if (is_near) {
        out.push_back(place(std::nextafter(inverse, 0.0F)));
        out.push_back(place(std::nextafter(inverse, 2.0F * inverse)));
    }
    return out;
}
template <bool kIsNear>
Places times_apart(float y, float w) {
    return with_inverses(w, kIsNear, [&](float inverse) { return apart(product(y, inverse)); });
}
template <bool kIsNear>
Places times_fused(float y, float w) {
    return with_inverses(w, kIsNear, [&](float inverse) { return fused(product(y, inverse)); });
}
template <bool kIsNear>
Places scaled_first(float y, float w) {
    return with_inverses(
        w, kIsNear, [&](float inverse) { return plus_half(product(product(y, kHalf), inverse)); });
}

constexpr auto kWays = std::to_array<Way>({
    {kDivides, kApart, false, [](float y, float w) { return Places{apart(y / w)}; }},
    {kDivides, kFused, false, [](float y, float w) { return Places{fused(y / w)}; }},
    {kDivides, kScaledFirst, false,
     [](float y, float w) { return Places{plus_half(product(y, kHalf) / w)}; }},
    {kMultiplies, kApart, false, times_apart<false>},
    {kMultiplies, kFused, false, times_fused<false>},
    {kMultiplies, kScaledFirst, false, scaled_first<false>},
    {kWider, kWider, false,
     [](float y, float w) {
         return Places{static_cast<double>(y) / static_cast<double>(w) *
                           static_cast<double>(kHalf) +
                       static_cast<double>(kHalf)};
     }},
    {kNearly, kApart, true, times_apart<true>},
    {kNearly, kFused, true, times_fused<true>},
    {kNearly, kScaledFirst, true, scaled_first<true>},
});
std::vector<size_t> ways(bool are_near) {
    std::vector<size_t> out;
    for (size_t k = 0; k < kWays.size(); ++k) {
        if (kWays.at(k).is_near == are_near) {
            out.push_back(k);
        }
    }
    return out;
}

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
    std::array<std::vector<int64_t>, kWays.size()> at;  // by each way
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
            v.at[k].clear();
            for (const double at : kWays[k].at(v.y, v.w)) {
                v.at[k].push_back(snapped(snap, at));
            }
            differs = differs || v.at[k][0] != v.at[0][0];
        }
        if (differs) {
            return v;
        }
    }
    return v;  // tells nothing
}

}  // namespace

void measure_transform(const Bench& bench) {
    const std::string how =
        "vertices beside the places where snapping changes side, which one bit more or less puts "
        "on another: where their edges cross a row";
    Finding viewport(bench, "setup.viewport", "How the viewport transform is rounded", how);
    Finding divide(bench, "setup.divide", "How vertices are divided by w", how);
    const Grid grid = grid_of(bench.sheet, bench.promises.limits.subpixel_bits);
    if (!grid.is_known) {
        divide.why = viewport.why = "the grid could not be told";
        return;
    }
    const std::array groups{ways(false), ways(true)};
    std::array votes{Vote(std::vector<std::string>(groups[0].size())),
                     Vote(std::vector<std::string>(groups[1].size()))};
    Dice dice(53);
    const double unit = std::ldexp(1.0, -grid.y.bits);
    const double aside = grid.y.rounding <= Rounding::nearest_down ? 0 : unit / 2;
    for (uint32_t n = 0; n < kScenes; ++n) {
        Scene scene("transform", kVernierLength, kRows);
        scene.target().has_depth = false;
        std::vector<Edge> edges;
        std::vector<Vertex> vertices;
        for (uint32_t row = 0; row < kRows; ++row) {
            const Vertex v = find_vertex(dice, grid.y, row);
            const Edge edge{0,  0, kVernierLength, row + 0.5625 + aside, {0, row + 1.0 + aside},
                            row};
            const float x = -v.w;  // the left border
            scene.add(Corner{}, {edge.along_b, edge.across_b}, edge.third);
            scene.draw().positions[3 * size_t{row}] = {x, v.y, 0.5F * v.w, v.w};
            edges.push_back(edge);
            vertices.push_back(v);
        }
        const Drawn drawn = bench.draw_one(scene.take());
        if (!drawn.picture) {
            divide.why = viewport.why = drawn.why_not;
            return;
        }
        for (uint32_t row = 0; row < kRows; ++row) {
            const int64_t count = count_row(*drawn.picture, row, false);
            const int64_t b = snapped(grid.y, edges[row].across_b);
            const auto explains = [&](size_t way) {
                const std::vector<int64_t>& at = vertices[row].at.at(way);
                return std::ranges::any_of(
                    at, [&](int64_t a) { return counts_of(edges[row], a, b).has(count); });
            };
            for (size_t g = 0; g < groups.size(); ++g) {
                votes.at(g).add([&](size_t k) { return explains(groups.at(g).at(k)); });
            }
        }
    }
    for (size_t g = 0; g < groups.size(); ++g) {
        const auto way = [&](size_t k) -> const Way& { return kWays.at(groups.at(g).at(k)); };
        Property by_divide = divide;
        Property by_viewport = viewport;
        votes.at(g).settle(by_viewport, [&](size_t k) { return std::string(way(k).viewport); });
        votes.at(g).settle(by_divide, [&](size_t k) { return std::string(way(k).divide); });
        if (g == 0 || by_viewport.is_known()) {
            divide = by_divide;
            viewport = by_viewport;
        }
        if (divide.is_known() || viewport.is_known()) {
            break;
        }
    }
}

}  // namespace probe
