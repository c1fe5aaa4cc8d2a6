// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/write/vertex_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cases/base/float_bits.hpp"
#include "cases/generate/vertices.hpp"
#include "cases/model/instances.hpp"
#include "cases/toml/binary32.hpp"
#include "cases/write/table_tree.hpp"

namespace cases {

namespace {

constexpr long kMostPixels = 1L << 24;
constexpr unsigned kFinestGrid = 16;        // bits below a pixel that are tried before decimals
constexpr int kFewDecimals = 4;             // tried before fractions
constexpr long kLargestDenominator = 4096;  // of fractions
constexpr int kFirstDigits = 6;             // significant ones that are tried after fractions ...
constexpr int kLastDigits = 17;             // ... up to what tells binary64 numbers apart

// A number of a file and its exact value.
struct Written {
    Number number;
    TomlValue value;
};

// How the loader goes from a position to clip space: (p - origin) * factor, rounded once.
struct Conversion {
    mpq_class origin, factor;
    float of(const mpq_class& p) const {
        const mpq_class product = (p - origin) * factor;
        return round_to_binary32(product).value;
    }
};

// A rational: a TOML number or an expression such as "3+17/256", what is shorter.
TomlValue value_of(const mpq_class& q) {
    const double near = q.get_d();
    if (q.get_den() == 1) {
        return tree::number(near);
    }
    const mpz_class whole = q.get_num() / q.get_den();  // towards 0
    const mpq_class rest = q - whole;
    std::string expression = whole != 0 ? whole.get_str() : "";
    expression += whole != 0 && rest > 0 ? "+" : "";
    expression += rest.get_str();
    constexpr size_t kQuotes = 2;
    return exact(near) == q && fmt::format("{}", near).size() <= expression.size() + kQuotes
               ? tree::number(near)
               : tree::text(expression);
}

// The nearest multiple of 1/n.
mpq_class multiple(const mpq_class& q, const mpz_class& n) {
    const mpz_class twice = 2 * q.get_num() * n + q.get_den();
    const mpz_class divisor = 2 * q.get_den();
    mpz_class whole;
    mpz_fdiv_q(whole.get_mpz_t(), twice.get_mpz_t(), divisor.get_mpz_t());
    mpq_class result(whole, n);
    result.canonicalize();
    return result;
}

// The simplest number that is converted to `wanted` (a zero of any sign), if one is found: on a
// grid of a power of two, a short decimal, a fraction, a decimal with as many digits as it takes.
std::optional<Written> simplest(const Conversion& conversion, float wanted) {
    const mpq_class about =
        exact(static_cast<double>(wanted)) / conversion.factor + conversion.origin;
    if (abs(about) > kMostPixels) {
        return std::nullopt;
    }
    const auto is_right = [&](const mpq_class& q) {
        const float found = conversion.of(q);
        return !(found < wanted) && !(found > wanted);
    };
    for (unsigned bits = 0; bits <= kFinestGrid; ++bits) {
        const mpq_class q = multiple(about, mpz_class(1) << bits);
        if (is_right(q)) {
            return Written{{q}, value_of(q)};
        }
    }
    const auto decimal = [&](const std::string& text) -> std::optional<Written> {
        const mpq_class q = exact(std::stod(text));
        return is_right(q) ? std::optional(Written{{q}, tree::number(q.get_d())}) : std::nullopt;
    };
    const double near = about.get_d();
    for (int digits = 1; digits <= kFewDecimals; ++digits) {
        if (std::optional<Written> found = decimal(fmt::format("{:.{}f}", near, digits))) {
            return found;
        }
    }
    // The convergents of its continued fraction, h / k.
    mpq_class rest = about;
    std::array<mpz_class, 2> h = {1, 0};
    std::array<mpz_class, 2> k = {0, 1};
    for (;;) {
        mpz_class whole;
        mpz_fdiv_q(whole.get_mpz_t(), rest.get_num_mpz_t(), rest.get_den_mpz_t());
        h = {whole * h[0] + h[1], h[0]};
        k = {whole * k[0] + k[1], k[0]};
        if (k[0] > kLargestDenominator) {
            break;
        }
        const mpq_class q(h[0], k[0]);
        if (is_right(q)) {
            return Written{{q}, value_of(q)};
        }
        rest -= whole;
        if (rest == 0) {
            break;
        }
        rest = 1 / rest;
    }
    for (int digits = kFirstDigits; digits <= kLastDigits; ++digits) {
        if (std::optional<Written> found = decimal(fmt::format("{:.{}g}", near, digits))) {
            return found;
        }
    }
    return std::nullopt;
}

// What is written of each vertex, all as long as the longest: z = 1/2 and w = 1 may be missing.
std::vector<TomlValue> joined(const std::vector<std::array<TomlValue, 4>>& vertices,
                              size_t numbers) {
    std::vector<TomlValue> out;
    out.reserve(vertices.size());
    for (const std::array<TomlValue, 4>& v : vertices) {
        out.push_back(tree::list({v.begin(), v.begin() + static_cast<std::ptrdiff_t>(numbers)}));
    }
    return out;
}

std::optional<std::vector<TomlValue>> in_pixels(const Draw& draw,
                                                const std::vector<glm::vec4>& positions) {
    const Viewport& v = draw.viewport;
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.width) ||
        !std::isfinite(v.height)) {
        return std::nullopt;
    }
    const mpq_class half_x = exact(static_cast<double>(v.width)) / 2;
    const mpq_class half_y = exact(static_cast<double>(v.height)) / 2;
    if (half_x == 0 || half_y == 0) {
        return std::nullopt;
    }
    const mpq_class origin_x = exact(static_cast<double>(v.x)) + half_x;
    const mpq_class origin_y = exact(static_cast<double>(v.y)) + half_y;
    std::vector<ExactVertex> exact_vertices;
    std::vector<std::array<TomlValue, 4>> values;
    size_t numbers = 2;
    for (const glm::vec4& p : positions) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) ||
            !std::isfinite(p.w) || std::fpclassify(p.w) == FP_ZERO) {
            return std::nullopt;
        }
        const mpq_class w = exact(static_cast<double>(p.w));
        const std::optional<Written> x = simplest({origin_x, w / half_x}, p.x);
        const std::optional<Written> y = x ? simplest({origin_y, w / half_y}, p.y) : std::nullopt;
        std::optional<Written> z = y ? simplest({0, w}, p.z) : std::nullopt;
        if (!z) {
            return std::nullopt;
        }
        if (std::fpclassify(p.z) == FP_ZERO && std::signbit(p.z) != std::signbit(p.w)) {
            *z = {{0, true}, tree::number(-0.0)};
        }
        const bool is_flat = z->number.value == mpq_class(1, 2);
        numbers = std::max<size_t>(numbers, w != 1 ? 4 : is_flat ? 2 : 3);
        exact_vertices.push_back({{x->number, y->number, z->number, {w}}});
        values.push_back({x->value, y->value, z->value, number_value(p.w, Reading::nearest)});
    }
    // The loader has the last word, about the signs of zeros, too.
    LeafContext context({});
    std::vector<std::string> notes;
    const std::optional<std::vector<glm::vec4>> clip =
        to_clip(context, exact_vertices, Space::pixels, v, {}, "", notes);
    const auto same = [](const glm::vec4& a, const glm::vec4& b) {
        return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z) &&
               same_bits(a.w, b.w);
    };
    if (!clip ||
        !std::equal(clip->begin(), clip->end(), positions.begin(), positions.end(), same)) {
        return std::nullopt;
    }
    return joined(values, numbers);
}

}  // namespace

VertexTree vertex_tree(const Draw& draw) {
    const std::vector<glm::vec4> positions = base_positions(draw);
    if (std::optional<std::vector<TomlValue>> pixels = in_pixels(draw, positions)) {
        return {true, std::move(*pixels)};
    }
    VertexTree out;
    for (const glm::vec4& p : positions) {
        out.vertices.push_back(
            tree::list({number_value(p.x, Reading::exact), number_value(p.y, Reading::exact),
                        number_value(p.z, Reading::exact), number_value(p.w, Reading::exact)}));
    }
    return out;
}

}  // namespace cases
