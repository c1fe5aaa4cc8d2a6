// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/measure.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

#include "cases/toml/field_reader.hpp"
#include "fuzz/reduce/draw_shape.hpp"

namespace fuzz {

namespace {

constexpr uint64_t kNotFiniteCost = 1000;
constexpr uint64_t kWordCost = 1000;  // more than any number, which has 1074 + 1024 bits at most

bool is_number_text(const std::string& text) {
    return !text.empty() && std::string_view("0123456789.+-(").find(text[0]) != std::string::npos;
}

uint64_t product(const Document* size) {
    if (size == nullptr || !size->is(Kind::array)) {
        return 0;
    }
    uint64_t out = 1;
    for (const Document& side : size->array) {
        out *= static_cast<uint64_t>(std::clamp(value_of(side).value_or(0.0), 0.0, 65536.0));
    }
    return out;
}

uint64_t count_of(const Document& table, std::string_view key) {
    const Document* value = table.find(key);
    return value == nullptr ? 0 : value->array.size();
}

uint64_t number_of(const Document* table, std::string_view key) {
    const Document* value = table == nullptr ? nullptr : table->find(key);
    const std::optional<double> number = value == nullptr ? std::nullopt : value_of(*value);
    return static_cast<uint64_t>(std::clamp(number.value_or(1.0), 0.0, 65536.0));
}

struct Tally {
    uint64_t nodes = 0, cost = 0;
};

void count(const Document& value, Tally& tally) {
    if (value.is(Kind::table)) {
        for (const cases::TomlEntry& entry : value.table) {
            ++tally.nodes;
            count(entry.value, tally);
        }
    } else if (value.is(Kind::array)) {
        for (const Document& element : value.array) {
            ++tally.nodes;
            count(element, tally);
        }
    } else {
        tally.cost += cost_of(value);
    }
}

// Bits before the point, those of them that are needed again, and three times those after it.
uint64_t bits_of(double value) {
    int exponent = 0;
    const double fraction = std::frexp(std::fabs(value), &exponent);  // value = fraction 2^exponent
    const auto mantissa = static_cast<uint64_t>(std::ldexp(fraction, 53));
    const int last = exponent - 53 + std::countr_zero(mantissa);  // of the lowest bit that is set
    const int before = std::max(exponent, 0);
    return static_cast<uint64_t>(2 * before - std::clamp(last, 0, before) + 3 * std::max(-last, 0));
}

}  // namespace

std::optional<double> value_of(const Document& value) {
    switch (value.kind) {
        case Kind::integer:
            return static_cast<double>(value.integer);
        case Kind::floating:
            return std::isfinite(value.floating) ? std::optional(value.floating) : std::nullopt;
        case Kind::string: {
            if (!is_number_text(value.string)) {
                return std::nullopt;
            }
            cases::LeafContext context({});
            const std::optional<cases::Number> number = context.any_binary32(value, "");
            if (!number || number->non_finite) {
                return std::nullopt;
            }
            const double near = number->value.get_d();
            return std::isfinite(near) ? std::optional(number->negative_zero ? -0.0 : near)
                                       : std::nullopt;
        }
        default:
            return std::nullopt;
    }
}

uint64_t cost_of(const Document& value) {
    if (value.is(Kind::boolean)) {
        return 1;
    }
    const std::optional<double> number = value_of(value);
    if (!number) {
        // Of words, the plain format costs least.
        const bool is_plain = value.string == kPlainFormat;
        return value.is(Kind::string) ? kWordCost + (is_plain ? 0 : 1 + value.string.size())
                                      : kNotFiniteCost;
    }
    const bool is_zero = std::fpclassify(*number) == FP_ZERO;
    const bool is_plain = fuzz::number(*number).kind == value.kind;
    return (is_zero ? 0 : 1 + bits_of(*number)) + (std::signbit(*number) ? 1 : 0) +
           (is_plain ? 0 : 1) + (value.is(Kind::string) ? value.string.size() : 0);
}

Measure measure(const Document& document) {
    Measure out{};
    if (const Document* draws = document.find("draw")) {
        out[0] = draws->array.size();
        for (const Document& draw : draws->array) {
            const DrawShape shape = shape_of(draw);
            out[1] += triangle_count(shape);
            out[2] += (shape.has_indices ? 1U : 0U) + (shape.is_list ? 0U : 1U);
            for (const char* key : {"attribute", "clip_distance", "cull_distance"}) {
                out[6] += count_of(draw, key);
            }
        }
    }
    const Document* target = document.find("target");
    out[3] = number_of(target, "samples");
    out[4] = number_of(target, "layers");
    out[5] = target == nullptr ? 0 : product(target->find("size"));
    if (const Document* blit = document.find("blit")) {
        out[5] += product(blit->find("size"));
    }
    Tally tally;
    count(document, tally);
    out[7] = tally.nodes;
    out[8] = tally.cost;
    return out;
}

}  // namespace fuzz
