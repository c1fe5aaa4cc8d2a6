// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A TOML document as a plain tree in file order. The parser (toml++) is seen by toml_reader.cpp
// only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cases/base/error.hpp"

namespace cases {

struct TomlEntry;

// One value. Which members mean something follows from `kind`.
struct TomlValue {
    enum class Kind : uint8_t { boolean, integer, floating, string, array, table, date_time };

    Kind kind = Kind::table;
    bool boolean = false;
    int64_t integer = 0;
    double floating = 0;  // finite, or infinite or NaN if the file says so
    std::string string;
    std::vector<TomlValue> array;
    std::vector<TomlEntry> table;  // in the order of the file
    SourceLocation where;

    bool is(Kind k) const { return kind == k; }
    // The entry of that key, or nullptr.
    const TomlValue* find(std::string_view key) const;
};

struct TomlEntry {
    std::string key;
    SourceLocation where;  // of the key
    TomlValue value;
};

// Names the kind of a value: "a string", "an array", ...
std::string describe(const TomlValue& value);

inline constexpr size_t kMaxFileSize = size_t{4} << 20U;  // bytes

// Parses a document; locations name `file_name`. Errors: not TOML, not UTF-8, too large, nested too
// deeply.
Expected<TomlValue> read_toml(std::string_view text, const std::string& file_name);

}  // namespace cases
