// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/position/viewport_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ref {

namespace {

// Of a binary32 number, which a power of two scales exactly in binary64.
bool is_multiple(float v, int bits) {
    const double scaled = std::ldexp(double{v}, bits);
    return !(std::floor(scaled) < scaled);
}

// A number in steps of the grid: the nearest binary64, and on which side of it the number lies.
struct Steps {
    double value = 0;
    double rest = 0;
};

// a + b without error (Knuth's TwoSum).
Steps sum_of(float a, float b, int bits) {
    const double x = std::ldexp(double{a}, bits), y = std::ldexp(double{b}, bits);
    const double sum = x + y;
    const double y_used = sum - x;
    return {sum, (x - (sum - y_used)) + (y - y_used)};
}

double floor_of(const Steps& v) {
    const double down = std::floor(v.value);
    return !(down < v.value) && v.rest < 0 ? down - 1 : down;
}
double ceil_of(const Steps& v) {
    return -floor_of({-v.value, -v.rest});
}
double nearest_of(const Steps& v) {  // halves up; + 1/2 is exact below 2^52
    return floor_of({v.value + 0.5, v.rest});
}

using Rounding = double (*)(const Steps&);
constexpr std::array<Rounding, 3> kRoundings = {floor_of, nearest_of, ceil_of};

// False if nothing is left of the viewport.
bool move(float& origin, float& extent, int bits, Rounding of_low, Rounding of_high) {
    const double low = of_low(sum_of(origin, 0, bits));
    const double high = of_high(sum_of(origin, extent, bits));
    const bool is_negative = extent < 0;
    origin = static_cast<float>(std::ldexp(low, -bits));
    extent = static_cast<float>(std::ldexp(high - low, -bits));
    return is_negative ? extent < 0 : extent > 0;
}

bool is_same(const cases::Viewport& a, const cases::Viewport& b) {
    const auto bounds = [](const cases::Viewport& v) {
        return std::array{v.x, v.y, v.width, v.height};
    };
    return bounds(a) == bounds(b);
}

bool has_same_viewports(const cases::Case& a, const cases::Case& b) {
    return std::equal(a.draws.begin(), a.draws.end(), b.draws.begin(),
                      [](const cases::Draw& one, const cases::Draw& other) {
                          return is_same(one.viewport, other.viewport);
                      });
}

}  // namespace

bool is_on_viewport_grid(float origin, float extent, int bits) {
    return is_multiple(origin, bits) && is_multiple(extent, bits);
}

std::vector<cases::Case> on_viewport_grids(const cases::Case& c, const Limits& limits) {
    const int bits = limits.viewport_bits;
    std::vector<cases::Case> found;
    if (std::all_of(c.draws.begin(), c.draws.end(), [&](const cases::Draw& draw) {
            const cases::Viewport& v = draw.viewport;
            return is_on_viewport_grid(v.x, v.width, bits) &&
                   is_on_viewport_grid(v.y, v.height, bits);
        })) {
        return found;
    }
    for (const Rounding of_low : kRoundings) {
        for (const Rounding of_high : kRoundings) {
            cases::Case moved = c;
            bool is_drawn = true;
            for (cases::Draw& draw : moved.draws) {
                cases::Viewport& v = draw.viewport;
                is_drawn = move(v.x, v.width, bits, of_low, of_high) &&
                           move(v.y, v.height, bits, of_low, of_high) && is_drawn;
            }
            if (is_drawn && !has_same_viewports(moved, c) &&
                std::none_of(found.begin(), found.end(), [&](const cases::Case& other) {
                    return has_same_viewports(moved, other);
                })) {
                found.push_back(std::move(moved));
            }
        }
    }
    return found;
}

}  // namespace ref
