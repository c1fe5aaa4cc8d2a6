// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "tests/docs/algorithm_figures.hpp"
#include "tests/unit/rasterizers/exact_numbers.hpp"
#include "tests/unit/rasterizers/random_triangles.hpp"

namespace figures {

namespace {

using namespace rasterizers;

constexpr int kBits[] = {6, 8, 10, 12, 15, 18, 21, 24, 28};
constexpr int kSamples = 1500;
constexpr int64_t kSize = 64;  // pixels, a side

struct Sample {
    Corners triangle;  // clockwise, with at least 8 pixels of area
    SubpixelPoint first;
    int64_t k = 0, l = 0;
    std::array<float, 3> w{};  // 1 to 4, 24 bits
};

std::vector<Sample> random_samples() {
    test::RandomTriangles random(2013);
    std::vector<Sample> out;
    while (out.size() < kSamples) {
        const std::optional<Corners> t = clockwise(random.triangle(2, kSize));
        if (!t || edge_function((*t)[0], (*t)[1], (*t)[2]) < 16 * kPixel * kPixel) {
            continue;
        }
        const SubpixelPoint offset{kPixel / 2, kPixel / 2};
        const PixelRect box = bounding_box(*t, {0, 0, kSize, kSize}, offset);
        const int64_t x = random.integer(box.x0, box.x1 - 1);
        const int64_t y = random.integer(box.y0, box.y1 - 1);
        const Areas areas = areas_at(*t, sample_of(x, y, offset));
        if (std::min({areas.part[0], areas.part[1], areas.part[2]}) < 0) {
            continue;
        }
        Sample s{*t, sample_of(box.x0, box.y0, offset), x - box.x0, y - box.y0, {}};
        for (float& w : s.w) {
            w = std::ldexp(static_cast<float>(random.integer(1 << 22, 1 << 24)), -22);
        }
        out.push_back(s);
    }
    return out;
}

// Half the sum of |b^ - b| when the products and b^ are rounded to n bits.
double coordinate_loss(const Sample& s, int bits) {
    const NineTerms terms =
        nine_terms(s.triangle, s.first, normalise_products(normalise_w(s.w, bits), bits), 0);
    const auto computed = at_pixel(terms, s.k, s.l);
    if (computed[0] + computed[1] + computed[2] <= 0) {
        return 1;
    }
    const std::array<int64_t, 3> q = quantised_barycentrics(computed, bits);
    const Areas areas = areas_at(s.triangle, {s.first.x + s.k * kPixel, s.first.y + s.l * kPixel});
    const auto b = test::exact_perspective(areas, s.w);
    mpq_class loss = 0;
    for (size_t i = 0; i < 3; ++i) {
        loss += abs(mpq_class(mpz_class(q[i])) * test::power_of_two(-bits) - b[i]);
    }
    return std::min(1.0, mpq_class(loss / 2).get_d());
}

// Samples of the bounding box whose side of an edge changes when the nine terms have n bits, all
// w = 1. Samples exactly on an edge count as inside in both.
double wrong_coverage(const std::vector<Sample>& samples, int bits) {
    uint64_t wrong = 0;
    uint64_t all = 0;
    for (size_t n = 0; n < samples.size(); n += 10) {
        const Corners& t = samples[n].triangle;
        const SubpixelPoint offset{kPixel / 2, kPixel / 2};
        const PixelRect box = bounding_box(t, {0, 0, kSize, kSize}, offset);
        const SubpixelPoint first = sample_of(box.x0, box.y0, offset);
        const NineTerms exact = nine_terms(t, first, {{1, 1, 1}, 0}, 0);
        const NineTerms rounded = nine_terms(t, first, {{1, 1, 1}, 0}, bits);
        const auto is_inside = [](const NineTerms& terms, int64_t k, int64_t l) {
            const auto a = at_pixel(terms, k, l);
            return a[0] >= 0 && a[1] >= 0 && a[2] >= 0;
        };
        for (int64_t l = 0; l < box.y1 - box.y0; ++l) {
            for (int64_t k = 0; k < box.x1 - box.x0; ++k) {
                ++all;
                wrong += is_inside(exact, k, l) != is_inside(rounded, k, l) ? 1U : 0U;
            }
        }
    }
    return static_cast<double>(wrong) / static_cast<double>(all);
}

std::string number(double v) {
    return v > 0 ? fmt::format("{:.2e}", v) : "0";
}

}  // namespace

std::vector<BlockRow> block_rows() {
    const std::vector<Sample> samples = random_samples();
    std::vector<BlockRow> rows;
    for (const int bits : kBits) {
        BlockRow row;
        row.bits = bits;
        row.terms_bound = 0;
        for (const Sample& s : samples) {
            const auto products = test::block_loss(s.triangle, s.first, s.k, s.l, s.w, bits, 0);
            row.products = std::max(row.products, products.measured);
            row.products_bound = std::max(row.products_bound, products.bound.value_or(1));
            const auto terms = test::block_loss(s.triangle, s.first, s.k, s.l, s.w, bits, bits);
            row.terms = std::max(row.terms, std::min(1.0, terms.measured));
            if (!terms.bound || *terms.bound >= 1) {
                row.terms_bound.reset();
            } else if (row.terms_bound) {
                row.terms_bound = std::max(*row.terms_bound, *terms.bound);
            }
            row.coordinates = std::max(row.coordinates, coordinate_loss(s, bits));
        }
        row.wrong_coverage = wrong_coverage(samples, bits);
        rows.push_back(row);
    }
    return rows;
}

std::string block_table(const std::vector<BlockRow>& rows) {
    std::string out =
        "| bits n | products of w: loss | bound | 2R 2^-n | nine terms too: loss | bound | "
        "products and b' "
        "rounded: loss | samples on the wrong side |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const BlockRow& r : rows) {
        out +=
            fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", r.bits, number(r.products),
                        number(r.products_bound), number(std::ldexp(8.0, -r.bits)), number(r.terms),
                        r.terms_bound ? number(*r.terms_bound) : "none", number(r.coordinates),
                        number(r.wrong_coverage));
    }
    return out;
}

std::string block_plot(const std::vector<BlockRow>& rows) {
    // Bits to the right, powers of two upwards: one bit is as long as one factor of two.
    constexpr double kLeft = 80;
    constexpr double kTop = 20;
    constexpr double kUnit = 16;  // per bit
    constexpr int kMinBits = 6;
    constexpr int kMaxBits = 28;
    constexpr int kLowest = -30;
    const double width = kLeft + (kMaxBits - kMinBits) * kUnit + 250;
    const double height = kTop - kLowest * kUnit + 50;
    const auto x_of = [&](double bits) { return kLeft + (bits - kMinBits) * kUnit; };
    const auto y_of = [&](double loss) {
        return kTop - std::max(static_cast<double>(kLowest), std::log2(loss)) * kUnit;
    };
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
        "<title>Loss of block-normalised barycentric interpolants by bits</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        width, height);
    for (int e = 0; e >= kLowest; e -= 5) {
        const double y = kTop - e * kUnit;
        out += fmt::format(
            "<path d=\"M{:.0f} {:.1f}H{:.0f}\" stroke=\"#ddd\"/><text x=\"{:.0f}\" y=\"{:.1f}\" "
            "text-anchor=\"end\">2<tspan dy=\"-4\" font-size=\"9\">{}</tspan></text>\n",
            kLeft, y, x_of(kMaxBits), kLeft - 6, y + 4, e);
    }
    for (const BlockRow& r : rows) {
        out += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n",
                           x_of(r.bits), height - 30, r.bits);
    }
    out += fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">bits n of w, of its products and "
        "of the nine terms</text>\n",
        x_of((kMinBits + kMaxBits) / 2.0), height - 10);
    out += fmt::format(
        "<text transform=\"translate(18 {:.0f}) rotate(-90)\" text-anchor=\"middle\">largest loss, "
        "in "
        "parts of the attribute's range</text>\n",
        kTop - kLowest * kUnit / 2);
    struct Line {
        const char* name;
        const char* color;
        const char* dashes;
        std::function<std::optional<double>(const BlockRow&)> value;
    };
    const Line lines[] = {
        {"bound, nine terms", "#c0392b", "5 4", [](const BlockRow& r) { return r.terms_bound; }},
        {"b' rounded to n bits", "#7d3c98", "",
         [](const BlockRow& r) { return std::optional(r.coordinates); }},
        {"nine terms of n bits", "#c0392b", "",
         [](const BlockRow& r) { return std::optional(r.terms); }},
        {"bound, products", "#1f618d", "5 4",
         [](const BlockRow& r) { return std::optional(r.products_bound); }},
        {"products of n bits", "#1f618d", "",
         [](const BlockRow& r) { return std::optional(r.products); }}};
    double legend = kTop + 10;
    for (const Line& line : lines) {
        std::string path;
        for (const BlockRow& r : rows) {
            if (const std::optional<double> v = line.value(r); v && *v > 0) {
                path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x_of(r.bits),
                                    y_of(*v));
            }
        }
        const double at = x_of(kMaxBits) + 20;
        out += fmt::format(
            "<path d=\"{0}\" fill=\"none\" stroke=\"{1}\" stroke-width=\"2\" "
            "stroke-dasharray=\"{2}\"/>\n<path d=\"M{3:.0f} {4:.1f}h30\" stroke=\"{1}\" "
            "stroke-width=\"2\" stroke-dasharray=\"{2}\"/><text x=\"{5:.0f}\" "
            "y=\"{6:.1f}\">{7}</text>\n",
            path, line.color, *line.dashes == '\0' ? "none" : line.dashes, at, legend, at + 38,
            legend + 4, line.name);
        legend += 22;
    }
    return out + "</svg>\n";
}

}  // namespace figures
