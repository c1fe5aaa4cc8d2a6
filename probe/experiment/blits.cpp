// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Blits: where the linear filter stops at a border, how many bits its weights have, and how source
// coordinates are made.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "cases/model/blit_source.hpp"
#include "probe/base/scene.hpp"
#include "probe/base/vote.hpp"
#include "probe/experiment/experiments.hpp"

namespace probe {

namespace {

using cases::ColorFormat;

struct Shape {
    uint32_t source = 0;  // texels of the source image, square
    int32_t from = 0, to = 0;
    uint32_t destination = 0;  // texels of the target, all of it
};
cases::Case make_case(const std::string& id, const Shape& shape, cases::BlitFilter filter,
                      ColorFormat from, ColorFormat to, cases::BlitPattern pattern) {
    cases::Case c;
    c.id = "probe/" + id;
    c.target.width = shape.destination;
    c.target.height = 1;
    c.target.has_instruments = false;
    c.target.has_depth = false;
    c.target.color = cases::ColorTarget{to, {}};
    cases::Blit blit;
    blit.source_format = from;
    blit.source_width = shape.source;
    blit.source_height = 1;
    blit.pattern = pattern;
    blit.filter = filter;
    blit.source = {shape.from, 0, shape.to, 1};
    blit.destination = {0, 0, static_cast<int32_t>(shape.destination), 1};
    c.blit = blit;
    return c;
}

// u of the centre of a destination texel [Vulkan, "Image Copies With Scaling"].
double coordinate(const Shape& s, uint32_t i) {
    return s.from + (i + 0.5) * (s.to - s.from) / s.destination;
}

// What the linear filter makes of a row of 8-bit codes: weights of `bits` bits, clamped to [low,
// high).
double filtered(const std::vector<cases::TexelCodes>& row, double u, int bits, int32_t low,
                int32_t high) {
    const double at = u - 0.5;
    const double whole = std::floor(at);
    const double scale = std::ldexp(1.0, bits);
    const double weight = std::floor((at - whole) * scale + 0.5) / scale;
    const auto texel = [&](double x) {
        const auto n = std::clamp(static_cast<int32_t>(x), low, high - 1);
        return static_cast<double>(row[static_cast<size_t>(n)][0]) / 255;
    };
    return texel(whole) + (texel(whole + 1) - texel(whole)) * weight;
}

// A blit with the linear filter from 8-bit codes to 16 bits; texels whose source coordinate lies in
// [lowest, highest] vote, with room for the filter's own error.
void measure_linear(
    const Bench& bench, Property& property, const Shape& shape, Vote vote, double room,
    double lowest, double highest,
    const std::function<double(size_t, const std::vector<cases::TexelCodes>&, double u)>& predict,
    const std::function<std::string(size_t)>& label = {}) {
    for (const ColorFormat to : {ColorFormat::rgba16_unorm, ColorFormat::rgba16_float}) {
        const cases::Case c = make_case(property.id, shape, cases::BlitFilter::linear,
                                        ColorFormat::rgba8_unorm, to, cases::BlitPattern::unique);
        const Drawn drawn = bench.draw_one(c);
        if (!drawn.picture) {
            property.why = drawn.why_not;
            continue;  // not every device blits to 16 bits of fixed point
        }
        const std::vector<cases::TexelCodes> row = cases::blit_source(*c.blit);
        for (uint32_t i = 0; i < shape.destination; ++i) {
            if (coordinate(shape, i) < lowest || coordinate(shape, i) > highest) {
                continue;
            }
            const uint32_t code = drawn.picture->color[i][0];
            double got = code / 65535.0;
            double step = 1 / 65535.0;
            if (to == ColorFormat::rgba16_float) {
                const int exponent = static_cast<int>(code >> 10 & 0x1fU);
                const double fraction = code & 0x3ffU;
                got = exponent == 0 ? std::ldexp(fraction, -24)
                                    : std::ldexp(fraction + 1024, exponent - 25);
                step = std::ldexp(1.0, std::max(exponent, 1) - 25);
            }
            vote.add([&](size_t k) {
                return std::fabs(predict(k, row, coordinate(shape, i)) - got) <= step + room;
            });
        }
        property.why.clear();
        vote.settle(property, label);
        break;
    }
}

void measure_border(const Bench& bench) {
    Finding property(bench, "blit.border", "Where the linear filter of a blit stops",
                     "a region inside the source, enlarged, with texels beyond its border");
    const Shape shape{64, 16, 20, 256};
    // Whatever its weights are: 1/24 of a texel's difference.
    measure_linear(bench, property, shape,
                   Vote({"at the image's border", "at the region's border"}), 1.0 / 24, 0, 64,
                   [&](size_t k, const auto& row, double u) {
                       return k == 0 ? filtered(row, u, 20, 0, 64)
                                     : filtered(row, u, 20, shape.from, shape.to);
                   });
}

void measure_weights(const Bench& bench) {
    Finding property(bench, "blit.weights", "Bits of the linear filter's weights",
                     "four texels enlarged to 4,096: how the numbers between them step");
    const Shape shape{64, 30, 34, 4096};
    constexpr std::array<int, 9> kBits{4, 5, 6, 7, 8, 9, 10, 12, 24};
    std::vector<std::string> names;
    for (const int bits : kBits) {
        names.push_back(bits == 24 ? "more than 12 bits" : fmt::format("{} bits", bits));
    }
    measure_linear(
        bench, property, shape, Vote(names), 0x1p-20, 30.5, 33.5,
        [&](size_t k, const auto& row, double u) { return filtered(row, u, kBits.at(k), 0, 64); });
}

// In binary32, from the corner or by adding the step of a texel again and again.
float by_product(const Shape& s, uint32_t i) {
    const float scale = static_cast<float>(s.to - s.from) / static_cast<float>(s.destination);
    return (static_cast<float>(i) + 0.5F) * scale + static_cast<float>(s.from);
}
std::vector<float> by_steps(const Shape& s) {
    const float scale = static_cast<float>(s.to - s.from) / static_cast<float>(s.destination);
    std::vector<float> out;
    float u = 0.5F * scale + static_cast<float>(s.from);
    for (uint32_t i = 0; i < s.destination; ++i) {
        out.push_back(u);
        u += scale;
    }
    return out;
}

void measure_coordinates(const Bench& bench) {
    Finding property(
        bench, "blit.coordinates", "How a blit gets from one source coordinate to the next",
        "rows of 1,000 and more texels with the nearest filter, where sums of steps leave the "
        "texel that the product of the step hits");
    Vote vote({"each by itself", "by adding the step to the last one"});
    for (const uint32_t size : {1000U, 1001U, 1023U, 1501U, 1777U, 2003U}) {
        for (const uint32_t source : {333U, 599U, 701U, 997U}) {
            const Shape shape{source, 0, static_cast<int32_t>(source), size};
            const cases::Case c = make_case(fmt::format("blit-{}-{}", size, source), shape,
                                            cases::BlitFilter::nearest, ColorFormat::rgba8_unorm,
                                            ColorFormat::rgba8_unorm, cases::BlitPattern::unique);
            const Drawn drawn = bench.draw_one(c);
            if (!drawn.picture) {
                property.why = drawn.why_not;
                continue;
            }
            const std::vector<cases::TexelCodes> row = cases::blit_source(*c.blit);
            const std::vector<float> steps = by_steps(shape);
            for (uint32_t i = 0; i < size; ++i) {
                const auto is_texel = [&](float u) {
                    const auto n = static_cast<size_t>(
                        std::clamp(std::floor(u), 0.0F, static_cast<float>(source - 1)));
                    return row[n] == drawn.picture->color[i];
                };
                vote.add(
                    [&](size_t k) { return is_texel(k == 0 ? by_product(shape, i) : steps[i]); });
            }
        }
    }
    vote.settle(property);
}

}  // namespace

void measure_blits(const Bench& bench) {
    measure_border(bench);
    measure_weights(bench);
    measure_coordinates(bench);
}

}  // namespace probe
