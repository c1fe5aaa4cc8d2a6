// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/fragment/quantities.hpp"

#include <algorithm>
#include <cmath>

#include "cases/model/rule_ids.hpp"
#include "cases/model/sample.hpp"
#include "ref/number/fixed_point.hpp"
#include "ref/number/rational.hpp"
#include "ref/position/clip.hpp"
#include "ref/position/position_detail.hpp"
#include "ref/value/fragment/shading_rate.hpp"

namespace ref::value {

namespace {

struct ProbeRow {
    cases::Probe probe;
    std::string_view rule = {};
    std::optional<Derivative> derivative = {};
};

// In the order of cases::Probe.
constexpr auto kProbes = [] {
    using P = cases::Probe;
    using enum Fineness;
    namespace rule = cases::rule;
    return std::to_array<ProbeRow>({
        {P::value},
        {P::at_centroid, rule::interp_at_centroid},
        {P::at_sample, rule::interp_at_sample},
        {P::at_offset, rule::interp_at_offset},
        {P::dx, rule::derivative_plain, Derivative{true, false, plain}},
        {P::dy, rule::derivative_plain, Derivative{false, true, plain}},
        {P::dx_fine, rule::derivative_fine, Derivative{true, false, fine}},
        {P::dy_fine, rule::derivative_fine, Derivative{false, true, fine}},
        {P::dx_coarse, rule::derivative_coarse, Derivative{true, false, coarse}},
        {P::dy_coarse, rule::derivative_coarse, Derivative{false, true, coarse}},
        {P::width, rule::derivative_plain, Derivative{true, true, plain}},
        {P::width_fine, rule::derivative_fine, Derivative{true, true, fine}},
        {P::width_coarse, rule::derivative_coarse, Derivative{true, true, coarse}},
        {P::lod, rule::lod_query},
    });
}();

constexpr const ProbeRow& row_of(cases::Probe probe) {
    return kProbes.at(static_cast<size_t>(probe));
}
static_assert(std::all_of(kProbes.begin(), kProbes.end(),
                          [](const ProbeRow& row) { return &row == &row_of(row.probe); }));

// Viewport transform: x_f = scale x_d + offset (Vulkan specification, "Controlling the Viewport").
template <class T>
struct Transform {
    T scale_x, scale_y, scale_z, offset_x, offset_y, offset_z;
};

template <class T>
Transform<T> transform_of(const cases::Draw& draw) {
    const cases::Viewport& v = draw.viewport;
    const T x(static_cast<double>(v.x));
    const T y(static_cast<double>(v.y));
    const T near(static_cast<double>(v.min_depth));
    const T far(static_cast<double>(v.max_depth));
    Transform<T> t;
    t.scale_x = T(static_cast<double>(v.width) / 2);  // exact: a power of two
    t.scale_y = T(static_cast<double>(v.height) / 2);
    t.scale_z = far - near;
    t.offset_x = x + t.scale_x;
    t.offset_y = y + t.scale_y;
    t.offset_z = near;
    if (draw.depth.negative_one_to_one) {
        // VK_EXT_depth_clip_control: p_z = (max - min)/2, o_z = (max + min)/2
        t.scale_z = t.scale_z * T(0.5);
        t.offset_z = (far + near) * T(0.5);
    }
    return t;
}

// Round half to even of a rational, in units of 2^-bits, as S47.16.
std::optional<int64_t> snap(const mpq_class& pixels, int bits) {
    const mpq_class scaled = pixels * mpq_class(uint64_t{1} << bits);
    mpz_class floor = floor_of(scaled);
    const mpq_class rest = scaled - floor;
    const int half = cmp(rest, mpq_class(1, 2));
    if (half > 0 || (half == 0 && mpz_odd_p(floor.get_mpz_t()) != 0)) {
        floor += 1;
    }
    const mpz_class fixed = floor << static_cast<mp_bitcnt_t>(kFixedBits - bits);
    if (abs(fixed) > (mpz_class(1) << (32 + kFixedBits))) {
        return std::nullopt;
    }
    return fixed.get_si();
}

// The same for a vertex, in binary64: half extent * c / w + offset. Nothing if the nearest grid
// point is not proven. Products of two binary32 are exact; the quotient, the offset and the sum
// are each off by at most 2^-53 of |quotient| + |offset|, and 2^-50 of it is more than all three.
std::optional<int64_t> snap_fast(float c, float w, float origin, float extent, int bits) {
    const double half = static_cast<double>(extent) / 2;
    const double quotient = half * static_cast<double>(c) / static_cast<double>(w);
    const double offset = static_cast<double>(origin) + half;
    const double scale = std::ldexp(1.0, bits);
    const double error = (std::fabs(quotient) + std::fabs(offset)) * scale * 0x1p-50 + 0x1p-900;
    const double scaled = (quotient + offset) * scale;
    if (!(std::fabs(scaled) < 0x1p31 * scale) || !(error < 0x1p-4)) {
        return std::nullopt;
    }
    const double floor = std::floor(scaled);
    const double from_tie = scaled - floor - 0.5;  // its sign is right: |scaled| < 2^47
    if (!(std::fabs(from_tie) > error)) {
        return std::nullopt;
    }
    const auto nearest = static_cast<int64_t>(floor) + (from_tie > 0 ? 1 : 0);
    return nearest * (int64_t{1} << (kFixedBits - bits));
}

// The quantity of an attribute whose source is a sample built-in.
bool set_sample_source(cases::Source source, Quantity& q) {
    struct Row {
        cases::Source source;
        Kind kind;
        std::string_view rule;
    };
    using enum cases::Source;
    static constexpr Row kRows[] = {
        {sample_mask_in, Kind::sample_mask, cases::rule::sample_mask_in},
        {sample_id, Kind::sample_id, cases::rule::sample_id},
        {sample_position, Kind::sample_position, cases::rule::sample_id},
        {shading_rate, Kind::shading_rate, cases::rule::fragment_size_rate}};
    const Row* const row = std::ranges::find(kRows, source, &Row::source);
    if (row == std::end(kRows)) {
        return false;
    }
    q.kind = row->kind;
    q.rule = row->rule;
    return true;
}

// at-centroid is an input that is evaluated elsewhere, all others are functions of their own.
void set_probe(const cases::Attribute& attribute, bool multisampled, Quantity& q) {
    if (attribute.probe == cases::Probe::value) {
        return;
    }
    q.rule = row_of(attribute.probe).rule;
    if (attribute.probe == cases::Probe::at_centroid) {
        q.at_sample = false;
        q.at_centroid = multisampled;
        return;
    }
    q.is_perspective = q.kind == Kind::perspective;
    q.kind = Kind::probe;
    q.probe = attribute.probe;
}

// `plane`: the next one that is free.
Quantity attribute_quantity(const cases::Draw& draw, size_t a, uint32_t c, bool multisampled,
                            uint32_t& plane) {
    const cases::Attribute& attribute = draw.attributes[a];
    Quantity q;
    q.id = QuantityId::of_attribute(a, c);
    if (set_sample_source(attribute.source, q)) {
        return q;
    }
    switch (attribute.interpolation) {
        case cases::Interpolation::smooth:
            q.kind = Kind::perspective;
            q.rule = cases::rule::interp_perspective;
            q.plane = plane++;
            break;
        case cases::Interpolation::noperspective:
            q.kind = Kind::linear;
            q.rule = cases::rule::interp_linear;
            q.plane = plane++;
            break;
        case cases::Interpolation::flat:
            q.kind = Kind::flat;
            q.rule = cases::rule::interp_flat;
            break;
    }
    if (multisampled && q.kind != Kind::flat) {
        q.at_sample = attribute.auxiliary == cases::Auxiliary::sample;
        q.at_centroid = attribute.auxiliary == cases::Auxiliary::centroid;
        q.rule = q.at_sample     ? cases::rule::interp_sample
                 : q.at_centroid ? cases::rule::interp_centroid
                                 : q.rule;
    }
    if (q.kind != Kind::flat) {
        set_probe(attribute, multisampled, q);
    }
    if (attribute.source == cases::Source::barycentric) {
        q.rule = cases::rule::barycentric_value;
    }
    return q;
}

}  // namespace

std::optional<Derivative> derivative_of(cases::Probe probe) {
    return row_of(probe).derivative;
}

std::vector<Quantity> quantities(const cases::Draw& draw, const cases::Target& target) {
    // With one sample in the centre of a fragment the sample is where everything is evaluated.
    const bool is_large = has_large_fragments(draw);
    const bool multisampled = target.samples > 1 || !target.sample_locations.empty() || is_large;
    const bool is_shaded = shading_rate(draw, target.samples) != ShadingRate::fragment;
    const std::string_view xy = is_large    ? cases::rule::fragment_size_area
                                : is_shaded ? cases::rule::fragcoord_sample
                                            : cases::rule::fragcoord_xy;
    std::vector<Quantity> all;
    all.push_back({Kind::pixel_centre, false, 0, QuantityId::of_frag_coord(0), xy});
    all.push_back({Kind::pixel_centre, false, 0, QuantityId::of_frag_coord(1), xy});
    all.push_back({Kind::linear, false, kPlaneDepth, QuantityId::of_frag_coord(2),
                   cases::rule::depth_linear});
    all.push_back(
        {Kind::linear, false, kPlaneInvW, QuantityId::of_frag_coord(3), cases::rule::fragcoord_w});
    if (replaces_depth(draw)) {
        // Of all samples the same: a number, or gl_FragCoord.z.
        const Kind kind = draw.frag_depth->is_coord ? Kind::linear : Kind::written_depth;
        const uint32_t plane = draw.frag_depth->is_coord ? kPlaneDepth : 0;
        all.push_back({kind, false, plane, QuantityId{}, cases::rule::depth_written});
    } else {
        all.push_back(
            {Kind::linear, multisampled, kPlaneDepth, QuantityId{}, cases::rule::depth_linear});
    }
    uint32_t plane = kPlaneDepth + 1;
    for (size_t a = 0; a < draw.attributes.size(); ++a) {
        for (uint32_t c = 0; c < draw.attributes[a].components; ++c) {
            all.push_back(attribute_quantity(draw, a, c, multisampled, plane));
        }
    }
    return all;
}

Primitive make_primitive(const cases::Case& c, const cases::Triangle& triangle,
                         const Limits& limits) {
    Primitive p;
    p.first_strip_order = limits.first_strip_order;
    p.draw = &c.draws[triangle.draw];
    p.triangle = triangle;
    p.depth_format = c.target.depth_format;
    p.is_finite = true;
    p.is_projectable = true;
    const ClipVolume volume = clip_volume_of(*p.draw);
    const ClipInput input(*p.draw, triangle.vertex);
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec4 v = p.draw->positions[triangle.vertex[i]];
        p.clip[i] = v;
        const bool finite = is_representable(v, cases::Profile::direct3d);
        p.is_finite = p.is_finite && finite;
        p.is_projectable = p.is_projectable && finite && v.w > 0;
    }
    p.needs_clipping = !is_inside(input, volume.all());
    return p;
}

// The barycentric built-ins interpolate unit vectors: vertex k of the order has a 1 in component k.
// The order is the triangle's, turned so that the provoking vertex is its first, or its last with
// the last vertex convention (Vulkan specification, "Barycentric Interpolation", the tables for
// list, strip and fan). A strip's triangles are assembled in the order of the first table, odd ones
// with their second and third vertex swapped, and a device may say that it keeps that order
// (triStripVertexOrderIndependentOfProvokingVertex).
Triple<float> barycentric_values(const Primitive& primitive, uint32_t component) {
    const cases::Triangle& t = primitive.triangle;
    uint32_t provoking = 0;
    for (uint32_t i = 0; i < 3; ++i) {
        if (t.vertex[i] == t.provoking) {
            provoking = i;
            break;
        }
    }
    const bool is_last = primitive.draw->provoking == cases::ProvokingVertex::last;
    if (is_last && primitive.first_strip_order &&
        primitive.draw->topology == cases::Topology::triangle_strip) {
        provoking = 2;
    }
    const uint32_t first = (provoking + (is_last ? 1U : 0U)) % 3;
    Triple<float> out{};
    out[(first + component) % 3] = 1.0F;
    return out;
}

Triple<float> attribute_values(const Primitive& primitive, uint32_t attribute, uint32_t component) {
    if (primitive.draw->attributes[attribute].source == cases::Source::barycentric) {
        return barycentric_values(primitive, component);
    }
    Triple<float> out{};
    for (size_t i = 0; i < 3; ++i) {
        out[i] = primitive.draw->attributes[attribute]
                     .values[primitive.triangle.vertex[i]]
                            [static_cast<glm::vec4::length_type>(component)];
    }
    return out;
}

namespace {

// transform_error (position.cpp) of the coordinate c of a vertex.
template <class T>
T coordinate_error(float c, float w, float origin, float extent) {
    if (is_transform_exact(c, w, origin, extent)) {
        return T(0.0);
    }
    const T half(static_cast<double>(extent) / 2);
    const T offset = T(static_cast<double>(origin)) + half;
    const T t = from_float<T>(c) / from_float<T>(w) * half;
    T error = rounding_bound(t, offset, T(t + offset), T(kUnitRoundoff));
    error =
        error + T(0x1p-120) * T(T(1.0) + magnitude(half)) * T(T(1.0) + magnitude(from_float<T>(c)));
    return std::abs(w) > 0x1p125F ? T(error + magnitude(t)) : error;
}

}  // namespace

template <class T>
Vertices<T> ideal_vertices(const Primitive& primitive) {
    const auto t = transform_of<T>(*primitive.draw);
    Vertices<T> v;
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec4& c = primitive.clip[i];
        v.w[i] = from_float<T>(c.w);
        v.hx[i] = t.scale_x * from_float<T>(c.x) + t.offset_x * v.w[i];
        v.hy[i] = t.scale_y * from_float<T>(c.y) + t.offset_y * v.w[i];
        v.finite[i] = c.w > 0 || c.w < 0;
        if (v.finite[i]) {
            const cases::Viewport& p = primitive.draw->viewport;
            v.ex[i] = coordinate_error<T>(c.x, c.w, p.x, p.width);
            v.ey[i] = coordinate_error<T>(c.y, c.w, p.y, p.height);
        }
    }
    return v;
}

template <class T>
Vertices<T> moved_vertices(const Primitive& primitive, const std::array<FixedPoint, 3>& at) {
    Vertices<T> v;
    for (size_t i = 0; i < 3; ++i) {
        v.w[i] = from_float<T>(primitive.clip[i].w);
        v.finite[i] = true;
        v.hx[i] = T(pixels(at[i].x)) * v.w[i];
        v.hy[i] = T(pixels(at[i].y)) * v.w[i];
    }
    return v;
}

template <class T>
std::vector<PlaneInput<T>> plane_inputs(const Primitive& primitive,
                                        std::span<const Quantity> quantities) {
    const auto t = transform_of<T>(*primitive.draw);
    std::vector<PlaneInput<T>> in(2);
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec4& c = primitive.clip[i];
        const T w = from_float<T>(c.w);
        in[kPlaneInvW].h[i] = T(1.0);
        const T scaled = t.scale_z * from_float<T>(c.z);  // p_z z_d w
        in[kPlaneDepth].h[i] = scaled + t.offset_z * w;
        if (c.w > 0 || c.w < 0) {
            // z_d = z/w: u, or 2u as z * (1/w); p_z rounded: u; the product: u; the sum: u |z_f|.
            const T z = magnitude(T(in[kPlaneDepth].h[i] / w));
            T e = T(kUnitRoundoff) * (T(4.0) * magnitude(T(scaled / w)) + z);
            if (primitive.draw->depth.negative_one_to_one) {
                e = e + T(kUnitRoundoff) * magnitude(t.offset_z);  // o_z is a sum
            }
            in[kPlaneDepth].rounding = larger(in[kPlaneDepth].rounding, e);
        }
    }
    for (const Quantity& q : quantities) {
        if (!q.id.is_attribute() || !has_plane(q)) {
            continue;
        }
        Triple<float> f = attribute_values(primitive, q.id.attribute, q.id.component);
        for (float& value : f) {
            value = std::isfinite(value) ? value : 0.0F;  // nothing is asked of it (promises_of)
        }
        PlaneInput<T> plane;
        for (size_t i = 0; i < 3; ++i) {
            plane.h[i] = is_quotient(q)
                             ? from_float<T>(f[i])
                             : T(from_float<T>(f[i]) * from_float<T>(primitive.clip[i].w));
        }
        in.push_back(plane);
    }
    return in;
}

std::optional<std::array<FixedPoint, 3>> snapped_positions(const Primitive& primitive,
                                                           const Limits& limits) {
    const cases::Viewport& viewport = primitive.draw->viewport;
    const auto snap_axis = [&](float c, float w, float origin, float extent) {
        const int bits = limits.subpixel_bits;
        if (const auto fast = snap_fast(c, w, origin, extent, bits); fast) {
            return fast;
        }
        const auto half = mpq_class(from_float<mpq_class>(extent) / 2);
        const auto offset = mpq_class(from_float<mpq_class>(origin) + half);
        return snap(mpq_class(half * from_float<mpq_class>(c) / from_float<mpq_class>(w) + offset),
                    bits);
    };
    std::array<FixedPoint, 3> out;
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec4& clip = primitive.clip[i];
        if (!(clip.w > 0 || clip.w < 0)) {
            return std::nullopt;
        }
        const auto x = snap_axis(clip.x, clip.w, viewport.x, viewport.width);
        const auto y = snap_axis(clip.y, clip.w, viewport.y, viewport.height);
        if (!x || !y) {
            return std::nullopt;
        }
        out[i] = {*x, *y};
    }
    return out;
}

template Vertices<Ball> ideal_vertices<Ball>(const Primitive&);
template Vertices<mpq_class> ideal_vertices<mpq_class>(const Primitive&);
template Vertices<Ball> moved_vertices<Ball>(const Primitive&, const std::array<FixedPoint, 3>&);
template Vertices<mpq_class> moved_vertices<mpq_class>(const Primitive&,
                                                       const std::array<FixedPoint, 3>&);
template std::vector<PlaneInput<Ball>> plane_inputs<Ball>(const Primitive&,
                                                          std::span<const Quantity>);
template std::vector<PlaneInput<mpq_class>> plane_inputs<mpq_class>(const Primitive&,
                                                                    std::span<const Quantity>);

}  // namespace ref::value
