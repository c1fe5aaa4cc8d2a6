// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Typed access to the tables of a case file: numbers through expressions and matrix keys, words of
// a fixed list, unknown keys with the nearest valid name. Mistakes are collected; a value that
// could not be read is nothing.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cases/model/words.hpp"
#include "cases/toml/binary32.hpp"
#include "cases/toml/expression.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

// One combination of matrix values, and the mistakes found while it is read.
class LeafContext {
  public:
    using Parameter = std::pair<std::string, const TomlValue*>;

    explicit LeafContext(std::vector<Parameter> parameters);

    const std::vector<Parameter>& parameters() const { return parameters_; }
    // The value of a matrix key (and marks it as used), or nullptr.
    const TomlValue* parameter(std::string_view key);
    const std::set<std::string>& used() const { return used_; }

    // The matrix keys that stand for numbers, with further names put before them.
    Names names(const std::vector<std::pair<std::string, Number>>& more = {});

    void error(const SourceLocation& where, std::string message);
    const Errors& errors() const { return errors_; }

    // --- values; `what` names them in errors ("size", "a coordinate") ---
    std::optional<Number> number(const TomlValue& value, const std::string& what);
    std::optional<Number> number(const TomlValue& value, const std::string& what,
                                 const Names& names);
    // Reads numbers and what no rational is: nan, inf (as words or TOML floats), "bits(0x...)".
    std::optional<Number> any_binary32(const TomlValue& value, const std::string& what);
    // An integer in [low, high].
    std::optional<int64_t> integer(const TomlValue& value, const std::string& what, int64_t low,
                                   int64_t high);
    std::optional<bool> boolean(const TomlValue& value, const std::string& what);
    std::optional<std::string> text(const TomlValue& value, const std::string& what);
    // The index of a word in a list; a matrix key may stand for it.
    std::optional<size_t> word(const TomlValue& value, const std::string& what,
                               std::span<const std::string_view> words);
    // The value whose word (words.hpp) this is.
    template <class Enum>
    std::optional<Enum> enumerator(const TomlValue& value, const std::string& what) {
        const std::optional<size_t> index = word(value, what, kWords<Enum>);
        return index ? std::optional(static_cast<Enum>(*index)) : std::nullopt;
    }
    // An array of numbers, exactly `count` of them.
    std::optional<std::vector<Number>> numbers(const TomlValue& value, const std::string& what,
                                               size_t count);
    // Rounded to the nearest binary32; too large ones are an error.
    std::optional<float> binary32(const TomlValue& value, const std::string& what);
    std::optional<float> binary32(const Number& n, const SourceLocation& where,
                                  const std::string& what);

    // True if value is a table; complains otherwise.
    bool table(const TomlValue& value, const std::string& what);
    bool array(const TomlValue& value, const std::string& what);
    // Complains about every key of the table that is not in the list.
    void known_keys(const TomlValue& table, const std::string& what,
                    std::initializer_list<std::string_view> keys);

  private:
    std::vector<Parameter> parameters_;
    std::set<std::string> used_;
    Errors errors_;
};

// Lists words as "a, b or c", each in quotes.
std::string alternatives(std::span<const std::string_view> words);

}  // namespace cases
