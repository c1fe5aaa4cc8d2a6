// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What depth is stored: rounding of the fixed-point formats, the unit of depth bias, and whose
// exponent it follows in D32.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "probe/base/scene.hpp"
#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"

namespace probe {

namespace {

using cases::DepthFormat;

struct Format {
    DepthFormat format;
    const char* name;
    double steps;  // 0: floating point
};
constexpr auto kFormats = std::to_array<Format>({
    {DepthFormat::d16_unorm, "d16", 65535},
    {DepthFormat::d24_unorm, "d24", 16777215},
    {DepthFormat::d32_float, "d32", 0},
});

// Squares of constant depth.
Scene make_scene(const std::string& id, DepthFormat format, const std::vector<float>& depths) {
    Scene scene(id, 2 * kSquaresAcross, 2 * kSquaresAcross);
    scene.target().has_depth = true;
    scene.target().depth_format = format;
    for (size_t k = 0; k < depths.size(); ++k) {
        const double x = 2.0 * static_cast<double>(k % kSquaresAcross);
        const double y = 2.0 * static_cast<double>(k / kSquaresAcross);
        add_rectangle(scene, x, y, x + 2, y + 2, static_cast<double>(depths[k]));
    }
    return scene;
}

void measure_rounding(const Bench& bench, const Format& f) {
    Finding property(bench, fmt::format("depth.rounding.{}", f.name),
                     fmt::format("How depth is rounded to {}", f.steps > 0 ? f.name : "D32"),
                     "squares of constant depth between two steps of the format");
    std::vector<float> depths;
    Dice dice(73);
    for (uint32_t k = 0; k < kSquares; ++k) {
        // Below 1/8 binary32 has eight numbers a step of D24. Ties are left out.
        const double step = std::floor(dice.real(0.0625, 0.125) * f.steps);
        constexpr std::array<double, 6> kRests{0.125, 0.25, 0.375, 0.625, 0.75, 0.875};
        depths.push_back(static_cast<float>(
            (step + kRests.at(static_cast<size_t>(dice.whole(0, 5)))) / f.steps));
    }
    const auto picture =
        bench.picture_of(make_scene(property.id, f.format, depths).take(), property);
    if (!picture) {
        return;
    }
    Vote vote({"nearest", "down", "up"});
    for_each_square(*picture, depths.size(), [&](size_t k, size_t at) {
        const double code = std::round(static_cast<double>(picture->depth[at]) * f.steps);
        const double scaled = static_cast<double>(depths[k]) * f.steps;
        const std::array<double, 3> codes{std::round(scaled), std::floor(scaled),
                                          std::ceil(scaled)};
        vote.add([&](size_t n) { return std::fabs(codes.at(n) - code) < 0.5; });
    });
    vote.settle(property);
}

// The pictures without and with a bias. Nothing if one of them cannot be drawn: then the property
// says why.
std::optional<std::array<capture::Capture, 2>> picture_pair(const Bench& bench, cases::Case plain,
                                                            cases::Case biased,
                                                            Property& property) {
    std::optional<capture::Capture> before = bench.picture_of(std::move(plain), property);
    if (!before) {
        return std::nullopt;
    }
    std::optional<capture::Capture> after = bench.picture_of(std::move(biased), property);
    if (!after) {
        return std::nullopt;
    }
    return std::array{std::move(*before), std::move(*after)};
}

// A candidate for r: 2^power, in D32 times 2^e.
std::string unit_name(const Format& f, int power) {
    return f.steps > 0 ? fmt::format("2^{}", power) : fmt::format("2^(e{})", power);
}

void measure_unit(const Bench& bench, const Format& f) {
    Finding property(bench, fmt::format("depth.bias_unit.{}", f.name),
                     fmt::format("The unit r of depth bias in {}",
                                 f.steps > 0 ? f.name : "D32, e: the depth's exponent"),
                     "squares of constant depth with and without a constant bias");
    const int nominal = f.format == DepthFormat::d16_unorm   ? -16
                        : f.format == DepthFormat::d24_unorm ? -24
                                                             : -23;
    constexpr float kFactor = 1000;
    std::vector<float> depths;
    Dice dice(79);
    for (uint32_t k = 0; k < kSquares; ++k) {
        depths.push_back(
            static_cast<float>(std::ldexp(dice.real(1, 1.9), -static_cast<int>(dice.whole(1, 4)))));
    }
    Scene plain = make_scene(property.id, f.format, depths);
    Scene biased = make_scene(property.id + "-biased", f.format, depths);
    biased.draw().depth.bias = cases::DepthBias{kFactor, 0, 0};
    const auto pictures = picture_pair(bench, plain.take(), biased.take(), property);
    if (!pictures) {
        return;
    }
    const auto& [before, after] = *pictures;
    std::vector<std::string> names;
    for (int k = -2; k <= 2; ++k) {
        names.push_back(unit_name(f, nominal + k));
    }
    names.emplace_back("no bias at all");
    Vote vote(names);
    for (size_t k = 0; k < depths.size(); ++k) {
        const size_t at = pixel_of_square(k);
        if (!is_hit(before, at) || !is_hit(after, at)) {
            continue;
        }
        const double moved =
            static_cast<double>(after.depth[at]) - static_cast<double>(before.depth[at]);
        const int exponent = f.steps > 0 ? 0 : std::ilogb(depths[k]);
        vote.add([&](size_t n) {
            if (n + 1 == names.size()) {
                return std::fabs(moved) <= 0;
            }
            const double expected = static_cast<double>(kFactor) *
                                    std::ldexp(1.0, nominal - 2 + static_cast<int>(n) + exponent);
            // A step of the format, and a thousandth for the sum's rounding.
            const double room =
                expected / 500 + (f.steps > 0 ? 1.5 / f.steps : std::ldexp(1.0, exponent - 22));
            return std::fabs(moved - expected) <= room;
        });
    }
    vote.settle(property);
}

// One vertex lies far beyond the far plane: its z has another exponent than what clipping leaves,
// and that another one than what is seen.
void measure_exponent(const Bench& bench) {
    Finding property(bench, "depth.bias_exponent",
                     "Whose exponent the unit of depth bias follows in D32",
                     "triangles that reach beyond the far plane, with and without a constant bias");
    const auto make = [](const std::string& id, bool is_biased) {
        Scene scene(id, 64, 64);
        for (int cell = 0; cell < 16; ++cell) {
            const double x = (cell % 4) * 16;
            const double y = (cell / 4) * 16;
            // z = 1/8 + (x + y) * 15/16 / 4: it is 1 where x + y is 3.73, and 7.6 at the far end.
            scene.add({x, y, 0.125}, {x + 16, y, 3.875}, {x, y + 16, 3.875});
        }
        if (is_biased) {
            scene.draw().depth.bias = cases::DepthBias{-4096, 0, 0};
        }
        return scene.take();
    };
    const auto pictures = picture_pair(bench, make(property.id, false),
                                       make(property.id + "-biased", true), property);
    if (!pictures) {
        return;
    }
    const auto& [before, after] = *pictures;
    // What r is times 2^e was found before.
    const std::string unit(bench.sheet.answer("depth.bias_unit.d32"));
    int power = 0;
    if (std::sscanf(unit.c_str(), "2^(e%d)", &power) != 1) {
        property.why = "the unit itself could not be told";
        return;
    }
    const auto candidates = std::to_array<const char*>(
        {"of the vertices before clipping", "of what clipping leaves", "of the fragment's depth"});
    Vote vote({candidates.begin(), candidates.end()});
    for (size_t k = 0; k < before.sample_count(); ++k) {
        if (!is_hit(before, k) || !is_hit(after, k)) {
            continue;
        }
        const auto z = static_cast<double>(before.depth[k]);
        const double moved = z - static_cast<double>(after.depth[k]);
        vote.add([&](size_t n) {
            const int exponent = n == 0 ? 1 : n == 1 ? 0 : std::ilogb(z);
            const double one = std::ldexp(4096.0, exponent + power);
            return std::fabs(moved / one - 1) < 0.02;
        });
    }
    vote.settle(property);
}

}  // namespace

void measure_depth(const Bench& bench) {
    for (const Format& f : kFormats) {
        if (f.steps > 0) {
            measure_rounding(bench, f);
        }
        measure_unit(bench, f);
    }
    measure_exponent(bench);
}

}  // namespace probe
