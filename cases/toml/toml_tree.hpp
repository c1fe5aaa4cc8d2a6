// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Making a TOML document: its values, and the entries of its tables.
#pragma once

#include <string_view>
#include <vector>

#include "cases/toml/toml_reader.hpp"

namespace cases::tree {

// An integer if the number is whole, below 2^53 in magnitude and not -0; a float otherwise. A NaN
// with a sign is the word "-nan": TOML's floats lose it.
TomlValue number(double value);
TomlValue text(std::string_view value);
TomlValue boolean(bool value);
TomlValue list(std::vector<TomlValue> elements);
TomlValue numbers(const std::vector<double>& values);
inline TomlValue table() {
    return {};
}

// The entry of that key, or nullptr; of a value that is no table, too.
TomlValue* find(TomlValue& table, std::string_view key);
// Replaces the entry of that key where it stands, or adds one at the end.
TomlValue& set(TomlValue& table, std::string_view key, TomlValue value);

}  // namespace cases::tree
