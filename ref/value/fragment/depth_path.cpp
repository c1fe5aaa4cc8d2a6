// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/fragment/depth_path.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ref/number/rational.hpp"
#include "ref/position/clip.hpp"
#include "ref/position/position.hpp"

namespace ref::value {

namespace {

// Roundings of the bias: slope times m, constant times r, their sum, and one for a unit that is not
// formed as a power of two. Each is at most u of |m slope| + |r constant|.
constexpr double kBiasRoundings = 4;

// The largest |z_f| of some vertices as a device has it.
struct Largest {
    mpq_class least, most;
    void add(const mpq_class& z, const mpq_class& slack) {
        least = std::max<mpq_class>(least, z * (1 - slack));
        most = std::max<mpq_class>(most, z * (1 + slack));
    }
};

// Above all depths of a primitive whose range of z has no end.
constexpr double kEndless = 0x1p127;

// Whether z_f has no bound on the triangle: a vertex is behind the eye, so that w passes through 0,
// and no depth plane cuts before. One that cuts just there leaves a corner whose z/w is 0/0.
bool is_endless(const Primitive& primitive) {
    if (primitive.is_projectable) {
        return false;
    }
    const ClipVolume volume = clip_volume_of(*primitive.draw);
    const auto planes = volume.depth();
    const ClipInput input(*primitive.draw, primitive.triangle.vertex);
    return planes.empty() ||
           std::ranges::any_of(
               clip_triangle(input, primitive.draw->viewport, cases::Profile::direct3d, planes),
               [](const ClippedVertex& c) { return c.clip[3] == 0; });
}

// Those of the vertices, of those of the clipped polygon, and of either after depth clamp. z_f of a
// vertex is off by at most five roundings (quantities.cpp) of terms up to 1; relative to the
// largest z that may be a few more when near and far cancel, and 16 leaves room. It is not off at
// all where w is a power of two and the viewport's range is 0 to 1.
std::vector<Largest> largest_depths(const Primitive& primitive, cases::Profile profile) {
    const cases::Viewport& v = primitive.draw->viewport;
    const mpq_class low = rational(std::min(v.min_depth, v.max_depth));
    const mpq_class high = rational(std::max(v.min_depth, v.max_depth));
    // z_f = range z_d + near ("Controlling the Viewport").
    const bool is_symmetric = primitive.draw->depth.negative_one_to_one;
    mpq_class range = rational(v.max_depth) - rational(v.min_depth);
    mpq_class near = rational(v.min_depth);
    if (is_symmetric) {
        range /= 2;
        near = (rational(v.max_depth) + rational(v.min_depth)) / 2;
    }
    const bool is_identity = range == 1 && near == 0;
    const mpq_class rounded =
        profile == cases::Profile::vulkan ? mpq_class(16, 100000) : mpq_class(16, 16777216);
    Largest whole, whole_clamped, cut;
    const auto clamped = [&](const mpq_class& z) {
        return std::min<mpq_class>(std::max<mpq_class>(z, low), high);
    };
    for (const glm::vec4& clip : primitive.clip) {
        if (clip.w > 0) {
            const bool is_exact =
                profile != cases::Profile::vulkan && is_identity && is_power_of_two(clip.w);
            const mpq_class slack = is_exact ? mpq_class(0) : rounded;
            const mpq_class z = range * rational(clip.z) / rational(clip.w) + near;
            whole.add(abs(z), slack);
            whole_clamped.add(abs(clamped(z)), slack);
        }
    }
    std::vector<Largest> out{whole};
    if (primitive.draw->depth.clamp) {
        out.push_back(whole_clamped);
    }
    if (primitive.needs_clipping) {
        const ClipInput input(*primitive.draw, primitive.triangle.vertex);
        const ClipVolume volume = clip_volume_of(*primitive.draw);
        for (const ClippedVertex& c :
             clip_triangle(input, v, cases::Profile::direct3d, volume.all())) {
            if (c.clip[3] > 0) {
                const bool is_exact =
                    c.original >= 0 && profile != cases::Profile::vulkan && is_identity &&
                    is_power_of_two(primitive.clip.at(static_cast<size_t>(c.original)).w);
                cut.add(abs(range * c.clip[2] / c.clip[3] + near),
                        is_exact ? mpq_class(0) : rounded);
            }
        }
        out.push_back(cut);
    }
    return out;
}

bool has_exponent(const mpq_class& z) {
    return z.get_d() >= 0x1p-126;
}

// 2^(e - 23), e the exponent of z >= 0 as a binary32; the least denormal where z is denormal or 0.
double unit_at(const mpq_class& z) {
    return has_exponent(z) ? std::ldexp(1.0, std::ilogb(z.get_d()) - 23)  // truncated: e is right
                           : 0x1p-149;
}

// The largest r that a device has where no depth has an exponent: "the exponent of 0" is what it
// says it is. An NVIDIA H200 has this one there (docs/findings/nvidia-bias-floor.md).
constexpr double kUnitOfNoExponent = 0x1p-125;

// Whether r is a step of fixed point, one for the whole attachment.
bool has_constant_unit(cases::DepthFormat format, const cases::DepthBias& bias) {
    using Representation = cases::DepthBiasRepresentation;
    return bias.representation == Representation::force_unorm ||
           (bias.representation == Representation::format &&
            format != cases::DepthFormat::d32_float);
}

// 2^-n; n: bits of the format, "or the number of mantissa bits plus one" of a floating-point one.
double constant_unit(cases::DepthFormat format) {
    return format == cases::DepthFormat::d16_unorm ? 0x1p-16 : 0x1p-24;
}

// r, and in `nominal` what it is where vertices and clipped polygon agree.
template <class T>
Range<T> unit_of(const Primitive& primitive, cases::Profile profile, T& nominal) {
    const cases::DepthFormat format = primitive.depth_format;
    const cases::DepthBias& bias = *primitive.draw->depth.bias;
    if (bias.representation == cases::DepthBiasRepresentation::floating) {
        nominal = T(1.0);
        return {T(1.0), T(1.0)};
    }
    if (has_constant_unit(format, bias)) {
        const double least = constant_unit(format);
        nominal = T(least);
        return bias.is_exact ? Range<T>{T(least), T(least)} : Range<T>{T(0.0), T(2 * least)};
    }
    mpq_class least, most;
    bool is_first = true;
    for (const Largest& largest : largest_depths(primitive, profile)) {
        least = is_first ? largest.least : std::min<mpq_class>(least, largest.least);
        most = std::max<mpq_class>(most, largest.most);
        is_first = false;
    }
    // "the range of z values spanned by the primitive": of the triangle as it is, that has no end.
    const double high = is_endless(primitive) ? unit_at(kEndless)
                        : has_exponent(least) ? unit_at(most)
                                              : std::max(unit_at(most), kUnitOfNoExponent);
    nominal = T(unit_at(most));
    return {T(least == 0 ? 0.0 : unit_at(least)), T(high)};
}

// A bound from above on the square root.
double root_above(const mpq_class& a) {
    return std::sqrt(a.get_d() * (1 + 0x1p-50)) * (1 + 0x1p-50) + 0x1p-500;
}
double root_above(const Ball& a) {
    return std::sqrt(std::max(0.0, a.v + a.e)) * (1 + 0x1p-50) + 0x1p-500;
}

template <class T>
struct Slope {
    T x, y, ex, ey;  // gradient and its error
};

// The gradients are differences of vertex values divided by the determinant: off by the budget that
// a step of one pixel has, 2u max_k b_k, and by the error of the vertex values (Plane::constant)
// through each barycentric gradient.
template <class T>
Slope<T> slope_of(const Basis<T>& basis, const T& factor) {
    const Plane<T>& plane = basis.planes[kPlaneDepth];
    Slope<T> s;
    T bx{}, by{}, sum_x{}, sum_y{};
    for (size_t k = 0; k < plane.bx.size(); ++k) {
        bx = larger(bx, plane.bx[k]);
        by = larger(by, plane.by[k]);
    }
    for (const Form<T>& b : basis.bary) {
        sum_x = sum_x + magnitude(b.x);
        sum_y = sum_y + magnitude(b.y);
    }
    s.x = magnitude(plane.form.x);
    s.y = magnitude(plane.form.y);
    s.ex = factor * (T(2 * kUnitRoundoff) * bx + plane.constant * sum_x);
    s.ey = factor * (T(2 * kUnitRoundoff) * by + plane.constant * sum_y);
    return s;
}

template <class T>
Range<T> times(float f, const Range<T>& r) {
    const T scale(static_cast<double>(f));
    return f < 0 ? Range<T>{T(scale * r.high), T(scale * r.low)}
                 : Range<T>{T(scale * r.low), T(scale * r.high)};
}

}  // namespace

template <class T>
DepthPath<T> make_depth_path(const Primitive& primitive, cases::Profile profile) {
    DepthPath<T> path;
    const cases::Viewport& v = primitive.draw->viewport;
    path.format = primitive.depth_format;
    path.bias = primitive.draw->depth.bias;
    path.is_clamped = primitive.draw->depth.clamp;
    path.is_max_norm = profile == cases::Profile::direct3d;
    path.viewport = {static_cast<double>(std::min(v.min_depth, v.max_depth)),
                     static_cast<double>(std::max(v.min_depth, v.max_depth))};
    if (path.bias) {
        path.unit = unit_of<T>(primitive, profile, path.nominal_unit);
    }
    return path;
}

template <class T>
Range<T> bias_of(const DepthPath<T>& path, const Basis<T>& basis, const T& factor) {
    if (!path.bias) {
        return {};
    }
    const Slope<T> s = slope_of(basis, factor);
    Range<T> m;
    m.low = larger(larger(T(s.x - s.ex), T(s.y - s.ey)), T(0.0));
    const T high_x = s.x + s.ex;
    const T high_y = s.y + s.ey;
    m.high = path.is_max_norm ? larger(high_x, high_y)
                              : T(root_above(T(high_x * high_x + high_y * high_y)));
    const Range<T> sloped = times(path.bias->slope, m);
    const Range<T> constant = times(path.bias->constant, path.unit);
    // s - k |s| grows with s for k < 1, so that the least sum is off by its own roundings.
    const T k = factor * T(kBiasRoundings * kUnitRoundoff);
    Range<T> o{
        T(sloped.low + constant.low - k * (magnitude(sloped.low) + magnitude(constant.low))),
        T(sloped.high + constant.high + k * (magnitude(sloped.high) + magnitude(constant.high)))};
    const T clamp(static_cast<double>(path.bias->clamp));
    if (path.bias->clamp > 0) {
        o = {smaller(o.low, clamp), smaller(o.high, clamp)};
    } else if (path.bias->clamp < 0) {
        o = {larger(o.low, clamp), larger(o.high, clamp)};
    }
    return o;
}

mpq_class nominal_bias(const DepthPath<mpq_class>& path, const Basis<mpq_class>& basis) {
    if (!path.bias) {
        return 0;
    }
    const Form<mpq_class>& form = basis.planes[kPlaneDepth].form;
    const mpq_class m = larger(magnitude(form.x), magnitude(form.y));
    const mpq_class o =
        m * rational(path.bias->slope) + path.nominal_unit * rational(path.bias->constant);
    const mpq_class clamp = rational(path.bias->clamp);
    return clamp > 0 ? smaller(o, clamp) : clamp < 0 ? larger(o, clamp) : o;
}

template DepthPath<Ball> make_depth_path<Ball>(const Primitive&, cases::Profile);
template DepthPath<mpq_class> make_depth_path<mpq_class>(const Primitive&, cases::Profile);
template Range<Ball> bias_of<Ball>(const DepthPath<Ball>&, const Basis<Ball>&, const Ball&);
template Range<mpq_class> bias_of<mpq_class>(const DepthPath<mpq_class>&, const Basis<mpq_class>&,
                                             const mpq_class&);

}  // namespace ref::value
