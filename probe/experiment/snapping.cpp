// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "probe/experiment/snapping.hpp"

#include <algorithm>
#include <charconv>

#include "ref/number/fixed_point.hpp"

namespace probe {

int64_t Snapping::operator()(int64_t fixed) const {
    const int shift = ref::kFixedBits - bits;
    const int64_t unit = int64_t{1} << shift;
    const int64_t low = fixed >> shift;  // rounds down
    const int64_t rest = fixed - low * unit;
    bool is_up = false;
    switch (rounding) {
        case Rounding::nearest_even:
            is_up = 2 * rest > unit || (2 * rest == unit && (low & 1) != 0);
            break;
        case Rounding::nearest_up:
            is_up = 2 * rest >= unit;
            break;
        case Rounding::nearest_down:
            is_up = 2 * rest > unit;
            break;
        case Rounding::floor:
            break;
        case Rounding::ceil:
            is_up = rest > 0;
            break;
    }
    return (low + (is_up ? 1U : 0U)) * unit;
}

std::vector<Snapping> all_snappings() {
    std::vector<Snapping> out;
    for (int bits = kLeastBits; bits <= kMostBits; ++bits) {
        for (size_t k = 0; k < kRoundingNames.size(); ++k) {
            out.push_back({bits, static_cast<Rounding>(k)});
        }
    }
    return out;
}

Grid grid_of(const Datasheet& sheet, int promised_bits) {
    Grid grid;
    grid.is_known = true;
    for (const bool is_y : {false, true}) {
        Snapping& snapping = is_y ? grid.y : grid.x;
        snapping.bits = promised_bits;
        const std::string axis = is_y ? "y" : "x";
        const std::string_view bits = sheet.answer("grid.bits." + axis);
        const std::string_view rounding = sheet.answer("grid.rounding." + axis);
        const auto* const name = std::ranges::find(kRoundingNames, rounding);
        grid.is_known = grid.is_known && bits != kCannotTell && name != kRoundingNames.end();
        if (bits != kCannotTell) {
            std::from_chars(bits.data(), bits.data() + bits.size(), snapping.bits);
        }
        if (name != kRoundingNames.end()) {
            snapping.rounding = static_cast<Rounding>(name - kRoundingNames.begin());
        }
    }
    return grid;
}

}  // namespace probe
