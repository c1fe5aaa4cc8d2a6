// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// In what numbers blending is done: a product of the source's colour and alpha.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cases/format/color_format.hpp"
#include "probe/base/scene.hpp"
#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"

namespace probe {

namespace {

using cases::BlendFactor;
using cases::ColorFormat;

struct Pair {
    float color = 0, alpha = 0;
};

Scene make_scene(const std::string& id, ColorFormat format, const std::vector<Pair>& pairs) {
    std::vector<glm::vec4> values;
    for (const Pair& p : pairs) {
        values.emplace_back(p.color, p.color, p.color, p.alpha);
    }
    Scene scene = make_squares(id, values);
    scene.target().color = cases::ColorTarget{format, {}};
    cases::Blend blend;
    blend.color = {BlendFactor::src_alpha, BlendFactor::zero, cases::BlendOp::add};
    blend.alpha = {BlendFactor::one, BlendFactor::zero, cases::BlendOp::add};
    scene.draw().color.blend = blend;
    return scene;
}

// The code of a number in fixed point: nearest.
double code_of(double v, double largest) {
    return std::round(v * largest);
}

void measure_unorm(const Bench& bench, ColorFormat format) {
    Finding property(
        bench, fmt::format("blending.{}", cases::name_of(format)),
        fmt::format("In what numbers {} is blended", cases::name_of(format)),
        "squares whose colour, multiplied by its alpha, is another code if the two are rounded to "
        "codes first");
    const cases::ColorFormatRow& row = cases::row_of(format);
    const double largest = std::ldexp(1.0, row.bits[0]) - 1;
    const double alphas = std::ldexp(1.0, row.bits[3] == 0 ? row.bits[0] : row.bits[3]) - 1;
    std::vector<Pair> pairs;
    Dice dice(97);
    const auto exact = [&](const Pair& p) {
        return static_cast<double>(p.color) * static_cast<double>(p.alpha) * largest;
    };
    const auto in_codes = [&](const Pair& p) {
        return code_of(static_cast<double>(p.color), largest) *
               code_of(static_cast<double>(p.alpha), alphas) / alphas;
    };
    const auto is_near_tie = [](double v) { return std::fabs(v - std::floor(v) - 0.5) < 0.02; };
    while (pairs.size() < kSquares) {
        const Pair p{static_cast<float>(dice.real(0, 1)), static_cast<float>(dice.real(0, 1))};
        if (!is_near_tie(exact(p)) && !is_near_tie(in_codes(p)) &&
            std::fabs(std::round(exact(p)) - std::round(in_codes(p))) > 0.5) {
            pairs.push_back(p);
        }
    }
    const auto picture = bench.picture_of(make_scene(property.id, format, pairs).take(), property);
    if (!picture) {
        return;
    }
    const double finer = (largest + 1) * 16;
    const auto cut = [&](float v) {
        return static_cast<float>(std::floor(static_cast<double>(v) * finer) / finer);
    };
    Vote vote({"floating point, rounded once", "the format's codes, the product to nearest",
               "the format's codes, the product down",
               "the format's codes of a source cut to 4 bits more, the product to nearest"});
    for_each_square(*picture, pairs.size(), [&](size_t k, size_t at) {
        const double code = picture->color[at][0];
        const std::array<double, 4> codes{
            std::round(exact(pairs[k])), std::round(in_codes(pairs[k])),
            std::floor(in_codes(pairs[k])),
            std::round(in_codes({cut(pairs[k].color), cut(pairs[k].alpha)}))};
        vote.add([&](size_t n) { return std::fabs(codes.at(n) - code) < 0.5; });
    });
    vote.settle(property);
}

}  // namespace

void measure_blending(const Bench& bench) {
    for (const ColorFormat format : {ColorFormat::rgba8_unorm, ColorFormat::rgba16_unorm}) {
        measure_unorm(bench, format);
    }
}

}  // namespace probe
