// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which pixels make a quad, whose differences are coarse, and how many bits a level of detail has.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "probe/base/scene.hpp"
#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"
#include "probe/experiment/triangle.hpp"

namespace probe {

namespace {

using cases::Probe;

constexpr uint32_t kSide = 32;
// One triangle around the target; x and y of clip space are exact for these w.
constexpr std::array<Corner, 3> kCorners{
    {{-16, -16, 0.5, 1}, {112, -16, 0.5, 4}, {-16, 112, 0.5, 8}}};
constexpr std::array<double, 3> kValues{0, 1, -1};

// The input, curved by perspective, at the centre of a pixel.
double value_at(int64_t x, int64_t y) {
    const Points p{{{kCorners[0].x, kCorners[0].y},
                    {kCorners[1].x, kCorners[1].y},
                    {kCorners[2].x, kCorners[2].y}}};
    return perspective(
        barycentrics(p, {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5}), kValues,
        {kCorners[0].w, kCorners[1].w, kCorners[2].w});
}

// A possible way: quads begin at even or odd pixels, and the difference is that of the pixel's own
// row (column), or of the quad's first or second one.
struct Way {
    int odd;
    int line;  // 0: own, 1: first, 2: second
};
std::vector<Way> all_ways() {
    std::vector<Way> ways;
    for (const int odd : {0, 1}) {
        for (const int line : {0, 1, 2}) {
            ways.push_back({odd, line});
        }
    }
    return ways;
}
constexpr std::array<const char*, 3> kLines = {"of the pixel's own row or column (fine)",
                                               "of the quad's first row or column",
                                               "of the quad's second row or column"};
double difference(const Way& way, bool is_x, int64_t x, int64_t y) {
    const int64_t left = x - ((x + way.odd) & 1);
    const int64_t top = y - ((y + way.odd) & 1);
    if (is_x) {
        const int64_t row = way.line == 0 ? y : way.line == 1 ? top : top + 1;
        return value_at(left + 1, row) - value_at(left, row);
    }
    const int64_t column = way.line == 0 ? x : way.line == 1 ? left : left + 1;
    return value_at(column, top + 1) - value_at(column, top);
}

struct Question {
    const char* id;
    const char* question;
    Probe dx, dy;
};
constexpr auto kQuestions = std::to_array<Question>({
    {"derivatives.fine", "Differences that dFdxFine and dFdyFine take", Probe::dx_fine,
     Probe::dy_fine},
    {"derivatives.coarse", "Differences that dFdxCoarse and dFdyCoarse take", Probe::dx_coarse,
     Probe::dy_coarse},
    {"derivatives.plain", "Differences that dFdx and dFdy take", Probe::dx, Probe::dy},
});

void settle_differences(const Bench& bench, const Question& q) {
    Finding property(bench, q.id, q.question,
                     "an input that perspective curves: each pair of pixels differs otherwise");
    Scene scene(q.id, kSide, kSide);
    scene.target().has_depth = false;
    scene.set_viewport(-128, -128, 256, 256);
    scene.add(kCorners[0], kCorners[1], kCorners[2]);
    for (const Probe probe : {q.dx, q.dy}) {
        cases::Attribute& a = scene.attribute("curved", 1);
        a.probe = probe;
        for (const double v : kValues) {
            a.values.emplace_back(static_cast<float>(v), 0, 0, 0);
        }
    }
    const auto picture = bench.picture_of(scene.take(), property);
    if (!picture) {
        return;
    }
    const std::vector<Way> ways = all_ways();
    std::vector<std::string> names;
    for (const Way& way : ways) {
        names.push_back(fmt::format("{}; quads begin at {} pixels",
                                    kLines.at(static_cast<size_t>(way.line)),
                                    way.odd == 0 ? "even" : "odd"));
    }
    Vote vote(names);
    for (uint32_t y = 2; y + 2 < kSide; ++y) {
        for (uint32_t x = 2; x + 2 < kSide; ++x) {
            if (!is_hit(*picture, x, y)) {
                continue;
            }
            for (const bool is_x : {true, false}) {
                const double got = static_cast<double>(
                    picture->attributes.at(is_x ? 0 : 1)[size_t{y} * kSide + x].x);
                vote.add([&](size_t k) {
                    // Values are some 2^-24 off each; the ways differ by 2^-16 or so.
                    return std::fabs(difference(ways[k], is_x, x, y) - got) < 0x1p-20;
                });
            }
        }
    }
    vote.settle(property);
}

void measure_lod(const Bench& bench) {
    Finding property(
        bench, "derivatives.lod", "Bits of the level of detail below the point",
        "textureQueryLod of coordinates that grow evenly, against log2 of the texels a pixel");
    constexpr uint32_t kTexture = 256;
    Scene scene("lod", 64, 64);
    scene.target().has_depth = false;
    cases::Attribute& a = scene.attribute("coordinates", 2);
    a.probe = Probe::lod;
    a.texture_size = {kTexture, kTexture};
    Dice dice(127);
    std::vector<double> exact;
    for (uint32_t cell = 0; cell < 64; ++cell) {
        const double x = (cell % 8) * 8;
        const double y = (cell / 8) * 8;
        add_rectangle(scene, x, y, x + 8, y + 8);
        // Along x alone: a pixel is so many texels.
        const auto slope = static_cast<float>(std::exp2(dice.real(0.5, 6)) / kTexture);
        const auto u = [&](double at) {
            return glm::vec4(slope * static_cast<float>(at), 0, 0, 0);
        };
        for (const double at : {0.0, 8.0, 0.0, 8.0, 8.0, 0.0}) {
            a.values.push_back(u(at));
        }
        exact.push_back(std::log2(static_cast<double>(slope) * kTexture));
    }
    const auto picture = bench.picture_of(scene.take(), property);
    if (!picture) {
        return;
    }
    double largest = 0;
    double sum = 0;
    for (uint32_t y = 0; y < 64; ++y) {
        for (uint32_t x = 0; x < 64; ++x) {
            if (!is_hit(*picture, x, y)) {
                continue;
            }
            const double error = static_cast<double>(picture->attributes[0][size_t{y} * 64 + x].y) -
                                 exact[(y / 8) * 8 + x / 8];
            largest = std::max(largest, std::fabs(error));
            sum += error;
            ++property.agree;
        }
    }
    if (property.agree == 0) {
        property.why = "no fragment was drawn";
        return;
    }
    const double bits = largest > 0 ? -std::log2(largest) : 24;
    property.answer = bits >= 1 ? fmt::format("{:.0f} bits", std::floor(std::min(bits, 24.0)))
                                : fmt::format("none: it is up to {:.2f} levels off", largest);
    property.figures = {
        {"largest error", largest, "levels"},
        {"mean error", sum / static_cast<double>(property.agree), "levels"},
        {"promised", static_cast<double>(bench.promises.limits.mipmap_bits), "bits"}};
}

}  // namespace

void measure_derivatives(const Bench& bench) {
    for (const Question& q : kQuestions) {
        settle_differences(bench, q);
    }
    measure_lod(bench);
}

}  // namespace probe
