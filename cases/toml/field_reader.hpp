// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Typed access to the tables of a case file: numbers through expressions and matrix keys, words of
// a fixed list, unknown keys with the nearest valid name. Mistakes are collected; a value that
// could not be read is nothing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "cases/base/fields.hpp"
#include "cases/key/key.hpp"
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
    // A number of 0..1; the key's advice ends the sentence about any other.
    std::optional<float> share(const TomlValue& value, const Key& key);
    // An integer in [low, high].
    std::optional<int64_t> integer(const TomlValue& value, const std::string& what, int64_t low,
                                   int64_t high);
    std::optional<bool> boolean(const TomlValue& value, const std::string& what);
    std::optional<std::string> text(const TomlValue& value, const std::string& what);
    // The index of a word in a list; a matrix key may stand for it.
    std::optional<size_t> word(const TomlValue& value, const std::string& what, Words words);
    // Reads a key as its row has it, if the table has the key. A mistake leaves the member as it
    // is, and the result is false. `most` is for a range that ends early.
    template <class T>
    bool read(const TomlValue& table, const Key& key, T& member,
              std::optional<int64_t> most = std::nullopt) {
        using Plain = typename Unwrapped<T>::type;
        const TomlValue* value = table.find(key.name);
        if (value == nullptr) {
            return true;
        }
        const std::string what(key.called.empty() ? key.name : key.called);
        const auto take = [&](const auto& given) {
            if (given) {
                member = static_cast<Plain>(*given);
            }
            return given.has_value();
        };
        if constexpr (std::is_floating_point_v<Plain>) {
            return take(key.kind == KeyKind::share ? share(*value, key) : binary32(*value, what));
        } else if (key.kind == KeyKind::word) {
            return take(word(*value, what, key.words));
        } else if (key.kind == KeyKind::flag) {
            return take(boolean(*value, what));
        } else {
            return take(integer(*value, what, key.least, most.value_or(key.most)));
        }
    }
    template <class T>
    bool read(const TomlValue& table, const KeyTable& keys, std::string_view name, T& member,
              std::optional<int64_t> most = std::nullopt) {
        const Key* key = keys.find(name);
        return key == nullptr || read(table, *key, member, most);
    }
    // Reads all words, flags and numbers that the structure has members for, and those of
    // structures in it that are no table of their own.
    template <class T>
    void read_all(const TomlValue& table, const KeyTable& keys, T& out) {
        T::fields(
            [&](const Field& field, auto& member) {
                using Member = std::remove_cvref_t<decltype(member)>;
                const Key* key = keys.find_field(field.name);
                if constexpr (HasFields<Member>) {
                    if (key == nullptr) {
                        read_all(table, keys, member);
                    }
                } else if constexpr (is_simple_member<Member>) {
                    if (key != nullptr && key->is_simple()) {
                        read(table, *key, member);
                    }
                }
            },
            out);
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
    // An array of two numbers of 0..1; `each` names one in errors.
    std::optional<std::array<float, 2>> depths(const TomlValue& value, const std::string& what,
                                               const char* each);
    // Rounded to the nearest binary32; too large ones are an error.
    std::optional<float> binary32(const TomlValue& value, const std::string& what);
    std::optional<float> binary32(const Number& n, const SourceLocation& where,
                                  const std::string& what);

    // True if value is a table; complains otherwise.
    bool table(const TomlValue& value, const std::string& what);
    bool array(const TomlValue& value, const std::string& what);
    // Complains about every key of the table that is not in the list. `what` is the table in
    // errors, if not by its name.
    void known_keys(const TomlValue& table, const std::string& what, Words keys);
    void known_keys(const TomlValue& table, const KeyTable& keys, const std::string& what = {});

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
std::string alternatives(Words words);

}  // namespace cases
