// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a triangle's fragments carry, and the vertices as each basis has them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/triangle.hpp"
#include "ref/number/plane_budget.hpp"
#include "ref/position/limits.hpp"
#include "ref/position/position.hpp"
#include "ref/value/fragment/fragment.hpp"

namespace ref::value {

// The planes of every basis: 0 is 1/w, 1 is depth, then one a smooth or noperspective component.
inline constexpr uint32_t kPlaneInvW = 0;
inline constexpr uint32_t kPlaneDepth = 1;

enum class Kind : uint8_t {
    linear,
    perspective,
    flat,
    // One of a few exact numbers (sample_values.hpp).
    pixel_centre,  // FragCoord.xy
    sample_mask,   // gl_SampleMaskIn
    sample_id,
    sample_position,
    shading_rate,   // gl_ShadingRateEXT
    written_depth,  // that the fragment shader writes, stored
    probe,          // made of an input by a function (probe.hpp)
};

// A scalar of a fragment, and how it is judged.
struct Quantity {
    Kind kind = Kind::linear;
    bool at_sample = false;  // evaluated at the sample; otherwise where the fragment's inputs are
    uint32_t plane = 0;      // linear and perspective
    QuantityId id;
    std::string_view rule;  // of a mismatch that stays inside the hull
    bool at_centroid = false;
    cases::Probe probe = cases::Probe::value;  // of Kind::probe
    bool is_perspective = false;               // likewise: of the input that it looks at
    float get(const FragmentValues& device) const { return number_of(device, id); }
};

// The largest error among the values of a fragment.
struct WorstError {
    double ratio = 0;                    // in budgets
    std::optional<QuantityId> quantity;  // which value has it; nothing while ratio is 0

    void raise(double other, const Quantity& of) {
        if (other > ratio) {
            *this = {other, of.id};
        }
    }
};

// Whether a quantity is itself interpolated by a plane.
inline bool is_numeric(const Quantity& q) {
    return q.kind == Kind::linear || q.kind == Kind::perspective;
}
// Whether a quantity has a plane of its own, and whether that plane's value is divided by 1/w.
inline bool has_plane(const Quantity& q) {
    return is_numeric(q) || q.kind == Kind::probe;
}
inline bool is_quotient(const Quantity& q) {
    return q.kind == Kind::perspective || (q.kind == Kind::probe && q.is_perspective);
}

// What derivative a probe asks for, if any.
enum class Fineness : uint8_t { plain, fine, coarse };
struct Derivative {
    bool has_x = false, has_y = false;  // both: fwidth
    Fineness fineness = Fineness::plain;
};
std::optional<Derivative> derivative_of(cases::Probe probe);

// All quantities of a draw, in the order in which mismatches are told.
std::vector<Quantity> quantities(const cases::Draw& draw, const cases::Target& target);

// What is known of one triangle exactly in binary32, or is cheap to have.
struct Primitive {
    const cases::Draw* draw = nullptr;
    cases::Triangle triangle;
    cases::DepthFormat depth_format = cases::DepthFormat::d32_float;
    std::array<glm::vec4, 3> clip{};
    bool is_finite = false;          // is_representable() at the profiles beyond vulkan
    bool is_projectable = false;     // and w > 0
    bool needs_clipping = false;     // a vertex is outside the clip volume
    bool first_strip_order = false;  // Limits
};
Primitive make_primitive(const cases::Case& c, const cases::Triangle& triangle,
                         const Limits& limits = {});

// Vertex values g_i of a plane that come straight from the case (attributes); not for 1/w and z.
Triple<float> attribute_values(const Primitive& primitive, uint32_t attribute, uint32_t component);

// The vertices at their ideal positions. `ex` and `ey` bound the device's rounding of them.
template <class T>
Vertices<T> ideal_vertices(const Primitive& primitive);
// The vertices moved to given positions, S47.16, which are exact, so ex = ey = 0.
template <class T>
Vertices<T> moved_vertices(const Primitive& primitive, const std::array<FixedPoint, 3>& at);

// The homogeneous vertex values h_i of all planes.
template <class T>
std::vector<PlaneInput<T>> plane_inputs(const Primitive& primitive,
                                        std::span<const Quantity> quantities);

// The nearest grid points of the three vertices; nothing if one has w = 0 or is farther than 2^32
// pixels. A vertex with w < 0 has one, too: its projected position is snapped.
std::optional<std::array<FixedPoint, 3>> snapped_positions(const Primitive& primitive,
                                                           const Limits& limits);

}  // namespace ref::value
