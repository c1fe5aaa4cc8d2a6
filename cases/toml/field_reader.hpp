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
#include <type_traits>
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
    // What the key of a table says, if it is there, read by the member's type: a word of its
    // enumeration, true or false, a binary32. `what` names it in errors, if not the key does. A
    // mistake leaves the member as it is, and the result is false.
    template <class T>
    bool read(const TomlValue& table, const char* key, T& member, const std::string& what = {}) {
        const TomlValue* value = table.find(key);
        if (value != nullptr) {
            using Plain = typename Unwrapped<T>::type;
            const auto read_as = [&](const std::string& name) -> std::optional<Plain> {
                if constexpr (std::is_enum_v<Plain>) {
                    return enumerator<Plain>(*value, name);
                } else if constexpr (std::is_same_v<Plain, bool>) {
                    return boolean(*value, name);
                } else {
                    static_assert(std::is_same_v<Plain, float>);
                    return binary32(*value, name);
                }
            };
            const std::optional<Plain> given = read_as(what.empty() ? key : what);
            if (!given) {
                return false;
            }
            member = *given;
        }
        return true;
    }
    // The same of an integer in [low, high].
    template <class T>
    bool read(const TomlValue& table, const char* key, T& member, int64_t low, int64_t high) {
        if (const TomlValue* value = table.find(key)) {
            const std::optional<int64_t> given = integer(*value, key, low, high);
            if (!given) {
                return false;
            }
            member = static_cast<typename Unwrapped<T>::type>(*given);
        }
        return true;
    }
    // The same of a number in 0..1; `why` is the rest of the sentence for any other.
    template <class T>
    void read_fraction(const TomlValue& table, const char* key, T& member, const char* why) {
        const TomlValue* value = table.find(key);
        const std::optional<Number> given = value != nullptr ? number(*value, key) : std::nullopt;
        if (given && (given->value < 0 || given->value > 1)) {
            error(value->where, std::string(key) + " is outside 0..1" + why);
        } else if (given) {
            member = round_to_binary32(*given).value;
        }
    }
    // True for an array of `count` elements; complains otherwise. `form` is what to write.
    bool array_of(const TomlValue& value, const std::string& what, size_t count, const char* form);
    // The key size of a table, whose name is `name`: two sides from 1 to `largest` of what `owner`
    // is. Nothing after a mistake.
    std::optional<std::array<uint32_t, 2>> read_size(const TomlValue& table, const char* name,
                                                     const std::string& owner, int64_t largest);
    // The text, or that of the matrix key that has this name.
    std::string named_text(const std::string& text);
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
    template <class T>
    struct Unwrapped {
        using type = T;
    };
    template <class T>
    struct Unwrapped<std::optional<T>> {
        using type = T;
    };

    std::vector<Parameter> parameters_;
    std::set<std::string> used_;
    Errors errors_;
};

// Lists words as "a, b or c", each in quotes.
std::string alternatives(std::span<const std::string_view> words);

}  // namespace cases
