// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the samples of a pixel lie, from coverage alone: small triangles on the 1/16 grid, and
// which of the 256 possible places explains what is covered.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cases/base/counted.hpp"
#include "cases/model/sample.hpp"
#include "probe/base/scene.hpp"
#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"

namespace probe {

namespace {

constexpr uint32_t kSide = 64, kCell = 4;  // pixels
constexpr int64_t kSixteenth = ref::kFixedOne / 16;

std::vector<std::string> place_names() {
    std::vector<std::string> names;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            names.push_back(fmt::format("({}, {})", x, y));
        }
    }
    return names;
}

struct Small {
    std::array<ref::FixedPoint, 3> corners;
};
// One triangle a cell, in sixteenths of a pixel.
std::vector<Small> small_triangles() {
    Dice dice(29);
    std::vector<Small> out;
    for (uint32_t cell = 0; cell < (kSide / kCell) * (kSide / kCell); ++cell) {
        const int64_t left = int64_t{cell % (kSide / kCell)} * kCell * ref::kFixedOne;
        const int64_t top = int64_t{cell / (kSide / kCell)} * kCell * ref::kFixedOne;
        Small small;
        for (ref::FixedPoint& p : small.corners) {
            p = {left + dice.whole(0, 16 * kCell) * kSixteenth,
                 top + dice.whole(0, 16 * kCell) * kSixteenth};
        }
        out.push_back(small);
    }
    return out;
}

std::vector<Vote> ask(const capture::Capture& picture, const std::vector<Small>& all,
                      uint32_t samples) {
    const std::vector<std::string> names = place_names();
    std::vector<Vote> votes(samples, Vote(names));
    std::array<int, 256> sides{};
    for (uint32_t y = 0; y < kSide; ++y) {
        for (uint32_t x = 0; x < kSide; ++x) {
            const Small& t = all[(y / kCell) * (kSide / kCell) + x / kCell];
            for (size_t n = 0; n < sides.size(); ++n) {
                const ref::FixedPoint at{
                    ref::kFixedOne * x + kSixteenth * static_cast<int64_t>(n % 16),
                    ref::kFixedOne * y + kSixteenth * static_cast<int64_t>(n / 16)};
                sides[n] = side(t.corners[0], t.corners[1], t.corners[2], at);
            }
            for (uint32_t s = 0; s < samples; ++s) {
                const int got = is_hit(picture, x, y, s) ? 1 : -1;
                votes[s].add([&](size_t n) { return sides[n] * got >= 0; });
            }
        }
    }
    return votes;
}

void measure(const Bench& bench, uint32_t samples) {
    Finding property(
        bench, fmt::format("samples.{}", samples),
        fmt::format("Where the {} of a pixel {}", cases::counted(samples, "sample"),
                    samples == 1 ? "lies" : "lie"),
        "256 small triangles on the 1/16 grid: the one place of 256 in a pixel that explains what "
        "is covered");
    const std::vector<Small> all = small_triangles();
    Scene scene(fmt::format("samples-{}", samples), kSide, kSide, samples);
    scene.target().has_depth = false;
    for (const Small& t : all) {
        std::array<Corner, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            corners[k] = {ref::pixels(t.corners[k].x), ref::pixels(t.corners[k].y)};
        }
        scene.add(corners[0], corners[1], corners[2]);
    }
    const auto picture = bench.picture_of(scene.take(), property);
    if (!picture) {
        return;
    }
    const std::vector<Vote> votes = ask(*picture, all, samples);
    const auto standard = cases::standard_sample_locations(samples);
    bool is_standard = true;
    std::string list;
    property.agree = UINT64_MAX;
    for (uint32_t s = 0; s < samples; ++s) {
        Property one;
        votes[s].settle(one);
        property.agree = std::min(property.agree, one.agree);
        property.contradict = std::max(property.contradict, one.contradict);
        if (!one.is_known()) {
            property.why = fmt::format("of sample {}: {}", s, one.why);
            return;
        }
        const size_t at = votes[s].best();
        is_standard = is_standard && at % 16 == standard[s][0] && at / 16 == standard[s][1];
        list += (s == 0 ? "" : " ") + one.answer;
        property.figures.push_back({fmt::format("sample {} x", s), double(at % 16) / 16, "pixel"});
        property.figures.push_back({fmt::format("sample {} y", s), double(at / 16) / 16, "pixel"});
    }
    property.answer = is_standard ? "the standard locations" : list + " sixteenths";
}

}  // namespace

void measure_locations(const Bench& bench) {
    for (const uint32_t samples : {1U, 2U, 4U, 8U, 16U}) {
        measure(bench, samples);
    }
}

}  // namespace probe
