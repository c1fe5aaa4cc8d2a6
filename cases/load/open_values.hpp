// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the table [fuzz] of a case file leaves open: names that stand in its expressions, each with
// several values. `edgecase fuzz FILE` takes others for each case; every other command takes the
// nominal ones.
#pragma once

#include <gmpxx.h>

#include <cstdint>
#include <string>
#include <vector>

#include "cases/base/error.hpp"
#include "cases/load/matrix.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

inline constexpr uint64_t kMostOpenValues = uint64_t{1} << 32;  // of a name

// One name, with the values of a list or those of a range in steps.
struct OpenName {
    std::string key;
    SourceLocation where;
    std::vector<TomlValue> list;  // empty: a range
    mpq_class from, step;         // of a range
    uint64_t count = 0;           // at least 2
    uint64_t nominal = 0;         // the number of the value that other commands take

    // The value of that number as [matrix] would have it: a number, a word or an expression.
    TomlValue value(uint64_t number) const;
};

// Checks names (those of `matrix` are taken), values, and ranges: numbers, the smaller one first, a
// whole number of steps. `table` may be missing: nothing is open then.
ExpectedAll<std::vector<OpenName>> read_open(const TomlValue* table, const Matrix& matrix);

}  // namespace cases
