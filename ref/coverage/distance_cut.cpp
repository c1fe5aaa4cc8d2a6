// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/distance_cut.hpp"

#include <algorithm>

#include "ref/number/rational.hpp"

namespace ref {

namespace {

Int128 to_int128(const mpz_class& v) {
    // |v| < 2^104
    const mpz_class size = abs(v);
    const mpz_class top = size >> 62;
    const mpz_class rest = size & ((mpz_class(1) << 62) - 1);
    const Int128 out = (Int128{top.get_si()} << 62) + rest.get_si();
    return v < 0 ? -out : out;
}

// Integer half planes around value >= 0 that are wide (narrow) by no more than the error and the
// rounding of the coefficients: 1/2 of a unit of 2^-49 of the larger slope, times the coordinate.
DistanceCut to_cut(const LinearBound& plane, const Window& window) {
    // value 2^16 = x X + y Y + c 2^16 with X, Y in S47.16.
    const mpq_class steepest = std::max<mpq_class>(abs(plane.x), abs(plane.y));
    DistanceCut out;
    const auto sign_plane = [](bool is_in) { return HalfPlane{0, 0, is_in ? 1 : -1}; };
    if (steepest == 0) {
        out.may = sign_plane(plane.c + plane.error >= 0);
        out.must = sign_plane(plane.c - plane.error > 0);
        return out;
    }
    // scale steepest to [2^48, 2^49)
    const auto bits = static_cast<int64_t>(mpz_sizeinbase(steepest.get_num_mpz_t(), 2)) -
                      static_cast<int64_t>(mpz_sizeinbase(steepest.get_den_mpz_t(), 2));
    const mpq_class scale = power_of_two(47 - bits);
    const mpz_class a = floor_of(plane.x * scale);
    const mpz_class b = floor_of(plane.y * scale);
    const auto far = [](int64_t low, int64_t high) {
        return std::max(std::abs(low), std::abs(high)) * kFixedOne;
    };
    // Each coefficient is off by less than 1.
    const mpz_class slack = mpz_class(far(window.pixel_x0, window.pixel_x1)) +
                            mpz_class(far(window.pixel_y0, window.pixel_y1)) + 2;
    const mpz_class low = floor_of((plane.c - plane.error) * scale * kFixedOne) - slack;
    const mpz_class high = floor_of((plane.c + plane.error) * scale * kFixedOne) + slack + 1;
    // |a X + b Y| < 2^101 for positions below 2^50: beyond it only the sign of c counts.
    const mpz_class limit = mpz_class(1) << 101;
    const auto bounded = [&](const mpz_class& c) {
        return to_int128(c > limit ? limit : (c < -limit ? mpz_class(-limit) : c));
    };
    out.may = {to_int128(a), to_int128(b), bounded(high)};
    out.must = {to_int128(a), to_int128(b), bounded(low)};
    return out;
}

bool is_passed_by_all(const DistanceCut& cut, std::span<const Box> boxes) {
    return std::ranges::all_of(boxes, [&](const Box& box) {
        const BoxCorners points(box);
        return std::all_of(points.begin(), points.end(),
                           [&](const FixedPoint& p) { return cut.must.at(p) >= 0; });
    });
}

bool is_passed_by_none(const DistanceCut& cut, std::span<const Box> boxes) {
    return std::ranges::all_of(boxes, [&](const Box& box) {
        const BoxCorners points(box);
        return std::all_of(points.begin(), points.end(),
                           [&](const FixedPoint& p) { return cut.may.at(p) < 0; });
    });
}

}  // namespace

std::optional<std::vector<DistanceCut>> distance_cuts(const CutSource& source,
                                                      std::span<const ClippedVertex> polygon,
                                                      std::span<const Box> boxes) {
    mpq_class least_inv_w;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const mpq_class& inv_w = polygon[i].position.inv_w;
        least_inv_w = i == 0 ? inv_w : std::min<mpq_class>(least_inv_w, inv_w);
    }
    const std::vector<LinearBound> planes = distance_planes(source, polygon, boxes);
    // D, linear, is the least at a corner.
    if (planes.empty() || least_inv_w - planes.back().error <= 0) {
        return std::nullopt;
    }
    std::vector<DistanceCut> out;
    for (uint32_t k = 0; k < source.triangle.distance_count; ++k) {
        const bool is_zero = std::all_of(
            source.triangle.distance.begin(), source.triangle.distance.end(), [&](const auto& d) {
                return !(std::abs(d[static_cast<glm::vec4::length_type>(k)]) > 0);
            });
        if (is_zero) {
            continue;  // 0 x = 0 and x + 0 = x hold exactly: c = 0 everywhere
        }
        DistanceCut cut = to_cut(planes[k], source.window);
        cut.plane = static_cast<ClipPlane>(static_cast<uint32_t>(ClipPlane::user_0) + k);
        if (!is_passed_by_all(cut, boxes)) {
            out.push_back(cut);
        }
    }
    return out;
}

std::optional<std::vector<DistanceCut>> depth_cuts(const CutSource& source,
                                                   std::span<const ClippedVertex> polygon,
                                                   std::span<const Box> boxes,
                                                   std::span<const ClipPlane> planes) {
    const std::optional<LinearBound> depth = depth_plane(source, polygon, boxes);
    if (!depth) {
        return std::nullopt;
    }
    std::vector<DistanceCut> out;
    for (const ClipPlane plane : planes) {
        LinearBound value = *depth;
        if (plane == ClipPlane::z_high) {  // 1 - z/w
            value.x = -value.x;
            value.y = -value.y;
            value.c = 1 - value.c;
        } else if (plane == ClipPlane::z_low_symmetric) {
            value.c += 1;
        }
        DistanceCut cut = to_cut(value, source.window);
        cut.plane = plane;
        if (is_passed_by_none(cut, boxes)) {
            return std::nullopt;
        }
        if (!is_passed_by_all(cut, boxes)) {
            out.push_back(cut);
        }
    }
    return out;
}

}  // namespace ref
