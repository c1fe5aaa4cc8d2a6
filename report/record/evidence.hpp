// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a reader needs to check a picture by hand: where the triangles and samples lie, and what the
// device wrote at a sample beside what was allowed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cases/base/fields.hpp"

namespace report {

// A plane of the clip volume that cuts a triangle, as it is seen on the screen: a vertex's distance
// from it over its w is (a x + b y + c) / d at framebuffer position (x, y), in whole numbers of any
// length, d > 0. What is negative there is cut off (where w > 0).
struct PlaneCut {
    uint8_t plane = 0;  // ref::ClipPlane; 7 and more: clip distance 0, ...
    std::array<std::string, 4> abcd;
    static void fields(auto&& visit, auto&... c) {
        visit("plane", c.plane...);
        visit("abcd", c.abcd...);
    }
    friend bool operator==(const PlaneCut&, const PlaneCut&) = default;
};

// One assembled triangle.
struct Shape {
    uint32_t draw = 0, primitive = 0;  // gl_PrimitiveID
    uint32_t layer = 0;                // that it goes to; coordinates are those of the layer
    std::array<uint32_t, 3> vertex{};  // numbers in the draw
    // x0, y0, x1, y1, x2, y2 after snapping to the nearest subpixel position, in 2^-16 pixels
    // (ref/number/sample.hpp); meaningless unless has_points.
    std::array<int64_t, 6> points{};
    bool has_points = false;  // false: a vertex has no position on screen (w <= 0, not finite)
    bool is_exact = false;    // every vertex may be in this one place only
    bool is_clipped = false;  // reaches out of the clip volume, clip distances included
    // Then: corners of what is left of it, x and y in pixels, rounded. Empty if nothing is.
    std::vector<double> piece;
    std::vector<PlaneCut> cuts;  // then: the planes beyond which a vertex lies
    // x0, y0, x1, y1 of the positions that a device may have for each vertex, in 2^-16 pixels;
    // empty if is_exact, or where a vertex may be anywhere.
    std::vector<std::array<int64_t, 4>> boxes;
    friend bool operator==(const Shape&, const Shape&) = default;
};

// Where everything lies.
struct Geometry {
    uint32_t width = 0, height = 0, samples = 1;  // of all layers, stacked; 0: nothing is known
    std::vector<std::array<uint8_t, 2>> sample_locations;  // in 1/16 pixel, one a sample
    std::vector<Shape> triangles;                          // those that the picture shows, capped
    uint64_t triangle_total = 0;                           // of the case
    std::vector<std::array<int64_t, 4>> scissors;  // x, y, width, height; of the first draws
    // x0, y0, x1, y1 of the viewports as exact fractions, "25/2"; one a draw. x0 > x1 or y0 > y1:
    // the viewport is turned over.
    std::vector<std::array<std::string, 4>> viewports;
    // x0, y0, x1, y1 of a blit's regions in texels; empty for a case with draws.
    std::vector<std::array<int64_t, 4>> blit_regions;  // source, destination
    static void fields(auto&& visit, auto&... g) {
        visit("width", g.width...);
        visit("height", g.height...);
        visit("samples", g.samples...);
        visit("locations", g.sample_locations...);
        visit("triangles", g.triangles...);
        visit("triangle_total", g.triangle_total...);
        visit("scissors", g.scissors...);
        visit({"viewports", cases::kOlderLackIt}, g.viewports...);
        visit("blit", g.blit_regions...);
    }
    friend bool operator==(const Geometry&, const Geometry&) = default;
};
inline constexpr size_t kMaxShapes = 512;
inline constexpr size_t kMaxReferenceShapes = 24;  // with the reference of a case that passes

// One value of a fragment.
struct SampleValue {
    std::string quantity;      // "attribute 0.x", "depth", "frag_coord.w"
    std::string exact;         // as a fraction where it is short
    double nearest = 0;        // the exact value rounded to binary64
    double budget = 0;         // one budget, absolute; 0 if it is compared bit for bit
    double low = 0, high = 0;  // what is accepted, all set-ups together
    std::string also;          // "or 1.375": other numbers that are right where bits are compared
    bool has_device = false;   // the device wrote it
    uint32_t bits = 0;         // then: the binary32 that it wrote
    static void fields(auto&& visit, auto&... v) {
        visit("quantity", v.quantity...);
        visit("exact", v.exact...);
        visit("nearest", v.nearest...);
        visit("budget", v.budget...);
        visit("low", v.low...);
        visit("high", v.high...);
        visit("also", v.also...);
        visit("has_device", v.has_device...);
        visit("bits", v.bits...);
    }
    friend bool operator==(const SampleValue&, const SampleValue&) = default;
};

struct SampleEvidence {
    std::array<uint32_t, 3> at{};     // x, row of the stacked layers, sample
    std::string writer;               // the triangle that wrote last, as the device says
    std::string allowed;              // the hits that are allowed here
    std::string hits;                 // what the device's hit counter says
    std::vector<SampleValue> values;  // of the writer, or of the triangle that ought to be it
    // What becomes of the triangles there, in drawing order: "triangle 0 of draw 1" and a sentence
    // on its discard or on one of its tests. Only of a case that discards or tests.
    std::vector<std::pair<std::string, std::string>> courses;
    // How the colour that ought to be there comes about, likewise; the clear's name is empty.
    std::vector<std::pair<std::string, std::string>> colors;
    std::string stencil;         // that the sample may hold, "3 or 5"; empty: nobody tests it
    std::string device_stencil;  // that it holds
    static void fields(auto&& visit, auto&... e) {
        visit("at", e.at...);
        visit("writer", e.writer...);
        visit("allowed", e.allowed...);
        visit("hits", e.hits...);
        visit("values", e.values...);
        visit({"courses", cases::kLeftOutIfEmpty}, e.courses...);
        visit({"colors", cases::kLeftOutIfEmpty}, e.colors...);
        visit({"stencil", cases::kLeftOutIfEmpty}, e.stencil...);
        visit({"device_stencil", cases::kLeftOutIfEmpty}, e.device_stencil...);
    }
    friend bool operator==(const SampleEvidence&, const SampleEvidence&) = default;
};
inline constexpr size_t kMaxEvidence = 32;  // samples of a case

}  // namespace report
