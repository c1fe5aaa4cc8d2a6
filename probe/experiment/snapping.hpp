// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How a coordinate is put on the subpixel grid: the possible ways.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "probe/base/datasheet.hpp"

namespace probe {

enum class Rounding : uint8_t { nearest_even, nearest_up, nearest_down, floor, ceil };
inline constexpr std::array<std::string_view, 5> kRoundingNames = {
    "nearest, ties to even", "nearest, ties up", "nearest, ties down", "floor", "ceil"};

struct Snapping {
    int bits = 8;
    Rounding rounding = Rounding::nearest_even;
    // A coordinate that is a multiple of 2^-16 pixel, as such a multiple, on the grid; exact.
    int64_t operator()(int64_t fixed) const;
};
inline constexpr int kLeastBits = 3, kMostBits = 13;
std::vector<Snapping> all_snappings();

// What the experiments of the grid have found along x and y where coordinates are positive; the
// promised bits and nearest even where they cannot tell. `is_known` says whether all was found.
struct Grid {
    Snapping x, y;
    bool is_known = false;
};
Grid grid_of(const Datasheet& sheet, int promised_bits);

}  // namespace probe
