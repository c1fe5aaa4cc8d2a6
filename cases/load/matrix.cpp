// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "cases/load/covering.hpp"
#include "cases/select/selector.hpp"
#include "cases/toml/field_reader.hpp"

namespace cases {

namespace {

using Kind = TomlValue::Kind;

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// What may stand in an id: no separators of ids, file names' odd characters or selectors' signs.
bool is_plain(const std::string& word) {
    return !word.empty() && std::ranges::all_of(word, [](char c) {
        return is_letter(c) || is_digit(c) ||
               std::string_view("+-./^()").find(c) != std::string_view::npos;
    });
}

// `leaves = "pairs"`.
Expected<std::vector<size_t>> pairs_of(const TomlValue& key, const Matrix& matrix) {
    std::vector<size_t> sizes;
    for (const Matrix::Axis& axis : matrix.axes) {
        sizes.push_back(axis.values.size());
    }
    const auto several = std::ranges::count_if(sizes, [](size_t size) { return size > 1; });
    if (several < 3) {
        return tl::unexpected(Error{
            key.where,
            fmt::format("leaves = \"pairs\" leaves out combinations of three matrix keys or more "
                        "with several values each, and the matrix has {}; write \"all\"",
                        several)});
    }
    return cover_pairs(sizes);
}

// `leaves = ["key=value,...", ...]`: each a combination, none twice, not all, no value unused.
ExpectedAll<std::vector<size_t>> named_leaves(const TomlValue& key, const Matrix& matrix) {
    std::vector<std::string> texts;
    for (size_t combination = 0; combination < matrix.size(); ++combination) {
        texts.push_back(matrix.text(combination));
    }
    LeafContext context({});
    std::vector<size_t> chosen;
    std::set<std::pair<size_t, size_t>> values;  // axis and value
    for (const TomlValue& element : key.array) {
        const std::optional<std::string> name = context.text(element, "a leaf");
        if (!name) {
            continue;
        }
        const auto found = std::ranges::find(texts, *name);
        if (found == texts.end()) {
            context.error(element.where, no_leaf(*name, texts, "\"" + texts.front() + "\""));
            continue;
        }
        chosen.push_back(static_cast<size_t>(found - texts.begin()));
        if (std::ranges::count(chosen, chosen.back()) > 1) {
            context.error(element.where, fmt::format("the leaf \"{}\" stands twice", *name));
        }
        const std::vector<size_t> choice = matrix.choice(chosen.back());
        for (size_t i = 0; i < choice.size(); ++i) {
            values.insert({i, choice[i]});
        }
    }
    if (key.array.empty()) {
        context.error(key.where, "leaves is empty; name some combinations of [matrix]");
    }
    if (chosen.size() == matrix.size()) {
        context.error(key.where, "leaves names every combination of [matrix]; leave it out");
    }
    const size_t looked_at = context.errors().empty() ? matrix.axes.size() : 0;
    for (size_t i = 0; i < looked_at; ++i) {
        const Matrix::Axis& axis = matrix.axes[i];
        for (size_t v = 0; v < axis.values.size(); ++v) {
            if (values.count({i, v}) == 0) {
                context.error(axis.values[v]->where,
                              fmt::format("leaves names no combination with the value {} of the "
                                          "matrix key {}; name one or leave the value out",
                                          axis.texts[v], axis.key));
            }
        }
    }
    if (!context.errors().empty()) {
        return tl::unexpected(context.errors());
    }
    std::ranges::sort(chosen);
    return chosen;
}

// The combinations that `key` asks for: all without it.
ExpectedAll<std::vector<size_t>> read_leaves(const TomlValue* key, const Matrix& matrix) {
    std::vector<size_t> all(matrix.size());
    std::iota(all.begin(), all.end(), size_t{0});
    if (key == nullptr) {
        return all;
    }
    const auto error = [&](std::string message) {
        return tl::unexpected(Errors{{key->where, std::move(message)}});
    };
    const bool is_pairs = key->is(Kind::string) && key->string == "pairs";
    const bool is_all = key->is(Kind::string) && key->string == "all";
    if (!is_pairs && !is_all && !key->is(Kind::array)) {
        return error(fmt::format(
            "leaves is {}; write \"all\", \"pairs\" or an array of combinations", describe(*key)));
    }
    if (matrix.axes.empty()) {
        return error(
            "leaves says which combinations of [matrix] are cases, but there is no "
            "[matrix]; leave it out");
    }
    if (key->is(Kind::array)) {
        return named_leaves(*key, matrix);
    }
    if (is_all) {
        return all;
    }
    Expected<std::vector<size_t>> pairs = pairs_of(*key, matrix);
    if (!pairs) {
        return tl::unexpected(Errors{pairs.error()});
    }
    return *pairs;
}

}  // namespace

bool is_name(const std::string& key) {
    return !key.empty() && is_letter(key[0]) &&
           std::ranges::all_of(key, [](char c) { return is_letter(c) || is_digit(c); });
}

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

std::string no_leaf(const std::string& name, const std::vector<std::string>& leaves,
                    const std::string& example) {
    const std::string nearest = nearest_name(name, leaves);
    return fmt::format(
        "the matrix has no leaf \"{}\"; {}", name,
        nearest.empty() ? "write " + example : fmt::format("did you mean \"{}\"?", nearest));
}

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
        ExpectedAll<std::vector<size_t>> chosen = read_leaves(leaves, matrix);
        if (!chosen) {
            return tl::unexpected(chosen.error());
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
            if (std::ranges::find(axis.texts, *text) != axis.texts.end()) {
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
