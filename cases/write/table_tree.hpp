// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers and tables as a case file has them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <type_traits>

#include "cases/base/fields.hpp"
#include "cases/base/float_bits.hpp"
#include "cases/key/key.hpp"
#include "cases/toml/toml_tree.hpp"

namespace cases {

// How a key reads a number: it must be a binary32, or it is rounded to the nearest.
enum class Reading : uint8_t { exact, nearest };
// The shortest value that is read as these bits; a text if it is no TOML number. NaNs but the quiet
// ones without a payload are written as their bits.
TomlValue number_value(float value, Reading reading);

TomlValue whole_numbers(std::initializer_list<int64_t> values);

// Some keys of one table, in the order of its rows: what a seed makes of a case hangs on it.
class TableTree {
  public:
    explicit TableTree(const KeyTable& keys) : keys_(keys) {}
    // Replaces the value that the key had. A key that no file has is left out.
    void add(std::string_view key, TomlValue value);
    void add(std::string_view key, const TableTree& table) { add(key, table.value()); }
    // Each word, flag and number of a structure that is not as usual, and those of structures in it
    // that are no table of their own.
    template <class T>
    void add_all(const T& value, const T& usual = {}) {
        T::fields(
            [&](const Field& field, const auto& member, const auto& plain) {
                using Member = std::remove_cvref_t<decltype(member)>;
                const Key* key = keys_.find_field(field.name);
                if constexpr (HasFields<Member>) {
                    if (key == nullptr) {
                        add_all(member, plain);
                    }
                } else if constexpr (is_simple_member<Member>) {
                    if (key != nullptr && key->is_simple()) {
                        add_simple(*key, member, plain);
                    }
                }
            },
            value, usual);
    }
    bool is_empty() const { return value_.table.empty(); }
    const TomlValue& value() const { return value_; }

  private:
    template <class T>
    void add_simple(const Key& key, const T& value, const T& usual) {
        if constexpr (is_optional<T>) {
            if (value) {
                add(key.name, value_of(key, *value));
            }
        } else if (!is_same(value, usual)) {
            add(key.name, value_of(key, value));
        }
    }
    template <class T>
    static bool is_same(const T& a, const T& b) {
        if constexpr (std::is_same_v<T, float>) {
            return same_bits(a, b);
        } else {
            return a == b;
        }
    }
    template <class T>
    static TomlValue value_of(const Key& key, const T& value) {
        if constexpr (std::is_same_v<T, float>) {
            return number_value(value, Reading::nearest);
        } else {
            return key.kind == KeyKind::word   ? tree::text(key.words[static_cast<size_t>(value)])
                   : key.kind == KeyKind::flag ? tree::boolean(value != T{})
                                               : tree::number(static_cast<double>(value));
        }
    }

    const KeyTable& keys_;
    TomlValue value_;
};

}  // namespace cases
