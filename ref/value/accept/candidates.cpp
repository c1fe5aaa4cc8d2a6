// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which bases a profile admits (docs/precision.md, "Bases").
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "cases/model/sample.hpp"
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
    bool is_known = true;
    for_each_choice(
        choice[0], choice[1], choice[2], [&](const auto& a, const auto& b, const auto& c) {
            Basis<T> basis =
                make_basis(moved_vertices<T>(primitive, {a, b, c}), inputs, kBudgetFactor);
            is_known = is_known && basis.orientation != 2;
            candidate.is_unbounded = candidate.is_unbounded || basis.orientation == 0 ||
                                     (orientation != 0 && orientation != basis.orientation);
            if (basis.orientation != 0) {
                orientation = basis.orientation;
                candidate.bases.push_back(std::move(basis));
            }
        });
    if (!is_known) {
        return false;
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

// A vertex of a clipped polygon, of which `rounding` bounds what clipping loses, relative.
template <class T>
PieceVertex<T> piece_vertex(const Primitive& primitive, const std::vector<PlaneInput<T>>& inputs,
                            const Vertices<T>& ideal, const ClippedVertex& vertex, const T& u,
                            const T& rounding) {
    const cases::Viewport& viewport = primitive.draw->viewport;
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
        return p;
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
    return p;
}

// The vertices of the polygon clipped by `planes` as a device re-projects them with rounding errors
// of `roundoff`.
template <class T>
std::vector<PieceVertex<T>> piece_vertices(const Primitive& primitive,
                                           const std::vector<PlaneInput<T>>& inputs,
                                           const Vertices<T>& ideal, double roundoff,
                                           std::span<const ClipPlane> planes) {
    const ClipInput input(*primitive.draw, primitive.triangle.vertex);
    const std::vector<ClippedVertex> polygon =
        clip_triangle(input, primitive.draw->viewport, cases::Profile::direct3d, planes);
    size_t cuts = 0;
    for (const ClipPlane& plane : planes) {
        cuts += is_inside(input, std::span(&plane, 1)) ? 0U : 1U;
    }
    const T u(roundoff);
    const T rounding = T(kClipRoundings * static_cast<double>(cuts)) * u;
    std::vector<PieceVertex<T>> out;
    for (const ClippedVertex& vertex : polygon) {
        out.push_back(piece_vertex(primitive, inputs, ideal, vertex, u, rounding));
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
    std::vector<Box> boxes;
    for (const glm::vec4& clip : primitive.clip) {
        const auto box = position_box(clip, primitive.draw->viewport, limits, profile);
        if (!box) {
            return true;
        }
        boxes.push_back(*box);
    }
    const auto [low, high] = area_range(boxes[0], boxes[1], boxes[2]);
    return low <= 0 && high >= 0;
}

// Makes the set of one triangle and profile.
template <class T>
class CandidateMaker {
  public:
    CandidateMaker(const Primitive& primitive, std::span<const Quantity> quantities,
                   const Limits& limits, cases::Profile profile)
        : primitive_(primitive),
          quantities_(quantities),
          limits_(limits),
          profile_(profile),
          inputs_(plane_inputs<T>(primitive, quantities)),
          ideal_(ideal_vertices<T>(primitive)),
          roundoff_(profile == cases::Profile::vulkan ? kVulkanRoundoff : kUnitRoundoff),
          volume_(clip_volume_of(*primitive.draw)),
          input_(*primitive.draw, primitive.triangle.vertex),
          is_overestimated_(primitive.draw->conservative == cases::Conservative::overestimate) {
        set_.factor = from_exact<T>(exact_budget_factor(profile));
        set_.margin = T(std::ldexp(1.0, -limits.subpixel_bits));
        set_.any_of_all = profile == cases::Profile::vulkan;
        // w of a visible point is a convex combination of the w_i.
        const float most_w =
            std::max({primitive.clip[0].w, primitive.clip[1].w, primitive.clip[2].w});
        set_.least_inv_w = most_w > 0 ? T(T(1.0) / from_float<T>(most_w)) : T{};
        set_.depth = make_depth_path<T>(primitive, profile);
        set_.covers_samples = !is_overestimated_;
    }

    // Nothing if T cannot tell an orientation.
    std::optional<CandidateSet<T>> make() {
        clip();
        make_hulls();
        if (!add_bases()) {
            return std::nullopt;
        }
        add_unbounded();
        return std::move(set_);
    }

  private:
    void clip() {
        if (primitive_.needs_clipping) {
            polygon_ = piece_vertices(primitive_, inputs_, ideal_, roundoff_, volume_.all());
            if (!is_inside(input_, volume_.borders()) &&
                !is_inside(input_, volume_.without_borders())) {
                guarded_ = piece_vertices(primitive_, inputs_, ideal_, roundoff_,
                                          volume_.without_borders());
                for (PieceVertex<T>& p : guarded_) {
                    // Where a cut lies that is off by more, far outside and near w = 0, position
                    // and values are off together, which bounds of each by itself do not show: they
                    // would accept nearly anything. The corners in the view stand for such a piece.
                    p.is_bounded = p.is_bounded && is_at_most(p.ex, set_.margin) == Answer::yes &&
                                   is_at_most(p.ey, set_.margin) == Answer::yes;
                }
            }
        }
        is_nothing_left_ = primitive_.needs_clipping && polygon_.empty();
    }

    void make_hulls() {
        // A clip distance may pass a sample that lies a little beyond the polygon_ it cuts, and a
        // device with a guard band one beyond a border between two pixels.
        const bool is_free_of_borders = primitive_.needs_clipping &&
                                        has_border_between_pixels(primitive_.draw->viewport) &&
                                        primitive_.is_projectable;
        if (primitive_.needs_clipping && (volume_.has_user_planes() || is_free_of_borders)) {
            const std::span<const ClipPlane> planes =
                is_free_of_borders ? volume_.depth() : volume_.view();
            set_.hulls =
                hulls_of(primitive_, inputs_, quantities_,
                         is_inside(input_, planes)
                             ? std::vector<PieceVertex<T>>{}
                             : piece_vertices(primitive_, inputs_, ideal_, roundoff_, planes),
                         roundoff_);
        } else {
            set_.hulls = hulls_of(primitive_, inputs_, quantities_, polygon_, roundoff_);
        }
        const bool is_large = cases::has_large_fragments(*primitive_.draw);
        for (size_t q = 0; q < set_.hulls.size(); ++q) {
            // The centre of a pixel that is covered, or of a fragment of several pixels, may lie
            // outside of the triangle, where values are extrapolated: nothing holds them in the
            // range of the vertices. And what roundings leave of a triangle, if clipping leaves
            // nothing, has corners anywhere on its edges.
            if (is_overestimated_ || (is_large && !quantities_[q].at_sample) ||
                (is_nothing_left_ && !quantities_[q].id.is_attribute())) {
                set_.hulls[q] = {T(-0x1p127), T(0x1p127)};
            }
        }
    }

    // The basis at these positions, if it has an area; false if T cannot tell.
    bool add_basis(ref::BasisKind name, const Vertices<T>& at) {
        Basis<T> basis = make_basis(at, inputs_, kBudgetFactor);
        const int orientation = basis.orientation;
        if (orientation == 1 || orientation == -1) {
            set_.candidates.push_back({name, {std::move(basis)}, false, false});
        }
        return orientation != 2;
    }

    bool add_bases() {
        bool is_known = add_basis(ref::BasisKind::unsnapped, ideal_);
        has_area_ = !set_.candidates.empty();
        if (const auto snapped = snapped_positions(primitive_, limits_)) {
            is_known =
                add_basis(ref::BasisKind::snapped, moved_vertices<T>(primitive_, *snapped)) &&
                is_known;
        }
        is_known = is_known && add_corner_triangles(primitive_, inputs_, limits_, profile_, set_);
        if (primitive_.needs_clipping && profile_ == cases::Profile::vulkan) {
            // "a convex combination": the hull of the clipped polygon's vertices is all that the
            // text demands.
            set_.candidates.push_back({ref::BasisKind::clipped_piece, {}, true, false});
        } else if (primitive_.needs_clipping && has_area_) {
            is_known = is_known && add_pieces(inputs_, polygon_, T{}, true, set_) &&
                       add_pieces(inputs_, polygon_, set_.margin, false, set_) &&
                       add_pieces(inputs_, guarded_, T{}, false, set_) &&
                       add_pieces(inputs_, guarded_, set_.margin, false, set_);
        }
        return is_known;
    }

    // Where there is no plane to speak of.
    void add_unbounded() {
        const bool may_gain_area = primitive_.needs_clipping ||
                                   std::ranges::any_of(set_.candidates, [](const auto& known) {
                                       return !known.bases.empty();
                                   });
        if (!has_area_ && may_gain_area) {
            // A device covers the sample by the positions that it snaps, and may set_ its planes up
            // from those before: these have an area by roundings alone, of any size and sign, and
            // the sample need not lie between them. So such a plane has any value there; the
            // weights of the specification have the area for a denominator ("Basic Polygon
            // Rasterization").
            set_.candidates.push_back({ref::BasisKind::unsnapped, {}, false, false, true});
        }
        // Of a triangle that may have no area, values are those of the provoking vertex, and which
        // piece of a clipped one a pixel outside of all belongs to is not said.
        if (is_overestimated_ &&
            (primitive_.needs_clipping || may_have_no_area(primitive_, limits_, profile_))) {
            set_.candidates.push_back({ref::BasisKind::unsnapped, {}, false, false, true});
        }
        if (is_nothing_left_ && profile_ != cases::Profile::vulkan) {
            set_.candidates.push_back(
                {ref::BasisKind::clipped_piece, {}, true, false});  // see the hulls
        }
        if (set_.candidates.empty()) {
            set_.candidates.push_back({ref::BasisKind::unsnapped, {}, true, false});
        }
    }

    const Primitive& primitive_;
    std::span<const Quantity> quantities_;
    const Limits& limits_;
    cases::Profile profile_;
    std::vector<PlaneInput<T>> inputs_;
    Vertices<T> ideal_;
    double roundoff_;
    ClipVolume volume_;
    ClipInput input_;
    bool is_overestimated_;
    bool is_nothing_left_ = false;  // of a triangle that is clipped
    bool has_area_ = false;         // at the ideal positions
    std::vector<PieceVertex<T>> polygon_, guarded_;
    CandidateSet<T> set_;
};

}  // namespace

template <class T>
CandidateSet<T> make_candidates(const Primitive& primitive, std::span<const Quantity> quantities,
                                const Limits& limits, cases::Profile profile) {
    auto set = CandidateMaker<T>(primitive, quantities, limits, profile).make();
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
