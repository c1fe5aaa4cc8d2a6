// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which bases a profile admits (docs/precision.md, "Bases").
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "cases/model/sample.hpp"
#include "ref/number/edge_function.hpp"
#include "ref/position/clip.hpp"
#include "ref/position/viewport_grid.hpp"
#include "ref/value/accept/judge_candidates.hpp"

namespace ref::value {

namespace {

// Roundings of one clipped component: the difference, the product and the sum of the line between
// two vertices stay below 4u (|a| + |b|) <= 8u max for each plane that cuts (docs/precision.md).
constexpr double kClipRoundings = 8;

// All corner triangles of the three boxes: at most 64.
template <class T>
bool add_corner_triangles(const Primitive& primitive, const std::vector<PlaneInput<T>>& inputs,
                          const Limits& limits, cases::Profile profile, CandidateSet<T>& set) {
    std::vector<BoxCorners> choice;
    size_t count = 1;
    for (size_t i = 0; i < 3; ++i) {
        // A vertex behind the eye has the framebuffer position of its negative, and devices snap it
        // like any other when they set planes up from unclipped vertices.
        const glm::vec4& clip = primitive.clip[i];
        const std::optional<Box> box =
            position_box(clip.w < 0 ? -clip : clip, primitive.draw->viewport, limits, profile);
        if (!box) {
            return true;
        }
        choice.emplace_back(*box);
        count *= choice.back().size();
    }
    if (count == 1 && set.candidates.size() > 1) {
        return true;  // the nearest grid points only: already a candidate
    }
    Candidate<T> candidate;
    candidate.name = ref::BasisKind::snapped;
    int orientation = 0;
    for (const FixedPoint& a : choice[0]) {
        for (const FixedPoint& b : choice[1]) {
            for (const FixedPoint& c : choice[2]) {
                Basis<T> basis =
                    make_basis(moved_vertices<T>(primitive, {a, b, c}), inputs, kBudgetFactor);
                if (basis.orientation == 2) {
                    return false;
                }
                if (basis.orientation == 0 ||
                    (orientation != 0 && orientation != basis.orientation)) {
                    candidate.is_unbounded = true;
                }
                if (basis.orientation != 0) {
                    orientation = basis.orientation;
                    candidate.bases.push_back(std::move(basis));
                }
            }
        }
    }
    set.candidates.push_back(std::move(candidate));
    return true;
}

template <class T>
struct PieceVertex {
    T hx, hy, w;
    T ex, ey;              // pixels
    std::vector<T> h;      // of each plane
    std::vector<T> error;  // of each plane's g
    bool is_bounded = true;
};

// The vertices of the polygon clipped by `planes` as a device re-projects them with rounding errors
// of `roundoff`.
template <class T>
std::vector<PieceVertex<T>> piece_vertices(const Primitive& primitive,
                                           const std::vector<PlaneInput<T>>& inputs,
                                           const Vertices<T>& ideal, double roundoff,
                                           std::span<const ClipPlane> planes) {
    const cases::Viewport& viewport = primitive.draw->viewport;
    const ClipInput input(*primitive.draw, primitive.triangle.vertex);
    const std::vector<ClippedVertex> polygon =
        clip_triangle(input, viewport, cases::Profile::direct3d, planes);
    size_t cuts = 0;
    for (const ClipPlane& plane : planes) {
        cuts += is_inside(input, std::span(&plane, 1)) ? 0U : 1U;
    }
    const T u(roundoff);
    const T rounding = T(kClipRoundings * static_cast<double>(cuts)) * u;
    std::vector<PieceVertex<T>> out;
    for (const ClippedVertex& vertex : polygon) {
        PieceVertex<T> p;
        Triple<T> weight;
        glm::vec4 most(0.0F);  // largest magnitude among the vertices that contribute
        for (size_t i = 0; i < 3; ++i) {
            weight[i] = from_exact<T>(vertex.weights[i]);
            if (sgn(vertex.weights[i]) != 0) {
                most = glm::max(most, glm::abs(primitive.clip[i]));
            }
            p.hx = p.hx + weight[i] * ideal.hx[i];
            p.hy = p.hy + weight[i] * ideal.hy[i];
            p.w = p.w + weight[i] * ideal.w[i];
        }
        const bool is_original = vertex.original >= 0;
        const T ew = is_original ? T{} : T(rounding * from_float<T>(most.w));
        const T safe_w = p.w - ew - ew;
        if (is_positive(safe_w) != Answer::yes) {
            p.is_bounded = false;
            out.push_back(std::move(p));
            continue;
        }
        const T room = p.w - ew;
        const T sx = magnitude(T(static_cast<double>(viewport.width) / 2));
        const T sy = magnitude(T(static_cast<double>(viewport.height) / 2));
        const T xd = magnitude(from_exact<T>(mpq_class(vertex.clip[0] / vertex.clip[3])));
        const T yd = magnitude(from_exact<T>(mpq_class(vertex.clip[1] / vertex.clip[3])));
        if (is_original) {
            p.ex = ideal.ex[static_cast<size_t>(vertex.original)];
            p.ey = ideal.ey[static_cast<size_t>(vertex.original)];
        } else {
            // Divide and transform as in position.cpp: u (4|t| + |o| + 2|x_f| + 1).
            const T ox = magnitude(from_float<T>(viewport.x)) + sx;
            const T oy = magnitude(from_float<T>(viewport.y)) + sy;
            p.ex = sx * (rounding * from_float<T>(most.x) + xd * ew) / room +
                   u * (T(6.0) * sx * xd + T(3.0) * ox + T(1.0));
            p.ey = sy * (rounding * from_float<T>(most.y) + yd * ew) / room +
                   u * (T(6.0) * sy * yd + T(3.0) * oy + T(1.0));
        }
        for (size_t plane = 0; plane < inputs.size(); ++plane) {
            T h{};
            T largest{};
            for (size_t i = 0; i < 3; ++i) {
                h = h + weight[i] * inputs[plane].h[i];
                if (sgn(vertex.weights[i]) != 0) {
                    largest = larger(largest, T(magnitude(inputs[plane].h[i])));
                }
            }
            // The components that were clipped, h = g w (depth: viewport transform of z and w).
            T own = is_original ? T{} : T(rounding * largest);
            const T g = magnitude(T(h / p.w));
            if (plane == kPlaneInvW) {
                own = T{};  // h = 1 is not computed
            }
            T error = (own + g * ew) / room;
            if (plane == kPlaneDepth) {
                // z_d |p_z| and z_f are at most 1: 4u + u, the offset's clipping included in `own`.
                error = error + T(5.0) * u + T(2.0) * ew / room;
            }
            p.h.push_back(h);
            p.error.push_back(error);
        }
        out.push_back(std::move(p));
    }
    return out;
}

// Triangles of every fan of the polygon, each once.
std::vector<std::array<size_t, 3>> fan_triangles(size_t n) {
    std::vector<std::array<size_t, 3>> all;
    for (size_t hub = 0; hub < n; ++hub) {
        for (size_t k = 1; k + 1 < n; ++k) {
            std::array<size_t, 3> t = {hub, (hub + k) % n, (hub + k + 1) % n};
            std::sort(t.begin(), t.end());
            if (std::find(all.begin(), all.end(), t) == all.end()) {
                all.push_back(t);
            }
        }
    }
    return all;
}

// `grid`: additional movement of the piece's vertices when the device snaps after clipping, pixels.
template <class T>
bool add_pieces(const std::vector<PlaneInput<T>>& inputs,
                const std::vector<PieceVertex<T>>& polygon, const T& grid, bool with_unbounded,
                CandidateSet<T>& set) {
    for (const std::array<size_t, 3>& t : fan_triangles(polygon.size())) {
        Vertices<T> v;
        std::vector<PlaneInput<T>> in(inputs.size());
        bool is_bounded = true;
        for (size_t i = 0; i < 3; ++i) {
            const PieceVertex<T>& p = polygon[t[i]];
            is_bounded = is_bounded && p.is_bounded;
            if (!is_bounded) {
                break;
            }
            v.hx[i] = p.hx;
            v.hy[i] = p.hy;
            v.w[i] = p.w;
            v.finite[i] = true;
            v.ex[i] = p.ex + grid;
            v.ey[i] = p.ey + grid;
            for (size_t plane = 0; plane < inputs.size(); ++plane) {
                in[plane].h[i] = p.h[plane];
                in[plane].rounding = larger(in[plane].rounding, p.error[plane]);
            }
        }
        Candidate<T> candidate;
        candidate.name = ref::BasisKind::clipped_piece;
        if (!is_bounded) {
            if (with_unbounded) {
                candidate.is_unbounded = true;
                set.candidates.push_back(std::move(candidate));
                with_unbounded = false;  // once
            }
            continue;
        }
        Basis<T> basis = make_basis(v, in, kBudgetFactor);
        if (basis.orientation == 2) {
            return false;
        }
        if (basis.orientation == 0) {
            continue;
        }
        candidate.is_piece = true;
        candidate.bases.push_back(std::move(basis));
        set.candidates.push_back(std::move(candidate));
    }
    return true;
}

// Hull of the vertex values of every numeric quantity, of the clipped polygon if there is one, as a
// device with rounding errors of `roundoff` may have them.
template <class T>
std::vector<Range<T>> hulls_of(const Primitive& primitive, const std::vector<PlaneInput<T>>& inputs,
                               std::span<const Quantity> quantities,
                               const std::vector<PieceVertex<T>>& polygon, double roundoff) {
    std::vector<Range<T>> out(quantities.size());
    for (size_t q = 0; q < quantities.size(); ++q) {
        const Quantity& quantity = quantities[q];
        if (!is_numeric(quantity)) {
            continue;
        }
        bool is_first = true;
        const auto add = [&](const T& g) {
            out[q].low = is_first ? g : smaller(out[q].low, g);
            out[q].high = is_first ? g : larger(out[q].high, g);
            is_first = false;
        };
        if (quantity.id.is_attribute()) {
            // Attributes are convex combinations of the three, clipped or not.
            for (const float f :
                 attribute_values(primitive, quantity.id.attribute, quantity.id.component)) {
                add(from_float<T>(std::isfinite(f) ? f : 0.0F));  // as in plane_inputs()
            }
        } else if (polygon.empty()) {
            for (size_t i = 0; i < 3; ++i) {
                if (primitive.clip[i].w > 0) {
                    add(T(inputs[quantity.plane].h[i] / from_float<T>(primitive.clip[i].w)));
                }
            }
        } else {
            for (const PieceVertex<T>& p : polygon) {
                if (p.is_bounded) {
                    const T g = p.h[quantity.plane] / p.w;
                    add(T(g - p.error[quantity.plane]));
                    add(T(g + p.error[quantity.plane]));
                } else {
                    add(T(0.0));
                    add(T(quantity.plane == kPlaneDepth ? 1.0 : 0x1p127));
                }
            }
        }
        // The rounding of the vertex values themselves, where there is no plane to budget for.
        const T slack = T(16 * roundoff) * (magnitude(out[q].low) + magnitude(out[q].high));
        out[q].low = out[q].low - slack;
        out[q].high = out[q].high + slack;
    }
    return out;
}

bool has_border_between_pixels(const cases::Viewport& v) {
    return !is_on_viewport_grid(v.x, v.width, 0) || !is_on_viewport_grid(v.y, v.height, 0);
}

// Whether the vertices may be snapped to a line.
bool may_have_no_area(const Primitive& primitive, const Limits& limits, cases::Profile profile) {
    std::vector<BoxCorners> boxes;
    for (const glm::vec4& clip : primitive.clip) {
        const auto box = position_box(clip, primitive.draw->viewport, limits, profile);
        if (!box) {
            return true;
        }
        boxes.emplace_back(*box);
    }
    // The area is affine in each position, so that its extremes lie at corners.
    bool has_positive = false;
    bool has_negative = false;
    for (const FixedPoint& a : boxes[0]) {
        for (const FixedPoint& b : boxes[1]) {
            for (const FixedPoint& c : boxes[2]) {
                const Int128 area = edge_function(a, b, c);
                has_positive = has_positive || area >= 0;
                has_negative = has_negative || area <= 0;
            }
        }
    }
    return has_positive && has_negative;
}

// Nothing if T cannot tell an orientation.
template <class T>
std::optional<CandidateSet<T>> try_candidates(const Primitive& primitive,
                                              std::span<const Quantity> quantities,
                                              const Limits& limits, cases::Profile profile) {
    CandidateSet<T> set;
    bool is_known = true;
    set.factor = from_exact<T>(exact_budget_factor(profile));
    set.margin = T(std::ldexp(1.0, -limits.subpixel_bits));
    set.any_of_all = profile == cases::Profile::vulkan;
    // w of a visible point is a convex combination of the w_i.
    const float most_w = std::max({primitive.clip[0].w, primitive.clip[1].w, primitive.clip[2].w});
    set.least_inv_w = most_w > 0 ? T(T(1.0) / from_float<T>(most_w)) : T{};
    set.depth = make_depth_path<T>(primitive, profile);
    const std::vector<PlaneInput<T>> inputs = plane_inputs<T>(primitive, quantities);
    const Vertices<T> ideal = ideal_vertices<T>(primitive);
    const double roundoff = profile == cases::Profile::vulkan ? kVulkanRoundoff : kUnitRoundoff;
    std::vector<PieceVertex<T>> polygon, guarded;
    const ClipVolume volume = clip_volume_of(*primitive.draw);
    const ClipInput input(*primitive.draw, primitive.triangle.vertex);
    if (primitive.needs_clipping) {
        polygon = piece_vertices(primitive, inputs, ideal, roundoff, volume.all());
        if (!is_inside(input, volume.borders()) && !is_inside(input, volume.without_borders())) {
            guarded = piece_vertices(primitive, inputs, ideal, roundoff, volume.without_borders());
            for (PieceVertex<T>& p : guarded) {
                // Where a cut lies that is off by more, far outside and near w = 0, position and
                // values are off together, which bounds of each by itself do not show: they would
                // accept nearly anything. The corners in the view stand for such a piece.
                p.is_bounded = p.is_bounded && is_at_most(p.ex, set.margin) == Answer::yes &&
                               is_at_most(p.ey, set.margin) == Answer::yes;
            }
        }
    }
    // A clip distance may pass a sample that lies a little beyond the polygon it cuts, and a device
    // with a guard band one beyond a border between two pixels.
    const bool is_free_of_borders = primitive.needs_clipping &&
                                    has_border_between_pixels(primitive.draw->viewport) &&
                                    primitive.is_projectable;
    if (primitive.needs_clipping && (volume.has_user_planes() || is_free_of_borders)) {
        const std::span<const ClipPlane> planes =
            is_free_of_borders ? volume.depth() : volume.view();
        set.hulls = hulls_of(primitive, inputs, quantities,
                             is_inside(input, planes)
                                 ? std::vector<PieceVertex<T>>{}
                                 : piece_vertices(primitive, inputs, ideal, roundoff, planes),
                             roundoff);
    } else {
        set.hulls = hulls_of(primitive, inputs, quantities, polygon, roundoff);
    }

    const bool is_overestimated = primitive.draw->conservative == cases::Conservative::overestimate;
    set.covers_samples = !is_overestimated;
    const bool is_nothing_left = primitive.needs_clipping && polygon.empty();
    const bool is_large = cases::has_large_fragments(*primitive.draw);
    for (size_t q = 0; q < set.hulls.size(); ++q) {
        // The centre of a pixel that is covered, or of a fragment of several pixels, may lie
        // outside of the triangle, where values are extrapolated: nothing holds them in the range
        // of the vertices. And what roundings leave of a triangle, if clipping leaves nothing, has
        // corners anywhere on its edges.
        if (is_overestimated || (is_large && !quantities[q].at_sample) ||
            (is_nothing_left && !quantities[q].id.is_attribute())) {
            set.hulls[q] = {T(-0x1p127), T(0x1p127)};
        }
    }

    Basis<T> unsnapped = make_basis(ideal, inputs, kBudgetFactor);
    is_known = unsnapped.orientation != 2;
    const bool has_area = unsnapped.orientation == 1 || unsnapped.orientation == -1;
    if (has_area) {
        set.candidates.push_back({ref::BasisKind::unsnapped, {std::move(unsnapped)}, false, false});
    }
    const auto snapped = snapped_positions(primitive, limits);
    if (snapped) {
        Basis<T> basis = make_basis(moved_vertices<T>(primitive, *snapped), inputs, kBudgetFactor);
        is_known = is_known && basis.orientation != 2;
        if (basis.orientation == 1 || basis.orientation == -1) {
            set.candidates.push_back({ref::BasisKind::snapped, {std::move(basis)}, false, false});
        }
    }
    is_known = is_known && add_corner_triangles(primitive, inputs, limits, profile, set);
    if (primitive.needs_clipping) {
        if (profile == cases::Profile::vulkan) {
            // "a convex combination": the hull of the clipped polygon's vertices is all that the
            // text demands.
            set.candidates.push_back({ref::BasisKind::clipped_piece, {}, true, false});
        } else if (has_area) {
            is_known = is_known && add_pieces(inputs, polygon, T{}, true, set) &&
                       add_pieces(inputs, polygon, set.margin, false, set) &&
                       add_pieces(inputs, guarded, T{}, false, set) &&
                       add_pieces(inputs, guarded, set.margin, false, set);
        }
    }
    const bool may_gain_area =
        primitive.needs_clipping ||
        std::ranges::any_of(set.candidates, [](const auto& known) { return !known.bases.empty(); });
    if (!has_area && may_gain_area) {
        // A device covers the sample by the positions that it snaps, and may set its planes up from
        // those before: these have an area by roundings alone, of any size and sign, and the
        // sample need not lie between them. So such a plane has any value there; the weights of
        // the specification have the area for a denominator ("Basic Polygon Rasterization").
        set.candidates.push_back({ref::BasisKind::unsnapped, {}, false, false, true});
    }
    // Of a triangle that may have no area, values are those of the provoking vertex, and which
    // piece of a clipped one a pixel outside of all belongs to is not said.
    if (is_overestimated &&
        (primitive.needs_clipping || may_have_no_area(primitive, limits, profile))) {
        set.candidates.push_back({ref::BasisKind::unsnapped, {}, false, false, true});
    }
    if (is_nothing_left && profile != cases::Profile::vulkan) {
        set.candidates.push_back(
            {ref::BasisKind::clipped_piece, {}, true, false});  // see the hulls
    }
    if (set.candidates.empty()) {
        set.candidates.push_back({ref::BasisKind::unsnapped, {}, true, false});
    }
    return is_known ? std::optional(std::move(set)) : std::nullopt;
}

}  // namespace

template <class T>
CandidateSet<T> make_candidates(const Primitive& primitive, std::span<const Quantity> quantities,
                                const Limits& limits, cases::Profile profile) {
    auto set = try_candidates<T>(primitive, quantities, limits, profile);
    if constexpr (std::is_same_v<T, Ball>) {
        return set ? *std::move(set)
                   : rounded(make_candidates<mpq_class>(primitive, quantities, limits, profile));
    } else {
        return std::move(set).value();
    }
}

template CandidateSet<Ball> make_candidates<Ball>(const Primitive&, std::span<const Quantity>,
                                                  const Limits&, cases::Profile);
template CandidateSet<mpq_class> make_candidates<mpq_class>(const Primitive&,
                                                            std::span<const Quantity>,
                                                            const Limits&, cases::Profile);

}  // namespace ref::value
