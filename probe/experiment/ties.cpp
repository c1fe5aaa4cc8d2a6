// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Who owns a sample that lies on an edge: edges in 32 directions through the centres of pixels,
// each with the triangle on the one side and on the other, wound both ways.
#include <array>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "probe/base/scene.hpp"
#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"

namespace probe {

namespace {

constexpr int kSteps = 3;         // pixels' centres on each side of the middle of an edge
constexpr uint32_t kCell = 32;    // pixels for a triangle
constexpr uint32_t kAcross = 8;   // cells in a row
constexpr double kMiddle = 16.5;  // of a cell

// A rule by the inner normal of an edge, y down: which sign of its first component that is not 0
// owns. "top-left": the triangle lies right of the edge, or, if that is level, below it.
struct Rule {
    const char* name;
    bool x_first;
    int x, y;
    bool owns(int nx, int ny) const {
        const bool by_x = x_first ? nx != 0 : ny == 0;
        return by_x ? nx * x > 0 : ny * y > 0;
    }
};
constexpr auto kRules = std::to_array<Rule>({
    {"top-left", true, 1, 1},
    {"top-right", true, -1, 1},
    {"bottom-left", true, 1, -1},
    {"bottom-right", true, -1, -1},
    {"edges above, of vertical ones the left", false, 1, 1},
    {"edges above, of vertical ones the right", false, -1, 1},
    {"edges below, of vertical ones the left", false, 1, -1},
    {"edges below, of vertical ones the right", false, -1, -1},
});
constexpr size_t kAll = kRules.size();  // further candidates: every edge owns, none does
constexpr size_t kNone = kAll + 1;

struct Direction {
    int dx, dy;  // of the edge; the triangle lies at its right hand, y down: normal (-dy, dx)
};
std::vector<Direction> directions() {
    std::vector<Direction> out;
    for (int dy = -3; dy <= 3; ++dy) {
        for (int dx = -3; dx <= 3; ++dx) {
            if (std::gcd(dx, dy) == 1) {
                out.push_back({dx, dy});
            }
        }
    }
    return out;
}

}  // namespace

void measure_ties(const Bench& bench) {
    Finding property(
        bench, "ties.rule", "Which edges own the samples on them",
        "edges in 32 directions through the centres of pixels, with the triangle on either side "
        "and wound both ways");
    const std::vector<Direction> all = directions();
    const auto rows = static_cast<uint32_t>((2 * all.size() + kAcross - 1) / kAcross);
    Scene scene("ties", kCell * kAcross, 256);
    scene.target().has_depth = false;
    if (rows * kCell > scene.target().height) {
        std::abort();  // a table of another size
    }
    const auto cell_of = [](size_t k) {
        return std::array{static_cast<uint32_t>(k % kAcross) * kCell,
                          static_cast<uint32_t>(k / kAcross) * kCell};
    };
    for (size_t k = 0; k < 2 * all.size(); ++k) {
        const auto [dx, dy] = all[k / 2];
        const auto [left, top] = cell_of(k);
        const auto at = [&, left = left, top = top](int x, int y) {
            return Corner{left + kMiddle + x, top + kMiddle + y};
        };
        const Corner a = at(-kSteps * dx, -kSteps * dy);
        const Corner b = at(kSteps * dx, kSteps * dy);
        const Corner c = at(-4 * dy, 4 * dx);
        if (k % 2 == 0) {
            scene.add(a, b, c);
        } else {
            scene.add(b, a, c);
        }
    }
    const auto picture = bench.picture_of(scene.take(), property);
    if (!picture) {
        return;
    }
    std::vector<std::string> names;
    for (const Rule& rule : kRules) {
        names.emplace_back(rule.name);
    }
    names.emplace_back("every edge");
    names.emplace_back("no edge");
    Vote vote(names);
    property.picture.kind = PictureKind::star;
    for (size_t k = 0; k < 2 * all.size(); ++k) {
        const auto [dx, dy] = all[k / 2];
        const auto [left, top] = cell_of(k);
        if (!is_hit(*picture, left + static_cast<uint32_t>(16 - dy),
                    top + static_cast<uint32_t>(16 + dx))) {
            continue;  // the triangle's inside
        }
        int owned = 0;
        for (int step = 1 - kSteps; step < kSteps; ++step) {
            const bool hit = is_hit(*picture, left + static_cast<uint32_t>(16 + step * dx),
                                    top + static_cast<uint32_t>(16 + step * dy));
            owned += hit ? 1 : 0;
            vote.add([&, dx = dx, dy = dy](size_t n) {
                return hit == (n == kAll || (n != kNone && kRules.at(n).owns(-dy, dx)));
            });
        }
        if (k % 2 == 0) {
            property.picture.points.push_back({static_cast<double>(-dy), static_cast<double>(dx)});
            property.picture.marks.push_back(2 * owned > 2 * kSteps - 1 ? 1U : 0U);
        }
    }
    vote.settle(property);
}

}  // namespace probe
