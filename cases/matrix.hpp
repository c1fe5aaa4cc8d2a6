// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cases/error.hpp"
#include "cases/toml_reader.hpp"

namespace cases {

inline constexpr size_t kMaxLeaves = 4096;  // a file

// The table [matrix]: keys in the order of the file, each with its values.
struct Matrix {
    struct Axis {
        std::string key;
        SourceLocation where;
        std::vector<const TomlValue*> values;
        std::vector<std::string> texts;  // of the values, as ids show them
    };
    std::vector<Axis> axes;

    // The number of combinations; 1 without axes.
    size_t size() const;
    // Which value of each axis the leaf takes; the first key is the slowest.
    std::vector<size_t> choice(size_t leaf) const;
    // "key=value,..."; empty without axes.
    std::string text(size_t leaf) const;
};

// Checks keys (letters, digits, _) and values (numbers, true, false or strings without blanks,
// commas, ':' and '='), duplicates and the number of combinations. The result points into `table`.
ExpectedAll<Matrix> read_matrix(const TomlValue* table);

}  // namespace cases
