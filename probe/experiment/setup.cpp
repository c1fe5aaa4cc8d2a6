// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// From which positions a triangle is set up: those of its vertices, or where they are on the
// subpixel grid; asked of each quantity, of facing, and of what clipping leaves.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "probe/base/scene.hpp"
#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"
#include "probe/experiment/snapping.hpp"
#include "probe/experiment/triangle.hpp"

namespace probe {

namespace {

constexpr uint32_t kSide = 64, kCell = 16, kAcross = kSide / kCell;
constexpr const char* kUnsnapped = "unsnapped positions";
constexpr const char* kSnapped = "snapped positions";
constexpr const char* kPieces = "snapped positions of the pieces";

// A position some 0.3 to 0.45 of a unit off the grid, in a cell.
double off_grid(Dice& dice, int bits, double low, double high) {
    const double unit = std::ldexp(1.0, -bits);
    const double base = std::floor(dice.real(low, high) / unit) * unit;
    const double off = dice.real(0.3, 0.45) * (dice.whole(0, 1) == 0 ? -1 : 1);
    return base + off * unit;
}

// A corner off the grid in one of the squares, with z of 1/2 and w of 1.
Corner corner_in(uint32_t cell, const Grid& grid, Dice& dice) {
    const double left = (cell % kAcross) * kCell;
    const double top = (cell / kAcross) * kCell;
    return {off_grid(dice, grid.x.bits, left + 1, left + kCell - 1),
            off_grid(dice, grid.y.bits, top + 1, top + kCell - 1)};
}

// One triangle as it was handed over.
struct Given {
    Points at;
    std::array<double, 3> z{}, w{}, smooth{}, linear{};
};

// Triangles with everything that is interpolated.
struct Sheet {
    Scene scene;
    std::vector<Given> given;
};
Sheet make_sheet(const Grid& grid) {
    Sheet sheet{Scene("setup", kSide, kSide), {}};
    Dice dice(41);
    for (uint32_t cell = 0; cell < kAcross * kAcross; ++cell) {
        add_triangle(sheet.scene, 32, [&](size_t) {
            Corner c = corner_in(cell, grid, dice);
            c.z = dice.real(0, 1);
            c.w = dice.real(1, 4);
            return c;
        });
    }
    cases::Attribute smooth;
    smooth.name = "smooth";
    cases::Attribute noperspective = smooth;
    noperspective.name = "linear";
    noperspective.interpolation = cases::Interpolation::noperspective;
    const cases::Draw& draw = sheet.scene.draw();
    for (size_t v = 0; v < draw.positions.size(); ++v) {
        smooth.values.emplace_back(static_cast<float>(dice.real(-1, 1)), 0, 0, 0);
        noperspective.values.emplace_back(static_cast<float>(dice.real(-1, 1)), 0, 0, 0);
    }
    for (size_t t = 0; 3 * t < draw.positions.size(); ++t) {
        Given g;
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec4& position = draw.positions[3 * t + k];
            g.at[k] = in_framebuffer(position, draw.viewport);
            g.w[k] = static_cast<double>(position.w);
            g.z[k] = static_cast<double>(position.z) / g.w[k];
            g.smooth[k] = static_cast<double>(smooth.values[3 * t + k].x);
            g.linear[k] = static_cast<double>(noperspective.values[3 * t + k].x);
        }
        sheet.given.push_back(g);
    }
    sheet.scene.draw().attributes = {smooth, noperspective};
    return sheet;
}

// What is asked of a fragment: what the device drew, and what set-up at given positions gives.
struct Quantity {
    const char* id;
    const char* name;
    std::function<double(const capture::Capture&, size_t)> got;
    std::function<double(const Given&, const std::array<double, 3>& b)> of;
};
std::vector<Quantity> quantities() {
    const auto inverse = [](const Given& g) {
        return std::array{1 / g.w[0], 1 / g.w[1], 1 / g.w[2]};
    };
    return {
        {"setup.smooth", "smooth inputs",
         [](const auto& c, size_t k) { return static_cast<double>(c.attributes[0][k].x); },
         [](const Given& g, const auto& b) { return perspective(b, g.smooth, g.w); }},
        {"setup.noperspective", "noperspective inputs",
         [](const auto& c, size_t k) { return static_cast<double>(c.attributes[1][k].x); },
         [](const Given& g, const auto& b) { return linear(b, g.linear); }},
        {"setup.depth", "the depth that is stored",
         [](const auto& c, size_t k) { return static_cast<double>(c.depth[k]); },
         [](const Given& g, const auto& b) { return linear(b, g.z); }},
        {"setup.frag_coord_z", "FragCoord.z",
         [](const auto& c, size_t k) { return static_cast<double>(c.frag_coord[k].z); },
         [](const Given& g, const auto& b) { return linear(b, g.z); }},
        {"setup.frag_coord_w", "FragCoord.w",
         [](const auto& c, size_t k) { return static_cast<double>(c.frag_coord[k].w); },
         [inverse](const Given& g, const auto& b) { return linear(b, inverse(g)); }},
    };
}

// Lets the numbers vote that the candidates predict: decisive if they differ by far more than
// binary32 loses of numbers up to 1.
void vote_by_numbers(Vote& vote, double got, const std::vector<double>& predicted) {
    double gap = 2;
    for (size_t a = 0; a < predicted.size(); ++a) {
        for (size_t b = a + 1; b < predicted.size(); ++b) {
            gap = std::min(gap, std::fabs(predicted[a] - predicted[b]));
        }
    }
    if (gap > 0x1p-18) {
        vote.add([&](size_t k) { return std::fabs(got - predicted[k]) < gap / 3; });
    }
}

// Calls visit(index in the planes, number of its triangle, its pixel's centre) for each fragment of
// one triangle a cell.
template <class Visit>
void for_each_fragment(const capture::Capture& picture, Visit visit) {
    for (size_t k = 0; k < picture.sample_count(); ++k) {
        if (is_hit(picture, k)) {
            const size_t x = k % kSide;
            const size_t y = k / kSide;
            visit(k, (y / kCell) * kAcross + x / kCell,
                  Point{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5});
        }
    }
}

void measure_quantities(const Bench& bench, const Grid& grid) {
    Sheet sheet = make_sheet(grid);
    const Drawn drawn = bench.draw_one(sheet.scene.get());
    for (const Quantity& q : quantities()) {
        Finding property(
            bench, q.id, fmt::format("From what {} is set up", q.name),
            "triangles whose vertices lie off the grid, where the two positions give values that "
            "differ by far more than binary32 loses");
        if (!drawn.picture) {
            property.why = drawn.why_not;
            continue;
        }
        Vote vote({kUnsnapped, kSnapped});
        for_each_fragment(*drawn.picture, [&](size_t k, size_t t, const Point& at) {
            const Given& g = sheet.given[t];
            vote_by_numbers(
                vote, q.got(*drawn.picture, k),
                {q.of(g, barycentrics(g.at, at)), q.of(g, barycentrics(snapped(g.at, grid), at))});
        });
        vote.settle(property);
    }
}

// One vertex before the near plane and two beyond it: what is left is one triangle.
void measure_clipped(const Bench& bench, const Grid& grid) {
    Finding property(
        bench, "setup.clipped", "From what inputs of clipped triangles are set up",
        "triangles of which the near plane leaves one corner, set up from the whole triangle or "
        "from the snapped corners of what is left");
    Scene scene("setup-clipped", kSide, kSide);
    Dice dice(43);
    cases::Attribute input;
    input.name = "linear";
    input.interpolation = cases::Interpolation::noperspective;
    std::vector<Given> given;
    std::vector<Points> pieces;
    for (uint32_t cell = 0; cell < kAcross * kAcross; ++cell) {
        add_triangle(scene, 64, [&](size_t k) {
            Corner c = corner_in(cell, grid, dice);
            c.z = k == 0 ? 0.75 : -0.25;
            return c;
        });
        Given g;
        for (size_t k = 0; k < 3; ++k) {
            g.at[k] = in_framebuffer(scene.draw().positions[3 * cell + k], scene.draw().viewport);
            input.values.emplace_back(static_cast<float>(dice.real(-1, 1)), 0, 0, 0);
            g.linear[k] = static_cast<double>(input.values.back().x);
        }
        given.push_back(g);
        // z goes from 3/4 to -1/4, so that three quarters of either edge are left.
        const auto cut = [&](size_t k) {
            return Point{g.at[0].x + 0.75 * (g.at[k].x - g.at[0].x),
                         g.at[0].y + 0.75 * (g.at[k].y - g.at[0].y)};
        };
        pieces.push_back({g.at[0], cut(1), cut(2)});
    }
    scene.draw().attributes = {input};
    const auto picture = bench.picture_of(scene.take(), property);
    if (!picture) {
        return;
    }
    Vote vote({kUnsnapped, kSnapped, kPieces});
    for_each_fragment(*picture, [&](size_t k, size_t t, const Point& at) {
        const Given& g = given[t];
        const auto at_cut = [&](size_t n) {
            return g.linear[0] + 0.75 * (g.linear[n] - g.linear[0]);
        };
        const std::array<double, 3> left{g.linear[0], at_cut(1), at_cut(2)};
        vote_by_numbers(vote, static_cast<double>(picture->attributes[0][k].x),
                        {linear(barycentrics(g.at, at), g.linear),
                         linear(barycentrics(snapped(g.at, grid), at), g.linear),
                         linear(barycentrics(snapped(pieces[t], grid), at), left)});
    });
    vote.settle(property);
}

// Triangles around one pixel's centre P whose snapped corners are P + (-n, 1), P + (n + 1, -1) and
// P + (-1, 0) units: their area is 3 square units, and moving the first two by half a unit changes
// it by n. So the sign before snapping is what we choose.
void measure_facing(const Bench& bench, const Grid& grid) {
    Finding property(
        bench, "setup.facing", "Whose area decides which face is seen",
        "slivers that turn over when they are snapped and still cover the centre of a pixel");
    if (grid.x.bits != grid.y.bits || grid.x.rounding > Rounding::nearest_down ||
        grid.y.rounding > Rounding::nearest_down) {
        property.why = "the slivers need a grid to which vertices snap by rounding to nearest";
        return;
    }
    constexpr int kUnits = 40;
    const double unit = std::ldexp(1.0, -grid.x.bits);
    Scene scene("setup-facing", kSide, kSide);
    scene.target().has_depth = false;
    struct Turn {
        bool snapped, unsnapped;  // whether the area is positive: clockwise on screen
    };
    std::vector<Turn> turns;
    Dice dice(47);
    for (uint32_t cell = 0; cell < kAcross * kAcross; ++cell) {
        const double x = (cell % kAcross) * kCell + 8.5;
        const double y = (cell / kAcross) * kCell + 8.5;
        const double sign = dice.whole(0, 1) == 0 ? -1 : 1;
        const auto at = [&](double dx, double dy) { return Corner{x + dx * unit, y + dy * unit}; };
        const double off = sign * dice.real(0.3, 0.45);
        std::array<Corner, 3> c{at(-kUnits, 1 + off), at(kUnits + 1, -1 + off), at(-1, -off / 4)};
        if (dice.whole(0, 1) == 0) {
            std::swap(c[0], c[1]);
        }
        scene.add(c[0], c[1], c[2]);
        Points p;
        for (size_t k = 0; k < 3; ++k) {
            p[k] = in_framebuffer(scene.draw().positions[3 * cell + k], scene.draw().viewport);
        }
        turns.push_back({doubled_area(snapped(p, grid)) > 0, doubled_area(p) > 0});
    }
    const auto picture = bench.picture_of(scene.take(), property);
    if (!picture) {
        return;
    }
    Vote vote({kSnapped, kUnsnapped});
    for (uint32_t cell = 0; cell < turns.size(); ++cell) {
        const uint32_t x = (cell % kAcross) * kCell + 8;
        const uint32_t y = (cell / kAcross) * kCell + 8;
        const glm::vec4& hits = picture->hits[size_t{y} * kSide + x];
        if (hits.x + hits.y > 0) {
            const bool is_clockwise = hits.y > 0;  // front faces are counter-clockwise here
            vote.add([&](size_t k) {
                return is_clockwise == (k == 0 ? turns[cell].snapped : turns[cell].unsnapped);
            });
        }
    }
    vote.settle(property);
}

}  // namespace

void measure_setup(const Bench& bench) {
    const Grid grid = grid_of(bench.sheet, bench.promises.limits.subpixel_bits);
    measure_quantities(bench, grid);
    measure_clipped(bench, grid);
    measure_facing(bench, grid);
}

}  // namespace probe
