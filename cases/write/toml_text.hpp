// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Values and tables as a case file writes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

// The keys of one table in the order of their adding.
class TableText {
  public:
    void add(std::string_view key, std::string value) { keys_.emplace_back(key, std::move(value)); }
    // The same for true and false, if the value is not the default.
    void add_flag(std::string_view key, bool value, bool otherwise);
    bool is_empty() const { return keys_.empty(); }
    // "key = value" a line, the signs aligned.
    std::string lines() const;
    // "{ key = value, key = value }".
    std::string in_line() const;

  private:
    std::vector<std::pair<std::string, std::string>> keys_;
};

}  // namespace cases
