// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Values and tables as a case file writes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "cases/base/fields.hpp"
#include "cases/key/key.hpp"

namespace cases {

// A TOML string on one line.
std::string string_toml(std::string_view text);

// How a key reads a number: it must be a binary32, or it is rounded to the nearest.
enum class Reading : uint8_t { exact, nearest };
// The shortest text that is read as these bits; in quotes if it is no TOML number. NaNs but the
// quiet ones without a payload are written as their bits.
std::string number_toml(float value, Reading reading);

// "[a, b]", or what else stands between the items.
std::string list_toml(const std::vector<std::string>& items, std::string_view separator = ", ");

// An array as the value of a key: on one line if that is short, otherwise on lines of their own
// with as many items as fit, and items of a group (0: none) never divided.
std::string array_toml(const std::vector<std::string>& items, size_t group);

// A bit mask; hexadecimal digits show the bits of a large one.
std::string mask_toml(uint32_t mask);

// Some keys of one table, written in the order of its rows.
class TableText {
  public:
    explicit TableText(const KeyTable& keys) : keys_(keys) {}
    // Replaces the value that the key had.
    void add(std::string_view key, std::string value);
    void add(std::string_view key, const TableText& table) { add(key, table.in_line()); }
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
    bool is_empty() const { return lines_.empty(); }
    // "key = value" a line, the signs aligned.
    std::string lines() const;
    // "{ key = value, key = value }".
    std::string in_line() const;

  private:
    template <class T>
    void add_simple(const Key& key, const T& value, const T& usual) {
        if constexpr (is_optional<T>) {
            if (value) {
                add(key.name, text_of(key, *value));
            }
        } else if (text_of(key, value) != text_of(key, usual)) {
            add(key.name, text_of(key, value));
        }
    }
    template <class T>
    static std::string text_of(const Key& key, const T& value) {
        if constexpr (std::is_same_v<T, float>) {
            return number_toml(value, Reading::nearest);
        } else {
            return key.kind == KeyKind::word   ? string_toml(key.words[static_cast<size_t>(value)])
                   : key.kind == KeyKind::flag ? std::string(value != T{} ? "true" : "false")
                   : key.kind == KeyKind::bits ? mask_toml(static_cast<uint32_t>(value))
                                               : std::to_string(static_cast<int64_t>(value));
        }
    }

    const KeyTable& keys_;
    std::vector<std::pair<const Key*, std::string>> lines_;  // in the order of the rows
};

}  // namespace cases
