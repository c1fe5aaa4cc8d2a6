// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Why a sample must, must not or may be covered, with numbers that a reader can check by hand: the
// reasons that the oracle decides each triangle for, and the sets that narrowing found.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/coverage.hpp"
#include "ref/depth/outcome.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/narrowing.hpp"
#include "ref/expectation/on_demand.hpp"
#include "ref/expectation/scene.hpp"
#include "ref/position/limits.hpp"
#include "ref/position/position.hpp"

namespace ref {

enum class EdgeKind : uint8_t { top, left, bottom, right };
std::string_view to_string(EdgeKind kind);

// One edge of a triangle with nearest snapping, in the order that makes the area positive.
struct EdgeExplanation {
    EdgeLabel label = 0;
    uint32_t from = 0, to = 0;  // vertex numbers in the draw
    FixedPoint a, b;            // snapped end points, S47.16
    mpq_class value;            // E_ab(p) in square pixels; > 0 is inside
    EdgeKind kind = EdgeKind::top;
};

// True if the triangle would cover the sample but for the state of its draw, a plane or a distance.
bool is_suppressed(const Decision& decision);

struct TriangleExplanation {
    uint32_t index = 0;  // into assemble(case)
    cases::Triangle triangle;
    Decision decision;  // of the triangle alone, under the asked profile
    Facing facing = Facing::depends;
    bool is_clipped = false;                  // a vertex lies outside the clip volume
    std::array<std::optional<Box>, 3> boxes;  // where a device may have the vertices
    std::vector<EdgeExplanation> edges;       // three; none if a vertex has no snapped position
    std::string sentence;                     // of the first reason
    // Of a triangle that may cover the sample, if the case tests depth.
    std::optional<DepthOutcome> depth;
    ReasonKind depth_reason = ReasonKind::depth_ranges;
    std::string depth_text;  // one sentence
    // The same, if the case needs a stencil test.
    std::optional<path::Fate> fate;
    std::string bounds_text, stencil_text;  // of the tests that it gets to

    ReasonKind why() const { return decision.reasons.front().kind; }
    bool has(ReasonKind kind) const;
    // True if an edge on which the sample lies decides.
    bool is_tie() const;
    bool is_suppressed() const { return ref::is_suppressed(decision); }
};

struct SetExplanation {
    FixedSet set;
    std::string sentence;
};

struct SampleExplanation {
    FixedPoint position;
    // What keeps every draw from the sample: other_layer, scissor or viewport.
    std::optional<ReasonKind> of_all;
    HitBounds hits;                              // of the whole case
    std::vector<TriangleExplanation> triangles;  // those within two pixels of the sample
    std::vector<SetExplanation> sets;
    std::optional<stencil::Values> stencils;  // that the sample may hold, if the case tests them
};

// How much of an explanation is wanted: all of it, or the reasons alone. Without the words a
// TriangleExplanation has neither boxes nor edges, and no sentence anywhere is set.
enum class Detail : uint8_t { all, reasons };

// Explains samples of one case at one profile. What does not depend on the sample is computed once.
class Explainer {
  public:
    // Keeps a reference to the case.
    Explainer(const cases::Case& c, const Limits& limits, cases::Profile profile);

    // The expectation of all samples, from what explaining has computed already.
    Expectation expectation() { return expect(scene_); }
    // The same as far as one sample goes (OnDemand), for those who ask for a few.
    const Expectation& expectation_at(size_t index) {
        if (!on_demand_) {
            on_demand_.emplace(scene_);
        }
        return on_demand_->at(index);
    }

    // Layer, pixel and sample must lie inside the target.
    SampleExplanation explain(cases::SampleId sample, Detail detail = Detail::all);

    // The sentences that explain(sample, Detail::reasons) leaves out, of one of its triangles, of
    // the same triangle's depth and stencil test, and of one of its sets.
    std::string sentence(const TriangleExplanation& t, cases::SampleId sample);
    std::string depth_sentence(const TriangleExplanation& t, cases::SampleId sample);
    std::string bounds_sentence(const TriangleExplanation& t);
    std::string stencil_sentence(const TriangleExplanation& t);
    std::string sentence(const FixedSet& set);

    // Decides triangle t alone at a sample, whose position is p.
    Decision decide(uint32_t t, const FixedPoint& p, cases::SampleId sample);
    bool is_taken_away_by_face(uint32_t t);

  private:
    static constexpr size_t kUntold = ~size_t{0};
    // The hits of a sample, and of each the number of its explanation, or kUntold.
    struct HitsAt {
        std::vector<Hit> hits;
        std::vector<size_t> explained;
    };

    std::optional<ReasonKind> reason_of_all(cases::SampleId sample, const FixedPoint& p) const;
    // Adds the triangles that are told to `out`.
    HitsAt hits_at(cases::SampleId sample, Detail detail, SampleExplanation& out);
    void add_details(TriangleExplanation& e, const FixedPoint& p);
    // What depth bounds, stencil and late discards make of a triangle's fragment.
    void add_fate(TriangleExplanation& t, const path::Fate& fate, cases::SampleId sample,
                  Detail detail);

    Scene scene_;
    std::optional<OnDemand> on_demand_;
};

// Explains one sample.
SampleExplanation explain_sample(const cases::Case& c, const Limits& limits, cases::Profile profile,
                                 cases::SampleId sample);

// A fixed-point coordinate as a decimal fraction or "p/q" when that is shorter: "10.5", "2753/256".
std::string to_text(int64_t fixed);
std::string to_text(const mpq_class& value);

}  // namespace ref
