// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The error of a clipped vertex, unit roundoff u. The plane distances d1 >= 0 > d2 of the end
// points P1, P2 are sums of two components that are off by at most e, so |dd_i| <= eta_i = e_w +
// e_c + u |d_i| (1 + u covers the rest). t = d1 / (d1 - d2), with D = |d1| + |d2|:
//
//     |dt| <= ((1-t) eta_1 + t eta_2) / (D - eta_1 - eta_2) + 4u m,    m = max(t, 1-t)
//
// (a subtraction, a reciprocal of 1 ulp and a product: 4u of t, which counts from either end). The
// new point R is computed as
//
//     P1 + t (P2 - P1)      difference and product 2u m |P2 - P1|, the sum u |R|
//     (1-t) P1 + t P2       1-t and the products 2u ((1-t) |P1| + t |P2|), the sum u |R|
//
// from either end, with the larger of both, r_c,
//
//     |dP_c| <= max(e1_c, e2_c) + (|dt| |P2_c - P1_c| + r_c + u |R_c|) (1 + 16u)
//
// where 1 + 16u covers the products of the at most seven roundings of a chain. The end points'
// errors enter as weights (1-t) and t, which are off by |dt| times e1 + e2. Several planes: the
// bound is carried from cut to cut. Devices cut in different orders; the larger bound of the orders
// x y z, z x y and, with clip distances, those first and last is taken. A clip distance is exact at
// the triangle's vertices and cut like a coordinate. Then x/w: (e_x + |x/w| e_w) / (w - e_w), times
// |p/2|, plus the rounding of divide and transform (position.cpp). Bounds are symmetric in the two
// end points, so that two triangles which share the edge get the same box for the same point.
//
// A cut point is kept as whole numbers: its weights of the triangle's three vertices, which have no
// common factor. A distance from a plane is then a whole number, too, whose sign is exact, and the
// new weights are |d2| m1 + |d1| m2, where d1 and d2 are such whole numbers. Rationals are made of
// what is left in the end. The bounds above are reckoned in Balls and rounded up.
#include "ref/position/clip.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ref/number/ball.hpp"
#include "ref/number/rational.hpp"
#include "ref/position/position_detail.hpp"

namespace ref {

namespace {

using value::Answer;
using value::Ball;

constexpr size_t kX = 0, kY = 1, kZ = 2, kW = 3;
constexpr size_t kCoordinates = 4;

// What is clipped: the clip coordinates, then up to four clip distances.
constexpr size_t kComponents = kCoordinates + kMaxUserPlanes;

size_t user_component(ClipPlane plane) {
    return kCoordinates + user_index(plane);
}

// The component that a plane of the view volume bounds; the distance is w + c (low), w - c (high),
// z (z_low).
size_t component_of(ClipPlane plane) {
    return plane == ClipPlane::z_low_symmetric ? kZ : static_cast<size_t>(plane) / 2;
}

// The components of the triangle's vertices as whole numbers: each is n 2^exponent.
struct WholeTriangle {
    std::array<std::array<mpz_class, 3>, kComponents> n;  // by component and vertex
    long exponent = 0;
    size_t components = kCoordinates;
};

float component(const ClipInput& triangle, size_t vertex, size_t k) {
    return k < kCoordinates
               ? triangle.clip[vertex][static_cast<glm::vec4::length_type>(k)]
               : triangle.distance[vertex][static_cast<glm::vec4::length_type>(k - kCoordinates)];
}

WholeTriangle whole_numbers(const ClipInput& triangle) {
    constexpr int kMantissaBits = 24;
    WholeTriangle out;
    out.components += triangle.distance_count;
    int least = 0;
    for (size_t k = 0; k < out.components; ++k) {
        for (size_t i = 0; i < 3; ++i) {
            int exponent = 0;
            if (std::fabs(std::frexp(component(triangle, i, k), &exponent)) > 0) {
                least = std::min(least, exponent - kMantissaBits);
            }
        }
    }
    out.exponent = least;
    for (size_t k = 0; k < out.components; ++k) {
        for (size_t i = 0; i < 3; ++i) {
            int exponent = 0;
            const float mantissa = std::frexp(component(triangle, i, k), &exponent);
            mpz_class& n = out.n[k][i];
            n = static_cast<double>(std::ldexp(mantissa, kMantissaBits));
            if (n != 0) {
                mpz_mul_2exp(n.get_mpz_t(), n.get_mpz_t(),
                             static_cast<mp_bitcnt_t>(exponent - kMantissaBits - least));
            }
        }
    }
    return out;
}

using Weights = std::array<mpz_class, 3>;

mpz_class weighted(const Weights& weight, const std::array<mpz_class, 3>& n) {
    mpz_class sum;
    for (size_t i = 0; i < 3; ++i) {
        mpz_addmul(sum.get_mpz_t(), weight[i].get_mpz_t(), n[i].get_mpz_t());
    }
    return sum;
}

mpz_class whole_of(const Weights& weight) {
    return weight[0] + weight[1] + weight[2];
}

// a / b 2^exponent, b > 0. Both are truncated to 53 bits, which is less than 2^-52 of each, and the
// quotient is rounded.
Ball quotient(const mpz_class& a, const mpz_class& b, long exponent) {
    long of_a = 0, of_b = 0;
    const double high = mpz_get_d_2exp(&of_a, a.get_mpz_t());
    const double low = mpz_get_d_2exp(&of_b, b.get_mpz_t());
    constexpr long kFar = 1 << 20;  // overflows or vanishes as well
    const double v =
        std::ldexp(high / low, static_cast<int>(std::clamp(of_a - of_b + exponent, -kFar, kFar)));
    return {v, sgn(a) == 0 ? 0.0 : std::fabs(v) * 0x1p-50 + value::ball::kTiny};
}

// Not less than the ball's number, which is no less than 0. Bounds next to nothing become short
// numbers that are larger.
double at_most(const Ball& b) {
    constexpr double kLeast = 0x1p-400;
    if (b.v <= 0 && b.e <= 0) {
        return 0;
    }
    return std::max((b.v + b.e) * value::ball::kInflate, kLeast);
}

struct Work {
    Weights weight;
    std::array<Ball, kComponents> value;
    std::array<double, kComponents> error{};  // of the clip coordinates and distances
    bool is_bounded = true;
    int original = -1;
    EdgeLabel edge = 0;
};

// Cuts polygons of one triangle by planes.
class Clipper {
  public:
    Clipper(const ClipInput& input, cases::Profile profile)
        : triangle_(whole_numbers(input)),
          u_(profile == cases::Profile::vulkan ? mpq_class(1, 100000)
                                               : mpq_class(1, int64_t{1} << 24)),
          unit_(value::from_exact<Ball>(u_)) {
        for (size_t i = 0; i < start_.size(); ++i) {
            Work& vertex = start_[i];
            vertex.weight[i] = 1;
            vertex.original = static_cast<int>(i);
            vertex.edge = static_cast<EdgeLabel>(i);
            for (size_t k = 0; k < triangle_.components; ++k) {
                vertex.value[k] = Ball(static_cast<double>(component(input, i, k)));
            }
        }
    }

    // `is_sure`: as of clip_triangle; it is left as it is where that holds.
    std::vector<Work> clip(std::span<const ClipPlane> order, bool& is_sure) const;
    ClippedVertex finished(const Work& p, const cases::Viewport& viewport) const;

  private:
    // n of a component of a point whose weights have the sum 1.
    mpz_class distance(const Work& p, ClipPlane plane) const;
    Ball distance_error(const Work& p, const Ball& d, ClipPlane plane) const;
    Work cut(const Work& p1, const Work& p2, const mpz_class& n1, const mpz_class& n2,
             ClipPlane plane) const;
    bool may_be_anywhere(const Work& p, const mpz_class& d, ClipPlane plane) const;
    std::vector<Work> clip_by(const std::vector<Work>& polygon, const std::vector<mpz_class>& d,
                              ClipPlane plane) const;
    mpq_class axis_error(const Work& p, size_t c, float extent, float origin) const;

    WholeTriangle triangle_;
    mpq_class u_;
    Ball unit_;  // roundoff
    std::vector<Work> start_ = std::vector<Work>(3);
};

// The distance of the point times the sum of its weights, in units of 2^exponent.
mpz_class Clipper::distance(const Work& p, ClipPlane plane) const {
    if (is_user(plane)) {
        return weighted(p.weight, triangle_.n[user_component(plane)]);
    }
    const size_t c = component_of(plane);
    switch (plane) {
        case ClipPlane::x_low:
        case ClipPlane::y_low:
        case ClipPlane::z_low_symmetric:
            return weighted(p.weight, triangle_.n[kW]) + weighted(p.weight, triangle_.n[c]);
        case ClipPlane::z_low:
            return weighted(p.weight, triangle_.n[kZ]);
        default:
            return weighted(p.weight, triangle_.n[kW]) - weighted(p.weight, triangle_.n[c]);
    }
}

Ball Clipper::distance_error(const Work& p, const Ball& d, ClipPlane plane) const {
    if (is_user(plane)) {
        return p.error[user_component(plane)];
    }
    if (plane == ClipPlane::z_low) {
        return p.error[kZ];
    }
    return (Ball(p.error[kW]) + Ball(p.error[component_of(plane)]) + unit_ * magnitude(d)) *
           (Ball(1) + unit_);
}

Work Clipper::cut(const Work& p1, const Work& p2, const mpz_class& n1, const mpz_class& n2,
                  ClipPlane plane) const {
    Work out;
    const mpz_class far1 = abs(n1), far2 = abs(n2);
    mpz_class common;
    for (size_t i = 0; i < 3; ++i) {
        out.weight[i] = far2 * p1.weight[i] + far1 * p2.weight[i];
        common = gcd(common, out.weight[i]);
    }
    for (mpz_class& weight : out.weight) {
        mpz_divexact(weight.get_mpz_t(), weight.get_mpz_t(), common.get_mpz_t());
    }
    const mpz_class whole1 = whole_of(p1.weight), whole2 = whole_of(p2.weight);
    const Ball d1 = quotient(far1, whole1, triangle_.exponent);
    const Ball d2 = quotient(far2, whole2, triangle_.exponent);
    const mpz_class share1 = far2 * whole1, share2 = far1 * whole2, shares = share1 + share2;
    const Ball rest = quotient(share1, shares, 0), t = quotient(share2, shares, 0);
    const Ball more = larger(t, rest);
    const Ball eta1 = distance_error(p1, d1, plane), eta2 = distance_error(p2, d2, plane);
    const Ball sure = d1 + d2 - eta1 - eta2;
    out.is_bounded = p1.is_bounded && p2.is_bounded && is_positive(sure) == Answer::yes;
    Ball dt = 1;  // t stays in [0,1]
    if (out.is_bounded) {
        dt = smaller(dt, (rest * eta1 + t * eta2) / sure + Ball(4) * unit_ * more);
    }
    for (size_t k = 0; k < triangle_.components; ++k) {
        const Ball &a = p1.value[k], &b = p2.value[k];
        out.value[k] = rest * a + t * b;
        const Ball difference = magnitude(b - a);
        const Ball rounding =
            Ball(2) * unit_ * larger(more * difference, rest * magnitude(a) + t * magnitude(b));
        const Ball ends = Ball(p1.error[k]) + Ball(p2.error[k]);
        const Ball own = dt * (difference + ends) + rounding + unit_ * magnitude(out.value[k]);
        out.error[k] =
            at_most(Ball(std::max(p1.error[k], p2.error[k])) + own * (Ball(1) + Ball(16) * unit_));
    }
    return out;
}

// `d`: the vertices' distances from the plane.
std::vector<Work> Clipper::clip_by(const std::vector<Work>& polygon,
                                   const std::vector<mpz_class>& d, ClipPlane plane) const {
    std::vector<Work> out;
    const size_t n = polygon.size();
    out.reserve(n + 1);
    const auto label = static_cast<EdgeLabel>(kFirstClipEdge + static_cast<EdgeLabel>(plane));
    for (size_t i = 0; i < n; ++i) {
        const Work& a = polygon[i];
        const size_t next = (i + 1) % n;
        if (d[i] >= 0) {
            out.push_back(a);
            if (d[next] < 0) {
                if (d[i] == 0) {
                    out.back().edge = label;  // leaves at a itself
                } else {
                    out.push_back(cut(a, polygon[next], d[i], d[next], plane));
                    out.back().edge = label;
                }
            }
        } else if (d[next] > 0) {
            out.push_back(cut(a, polygon[next], d[i], d[next], plane));
            out.back().edge = a.edge;
        }
    }
    return out;
}

// Whether a device may find a cut corner inside of a plane that it is outside of, and draw it
// anywhere, since its w may be 0. That of a vertex of the triangle is the sign of one sum of two of
// its numbers, which no rounding turns.
bool Clipper::may_be_anywhere(const Work& p, const mpz_class& d, ClipPlane plane) const {
    const Ball far = quotient(abs(d), whole_of(p.weight), triangle_.exponent);
    const auto may_be = [](const Ball& number) { return is_positive(number) != Answer::yes; };
    return p.original < 0 && may_be(p.value[kW] - Ball(p.error[kW])) &&
           (!p.is_bounded || may_be(far - distance_error(p, far, plane)));
}

std::vector<Work> Clipper::clip(std::span<const ClipPlane> order, bool& is_sure) const {
    std::vector<Work> polygon = start_;
    for (const ClipPlane plane : order) {
        if (polygon.empty()) {
            break;
        }
        // An earlier plane may have cut off all that is outside of this one.
        std::vector<mpz_class> d;
        d.reserve(polygon.size());
        for (const Work& p : polygon) {
            d.push_back(distance(p, plane));
        }
        if (std::any_of(d.begin(), d.end(), [](const mpz_class& each) { return each < 0; })) {
            std::vector<Work> left = clip_by(polygon, d, plane);
            for (size_t i = 0; left.empty() && i < polygon.size(); ++i) {
                is_sure = is_sure && !may_be_anywhere(polygon[i], d[i], plane);
            }
            polygon = std::move(left);
        }
    }
    return polygon;
}

// The planes that cut something off, in their order. All points of the polygon, which is exact, are
// convex combinations of the triangle's vertices: a plane with these inside has all of them inside.
std::vector<ClipPlane> cutting_planes(const ClipInput& triangle,
                                      std::span<const ClipPlane> planes) {
    std::vector<ClipPlane> out;
    for (const ClipPlane& plane : planes) {
        if (!is_inside(triangle, std::span(&plane, 1))) {
            out.push_back(plane);
        }
    }
    return out;
}

// Takes the larger bound of the vertex of `other` between the same two edges.
void widen_by(std::vector<Work>& polygon, const std::vector<Work>& other) {
    const size_t n = polygon.size();
    const size_t m = other.size();
    for (size_t i = 0; i < n; ++i) {
        Work& p = polygon[i];
        const EdgeLabel in = polygon[(i + n - 1) % n].edge;
        for (size_t k = 0; k < m; ++k) {
            if (other[k].edge != p.edge || other[(k + m - 1) % m].edge != in) {
                continue;
            }
            p.is_bounded = p.is_bounded && other[k].is_bounded;
            for (size_t c = 0; c < p.error.size(); ++c) {
                p.error[c] = std::max(p.error[c], other[k].error[c]);
            }
        }
    }
}

mpq_class Clipper::axis_error(const Work& p, size_t c, float extent, float origin) const {
    const Ball half = Ball(static_cast<double>(extent)) * Ball(0.5);
    const Ball offset = Ball(static_cast<double>(origin)) + half;
    const Ball normalized = magnitude(p.value[c] / p.value[kW]);
    const Ball divided =
        (Ball(p.error[c]) + normalized * Ball(p.error[kW])) / (p.value[kW] - Ball(p.error[kW]));
    const Ball t = (normalized + divided) * magnitude(half);
    return at_most(divided * magnitude(half) +
                   rounding_bound(t, offset, t + magnitude(offset), unit_));
}

ClippedVertex Clipper::finished(const Work& p, const cases::Viewport& viewport) const {
    ClippedVertex v;
    v.is_bounded = p.is_bounded;
    v.original = p.original;
    v.edge = p.edge;
    const mpz_class whole = whole_of(p.weight);
    const mpq_class unit = power_of_two(triangle_.exponent);
    std::array<mpz_class, kCoordinates> n;
    for (size_t i = 0; i < 3; ++i) {
        v.weights[i] = fraction(p.weight[i], whole);
    }
    for (size_t c = 0; c < kCoordinates; ++c) {
        n[c] = weighted(p.weight, triangle_.n[c]);
        v.clip[c] = fraction(n[c], whole) * unit;
    }
    if (sgn(n[kW]) <= 0) {
        v.is_bounded = false;
        return v;
    }
    IdealPosition& out = v.position;
    out.inv_w = 1 / v.clip[kW];
    const mpq_class half_x = rational(viewport.width) / 2;
    const mpq_class half_y = rational(viewport.height) / 2;
    const mpq_class range = rational(viewport.max_depth) - rational(viewport.min_depth);
    out.x = half_x * fraction(n[kX], n[kW]) + rational(viewport.x) + half_x;
    out.y = half_y * fraction(n[kY], n[kW]) + rational(viewport.y) + half_y;
    out.z = range * fraction(n[kZ], n[kW]) + rational(viewport.min_depth);
    const size_t distances = triangle_.components - kCoordinates;
    v.ratio_error.resize(distances);
    for (size_t k = 0; k < distances; ++k) {
        v.ratio.push_back(fraction(weighted(p.weight, triangle_.n[kCoordinates + k]), n[kW]));
    }
    if (v.original >= 0) {
        return v;
    }
    const Ball sure = p.value[kW] - Ball(p.error[kW]);
    if (is_positive(sure) != Answer::yes) {
        v.is_bounded = false;
        return v;
    }
    v.error.x = axis_error(p, kX, viewport.width, viewport.x);
    v.error.y = axis_error(p, kY, viewport.height, viewport.y);
    for (size_t k = 0; k < distances; ++k) {
        const Ball ratio = magnitude(p.value[kCoordinates + k] / p.value[kW]);
        v.ratio_error[k] =
            at_most((Ball(p.error[kCoordinates + k]) + ratio * Ball(p.error[kW])) / sure);
    }
    return v;
}

}  // namespace

std::vector<ClippedVertex> clip_triangle(const ClipInput& triangle, const cases::Viewport& viewport,
                                         cases::Profile profile, std::span<const ClipPlane> planes,
                                         bool* is_sure) {
    const Clipper clipper(triangle, profile);
    // An order that has been cut in before gives the same polygon again.
    const std::vector<ClipPlane> order = cutting_planes(triangle, planes);
    bool is_empty_surely = true;
    std::vector<Work> polygon = clipper.clip(order, is_empty_surely);
    std::vector<ClipPlane> other_order = order;
    std::stable_partition(other_order.begin(), other_order.end(),
                          [](ClipPlane p) { return !is_user(p) && component_of(p) == kZ; });
    if (other_order != order) {
        widen_by(polygon, clipper.clip(other_order, is_empty_surely));
    }
    std::vector<ClipPlane> user_first = other_order;
    std::stable_partition(user_first.begin(), user_first.end(), is_user);
    if (user_first != other_order && user_first != order) {
        widen_by(polygon, clipper.clip(user_first, is_empty_surely));
    }
    std::vector<ClippedVertex> out;
    out.reserve(polygon.size());
    for (const Work& p : polygon) {
        out.push_back(clipper.finished(p, viewport));
    }
    if (is_sure != nullptr) {
        *is_sure = is_empty_surely || !out.empty();
    }
    return out;
}

}  // namespace ref
