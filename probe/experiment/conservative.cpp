// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Conservative draws: how far beyond an edge pixels are overestimated, how far inside it they have
// to lie to be underestimated, where enlarged corners end, and whether what clipping leaves is one
// polygon.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "cases/base/counted.hpp"
#include "cases/base/number_text.hpp"
#include "probe/base/scene.hpp"
#include "probe/experiment/experiments.hpp"

namespace probe {

namespace {

using cases::Conservative;

constexpr uint32_t kWidth = 64;
constexpr uint32_t kBorder = 32;  // the column whose left border edges come near

uint32_t hits_of(const capture::Capture& picture, uint32_t x, uint32_t y) {
    const glm::vec4& hits = picture.hits[size_t{y} * picture.target.width + x];
    return static_cast<uint32_t>(hits.x + hits.y);
}

Scene make_scene(const std::string& id, uint32_t height, Conservative mode) {
    Scene scene(id, kWidth, height);
    scene.target().has_depth = false;
    scene.draw().conservative = mode;
    return scene;
}

// Distances from the border, in pixels: the first units of the grid, then steps of 1/64.
std::vector<double> gaps(int bits, int steps) {
    std::vector<double> out;
    for (int k = 0; k <= 4; ++k) {
        out.push_back(std::ldexp(k, -bits));
    }
    for (int k = 1; k <= steps; ++k) {
        out.push_back(k / 64.0);
    }
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

std::string text_of(double gap, int bits) {
    const double units = std::ldexp(gap, bits);
    return units <= 4 ? cases::counted(static_cast<uint64_t>(units), "unit") + " of the grid"
                      : cases::number_text(gap) + " pixel";
}

// Triangles with an upright edge near the border, one a cell of rows: which pixels of a column, in
// one row of each cell, are covered.
struct Ladder {
    const char* id;
    Conservative mode;
    uint32_t cell;    // rows
    uint32_t row;     // in the cell
    uint32_t column;  // the pixel at the border
};
// How many of the first gaps are answered as the nearest is expected to be. Returns
// nothing if that cannot be told: then the property says why.
template <class Triangle>
std::optional<size_t> climb(const Bench& bench, Property& property, const Ladder& ladder,
                            const std::vector<double>& all, bool first, const Triangle& add) {
    constexpr uint32_t kAside = 4;  // columns left of the border, far from all edges
    Scene scene = make_scene(ladder.id, 512, ladder.mode);
    for (size_t k = 0; k < all.size(); ++k) {
        add(scene, all[k], static_cast<double>(ladder.cell * k));
    }
    const auto picture = bench.picture_of(scene.take(), property);
    if (!picture) {
        return std::nullopt;
    }
    size_t count = 0;
    bool is_drawn = true;
    bool is_monotonic = true;
    for (size_t k = 0; k < all.size(); ++k) {
        const auto row = static_cast<uint32_t>(ladder.cell * k + ladder.row);
        const bool is_first = (hits_of(*picture, ladder.column, row) > 0) == first;
        is_monotonic = is_monotonic && (!is_first || count == k);
        count += is_first ? 1U : 0U;
        is_drawn = is_drawn && hits_of(*picture, kBorder - kAside, row) > 0;
    }
    if (!is_drawn || !is_monotonic) {
        property.why =
            is_drawn ? "nearer and farther pixels are covered in turns" : "a triangle is not drawn";
        return std::nullopt;
    }
    property.agree = all.size();
    return count;
}

// Each edge lies this far left of a pixel.
void measure_reach(const Bench& bench) {
    Finding property(
        bench, "conservative.reach", "How far beyond an edge pixels are overestimated",
        "triangles with an upright edge 0 to 1 pixel left of a pixel, which is covered or not");
    const int bits = bench.promises.limits.subpixel_bits;
    const std::vector<double> all = gaps(bits, 64);
    const auto count =
        climb(bench, property, {"conservative-reach", Conservative::overestimate, 4, 1, kBorder},
              all, true, [](Scene& scene, double gap, double y) {
                  const double x = kBorder - gap;
                  scene.add({x, y + 0.25}, {x, y + 2.75}, {8, y + 1.5});
              });
    if (!count) {
        return;
    }
    property.answer = *count == 0           ? "not at all, and not where borders alone meet"
                      : *count == 1         ? "not at all, but where borders meet"
                      : *count < all.size() ? "by " + text_of(all[*count - 1], bits)
                                            : "by a pixel or more";
}

// Each edge lies this far right of a pixel.
void measure_inner(const Bench& bench) {
    Finding property(
        bench, "conservative.inner", "How far inside an edge underestimated pixels lie",
        "triangles with an upright edge 0 to 1/4 pixel right of a pixel that they hold");
    const int bits = bench.promises.limits.subpixel_bits;
    const std::vector<double> all = gaps(bits, 16);
    const auto count = climb(
        bench, property, {"conservative-inner", Conservative::underestimate, 16, 7, kBorder - 1},
        all, false, [](Scene& scene, double gap, double y) {
            const double x = kBorder + gap;
            scene.add({x, y + 1}, {x, y + 15}, {x - 14, y + 8});
        });
    if (!count) {
        return;
    }
    property.answer = *count == 0           ? "up to the edge"
                      : *count < all.size() ? text_of(all[*count], bits) + " from it"
                                            : "more than 1/4 pixel from it";
}

// A needle to the right: its edges rise by 1/8. Enlarged by s, its box ends s beyond the tip, and
// its edges, moved by s along x and y, meet 9 s beyond it.
void measure_corners(const Bench& bench) {
    Finding property(bench, "conservative.corners", "Where enlarged corners end",
                     "a needle that is enlarged by 1/4 pixel, or more if the device adds to it");
    constexpr double kTip = 32.5;
    constexpr uint32_t kRow = 16;
    Scene scene = make_scene("conservative-corners", 32, Conservative::overestimate);
    scene.draw().conservative_extra = 0.25F;
    scene.add({kTip - 16, kRow + 0.5 - 2}, {kTip, kRow + 0.5}, {kTip - 16, kRow + 0.5 + 2});
    const auto picture = bench.picture_of(scene.take(), property);
    if (!picture) {
        return;
    }
    // The box reaches from 32.75 to 33.25 at most, the edges to 34.75 at least.
    property.agree = 1;
    if (hits_of(*picture, 34, kRow) > 0) {
        property.answer = "where the moved edges meet";
    } else if (hits_of(*picture, 32, kRow) > 0) {
        property.answer = "with the box around the triangle";
    } else {
        property.agree = 0;
        property.why = "the needle's tip is not covered";
    }
}

// The near plane leaves quads; along each of their diagonals lie some pixels.
void measure_pieces(const Bench& bench) {
    Finding property(
        bench, "conservative.pieces", "How what clipping leaves is overestimated",
        "triangles of which the near plane cuts off a corner: how often pixels are hit inside");
    Scene scene = make_scene("conservative-pieces", 64, Conservative::overestimate);
    const double top[] = {1, 17, 33, 49};
    for (const double y : top) {
        scene.add({1.25, y + 0.5, 0.75}, {58.75, y + 1.25, 0.75}, {29.125, y + 13.5, -0.25});
    }
    const auto picture = bench.picture_of(scene.take(), property);
    if (!picture) {
        return;
    }
    uint64_t once = 0;
    uint64_t twice = 0;
    for (uint32_t y = 0; y < 64; ++y) {
        for (uint32_t x = 0; x < kWidth; ++x) {
            const uint32_t hits = hits_of(*picture, x, y);
            once += hits == 1 ? 1U : 0U;
            twice += hits > 1 ? 1U : 0U;
        }
    }
    property.agree = twice > 0 ? twice : once;
    if (once == 0) {
        property.why = "no pixel is hit once";
    } else {
        property.answer = twice > 0 ? "triangle by triangle" : "as one polygon";
    }
}

}  // namespace

void measure_conservative(const Bench& bench) {
    measure_reach(bench);
    measure_inner(bench);
    measure_corners(bench);
    measure_pieces(bench);
}

}  // namespace probe
