// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What binary64 can prove of a linearly filtered blit before the rationals are asked.
#include <algorithm>
#include <array>
#include <cmath>

#include "ref/blit/blit.hpp"

namespace ref {

using cases::ComponentFormat;
using cases::ComponentKind;
using cases::TexelCodes;
using color::Component;

double BlitReference::number_at(int64_t x, int64_t y, uint32_t k) const {
    const auto clamped = [](int64_t i, uint32_t size) {
        return static_cast<size_t>(std::clamp<int64_t>(i, 0, int64_t{size} - 1));
    };
    return numbers_[clamped(y, blit_.source_height) * blit_.source_width +
                    clamped(x, blit_.source_width)][k];
}

// A filter before the rationals: the same box without the error of the coordinate, in binary64,
// which loses less than 2^-44 of the largest texel here (some 40 operations; a coordinate below
// 2^15 is right to 2^-37 of a texel, which moves a value by as much of the largest). What lies
// inside the hull by 2^-34 of the largest texel lies inside. Says nothing if false.
bool BlitReference::surely_linear(uint32_t x, uint32_t y, const TexelCodes& got) const {
    constexpr double kStep = 1.0 / (1U << kSubTexelBits);
    const auto points = [](const Axis& axis, uint32_t i, std::array<double, 4>& out) {
        const BlitCoordinate u = axis.at(i);
        const double at =
            static_cast<double>(u.numerator) / static_cast<double>(u.denominator) - 0.5;
        size_t count = 0;
        out[count++] = at - kStep;
        if (const double whole = std::floor(at + kStep); whole > at - kStep) {
            out[count++] = whole;
        }
        out[count++] = at + kStep;
        return count;
    };
    std::array<double, 4> columns{};
    std::array<double, 4> rows{};
    const size_t column_count = points(across_, x, columns);
    const size_t row_count = points(down_, y, rows);
    for (uint32_t k = 0; k < 4; ++k) {
        const ComponentFormat to = cases::component_of(format_, k);
        const ComponentFormat from = cases::component_of(blit_.source_format, k);
        if (to.bits == 0) {
            continue;
        }
        if (from.bits == 0 || from.kind == ComponentKind::srgb || to.kind == ComponentKind::srgb ||
            !std::isfinite(Component(to).number(got[k]))) {
            return false;
        }
        double lo = 0;
        double hi = 0;
        double largest = 0;
        for (size_t r = 0; r < row_count; ++r) {
            for (size_t c = 0; c < column_count; ++c) {
                const double i = std::floor(columns[c]);
                const double j = std::floor(rows[r]);
                const double alpha = columns[c] - i;
                const double beta = rows[r] - j;
                const auto value = [&](int64_t dx, int64_t dy) {
                    const double v =
                        number_at(static_cast<int64_t>(i) + dx, static_cast<int64_t>(j) + dy, k);
                    largest = std::max(largest, std::abs(v));
                    return v;
                };
                const double v = (value(0, 0) * (1 - alpha) + value(1, 0) * alpha) * (1 - beta) +
                                 (value(0, 1) * (1 - alpha) + value(1, 1) * alpha) * beta;
                const bool first = r == 0 && c == 0;
                lo = first ? v : std::min(lo, v);
                hi = first ? v : std::max(hi, v);
            }
        }
        const double number = Component(to).number(got[k]);
        const double slack = 2 * Component(from).step().get_d() - largest * 0x1p-34;
        if (number < lo - slack || number > hi + slack) {
            return false;
        }
    }
    return true;
}

}  // namespace ref
