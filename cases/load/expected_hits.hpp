// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// [expect] of a case file: the hits of each pixel, as a picture of characters.
#pragma once

#include <string>

#include "cases/load/matrix.hpp"
#include "cases/model/case.hpp"
#include "cases/toml/field_reader.hpp"
#include "cases/toml/toml_reader.hpp"

namespace cases {

// Reads the expectation of one leaf, if the file has one for it. Mistakes go to the context.
void read_expectation(LeafContext& context, const TomlValue& root, const std::string& leaf,
                      Case& c);

// In a file with a matrix every key of [expect] names a leaf, not a combination that is left out.
void check_expectation_keys(const TomlValue& root, const Matrix& matrix, Errors& errors);

}  // namespace cases
