// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The keys of a case file, one row each. Loader and writers read and write by a row whatever is a
// word, true or false, or a number; the order of keys, the changes, neighbours and causes of a
// hunt, the schema of the export and the tables of docs/cases.md come from the rows, too.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

namespace cases {

using Words = std::span<const std::string_view>;

enum class KeyKind : uint8_t {
    word,    // one of Key::words, in the order of the member's enumeration (or of false and true)
    flag,    // true or false
    whole,   // an integer of least..most
    bits,    // an integer of least..most, in hexadecimal digits
    number,  // rounded to the nearest binary32
    share,   // a number of 0..1
    table,   // a table with keys of its own
    other,   // a value that code of its own reads and writes
};

struct KeyTable;

struct Key {
    // Facts about a key that a row sets by a call.
    enum Mark : uint8_t {
        kPipeline = 1,  // another value costs a driver a pipeline or an attachment
        kShape = 2,     // tells triangles: text for people has it behind the state
        kSilent = 4,    // says nothing of a cause: every case has it, or it draws nothing
        kAnyWord = 8,   // a cause that needs the key is mostly met with other words, too
    };

    std::string_view name;
    KeyKind kind = KeyKind::other;
    uint8_t marks = 0;
    Words words = {};                      // all that are valid, or some to try
    std::span<const double> numbers = {};  // some to try
    int64_t least = 0, most = 0;
    const KeyTable* keys = nullptr;  // of its table, or of each table of its array
    std::string_view field = {};     // of the structure in cases/model
    std::string_view absent = {};    // the value of a missing key, as docs/cases.md tells it
    // How to say that it has another word, which stands for "{}". Empty: other words are not tried.
    std::string_view neighbour = {};
    std::string_view called = {};  // in an error
    std::string_view advice = {};  // the end of the error of a share outside 0..1

    constexpr bool has(Mark mark) const { return (marks & mark) != 0; }
    // Whether a row is all that reading and writing it takes.
    constexpr bool is_simple() const { return kind < KeyKind::table; }
    constexpr bool has_values() const {
        return kind == KeyKind::flag || !words.empty() || !numbers.empty();
    }

    // --- calls that rows are written with ---
    constexpr Key as(std::string_view of_model) const { return with(&Key::field, of_model); }
    constexpr Key plain(std::string_view value) const { return with(&Key::absent, value); }
    constexpr Key near(std::string_view phrase) const { return with(&Key::neighbour, phrase); }
    constexpr Key names(std::string_view what) const { return with(&Key::called, what); }
    constexpr Key advises(std::string_view what) const { return with(&Key::advice, what); }
    constexpr Key tries(Words some) const { return with(&Key::words, some); }
    constexpr Key tries(std::span<const double> some) const { return with(&Key::numbers, some); }
    constexpr Key marked(Mark mark) const {
        return with(&Key::marks, static_cast<uint8_t>(marks | mark));
    }
    constexpr Key pipeline() const { return marked(kPipeline); }
    constexpr Key shape() const { return marked(kShape); }
    constexpr Key silent() const { return marked(kSilent); }
    constexpr Key any_word() const { return marked(kAnyWord); }

  private:
    template <class T>
    constexpr Key with(T Key::*member, T value) const {
        Key key = *this;
        key.*member = value;
        return key;
    }
};

// The keys of one kind of table, in the order in which files have them.
struct KeyTable {
    std::string_view name;  // in errors
    std::span<const Key> keys;

    // The row of a key, or nullptr.
    const Key* find(std::string_view key) const;
    // The row of a member of the structure that the table fills, or nullptr.
    const Key* find_field(std::string_view field) const;
};

extern const KeyTable kFileKeys, kTargetKeys, kTargetColorKeys, kDrawKeys, kClearKeys,
    kViewportKeys, kDepthKeys, kBiasKeys, kStencilKeys, kStencilFaceKeys, kFragDepthKeys,
    kColorKeys, kBlendKeys, kBlendAlphaKeys, kAttributeKeys, kDistanceKeys, kBlitKeys, kExpectKeys,
    kRelationKeys, kOpenRangeKeys;

// Members that a row alone can read and write: enumerations, numbers, true or false.
template <class T>
inline constexpr bool is_simple_member = std::is_enum_v<T> || std::is_arithmetic_v<T>;
template <class T>
inline constexpr bool is_simple_member<std::optional<T>> = is_simple_member<T>;

// The row of a key in a table, and the keys that the key's own table has; nullptr if there are
// none, or `table` is nullptr.
const Key* find_key(const KeyTable* table, std::string_view key);
const KeyTable* keys_in(const KeyTable* table, std::string_view key);

}  // namespace cases
