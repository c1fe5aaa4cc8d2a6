// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What of a triangle does not depend on the sample. A device may draw a triangle from one of up to
// six outlines: the triangle as it is (cut by the depth planes only, if it has to be: a guard band
// with an exact viewport scissor), and, if it leaves the view volume, the polygon clipped against
// all planes; either of them cut by the clip distances, or not cut by them and the distances tested
// at each sample; and, if a depth plane cuts it, the two not cut by these and the depth tested at
// each sample. Each vertex of an outline is a box of positions.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/coverage.hpp"
#include "ref/coverage/pixel_area.hpp"
#include "ref/coverage/vertex_boxes.hpp"
#include "ref/coverage/window.hpp"
#include "ref/number/edge_function.hpp"
#include "ref/number/fixed_point.hpp"
#include "ref/position/clip.hpp"
#include "ref/position/limits.hpp"
#include "ref/position/position.hpp"

namespace ref {

// How the samples of an outline are decided.
enum class OutlineMode : uint8_t {
    empty,    // covers nothing
    snapped,  // every grid point of the boxes is tried, with the top-left rule (profile direct3d)
    boxes,    // must: inside for every choice of positions; must not: outside the hull of the boxes
};
inline constexpr int64_t kMaxCandidates = 64;

// How an edge between two boxes is tested for `must` in mode boxes.
enum class EdgeTest : uint8_t {
    strict,    // strictly inside for every choice of its ends
    parallel,  // strictly inside the line that runs as the edge between the middles of the boxes,
               // and has both boxes on its outer side
    top_left,  // between two points that every device has (profile direct3d): the top-left rule
};

// A clip distance, or the depth against a depth plane, that is tested at each sample
// (ref/coverage/distance_cut.hpp): inside `may` it may pass, inside `must` it passes whatever the
// device's freedom.
struct DistanceCut {
    HalfPlane may, must;
    std::optional<ClipPlane> plane = {};  // nothing: none in particular
};

// Holds the boxes of an outline in one piece. Nearly every outline is a triangle, and there may be
// hundreds of thousands: the first three are kept in place, all of them elsewhere once there are
// more.
class BoxList {
  public:
    BoxList() = default;
    BoxList(const BoxList& other) { *this = other; }
    BoxList(BoxList&&) noexcept = default;
    BoxList& operator=(BoxList&&) noexcept = default;
    BoxList& operator=(const BoxList& other) {
        near_ = other.near_;
        all_ = other.all_ ? std::make_unique<All>(*other.all_) : nullptr;
        return *this;
    }
    ~BoxList() = default;

    Box& operator[](size_t i) {
        if (i >= kNear && !all_) {
            all_ = std::make_unique<All>();
            std::copy(near_.begin(), near_.end(), all_->begin());
        }
        return all_ ? (*all_)[i] : near_[i];
    }
    // One that has been written to.
    const Box& operator[](size_t i) const { return data()[i]; }
    const Box* data() const { return all_ ? all_->data() : near_.data(); }

  private:
    static constexpr size_t kNear = 3;
    using All = std::array<Box, kMaxClippedVertices>;
    std::array<Box, kNear> near_{};
    std::unique_ptr<All> all_;
};

struct Outline {
    OutlineMode mode = OutlineMode::empty;
    bool is_on_grid = true;                             // every corner of the boxes is a grid point
    uint32_t count = 0;                                 // vertices, at most kMaxClippedVertices
    BoxList boxes;                                      // in the order of the triangle
    std::array<EdgeLabel, kMaxClippedVertices> edge{};  // from vertex i to the next
    // The same with neighbours whose boxes overlap drawn together into one box: what `must` is
    // decided by in mode boxes, and empty in the others. Edges inside such a box cannot separate it
    // from the rest.
    uint32_t must_count = 0;
    BoxList must_boxes;
    // The test of the edge from box i to the next.
    std::array<EdgeTest, kMaxClippedVertices> must_test{};
    std::array<int8_t, kMaxClippedVertices> tie_side{};  // top_left: sign of E for the other boxes
    std::vector<DistanceCut> cuts;
    // How many corners of the triangle lie on a plane that cuts it (ref/coverage/pieces.hpp).
    uint32_t cut_corners = 0;

    std::span<const Box> vertices() const { return {boxes.data(), count}; }
    std::span<const Box> must_vertices() const { return {must_boxes.data(), must_count}; }
};

// Whether it has three corners that lie apart, and edges of the triangle between them.
bool is_plain_triangle(const Outline& o);

// The outlines of a triangle that a device may use, one to six.
class OutlineList {
  public:
    static constexpr size_t kMaxOutlines = 6;
    void add(const Outline* o) { list_[count_++] = o; }
    const Outline* const* begin() const { return list_.data(); }
    const Outline* const* end() const { return list_.data() + count_; }
    const Outline* operator[](size_t k) const { return list_.at(k); }
    size_t size() const { return count_; }

  private:
    std::array<const Outline*, kMaxOutlines> list_{};
    size_t count_ = 0;
};

struct TriangleSetup {
    enum class Kind : uint8_t {
        nothing,   // culled or outside
        outlines,  // decided by the outlines
        anywhere,  // undefined position: any sample of the window, or none
        cleared,   // every sample of the window, which is a rectangle of a clear
    };
    Kind kind = Kind::nothing;
    bool is_clipped = false;   // a vertex lies outside the clip volume
    bool has_outline = false;  // `unclipped` is meaningful
    Outline unclipped;         // cut by the depth planes and clip distances only
    // Cut by all planes; only if is_clipped. Few triangles have one, and it is large.
    std::shared_ptr<Outline> clipped;
    // Not cut by the clip distances, or not by the depth planes, which are tested at each sample;
    // empty where none of them matters.
    std::vector<Outline> tested;
    int8_t tested_unclipped = -1, tested_clipped = -1;  // into `tested`; -1: as if cut
    int64_t grid_step = 1;                              // S47.16 units of one subpixel
    int orientation = 0;  // sign of the area for every choice of positions; 0 if it depends
    Facing facing = Facing::depends;  // before culling
    bool can_be_front = false;        // drawn so, after culling
    bool can_be_back = false;
    bool may_be_culled = false;
    bool is_culled = false;  // by its face
    Window window;
    PixelArea area;        // if the draw is conservative
    bool is_flat = false;  // it has no area before its vertices are snapped
    Reasons reasons;       // of `kind`, but for is_culled; only if set up to be told

    OutlineList outlines() const;

    // The faces that a fragment may show. A further piece of an overestimated triangle may be
    // folded or have no area, and show another one than its triangle, unless that face is culled.
    struct Faces {
        bool front = false, back = false;
    };
    Faces faces(bool is_further) const {
        return is_further && area.is_over() ? drawn_faces : Faces{can_be_front, can_be_back};
    }
    Faces drawn_faces;  // those that the draw does not cull
};

// What is cut off by a plane of the clip volume.
inline Reason reason_of_plane(ClipPlane plane) {
    return plane >= ClipPlane::user_0
               ? Reason{ReasonKind::clip_distance,
                        static_cast<uint8_t>(static_cast<uint8_t>(plane) -
                                             static_cast<uint8_t>(ClipPlane::user_0))}
               : Reason{ReasonKind::clip_plane, static_cast<uint8_t>(plane)};
}

// `is_told`: also why nothing is drawn or anything may be. A triangle beyond a plane of the view
// volume then has the outline that it would have without planes.
TriangleSetup set_up(const cases::Case& c, const cases::Triangle& triangle, const Limits& limits,
                     cases::Profile profile, VertexBoxes& boxes, const Window& window,
                     bool is_told = false);

// Computes a position in the middle of a box, which need not lie on a grid.
FixedPoint middle_of(const Box& box);

// The grid points that a box in mode snapped contains.
std::vector<FixedPoint> grid_points(const Box& box, int64_t step);

// Calls body(polygon) for every polygon that an outline in mode snapped may be.
template <class Body>
void for_each_candidate(const Outline& o, int64_t step, const Body& body) {
    if (o.count != 3) {
        std::vector<FixedPoint> polygon;
        for (const Box& b : o.vertices()) {
            polygon.push_back({b.x0, b.y0});
        }
        body(std::span<const FixedPoint>(polygon));
        return;
    }
    for_each_choice(grid_points(o.boxes[0], step), grid_points(o.boxes[1], step),
                    grid_points(o.boxes[2], step),
                    [&](const auto& a, const auto& b, const auto& c) {
                        body(std::span<const FixedPoint>(std::array{a, b, c}));
                    });
}

}  // namespace ref
