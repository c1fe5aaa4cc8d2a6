// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace diagnosis {

namespace {

constexpr double kFarthest = 4;     // pixels
constexpr float kStep = 1.0F / 16;  // pixels between the drawings that measure a change
constexpr int kIterations = 4;

Hypothesis moved_by(double x, double y, int subpixel_bits) {
    Hypothesis out;
    out.device.subpixel_bits = subpixel_bits;
    out.moved_x = static_cast<float>(x);
    out.moved_y = static_cast<float>(y);
    return out;
}

// A number that the record tells.
struct Wanted {
    size_t index = 0;  // of the sample
    std::string_view quantity;
    double got = 0;
    std::optional<double> in(const capture::Capture& capture) const {
        return number_at(capture, index, quantity);
    }
};

std::vector<Wanted> wanted_of(const Subject& subject) {
    std::vector<Wanted> out;
    const cases::Target& target = subject.data->target;
    for (const diff::Finding& f : subject.record->outcome.findings) {
        const double got = std::strtod(f.got.c_str(), nullptr);
        const size_t index = cases::index_of(target, diff::sample_of(f));
        const Wanted wanted{index, f.quantity, got};
        if (f.kind == diff::FindingKind::value && std::isfinite(got) && wanted.in(subject.right)) {
            out.push_back(wanted);
        }
    }
    return out;
}

// The shift (x, y) of all positions that brings a right device's values to those wanted.
std::optional<std::array<double, 2>> shift_of(const Subject& subject,
                                              const std::vector<Wanted>& wanted,
                                              int subpixel_bits) {
    double x = 0;
    double y = 0;
    for (int n = 0; n < kIterations; ++n) {
        const auto drawn = [&](double dx, double dy) {
            return *draw(moved_by(x + dx, y + dy, subpixel_bits), *subject.data);
        };
        const capture::Capture here = drawn(0, 0);
        const capture::Capture right = drawn(static_cast<double>(kStep), 0);
        const capture::Capture below = drawn(0, static_cast<double>(kStep));
        // Normal equations; each value counts by its own change a pixel.
        double xx = 0;
        double xy = 0;
        double yy = 0;
        double bx = 0;
        double by = 0;
        for (const Wanted& w : wanted) {
            const size_t k = w.index;
            const bool is_one_triangle = k < here.writers.size() &&
                                         here.writers[k] == right.writers[k] &&
                                         here.writers[k] == below.writers[k];
            if (!is_one_triangle) {
                continue;
            }
            const double v = *w.in(here);
            const double gx = (*w.in(right)-v) / static_cast<double>(kStep);
            const double gy = (*w.in(below)-v) / static_cast<double>(kStep);
            const double size = gx * gx + gy * gy;
            if (!(size > 0) || !std::isfinite(size)) {
                continue;
            }
            const double r = w.got - v;
            xx += gx * gx / size;
            xy += gx * gy / size;
            yy += gy * gy / size;
            bx += gx * r / size;
            by += gy * r / size;
        }
        const double det = xx * yy - xy * xy;
        const double trace = xx + yy;
        if (!(trace > 0)) {
            return std::nullopt;
        }
        // Along one direction only, the shortest shift.
        const bool is_plane = det > trace * trace * 0x1p-10;
        x += is_plane ? (bx * yy - by * xy) / det : bx / trace;
        y += is_plane ? (by * xx - bx * xy) / det : by / trace;
        if (!(std::abs(x) < kFarthest && std::abs(y) < kFarthest)) {
            return std::nullopt;
        }
    }
    return std::array{x, y};
}

// "1/2", "3/256"; of a multiple of 2^-10.
std::string fraction(double x) {
    for (int bits = 0; bits <= 10; ++bits) {
        const double n = std::ldexp(x, bits);
        if (!(n > std::floor(n))) {
            return bits == 0 ? fmt::format("{}", n) : fmt::format("{}/{}", n, 1 << bits);
        }
    }
    return fmt::format("{:.4g}", x);
}

std::string distance(double x, double y, std::string_view right, std::string_view left,
                     std::string_view below, std::string_view above) {
    std::string text;
    const auto add = [&](double d, std::string_view positive, std::string_view negative) {
        if (d < 0 || d > 0) {
            text +=
                fmt::format("{}{} pixel{} {}", text.empty() ? "" : " and ", fraction(std::abs(d)),
                            std::abs(d) > 1 ? "s" : "", d > 0 ? positive : negative);
        }
    };
    add(x, right, left);
    add(y, below, above);
    return text;
}

Hypothesis positions_moved(const std::array<double, 2>& d, int subpixel_bits) {
    Hypothesis positions = moved_by(d[0], d[1], subpixel_bits);
    positions.name = fmt::format("positions-moved-{:g},{:g}", d[0], d[1]);
    positions.what = "Vertices lie " +
                     distance(d[0], d[1], "too far right", "too far left", "too low", "too high");
    return positions;
}

}  // namespace

std::vector<Hypothesis> usual_shifts(int subpixel_bits) {
    constexpr std::array<std::array<double, 2>, 12> kShifts = {{{0.5, 0},
                                                                {-0.5, 0},
                                                                {0, 0.5},
                                                                {0, -0.5},
                                                                {0.5, 0.5},
                                                                {-0.5, -0.5},
                                                                {0.5, -0.5},
                                                                {-0.5, 0.5},
                                                                {1, 0},
                                                                {-1, 0},
                                                                {0, 1},
                                                                {0, -1}}};
    std::vector<Hypothesis> out;
    for (const std::array<double, 2>& d : kShifts) {
        out.push_back(positions_moved(d, subpixel_bits));
    }
    return out;
}

std::vector<Hypothesis> fitted_hypotheses(const Subject& subject, int subpixel_bits) {
    const std::vector<Wanted> wanted = wanted_of(subject);
    if (wanted.empty() || subject.data->blit) {
        return {};
    }
    const auto shift = shift_of(subject, wanted, subpixel_bits);
    if (!shift) {
        return {};
    }
    std::vector<Hypothesis> out;
    std::vector<std::array<double, 2>> seen;
    for (const int bits : {1, 4, 8, 9, 10}) {
        const auto rounded = [bits](double x) {
            return std::ldexp(std::round(std::ldexp(x, bits)), -bits) + 0.0;  // no negative zero
        };
        const std::array<double, 2> d = {rounded((*shift)[0]), rounded((*shift)[1])};
        const bool is_zero = std::abs(d[0]) + std::abs(d[1]) <= 0;
        if (is_zero || std::ranges::find(seen, d) != seen.end()) {
            continue;
        }
        seen.push_back(d);
        out.push_back(positions_moved(d, subpixel_bits));
        Hypothesis values;
        values.device.subpixel_bits = subpixel_bits;
        values.device.place_x = -static_cast<float>(d[0]);
        values.device.place_y = -static_cast<float>(d[1]);
        values.name = fmt::format("values-moved-{:g},{:g}", -d[0], -d[1]);
        values.what =
            "Values are evaluated " + distance(-d[0], -d[1], "right", "left", "below", "above") +
            (std::abs(d[1]) > 0 ? " the place that is asked" : " of the place that is asked");
        out.push_back(std::move(values));
    }
    return out;
}

}  // namespace diagnosis
