// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace cases {

// A number as every report tells it: of nine significant digits, which tell binary32 numbers apart,
// or of fewer; "NaN" whatever its sign, "infinity", "-infinity". Not for files that programs read.
inline std::string number_text(double value, int digits = 9) {
    if (std::isnan(value)) {
        return "NaN";
    }
    if (std::isinf(value)) {
        return value > 0 ? "infinity" : "-infinity";
    }
    return fmt::format("{:.{}g}", value, digits);
}

}  // namespace cases
