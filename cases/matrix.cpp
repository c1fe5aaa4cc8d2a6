// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "cases/covering.hpp"
#include "cases/field_reader.hpp"

namespace cases {

namespace {

using Kind = TomlValue::Kind;

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_name(const std::string& key) {
    return !key.empty() && is_letter(key[0]) &&
           std::all_of(key.begin(), key.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

// What may stand in an id: no separators of ids, file names' odd characters or selectors' signs.
bool is_plain(const std::string& word) {
    return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
        return is_letter(c) || is_digit(c) ||
               std::string_view("+-./^()").find(c) != std::string_view::npos;
    });
}

// The value as ids show it, or what is wrong with it.
tl::expected<std::string, std::string> value_text(const TomlValue& value) {
    switch (value.kind) {
        case Kind::boolean:
            return std::string(value.boolean ? "true" : "false");
        case Kind::integer:
            return std::to_string(value.integer);
        case Kind::floating:
            if (std::isfinite(value.floating)) {
                return fmt::format("{}", value.floating);
            }
            return tl::unexpected(std::string("is not a finite number"));
        case Kind::string:
            if (is_plain(value.string)) {
                return value.string;
            }
            return tl::unexpected(
                std::string("has characters that an id cannot have; write letters, digits and "
                            "+-./^()"));
        default:
            return tl::unexpected("is " + describe(value) + "; write a number or a string");
    }
}

// The combinations that `key` asks for: all without it.
Expected<std::vector<size_t>> read_leaves(const TomlValue* key, const Matrix& matrix) {
    std::vector<size_t> all(matrix.size());
    std::iota(all.begin(), all.end(), size_t{0});
    if (key == nullptr) {
        return all;
    }
    constexpr std::array<std::string_view, 2> kChoices = {"all", "pairs"};
    LeafContext context({});
    const std::optional<size_t> choice = context.word(*key, "leaves", kChoices);
    if (!choice) {
        return tl::unexpected(context.errors().front());
    }
    if (matrix.axes.empty()) {
        return tl::unexpected(
            Error{key->where,
                  "leaves says which combinations of [matrix] are cases, but there is "
                  "no [matrix]; leave it out"});
    }
    if (kChoices[*choice] == "all") {
        return all;
    }
    std::vector<size_t> sizes;
    for (const Matrix::Axis& axis : matrix.axes) {
        sizes.push_back(axis.values.size());
    }
    const auto several =
        std::count_if(sizes.begin(), sizes.end(), [](size_t size) { return size > 1; });
    if (several < 3) {
        return tl::unexpected(Error{
            key->where,
            fmt::format("leaves = \"pairs\" leaves out combinations of three matrix keys or more "
                        "with several values each, and the matrix has {}; write \"all\"",
                        several)});
    }
    return cover_pairs(sizes);
}

}  // namespace

size_t Matrix::size() const {
    size_t n = 1;
    for (const Axis& axis : axes) {
        n *= axis.values.size();
    }
    return n;
}

std::vector<size_t> Matrix::choice(size_t combination) const {
    std::vector<size_t> result(axes.size());
    for (size_t i = axes.size(); i-- > 0;) {
        result[i] = combination % axes[i].values.size();
        combination /= axes[i].values.size();
    }
    return result;
}

std::string Matrix::text(size_t combination) const {
    const std::vector<size_t> chosen = choice(combination);
    std::string result;
    for (size_t i = 0; i < axes.size(); ++i) {
        result += fmt::format("{}{}={}", i == 0 ? "" : ",", axes[i].key, axes[i].texts[chosen[i]]);
    }
    return result;
}

ExpectedAll<Matrix> read_matrix(const TomlValue* table, const TomlValue* leaves) {
    Matrix matrix;
    Errors errors;
    const auto with_leaves = [&]() -> ExpectedAll<Matrix> {
        Expected<std::vector<size_t>> chosen = read_leaves(leaves, matrix);
        if (!chosen) {
            return tl::unexpected(Errors{chosen.error()});
        }
        matrix.leaves = std::move(*chosen);
        return std::move(matrix);
    };
    if (table == nullptr) {
        return with_leaves();
    }
    if (!table->is(Kind::table) || table->table.empty()) {
        errors.push_back({table->where,
                          "matrix is not a table of arrays; write [matrix] with "
                          "key = [value, ...] or leave it out"});
        return tl::unexpected(errors);
    }
    size_t combinations = 1;
    for (const TomlEntry& entry : table->table) {
        Matrix::Axis axis{entry.key, entry.where, {}, {}};
        if (!is_name(entry.key)) {
            errors.push_back({entry.where, fmt::format("the matrix key \"{}\" is not a name; write "
                                                       "letters, digits and _",
                                                       entry.key)});
            continue;
        }
        if (!entry.value.is(Kind::array) || entry.value.array.empty()) {
            errors.push_back(
                {entry.value.where,
                 fmt::format("the matrix key {} has no array of values; write {} = [value, ...]",
                             entry.key, entry.key)});
            continue;
        }
        for (const TomlValue& value : entry.value.array) {
            const tl::expected<std::string, std::string> text = value_text(value);
            if (!text) {
                errors.push_back({value.where, fmt::format("a value of the matrix key {} {}",
                                                           entry.key, text.error())});
                continue;
            }
            if (std::find(axis.texts.begin(), axis.texts.end(), *text) != axis.texts.end()) {
                errors.push_back(
                    {value.where, fmt::format("the value {} of the matrix key {} stands twice",
                                              *text, entry.key)});
                continue;
            }
            axis.values.push_back(&value);
            axis.texts.push_back(*text);
        }
        combinations *= std::max<size_t>(axis.values.size(), 1);
        if (combinations > kMaxLeaves) {
            errors.push_back(
                {table->where,
                 fmt::format("the matrix has more than {} combinations; split the file",
                             kMaxLeaves)});
            return tl::unexpected(errors);
        }
        matrix.axes.push_back(std::move(axis));
    }
    if (!errors.empty()) {
        return tl::unexpected(errors);
    }
    return with_leaves();
}

}  // namespace cases
