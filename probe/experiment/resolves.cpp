// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How averages of samples are rounded, and whether those of sRGB are taken of numbers or codes.
#include <array>
#include <cmath>

#include "cases/format/color_format.hpp"
#include "probe/base/scene.hpp"
#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"

namespace probe {

namespace {

using cases::ColorFormat;

constexpr uint32_t kSamples = 4;

// Squares whose four samples hold codes of our choice: one draw a sample.
using Codes = std::vector<std::array<uint32_t, kSamples>>;
double decode_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}
double encode_srgb(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

cases::Case make_case(const std::string& id, ColorFormat format, const Codes& codes) {
    cases::Case out;
    for (uint32_t s = 0; s < kSamples; ++s) {
        std::vector<glm::vec4> values;
        for (const auto& c : codes) {
            const double encoded = c.at(s) / 255.0;
            const auto v = static_cast<float>(
                format == ColorFormat::rgba8_srgb ? decode_srgb(encoded) : encoded);
            values.emplace_back(v, v, v, 1.0F);
        }
        Scene scene = make_squares(id, values, kSamples);
        scene.draw().multisample.sample_mask = 1U << s;
        if (s == 0) {
            scene.target().color = cases::ColorTarget{format, {}};
            scene.target().color_resolve = cases::Resolve::average;
            out = scene.take();
        } else {
            out.draws.push_back(scene.draw());
        }
    }
    return out;
}

void measure(const Bench& bench, Finding&& property, ColorFormat format, const Codes& codes,
             Vote vote, double room,
             double (*predict)(size_t candidate, const std::array<uint32_t, kSamples>&)) {
    const auto picture = bench.picture_of(make_case(property.id, format, codes), property);
    if (!picture) {
        return;
    }
    for (size_t k = 0; k < codes.size(); ++k) {
        const size_t pixel = pixel_of_square(k);
        // The samples hold what was drawn, whatever the device made of it.
        std::array<uint32_t, kSamples> held{};
        bool is_drawn = true;
        for (uint32_t s = 0; s < kSamples; ++s) {
            held.at(s) = picture->color[pixel * kSamples + s][0];
            is_drawn = is_drawn && is_hit(*picture, pixel * kSamples + s);
        }
        if (is_drawn) {
            const double got = picture->resolved_color[pixel][0];
            vote.add([&](size_t n) { return std::fabs(predict(n, held) - got) < room; });
        }
    }
    vote.settle(property);
}

double sum_of(const std::array<uint32_t, kSamples>& codes) {
    return codes[0] + codes[1] + codes[2] + codes[3];
}

}  // namespace

void measure_resolves(const Bench& bench) {
    Dice dice(131);
    Codes codes;
    Codes apart;  // whose averages of numbers and of codes differ by several codes
    for (uint32_t k = 0; k < kSquares; ++k) {
        std::array<uint32_t, kSamples> c{};
        for (uint32_t& one : c) {
            one = static_cast<uint32_t>(dice.whole(0, 255));
        }
        codes.push_back(c);
        const auto low = static_cast<uint32_t>(dice.whole(0, 60));
        const auto high = static_cast<uint32_t>(dice.whole(180, 255));
        apart.push_back({low, high, low, high});
    }
    measure(bench,
            Finding(bench, "resolve.rounding",
                    "How averages of four samples are rounded to rgba8-unorm",
                    "squares whose samples hold codes that average between two codes"),
            ColorFormat::rgba8_unorm, codes,
            Vote({"nearest, ties up", "nearest, ties to even", "nearest, ties down", "down"}), 0.5,
            [](size_t n, const auto& held) {
                const double mean = sum_of(held) / kSamples;
                return n == 0   ? std::floor(mean + 0.5)
                       : n == 1 ? std::nearbyint(mean)
                       : n == 2 ? std::ceil(mean - 0.5)
                                : std::floor(mean);
            });
    measure(bench,
            Finding(bench, "resolve.srgb", "What samples of rgba8-srgb are averaged",
                    "squares whose samples hold dark and bright codes"),
            ColorFormat::rgba8_srgb, apart,
            Vote({"the numbers that the codes stand for", "the codes"}),
            1.01,  // however it is rounded; the two ways differ by several codes
            [](size_t n, const auto& held) {
                if (n == 1) {
                    return sum_of(held) / kSamples;
                }
                double sum = 0;
                for (const uint32_t code : held) {
                    sum += decode_srgb(code / 255.0);
                }
                return 255 * encode_srgb(sum / kSamples);
            });
}

}  // namespace probe
