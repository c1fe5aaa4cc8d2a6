// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps that make numbers rounder: many at once, then each.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <span>

#include "fuzz/reduce/measure.hpp"
#include "fuzz/reduce/path.hpp"
#include "fuzz/reduce/steps.hpp"

namespace fuzz {

namespace {

// What may become of a number: a constant, a multiple of 2^-bits, one with half of its digits, or
// one whose logarithm is half as far from 0.
struct Rounding {
    enum class Kind : uint8_t { constant, multiple, half_of_digits, moderate };
    Kind kind = Kind::multiple;
    double constant = 0;
    int bits = 0;
    const char* words = "";
};
constexpr std::array<Rounding, 7> kPositions = {{
    {Rounding::Kind::multiple, 0, 0, "whole numbers"},
    {Rounding::Kind::multiple, 0, 1, "halves"},
    {Rounding::Kind::multiple, 0, 2, "quarters"},
    {Rounding::Kind::multiple, 0, 4, "sixteenths"},
    {Rounding::Kind::multiple, 0, 8, "parts of 256"},
    {Rounding::Kind::half_of_digits, 0, 0, "half the digits"},
    {Rounding::Kind::moderate, 0, 0, "moderate numbers"},
}};
constexpr Rounding kZero = {Rounding::Kind::constant, 0, 0, "0"};
constexpr Rounding kHalf = {Rounding::Kind::constant, 0.5, 0, "1/2"};
constexpr Rounding kOne = {Rounding::Kind::constant, 1, 0, "1"};

// The same, with constants that are plainer than any other number where it stands.
std::vector<Rounding> roundings_with(std::initializer_list<Rounding> constants) {
    std::vector<Rounding> out = constants;
    out.insert(out.end(), kPositions.begin(), kPositions.end());
    return out;
}
std::vector<Rounding> roundings_of_component(size_t component) {
    return component < 2    ? roundings_with({})
           : component == 2 ? roundings_with({kHalf})
                            : roundings_with({kOne});
}

double with_half_of_digits(double value) {
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);
    const auto mantissa = static_cast<uint64_t>(std::ldexp(std::fabs(fraction), 53));
    const int bits = mantissa == 0 ? 0 : 53 - std::countr_zero(mantissa);
    const int kept = std::max(bits / 2, 1);
    return std::ldexp(std::nearbyint(std::ldexp(fraction, kept)), exponent - kept);
}

// Numbers from 2^-6 to 2^6 are moderate.
double moderate(double value) {
    constexpr int kModerate = 6;
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);
    return std::abs(exponent) <= kModerate ? value : std::ldexp(fraction, exponent / 2);
}

double rounded(double value, const Rounding& rounding) {
    switch (rounding.kind) {
        case Rounding::Kind::constant:
            return rounding.constant;
        case Rounding::Kind::half_of_digits:
            return with_half_of_digits(value);
        case Rounding::Kind::moderate:
            return moderate(value);
        case Rounding::Kind::multiple:
            break;
    }
    return std::ldexp(std::nearbyint(std::ldexp(value, rounding.bits)), -rounding.bits);
}

bool is_not_finite(const Document& value) {
    constexpr std::array<std::string_view, 4> kWords = {"nan", "-nan", "inf", "-inf"};
    return (value.is(Kind::floating) && !std::isfinite(value.floating)) ||
           (value.is(Kind::string) && (std::ranges::find(kWords, value.string) != kWords.end() ||
                                       value.string.starts_with("bits(")));
}

// The simpler value, or nothing if it would cost as much. What is not finite becomes a constant or
// 0.
std::optional<Document> simpler_number(const Document& value, const Rounding& rounding) {
    const std::optional<double> given = value_of(value);
    if (!given && !is_not_finite(value)) {
        return std::nullopt;
    }
    const double near = rounded(given.value_or(0), rounding) + 0.0;  // -0 becomes 0
    Document out = number(near);
    return cost_of(out) < cost_of(value) ? std::optional(std::move(out)) : std::nullopt;
}

// Rounds every number below a value; false if none changed.
bool round_all(Document& value, const Rounding& rounding) {
    bool is_changed = false;
    for (Document& element : value.array) {
        is_changed = round_all(element, rounding) || is_changed;
    }
    if (std::optional<Document> simple = simpler_number(value, rounding)) {
        value = std::move(*simple);
        return true;
    }
    return is_changed;
}

void add_rounding(const std::vector<Path>& places, const Rounding& rounding, Step step,
                  std::vector<Step>& steps) {
    step.need.clear();
    step.apply = [places, rounding](Document& d) {
        bool is_changed = false;
        for (const Path& place : places) {
            Document* value = at(d, place);
            is_changed = (value != nullptr && round_all(*value, rounding)) || is_changed;
        }
        return is_changed;
    };
    steps.push_back(std::move(step));
}

// All roundings of what stands at a path as a whole.
void add_roundings(const Document& document, const Path& path, std::span<const Rounding> roundings,
                   std::vector<Step>& steps) {
    for (const Rounding& rounding : roundings) {
        Step step;
        name_at(document, path, fmt::format("{{}}with {}", rounding.words), step);
        add_rounding({path}, rounding, std::move(step), steps);
    }
}

// Each number below a path by itself: its roundings that differ from the plainer ones before.
void add_each(const Document& document, const Document& value, const Path& path,
              std::span<const Rounding> roundings, std::vector<Step>& steps) {
    for (size_t k = 0; k < value.array.size(); ++k) {
        add_each(document, value.array[k], path + k, roundings, steps);
    }
    if (!value.array.empty()) {
        return;
    }
    std::vector<Document> seen;
    for (const Rounding& rounding : roundings) {
        const std::optional<Document> simple = simpler_number(value, rounding);
        if (!simple || std::ranges::any_of(
                           seen, [&](const Document& other) { return is_same(other, *simple); })) {
            continue;
        }
        seen.push_back(*simple);
        Step step;
        name_at(document, path, fmt::format("with {{}}as {}", value_of(*simple).value_or(0)), step);
        add_rounding({path}, rounding, std::move(step), steps);
    }
}

// Components 0 and 1 of all vertices of a draw.
std::vector<Path> places_of(const Document& draw, size_t number, size_t component) {
    std::vector<Path> places;
    if (const Document* vertices = draw.find("vertices")) {
        for (size_t v = 0; v < vertices->array.size(); ++v) {
            if (component < vertices->array[v].array.size()) {
                places.push_back(Path() + "draw" + number + "vertices" + v + component);
            }
        }
    }
    return places;
}

void append(std::vector<Path>& to, const std::vector<Path>& more) {
    to.insert(to.end(), more.begin(), more.end());
}

// All numbers elsewhere: arrays as a whole first, then each number.
void add_values(const Document& document, const Document& value, const Path& path,
                std::vector<Step>& steps) {
    const std::vector<Rounding> roundings = roundings_with({kZero, kOne});
    for (const cases::TomlEntry& entry : value.table) {
        constexpr std::array<std::string_view, 9> kOthers = {
            "format", "vertices", "indices", "size",          "samples",
            "layers", "rules",    "matrix",  "viewport_index"};
        if (std::ranges::find(kOthers, entry.key) != kOthers.end()) {
            continue;
        }
        const Path inner = path + entry.key;
        const bool is_tables = !entry.value.array.empty() && entry.value.array[0].is(Kind::table);
        if (entry.value.is(Kind::table)) {
            add_values(document, entry.value, inner, steps);
        } else if (is_tables) {
            for (size_t k = 0; k < entry.value.array.size(); ++k) {
                add_values(document, entry.value.array[k], inner + k, steps);
            }
        } else {
            if (!entry.value.array.empty()) {
                add_roundings(document, inner, roundings, steps);
            }
            add_each(document, entry.value, inner, roundings, steps);
        }
    }
}

}  // namespace

// Places of vertices: of all draws, each draw, each vertex, each number.
void add_position_steps(const Document& document, std::vector<Step>& steps) {
    const size_t draws = draw_count(document);
    std::vector<std::vector<Path>> of_draws(draws);
    std::vector<Path> all;
    for (size_t d = 0; d < draws; ++d) {
        for (const size_t component : {0U, 1U}) {
            append(of_draws[d], places_of(document.find("draw")->array[d], d, component));
        }
        append(all, of_draws[d]);
    }
    for (const Rounding& rounding : kPositions) {
        Step step;
        step.words = fmt::format("with positions of {}", rounding.words);
        add_rounding(all, rounding, std::move(step), steps);
    }
    for (size_t d = 0; d < draws; ++d) {
        const Document& draw = document.find("draw")->array[d];
        for (const Rounding& rounding : kPositions) {
            Step step;
            name_in_draw(document, d, fmt::format("with positions of {}", rounding.words), step);
            add_rounding(of_draws[d], rounding, std::move(step), steps);
        }
        for (const size_t component : {3U, 2U}) {
            for (const Rounding& rounding : roundings_of_component(component)) {
                Step step;
                name_in_draw(
                    document, d,
                    fmt::format("with {} of {}", component == 2 ? "z" : "w", rounding.words), step);
                add_rounding(places_of(draw, d, component), rounding, std::move(step), steps);
            }
        }
        const Document* vertices = draw.find("vertices");
        for (size_t v = 0; vertices != nullptr && v < vertices->array.size(); ++v) {
            const Path path = Path() + "draw" + d + "vertices" + v;
            const Document& vertex = vertices->array[v];
            for (size_t k = 0; k < std::min<size_t>(vertex.array.size(), 4); ++k) {
                const std::vector<Rounding> roundings = roundings_of_component(k);
                add_each(document, vertex.array[k], path + k, roundings, steps);
            }
        }
    }
}

void add_value_steps(const Document& document, std::vector<Step>& steps) {
    add_values(document, document, {}, steps);
}

}  // namespace fuzz
