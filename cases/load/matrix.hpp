// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cases/base/error.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

inline constexpr size_t kMaxLeaves = 4096;  // a file

// The table [matrix]: keys in the order of the file, each with its values, and which of their
// combinations are leaves.
struct Matrix {
    struct Axis {
        std::string key;
        SourceLocation where;
        std::vector<const TomlValue*> values;
        std::vector<std::string> texts;  // of the values, as ids show them
    };
    std::vector<Axis> axes;
    // Combinations that are leaves of the file, ascending: all, a covering array of strength 2
    // (covering.hpp) or those that the file names. Never empty.
    std::vector<size_t> leaves;

    // The number of combinations, which is 1 without axes.
    size_t size() const;
    // Which value of each axis a combination takes; the first key is the slowest.
    std::vector<size_t> choice(size_t combination) const;
    // The combination as ids show it, "key=value,..."; empty without axes.
    std::string text(size_t combination) const;
};

// Checks keys (letters, digits, _) and values (numbers, true, false or strings without blanks,
// commas, ':' and '='), duplicates and the number of combinations. `leaves` is the key beside
// [matrix] that says which combinations are leaves; either may be missing. The result points into
// `table`.
ExpectedAll<Matrix> read_matrix(const TomlValue* table, const TomlValue* leaves);

// Whether a key of [matrix] or [fuzz] is a name that expressions can use.
bool is_name(const std::string& key);
// A value of such a key as ids show it, or what is wrong with it.
tl::expected<std::string, std::string> value_text(const TomlValue& value);

// What is said of a name that no leaf has.
std::string no_leaf(const std::string& name, const std::vector<std::string>& leaves,
                    const std::string& example);

}  // namespace cases
