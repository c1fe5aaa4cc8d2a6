// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The subpixel grid by a vernier of coverage.
#include <fmt/format.h>

#include <cmath>

#include "probe/base/scene.hpp"
#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"
#include "probe/experiment/snapping.hpp"
#include "probe/experiment/vernier.hpp"

namespace probe {

namespace {

constexpr uint32_t kLong = kVernierLength;
constexpr uint32_t kRows = 128;  // one edge each

Counts predicted(const Edge& edge, const Snapping& snap) {
    return counts_of(edge, snap(fixed(edge.across_a)), snap(fixed(edge.across_b)));
}

// Edges whose ends lie f pixels below the top of their rows; the row's centre is crossed within
// 1024 columns if f is in [1/2 - drop, 1/2].
Edge vernier(uint32_t row, double f, double drop) {
    const double top = row;
    return {0, top + f, kLong, top + f + drop, {0, top + 1}, row};
}

// Fractions that tell roundings apart: the ties and quarters of each grid up to 2^-8.
std::vector<double> telling_fractions() {
    std::vector<double> out;
    Dice dice(11);
    for (int bits = kLeastBits; bits <= 8; ++bits) {
        const int64_t cells = int64_t{1} << (bits - 1);  // in half a pixel
        for (int k = 0; k < 7; ++k) {
            const auto cell = static_cast<double>(dice.whole(0, cells - 1));
            out.push_back(std::ldexp(cell + 0.5, -bits));
            out.push_back(std::ldexp(cell + 0.25, -bits));
            out.push_back(std::ldexp(cell + 0.75, -bits));
        }
    }
    out.resize(kRows, 0.1875);
    return out;
}

struct Set {
    double drop;
    std::vector<double> fractions = {};
    bool is_shown = false;  // in the picture of the staircase
};
std::vector<Set> positive_sets() {
    std::vector<Set> sets{{0.5, telling_fractions()}, {0.125, {}, true}, {0.125}};
    for (uint32_t k = 0; k < kRows; ++k) {
        sets[1].fractions.push_back(0.375 + std::ldexp(k, -10));
        sets[2].fractions.push_back(0.4375 + std::ldexp(k, -13));
    }
    return sets;
}

void settle(const Bench& bench, const Vote& vote, Property& rounding, const std::string& axis,
            bool has_bits) {
    const std::vector<Snapping> all = all_snappings();
    if (has_bits) {
        Finding bits(bench, "grid.bits." + axis, "Subpixel bits in effect along " + axis,
                     rounding.experiment);
        bits.why = rounding.why;
        vote.settle(bits, [&](size_t k) { return std::to_string(all[k].bits); });
        bits.figures.push_back(
            {"promised", static_cast<double>(bench.promises.limits.subpixel_bits), "bits"});
    }
    vote.settle(rounding, [&](size_t k) {
        return std::string(kRoundingNames.at(static_cast<size_t>(all[k].rounding)));
    });
}

std::vector<std::string> names_of(const std::vector<Snapping>& all) {
    std::vector<std::string> names;
    for (const Snapping& s : all) {
        names.push_back(
            fmt::format("{} bits, {}", s.bits, kRoundingNames.at(static_cast<size_t>(s.rounding))));
    }
    return names;
}

void measure_positive(const Bench& bench, bool is_x) {
    const std::string axis = is_x ? "x" : "y";
    Finding property(
        bench, "grid.rounding." + axis, "Rounding to the grid along " + axis,
        "edges that fall by 1/8 and 1/2 pixel over 1024: the column where one crosses the centres "
        "of a row tells where its ends were put");
    const std::vector<Snapping> all = all_snappings();
    Vote vote(names_of(all));
    for (const Set& set : positive_sets()) {
        Scene scene(fmt::format("grid-{}", axis), is_x ? kRows : kLong, is_x ? kLong : kRows);
        scene.target().has_depth = false;
        for (uint32_t row = 0; row < kRows; ++row) {
            add_edge(scene, vernier(row, set.fractions[row], set.drop), is_x);
        }
        const Drawn drawn = bench.draw_one(scene.take());
        if (!drawn.picture) {
            property.why = drawn.why_not;
            continue;
        }
        for (uint32_t row = 0; row < kRows; ++row) {
            const Edge edge = vernier(row, set.fractions[row], set.drop);
            const int64_t count = count_row(*drawn.picture, row, is_x);
            vote.add([&](size_t k) { return predicted(edge, all[k]).has(count); });
            if (set.is_shown) {
                property.picture.kind = PictureKind::staircase;
                property.picture.axes = {"where a vertex is put, pixels", "where it lies"};
                property.picture.points.push_back(
                    {set.fractions[row],
                     0.5 - static_cast<double>(count) * set.drop / double{kLong}});
            }
        }
    }
    settle(bench, vote, property, axis, true);
}

// One end of the edge has a negative coordinate, and the picture is where it has become positive.
void measure_negative(const Bench& bench, bool is_x) {
    const std::string axis = is_x ? "x" : "y";
    Finding property(
        bench, "grid.negative." + axis, "Rounding of negative coordinates along " + axis,
        "edges from a vertex left of or above the framebuffer, inside a viewport that reaches "
        "there: the column where one crosses the centres of the first row");
    std::vector<Edge> edges;
    for (int k = 1; k <= 128; ++k) {
        edges.push_back({-16, -std::ldexp(k, -10), 2032, 3, {-16, 40}, 0});
    }
    std::vector<cases::Case> cases;
    for (size_t k = 0; k < edges.size(); ++k) {
        Scene scene(fmt::format("grid-negative-{}-{}", axis, k), is_x ? 1 : kLong,
                    is_x ? kLong : 1);
        scene.target().has_depth = false;
        scene.set_viewport(-2048, -2048, 4096, 4096);
        add_edge(scene, edges[k], is_x);
        cases.push_back(scene.take());
    }
    const std::vector<Drawn> drawn = bench.draw(std::move(cases));
    const std::vector<Snapping> all = all_snappings();
    Vote vote(names_of(all));
    for (size_t k = 0; k < drawn.size(); ++k) {
        if (!drawn[k].picture) {
            property.why = drawn[k].why_not;
            continue;
        }
        const int64_t count = count_row(*drawn[k].picture, 0, is_x);
        vote.add([&](size_t n) { return predicted(edges[k], all[n]).has(count); });
    }
    settle(bench, vote, property, axis, false);
}

// Both signs together, in the words that programmers use.
void add_rule(const Bench& bench, const std::string& axis) {
    Finding property(bench, "grid.rule." + axis, "The same of both signs along " + axis,
                     "the two answers before this one");
    const Property* positive = bench.sheet.find("grid.rounding." + axis);
    const Property* negative = bench.sheet.find("grid.negative." + axis);
    property.agree = positive->agree + negative->agree;
    property.contradict = positive->contradict + negative->contradict;
    if (!positive->is_known() || !negative->is_known()) {
        property.why = "one of the two could not be told";
    } else if (positive->answer == negative->answer) {
        property.answer = positive->answer;
    } else if (positive->answer == "floor" && negative->answer == "ceil") {
        property.answer = "toward zero";
    } else if (positive->answer == "nearest, ties up" && negative->answer == "nearest, ties down") {
        property.answer = "nearest, ties away from zero";
    } else if (positive->answer == "ceil" && negative->answer == "floor") {
        property.answer = "away from zero";
    } else {
        property.answer = positive->answer + "; negative ones " + negative->answer;
    }
}

}  // namespace

void measure_grid(const Bench& bench) {
    for (const bool is_x : {true, false}) {
        measure_positive(bench, is_x);
        measure_negative(bench, is_x);
        add_rule(bench, is_x ? "x" : "y");
    }
}

}  // namespace probe
