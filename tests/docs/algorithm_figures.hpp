// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The figures of docs/algorithms.md: fixed seeds, integers and rationals, so they are the same on
// every machine with IEEE 754 binary32.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace figures {

// What block normalisation to n bits loses, as parts of an attribute's range; over all samples.
struct BlockRow {
    int bits = 0;
    double products = 0, products_bound = 0;  // w and its products
    double terms = 0;                         // and the nine terms, n bits
    std::optional<double> terms_bound;        // nothing if some sample has none
    double coordinates = 0;                   // the products, and b' rounded to n bits
    double wrong_coverage = 0;                // samples that change sides, parts of those tested
};
std::vector<BlockRow> block_rows();

std::string block_table(const std::vector<BlockRow>& rows);
std::string block_plot(const std::vector<BlockRow>& rows);  // SVG
std::string work_table();
std::string float_table();
std::string float_coverage_table();

}  // namespace figures
