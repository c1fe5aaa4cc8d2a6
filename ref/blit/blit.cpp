// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/blit/blit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "cases/model/words.hpp"
#include "ref/number/rational.hpp"

namespace ref {

using cases::BlitFilter;
using cases::ComponentFormat;
using cases::ComponentKind;
using cases::Profile;
using cases::TexelCodes;
using color::Component;
using color::Interval;

namespace {

// What one operation loses: half an ULP in binary32 (counted in 2^-24), or the only bound that
// Vulkan names (1 part in 10^5).
mpq_class unit_of(Profile profile) {
    return profile == Profile::vulkan ? mpq_class(1, 100000) : mpq_class(1, 1U << 24U);
}

// Of a component that the source lacks: 0, alpha 1.
Interval point_of_lacking(uint32_t k) {
    return color::point(k == 3 ? 1 : 0);
}

mpq_class ratio_of(const BlitCoordinate& u) {
    return fraction(mpz_class(u.numerator), mpz_class(u.denominator));
}

Interval widen(const Interval& v, const mpq_class& by) {
    return {v.low - by, v.high + by};
}

mpq_class magnitude(const Interval& v) {
    return std::max(mpq_class(abs(v.low)), mpq_class(abs(v.high)));
}

}  // namespace

BlitCoordinate blit_coordinate(int32_t i, int32_t s0, int32_t s1, int32_t d0, int32_t d1) {
    // (2 (i - d0) + 1) (s1 - s0) / (2 (d1 - d0)) + s0, with the denominator made positive.
    const int64_t sign = d1 > d0 ? 1 : -1;
    const int64_t denominator = 2 * sign * (int64_t{d1} - d0);
    const int64_t numerator = sign * (2 * (int64_t{i} - d0) + 1) * (int64_t{s1} - s0);
    return {numerator + s0 * denominator, denominator};
}

BlitCoordinate BlitReference::Axis::at(uint32_t i) const {
    return blit_coordinate(static_cast<int32_t>(i), s0, s1, d0, d1);
}

BlitReference::BlitReference(const cases::Case& c)
    : blit_(*c.blit),
      format_(c.target.color->format),
      width_(c.target.width),
      height_(c.target.height),
      across_{blit_.source.x0, blit_.source.x1, blit_.destination.x0, blit_.destination.x1,
              blit_.source_width},
      down_{blit_.source.y0, blit_.source.y1, blit_.destination.y0, blit_.destination.y1,
            blit_.source_height},
      texels_(cases::blit_source(blit_)) {
    if (blit_.filter == BlitFilter::linear) {
        for (const TexelCodes& codes : texels_) {
            std::array<double, 4> numbers{};
            for (uint32_t k = 0; k < 4; ++k) {
                const Component component(cases::component_of(blit_.source_format, k));
                numbers[k] = component.exists() ? component.number(codes[k]) : 0;
            }
            numbers_.push_back(numbers);
        }
    }
    for (const Profile profile : cases::kProfiles) {
        columns_[static_cast<size_t>(profile)] =
            spans_of(across_, width_, error_of(across_, profile));
        rows_[static_cast<size_t>(profile)] = spans_of(down_, height_, error_of(down_, profile));
        cleared_[static_cast<size_t>(profile)] =
            color::Unit{format_, profile}.cleared(*c.target.color);
    }
    for (uint32_t k = 0; k < 4; ++k) {
        const Component component(cases::component_of(format_, k));
        if (component.exists()) {
            clear_[k] = component.code_of(
                mpq_class(static_cast<double>(c.target.color->clear[static_cast<int>(k)])));
        }
    }
}

std::vector<BlitReference::TexelRange> BlitReference::spans_of(const Axis& axis, uint32_t size,
                                                               const mpq_class& error) const {
    std::vector<TexelRange> spans;
    for (uint32_t i = 0; i < size; ++i) {
        const mpq_class u = ratio_of(axis.at(i));
        spans.push_back({floor_of(u - error).get_si(), floor_of(u + error).get_si()});
    }
    return spans;
}

bool BlitReference::is_inside(uint32_t x, uint32_t y) const {
    const auto within = [](const Axis& axis, uint32_t i) {
        const auto at = static_cast<int32_t>(i);
        return at >= std::min(axis.d0, axis.d1) && at < std::max(axis.d0, axis.d1);
    };
    return within(across_, x) && within(down_, y);
}

mpq_class BlitReference::error_of(const Axis& axis, Profile profile) const {
    const auto side = [](const Axis& a) { return static_cast<uint32_t>(std::abs(a.d1 - a.d0)); };
    const mpq_class extrapolation =
        mpq_class(width_) / side(across_) + mpq_class(height_) / side(down_);
    return unit_of(profile) * axis.size * (9 + 2 * (1 + 8 * extrapolation));
}

const TexelCodes& BlitReference::texel(int64_t x, int64_t y, bool by_region) const {
    const auto clamped = [&](int64_t i, const Axis& axis) {
        const int64_t low = by_region ? std::min(axis.s0, axis.s1) : 0;
        const int64_t high = by_region ? std::max(axis.s0, axis.s1) : int64_t{axis.size};
        return static_cast<size_t>(std::clamp(i, low, high - 1));
    };
    return texels_[clamped(y, down_) * blit_.source_width + clamped(x, across_)];
}

// True if a texel may be stored as these codes. From format to format a number passes two
// conversions, each of which loses at most two units of it (1 ULP).
bool BlitReference::converts(const TexelCodes& source, const TexelCodes& got,
                             Profile profile) const {
    if (format_ == blit_.source_format && profile != Profile::vulkan) {
        return got == source;  // nothing is converted: bit for bit
    }
    for (uint32_t k = 0; k < 4; ++k) {
        const ComponentFormat to = cases::component_of(format_, k);
        if (to.bits == 0) {
            continue;
        }
        const ComponentFormat from = cases::component_of(blit_.source_format, k);
        if (to.kind == ComponentKind::uint && from.bits == to.bits) {
            if (got[k] != source[k]) {
                return false;
            }
            continue;
        }
        const Interval number =
            from.bits == 0 ? point_of_lacking(k) : Component(from).read(source[k]);
        const mpq_class slack = from.bits == 0 || to.kind == ComponentKind::uint
                                    ? mpq_class(0)
                                    : mpq_class(4 * unit_of(profile) * magnitude(number));
        if (!Component(to).may_convert(widen(number, slack), got[k])) {
            return false;
        }
    }
    return true;
}

bool BlitReference::allows_nearest(uint32_t x, uint32_t y, const TexelCodes& got,
                                   Profile profile) const {
    const TexelRange& columns = columns_[static_cast<size_t>(profile)][x];
    const TexelRange& rows = rows_[static_cast<size_t>(profile)][y];
    for (int64_t j = rows.first; j <= rows.last; ++j) {
        for (int64_t i = columns.first; i <= columns.last; ++i) {
            if (converts(texel(i, j, false), got, profile) ||
                converts(texel(i, j, true), got, profile)) {
                return true;
            }
        }
    }
    return false;
}

namespace {

// The points at which a function that is linear between whole numbers takes its extremes on an
// interval around x: its ends and the whole numbers inside.
std::vector<mpq_class> corners_of(const mpq_class& x, const mpq_class& reach) {
    const mpq_class lo = x - reach;
    const mpq_class hi = x + reach;
    std::vector<mpq_class> points = {lo};
    for (int64_t i = floor_of(lo).get_si() + 1; mpq_class(i) < hi; ++i) {
        points.emplace_back(i);
    }
    points.push_back(hi);
    return points;
}

}  // namespace

// The filtered value is bilinear between texel centres, so over a box of coordinates its extremes
// lie at corners of the box cut by the whole numbers. The weights have subTexelPrecisionBits bits,
// 4 or more: a coordinate moves by less than one step of them. The filter itself may keep the
// source's precision: each lerp of UNORM texels loses less than one code, and the second averages
// the loss of the first, so less than 2 codes; in floating point a lerp a + (b - a) t loses at most
// 10 units of the largest texel (three operations of 2 units each; |b - a| <= 2 max), both 20.
//
// No weight is negative and their sum is 1, so that no rounding to codes leads beyond the texels:
// from between two multiples of a step it goes to either of them or to one between them. The texels
// are multiples themselves, but for those of sRGB, whose linear numbers may be rounded once more,
// and those of fewer than 8 bits where a device filters them as 8 (lavapipe: 12/63 as 48/255).
bool BlitReference::allows_linear(uint32_t x, uint32_t y, const TexelCodes& got, Profile profile,
                                  bool by_region) const {
    const auto corners = [&](const Axis& axis, uint32_t i) {
        const mpq_class step(1, 1U << kSubTexelBits);
        return corners_of(ratio_of(axis.at(i)) - mpq_class(1, 2), error_of(axis, profile) + step);
    };
    const std::vector<mpq_class> columns = corners(across_, x);
    const std::vector<mpq_class> rows = corners(down_, y);
    for (uint32_t k = 0; k < 4; ++k) {
        const ComponentFormat to = cases::component_of(format_, k);
        const ComponentFormat from = cases::component_of(blit_.source_format, k);
        if (to.bits == 0) {
            continue;
        }
        Interval number = point_of_lacking(k);
        if (from.bits != 0) {
            bool first = true;
            mpq_class largest;
            std::optional<Interval> hull;  // of all texels that may have a weight
            for (const mpq_class& row : rows) {
                const int64_t j = floor_of(row).get_si();
                const mpq_class beta = row - j;
                for (const mpq_class& column : columns) {
                    const int64_t i = floor_of(column).get_si();
                    const mpq_class alpha = column - i;
                    mpq_class lo;
                    mpq_class hi;
                    for (int corner = 0; corner < 4; ++corner) {
                        const mpq_class weight =
                            ((corner & 1) != 0 ? alpha : mpq_class(1 - alpha)) *
                            ((corner & 2) != 0 ? beta : mpq_class(1 - beta));
                        const Interval v = Component(from).read(
                            texel(i + (corner & 1), j + (corner >> 1), by_region)[k]);
                        lo += weight * v.low;
                        hi += weight * v.high;
                        largest = std::max(largest, magnitude(v));
                        if (weight > 0) {
                            hull = hull ? Interval{std::min(hull->low, v.low),
                                                   std::max(hull->high, v.high)}
                                        : v;
                        }
                    }
                    number.low = first ? lo : std::min(number.low, lo);
                    number.high = first ? hi : std::max(number.high, hi);
                    first = false;
                }
            }
            // 20 units of the filter and 4 of the conversions, as for nearest.
            const mpq_class slack = 24 * unit_of(profile) * largest;
            const mpq_class step = Component(from).step();
            if (step > 0) {
                const mpq_class grid = from.bits < 8 ? mpq_class(1, 255) : step;
                *hull = {floor_of(hull->low / grid) * grid, -floor_of(-hull->high / grid) * grid};
            }
            number = widen(number, 2 * step);
            number =
                widen({std::max(number.low, hull->low), std::min(number.high, hull->high)}, slack);
        }
        if (!Component(to).may_convert(number, got[k])) {
            return false;
        }
    }
    return true;
}

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
        double least = std::numeric_limits<double>::infinity(), most = -least;  // of the texels
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
                    if ((dx == 0 || alpha > 0) && (dy == 0 || beta > 0)) {
                        least = std::min(least, v);
                        most = std::max(most, v);
                    }
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
        if (number < std::max(lo - slack, least) || number > std::min(hi + slack, most)) {
            return false;
        }
    }
    return true;
}

bool BlitReference::is_clear(const TexelCodes& got, Profile profile) const {
    return color::Unit{format_, profile}.allows(cleared_[static_cast<size_t>(profile)], got);
}

bool BlitReference::allows_exact(uint32_t x, uint32_t y, const TexelCodes& got,
                                 Profile profile) const {
    if (!is_inside(x, y)) {
        return is_clear(got, profile);
    }
    if (blit_.filter == BlitFilter::nearest) {
        return allows_nearest(x, y, got, profile);
    }
    return allows_linear(x, y, got, profile, false) || allows_linear(x, y, got, profile, true);
}

bool BlitReference::allows(uint32_t x, uint32_t y, const TexelCodes& got, Profile profile) const {
    if (is_inside(x, y) && blit_.filter == BlitFilter::linear && surely_linear(x, y, got)) {
        return true;
    }
    return allows_exact(x, y, got, profile);
}

bool BlitReference::has_freedom(uint32_t x, uint32_t y, Profile profile) const {
    if (!is_inside(x, y)) {
        return false;
    }
    if (blit_.filter == BlitFilter::linear || format_ != blit_.source_format ||
        profile == Profile::vulkan) {
        return true;
    }
    const TexelRange& column = columns_[static_cast<size_t>(profile)][x];
    const TexelRange& row = rows_[static_cast<size_t>(profile)][y];
    return column.first != column.last || row.first != row.last;
}

TexelCodes BlitReference::nominal(uint32_t x, uint32_t y) const {
    if (!is_inside(x, y)) {
        return clear_;
    }
    const bool linear = blit_.filter == BlitFilter::linear;
    const mpq_class shift(linear ? 1 : 0, 2);
    const mpq_class column = ratio_of(across_.at(x)) - shift;
    const mpq_class row = ratio_of(down_.at(y)) - shift;
    const int64_t i = floor_of(column).get_si();
    const int64_t j = floor_of(row).get_si();
    const TexelCodes& source = texel(i, j, false);
    if (!linear && format_ == blit_.source_format) {
        return source;
    }
    TexelCodes codes{};
    for (uint32_t k = 0; k < 4; ++k) {
        const ComponentFormat to = cases::component_of(format_, k);
        const ComponentFormat from = cases::component_of(blit_.source_format, k);
        if (to.bits == 0) {
            continue;
        }
        mpq_class number = point_of_lacking(k).low;
        if (from.bits != 0) {
            number = 0;
            for (int corner = 0; corner < (linear ? 4 : 1); ++corner) {
                const mpq_class alpha = linear ? mpq_class(column - i) : mpq_class(0);
                const mpq_class beta = linear ? mpq_class(row - j) : mpq_class(0);
                mpq_class v;
                Component(from).value_of(texel(i + (corner & 1), j + (corner >> 1), false)[k], v);
                number += ((corner & 1) != 0 ? alpha : mpq_class(1 - alpha)) *
                          ((corner & 2) != 0 ? beta : mpq_class(1 - beta)) * v;
            }
        }
        codes[k] = Component(to).code_of(number);
    }
    return codes;
}

std::string BlitReference::explain(uint32_t x, uint32_t y) const {
    if (!is_inside(x, y)) {
        return "the texel lies outside the destination region, so it keeps the clear value";
    }
    const BlitCoordinate u = across_.at(x);
    const BlitCoordinate v = down_.at(y);
    return fmt::format("u = {}/{} = {}, v = {}/{} = {} in texels of the source, filter {}",
                       u.numerator, u.denominator, ratio_of(u).get_d(), v.numerator, v.denominator,
                       ratio_of(v).get_d(), cases::word_of(blit_.filter));
}

}  // namespace ref
