// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Why a sample must, must not or may be covered, in exact arithmetic a reader can check by hand.
// Slow and independent of the fast path: it works one sample at a time.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/coverage.hpp"
#include "ref/depth/outcome.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/position/limits.hpp"
#include "ref/position/position.hpp"
#include "ref/value/value.hpp"

namespace ref {

enum class EdgeKind : uint8_t { top, left, bottom, right };
std::string_view to_string(EdgeKind kind);

// One edge of a triangle with nearest snapping, in the order that makes the area positive.
struct EdgeExplanation {
    uint32_t from = 0, to = 0;  // vertex numbers in the draw
    FixedPoint a, b;            // snapped end points, S47.16
    mpq_class value;            // E_ab(p) in square pixels; > 0 is inside
    EdgeKind kind = EdgeKind::top;
};

struct TriangleExplanation {
    uint32_t index = 0;  // into assemble(case)
    cases::Triangle triangle;
    Coverage coverage =
        Coverage::must_not;              // under the asked profile, scissor and culling included
    bool culled = false;                 // faces away for every allowed position
    bool is_discarded = false;           // by rasterizer discard of its draw
    bool in_layer = true;                // its draw goes to the sample's layer
    bool in_scissor = true;              // of its draw
    bool in_viewport = true;             // of its draw
    bool in_mask = true;                 // of its draw
    bool is_undefined = false;           // a vertex is beyond what the profile promises anything of
    bool needs_clipping = false;         // a vertex lies outside the view volume
    bool has_distances = false;          // of clipping
    bool culled_by_distance = false;     // it could cover the sample but for its cull distances
    bool clipped_by_distance = false;    // or but for its clip distances
    bool near_distance = false;          // only its clip distances leave the sample open
    bool has_area = true;                // with nearest snapping
    bool on_edge = false;                // some E is 0 and no E is negative, with nearest snapping
    bool on_vertex = false;              // the sample equals a snapped vertex
    bool on_grid = false;                // every vertex may be in one place only
    std::vector<EdgeExplanation> edges;  // three; none if a vertex has no snapped position
    std::string reason;                  // one sentence
    // Of a triangle that may cover the sample, if the case tests depth.
    std::optional<DepthOutcome> depth;
    DepthReason depth_reason = DepthReason::ranges;
    std::string depth_text;  // one sentence
};

struct SampleExplanation {
    FixedPoint position;
    bool in_layer = true;                        // at least one draw goes to its layer
    bool in_scissor = true;                      // of at least one of these draws
    bool in_viewport = true;                     // of at least one of them
    SampleExpectation expectation;               // of the whole case
    std::vector<TriangleExplanation> triangles;  // those within two pixels of the sample
};

// Explains a sample of a case. Layer, pixel and sample must lie inside the target.
SampleExplanation explain_sample(const cases::Case& c, const Limits& limits, cases::Profile profile,
                                 cases::SampleId sample);

// A fixed-point coordinate as a decimal fraction or "p/q" when that is shorter: "10.5", "2753/256".
std::string to_text(int64_t fixed);
std::string to_text(const mpq_class& value);

}  // namespace ref
