// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/generate/generator_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cases {

void GeneratorKeys::error(const char* key, std::string message) {
    const TomlValue* value = table_.find(key);
    context_.error(value != nullptr ? value->where : table_.where, std::move(message));
}

int64_t GeneratorKeys::integer(const char* key, int64_t low, int64_t high,
                               std::optional<int64_t> otherwise) {
    const TomlValue* value = table_.find(key);
    if (value == nullptr) {
        if (!otherwise) {
            error(key, fmt::format("generate has no {}; write an integer", key));
        }
        return otherwise.value_or(low);
    }
    return context_.integer(*value, key, low, high).value_or(low);
}

mpq_class GeneratorKeys::length(const char* key, std::optional<mpq_class> otherwise) {
    const TomlValue* value = table_.find(key);
    if (value == nullptr) {
        if (!otherwise) {
            error(key, fmt::format("generate has no {}; write a number of pixels", key));
        }
        return otherwise.value_or(mpq_class(0));
    }
    const std::optional<Number> n = context_.number(*value, key);
    if (n && n->value < 0) {
        error(key, fmt::format("{} is negative", key));
    }
    return n ? n->value : mpq_class(0);
}

ExactPoint GeneratorKeys::point(const char* key, std::optional<ExactPoint> otherwise) {
    const TomlValue* value = table_.find(key);
    if (value == nullptr) {
        if (!otherwise) {
            error(key, fmt::format("generate has no {}; write [x, y]", key));
        }
        return otherwise.value_or(ExactPoint{});
    }
    const std::optional<std::vector<Number>> numbers = context_.numbers(*value, key, 2);
    if (!numbers) {
        return {};
    }
    for (const Number& n : *numbers) {
        if (abs(n.value) > 16777216) {
            error(key, fmt::format("{} is more than 2^24 pixels away", key));
        }
    }
    return {(*numbers)[0].value, (*numbers)[1].value};
}

bool GeneratorKeys::boolean(const char* key) {
    const TomlValue* value = table_.find(key);
    return value != nullptr && context_.boolean(*value, key).value_or(false);
}

size_t GeneratorKeys::word(const char* key, std::span<const std::string_view> words,
                           size_t otherwise) {
    const TomlValue* value = table_.find(key);
    return value == nullptr ? otherwise : context_.word(*value, key, words).value_or(otherwise);
}

GeneratorKeys::Rectangle GeneratorKeys::rectangle() {
    Rectangle r{point("from", ExactPoint{0, 0}),
                point("to", ExactPoint{target_.width, target_.height})};
    if (good() && (r.from.x >= r.to.x || r.from.y >= r.to.y)) {
        error("to", "to is not right of and below from");
    }
    return r;
}

std::optional<GeneratorKeys::WRange> GeneratorKeys::w_range() {
    const TomlValue* value = table_.find("w");
    if (value == nullptr) {
        return std::nullopt;
    }
    const std::optional<std::vector<Number>> numbers = context_.numbers(*value, "w", 2);
    if (!numbers) {
        return std::nullopt;
    }
    const mpq_class low = (*numbers)[0].value * 256;
    const mpq_class high = (*numbers)[1].value * 256;
    if (low.get_den() != 1 || high.get_den() != 1 || low < 1 || high < low || high > 256 * 65536) {
        error("w", "w is not [low, high] in multiples of 1/256 with 1/256 <= low <= high <= 65536");
        return std::nullopt;
    }
    return WRange{low.get_num().get_si(), high.get_num().get_si()};
}

mpz_class floor_of(const mpq_class& q) {
    mpz_class result;
    mpz_fdiv_q(result.get_mpz_t(), q.get_num_mpz_t(), q.get_den_mpz_t());
    return result;
}

mpq_class on_grid(const mpq_class& value, int64_t grid) {
    if (grid == 0) {
        return value;
    }
    mpq_class result(floor_of(value * mpq_class(grid) + mpq_class(1, 2)), mpz_class(grid));
    result.canonicalize();
    return result;
}

ExactPoint on_grid(const ExactPoint& p, int64_t grid) {
    return {on_grid(p.x, grid), on_grid(p.y, grid)};
}

mpq_class twice_area(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

void draw_w(std::vector<ExactVertex>& vertices, const std::optional<GeneratorKeys::WRange>& range,
            Random& random) {
    if (!range) {
        return;
    }
    for (ExactVertex& v : vertices) {
        mpq_class w(random.between(range->low, range->high), 256);
        w.canonicalize();
        v.xyzw[3].value = w;
    }
}

void shuffle_triangles(std::vector<uint32_t>& indices, Random& random) {
    const auto count = static_cast<int64_t>(indices.size() / 3);
    for (int64_t t = count - 1; t >= 0; --t) {
        const int64_t other = random.between(0, t);
        const int64_t turn = random.between(0, 2);
        if (other != t) {
            std::swap_ranges(indices.begin() + 3 * t, indices.begin() + 3 * t + 3,
                             indices.begin() + 3 * other);
        }
        std::rotate(indices.begin() + 3 * t, indices.begin() + 3 * t + turn,
                    indices.begin() + 3 * t + 3);
    }
}

}  // namespace cases
