// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How numbers become codes of a colour target: squares of one number each, written without
// blending.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cases/format/color_format.hpp"
#include "probe/base/scene.hpp"
#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"

namespace probe {

namespace {

using cases::ColorFormat;

Scene make_scene(const std::string& id, ColorFormat format, const std::vector<float>& numbers) {
    std::vector<glm::vec4> values;
    for (const float v : numbers) {
        values.emplace_back(v, v, v, 1.0F);
    }
    Scene scene = make_squares(id, values);
    scene.target().color = cases::ColorTarget{format, {}};
    return scene;
}

// Calls visit(k, code of red) for each square that was drawn; false: there is no picture, and the
// property says why.
template <class Visit>
bool for_each_code(const Bench& bench, Scene scene, size_t count, Property& property, Visit visit) {
    const auto picture = bench.picture_of(scene.take(), property);
    if (picture) {
        for_each_square(*picture, count,
                        [&](size_t k, size_t at) { visit(k, picture->color[at][0]); });
    }
    return picture.has_value();
}

// Numbers between two codes, and, every fourth, one whose product with the largest code is half-way
// in binary32.
std::vector<float> between_codes(double largest) {
    std::vector<float> out;
    Dice dice(83);
    for (uint32_t k = 0; out.size() < kSquares && k < 64 * kSquares; ++k) {
        const auto step = static_cast<double>(dice.whole(0, static_cast<int64_t>(largest) - 1));
        if (out.size() % 4 != 0) {
            constexpr std::array<double, 4> kRests{0.2, 0.4, 0.6, 0.8};
            out.push_back(static_cast<float>(
                (step + kRests.at(static_cast<size_t>(dice.whole(0, 3)))) / largest));
            continue;
        }
        const auto v = static_cast<float>((step + 0.5) / largest);
        const float scaled = v * static_cast<float>(largest);
        if (std::fabs(static_cast<double>(scaled) - step - 0.5) <= 0) {
            out.push_back(v);
        }
    }
    return out;
}

void measure_unorm(const Bench& bench, ColorFormat format) {
    Finding property(
        bench, fmt::format("color.rounding.{}", cases::name_of(format)),
        fmt::format("How numbers are rounded to {}", cases::name_of(format)),
        "squares of one number each between two codes; half-way ones where the product with the "
        "largest code is half-way in binary32");
    const double largest = std::ldexp(1.0, cases::row_of(format).bits[0]) - 1;
    const std::vector<float> numbers = between_codes(largest);
    std::vector<std::string> answers = {"nearest, ties up", "nearest, ties to even",
                                        "nearest, ties down", "nearest, ties by the exact number",
                                        "down"};
    const uint32_t bits = cases::row_of(format).bits[0];
    if (bits < 8) {  // twice: ties of the 8 bits up, and down
        answers.resize(answers.size() + 2, "to 8 bits, of which the low ones are cut off");
    }
    Vote vote(answers);
    const bool is_drawn = for_each_code(
        bench, make_scene(property.id, format, numbers), numbers.size(), property,
        [&](size_t k, uint32_t code) {
            const float scaled = numbers[k] * static_cast<float>(largest);
            const double exact = static_cast<double>(numbers[k]) * largest;  // fits binary64
            const auto eight = static_cast<double>(numbers[k] * 255.0F);
            const auto high_bits = [&](double of_eight) {
                return std::floor(std::ldexp(of_eight, static_cast<int>(bits) - 8));
            };
            const std::array<double, 7> codes{std::floor(static_cast<double>(scaled) + 0.5),
                                              std::nearbyint(static_cast<double>(scaled)),
                                              std::ceil(static_cast<double>(scaled) - 0.5),
                                              std::floor(exact + 0.5),
                                              std::floor(static_cast<double>(scaled)),
                                              high_bits(std::floor(eight + 0.5)),
                                              high_bits(std::ceil(eight - 0.5))};
            vote.add(
                [&](size_t n) { return std::fabs(codes.at(n) - static_cast<double>(code)) < 0.5; });
        });
    if (is_drawn) {
        vote.settle(property);
    }
}

// The number of a half's bits.
double half_number(uint32_t bits) {
    const int exponent = static_cast<int>(bits >> 10 & 0x1fU);
    const auto fraction = static_cast<double>(bits & 0x3ffU);
    return exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(fraction + 1024, exponent - 25);
}

void measure_half(const Bench& bench) {
    Finding property(bench, "color.rounding.rgba16-float", "How numbers are rounded to halves",
                     "squares of one number each between two halves");
    std::vector<float> numbers;
    std::vector<uint32_t> below;
    Dice dice(89);
    for (uint32_t k = 0; k < kSquares; ++k) {
        const auto bits = static_cast<uint32_t>(dice.whole(0x2000, 0x4800));
        const double low = half_number(bits);
        const double gap = half_number(bits + 1) - low;
        constexpr std::array<double, 5> kRests{0.125, 0.25, 0.5, 0.75, 0.875};
        numbers.push_back(
            static_cast<float>(low + gap * kRests.at(static_cast<size_t>(dice.whole(0, 4)))));
        below.push_back(bits);
    }
    Vote vote({"nearest, ties to even", "nearest, ties away from zero", "toward zero"});
    const bool is_drawn =
        for_each_code(bench, make_scene(property.id, ColorFormat::rgba16_float, numbers),
                      numbers.size(), property, [&](size_t k, uint32_t code) {
                          const double low = half_number(below[k]);
                          const double rest = (static_cast<double>(numbers[k]) - low) /
                                              (half_number(below[k] + 1) - low);
                          const bool is_tie = std::fabs(rest - 0.5) <= 0;
                          const uint32_t away = below[k] + (rest >= 0.5 ? 1U : 0U);
                          const uint32_t even = is_tie ? below[k] + (below[k] & 1U) : away;
                          const std::array<uint32_t, 3> codes{even, away, below[k]};
                          vote.add([&](size_t n) { return codes.at(n) == code; });
                      });
    if (is_drawn) {
        vote.settle(property);
    }
}

void measure_denormals(const Bench& bench, ColorFormat format, double smallest, int fraction_bits) {
    Finding property(bench, fmt::format("color.denormals.{}", cases::name_of(format)),
                     fmt::format("What becomes of denormals in {}", cases::name_of(format)),
                     "squares of one number each below the smallest normal one");
    std::vector<float> numbers;
    std::vector<uint32_t> kept;
    for (uint32_t k = 1; k <= 256; ++k) {
        const uint32_t bits = k << (fraction_bits - 9);
        kept.push_back(bits);
        numbers.push_back(
            static_cast<float>(smallest * std::ldexp(static_cast<double>(bits), -fraction_bits)));
    }
    kept.pop_back();  // a normal number
    numbers.pop_back();
    Vote vote({"kept", "they become zero"});
    const bool is_drawn =
        for_each_code(bench, make_scene(property.id, format, numbers), numbers.size(), property,
                      [&](size_t k, uint32_t code) {
                          vote.add([&](size_t n) { return code == (n == 0 ? kept[k] : 0U); });
                      });
    if (is_drawn) {
        vote.settle(property);
    }
}

// Khronos Data Format Specification, "sRGB transfer functions".
double encode_srgb(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

void measure_srgb(const Bench& bench) {
    Finding property(bench, "color.srgb", "How far codes of rgba8-srgb are from the curve",
                     "squares of one number each over the whole curve");
    std::vector<float> numbers;
    for (uint32_t k = 0; k < kSquares; ++k) {
        const double t = (k + 0.5) / kSquares;
        numbers.push_back(static_cast<float>(t * t));  // denser where the curve is steep
    }
    double largest = 0;
    double sum = 0;
    const bool is_drawn = for_each_code(
        bench, make_scene(property.id, ColorFormat::rgba8_srgb, numbers), numbers.size(), property,
        [&](size_t k, uint32_t code) {
            const double exact = 255 * encode_srgb(static_cast<double>(numbers[k]));
            const double error = static_cast<double>(code) - exact;
            sum += error;
            largest = std::max(largest, std::fabs(error));
            // Binary32 may take the other neighbour of a number half-way between two codes.
            (std::fabs(error) <= 0.501 ? property.agree : property.contradict) += 1;
            property.picture.points.push_back({static_cast<double>(numbers[k]), error});
        });
    if (!is_drawn) {
        return;
    }
    if (property.agree + property.contradict == 0) {
        property.why = "no fragment was drawn";
    } else {
        property.answer = largest <= 0.501 ? "the nearest code"
                          : largest <= 0.6 ? "within 0.6 of a code"
                          : largest <= 1   ? "within a code"
                                           : fmt::format("up to {:.2f} codes away", largest);
        const uint64_t all = property.agree + property.contradict;
        if (property.answer != "the nearest code") {
            property.agree = all;
            property.contradict = 0;
        }
        property.figures = {
            {"largest error", largest, "codes"},
            {"mean error", sum / static_cast<double>(std::max<uint64_t>(all, 1)), "codes"}};
        property.picture.kind = PictureKind::curve;
        property.picture.axes = {"the number", "error, codes"};
    }
}

}  // namespace

void measure_colors(const Bench& bench) {
    for (const ColorFormat format : {ColorFormat::rgba8_unorm, ColorFormat::rgb10a2_unorm,
                                     ColorFormat::r5g6b5_unorm, ColorFormat::rgba16_unorm}) {
        measure_unorm(bench, format);
    }
    measure_half(bench);
    measure_denormals(bench, ColorFormat::rgba16_float, 0x1p-14, 10);
    measure_denormals(bench, ColorFormat::rgba32_float, 0x1p-126, 23);
    measure_srgb(bench);
}

}  // namespace probe
