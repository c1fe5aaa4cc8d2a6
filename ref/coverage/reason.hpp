// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Why a sample is covered as it is. Whatever decides a sample names its reasons; what each of them
// is called, and which rule it is, stands in one table (ref/expectation/reason_table.hpp).
#pragma once

#include <cstdint>
#include <vector>

namespace ref {

enum class Coverage : uint8_t { must_not, either, must };

// In the order in which several reasons for one answer are told. `which` of a Reason is what stands
// behind the name, if anything.
enum class ReasonKind : uint8_t {
    // must be covered
    top_left_in,           // on an edge that owns it; the edge's label
    passes_cull_distance,  // inside, and no cull distance is negative at all vertices
    passes_clip_distance,  // inside, and no clip distance is negative
    inside,                // wherever the vertices may lie
    // must not be covered
    other_layer,    // the draw goes to another layer
    masked,         // a sample mask of the draw leaves the sample out
    scissor,        // outside the scissor rectangle or the target
    viewport,       // outside the viewport
    discarded,      // the draw has rasterizer discard
    outside,        // outside an edge, wherever its ends may lie; the edge, 0 to 2
    outside_hull,   // outside all that the positions of the vertices span
    no_area,        // on a triangle that has no area once it is snapped
    top_left_out,   // on an edge that does not own it; the edge's label
    culled,         // by its face
    cull_distance,  // the number of the distance
    clip_distance,  // cut off by a clip distance; its number
    clip_plane,     // cut off by a plane of the view volume; a ClipPlane
    // may be covered
    undefined,        // a vertex beyond what the profile promises anything of
    unbounded,        // a vertex of the clipped polygon may be anywhere
    near_distance,    // a clip distance is 0 within its error; its number
    open_facing,      // culled or not, as the vertices snap
    viewport_border,  // within a pixel of a viewport's fractional border
    on_edge,          // exactly, and no rule of the profile decides it; the edge's label
    vertex_boxes,     // inside for some positions of the vertices only; an edge's label or kNothing
    // may be covered by itself, but the triangles of a set share a number of hits
    complement,     // clip distances and their negatives
    clipped_edge,   // shared edges that are clipped
    shared_vertex,  // a vertex that all of them have
    shared_edge
};
inline constexpr ReasonKind kLastReason = ReasonKind::shared_edge;

inline constexpr uint8_t kNothing = 0xff;

struct Reason {
    ReasonKind kind = ReasonKind::outside_hull;
    uint8_t which = kNothing;
    friend auto operator<=>(const Reason&, const Reason&) = default;
};

// Each once, in the order of telling. Of a sample that must not be covered each one alone is
// enough, of one that may be covered each one alone leaves it open, and one that must be covered
// has one.
using Reasons = std::vector<Reason>;

// What is said of one triangle at one sample.
struct Decision {
    Coverage coverage = Coverage::must_not;
    Reasons reasons;
};

inline void add_reason(Reasons& reasons, Reason reason) {
    for (const Reason& r : reasons) {
        if (r == reason) {
            return;
        }
    }
    reasons.push_back(reason);
}

}  // namespace ref
