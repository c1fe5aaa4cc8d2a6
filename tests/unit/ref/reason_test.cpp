// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Every reason that is told decides: the reference answers otherwise once it is taken away. On some
// samples of a share of the leaves of the suite at every profile (share.hpp).
#include "ref/reason/reason.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "cases/load/loader.hpp"
#include "cases/model/profile.hpp"
#include "folders.hpp"
#include "ref/coverage/exact/exact.hpp"
#include "ref/coverage/fast/fast.hpp"
#include "ref/coverage/outline.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/expectation/reason_text.hpp"
#include "ref/value/reference.hpp"
#include "tests/share.hpp"

namespace ref::test {
namespace {

using cases::Profile;

constexpr size_t kSamples = 8;            // of a leaf at a profile
constexpr size_t kTriangles = 4;          // told at a sample
constexpr size_t kDepths = 4;             // related depths of a leaf at a profile
constexpr uint64_t kLargest = 1U << 22U;  // samples times triangles of a leaf

// One triangle with the state of its draw, in which reasons are taken away.
struct Scene {
    cases::Case c;
    Profile profile;
    bool has_viewport = true;  // keeps samples out, or its border leaves them open
    bool has_boxes = true;     // else each vertex is at some corner of its box
    bool is_moved = false;     // the sample, a little off where it is exactly
    float far = 3;             // how far from the viewport another triangle's vertices are
    cases::Draw& draw() { return c.draws[0]; }
};

Scene scene_of(const cases::Case& c, const cases::Triangle& t, Profile profile) {
    Scene out{{}, profile};
    out.c.target = c.target;
    cases::Draw d = c.draws[t.draw];
    const cases::Draw all = d;
    d.topology = cases::Topology::triangle_list;
    d.indices.reset();
    d.instances = 1;  // positions and values of all instances have their offsets and divisors
    d.offsets.clear();
    if (cases::discards_by_value(d)) {
        d.attributes = {all.attributes[all.discard_attribute]};
        d.attributes[0].values.clear();
        d.attributes[0].divisor.reset();
        d.discard_attribute = 0;
        for (const uint32_t v : t.vertex) {
            const bool is_flat = d.attributes[0].interpolation == cases::Interpolation::flat;
            d.attributes[0].values.push_back(
                all.attributes[all.discard_attribute].values[is_flat ? t.provoking : v]);
        }
    } else {
        d.attributes.clear();
    }
    d.positions.clear();
    d.distances.clip.clear();
    d.distances.cull.clear();
    for (const uint32_t v : t.vertex) {
        d.positions.push_back(all.positions[v]);
        if (d.distances.clip_count > 0) {
            d.distances.clip.push_back(all.distances.clip[v]);
        }
        if (d.distances.cull_count > 0) {
            d.distances.cull.push_back(all.distances.cull[v]);
        }
    }
    out.c.draws.push_back(d);
    return out;
}

// Whether an outline decides p for some choice of corners of its boxes.
bool is_decided_by_points(const TriangleSetup& setup, const Outline& outline, Profile profile,
                          const FixedPoint& p) {
    for (uint32_t corner = 0; corner < 64; ++corner) {
        Outline o = outline;
        for (uint32_t i = 0; i < o.count; ++i) {
            const Box b = o.boxes[i];
            const uint32_t which = corner >> (2 * (i % 3));
            const int64_t x = (which & 1U) != 0 ? b.x1 : b.x0;
            const int64_t y = (which & 2U) != 0 ? b.y1 : b.y0;
            o.boxes[i] = {x, y, x, y};
        }
        choose_mode(o, setup.grid_step, profile);
        if (exact::coverage_of(setup, o, p) != Coverage::either) {
            return true;
        }
    }
    return false;
}

TriangleSetup set_up(const Scene& s, bool is_told) {
    VertexBoxes boxes(s.c, Limits{}, s.profile);
    Window window = window_of(s.c, s.c.draws[0], s.profile);
    if (!s.has_viewport) {
        window.is_viewport_ignored = true;
        window.core_x = window.core_y = {INT64_MIN / 2, INT64_MAX / 2};
    }
    return ref::set_up(s.c, cases::assemble(s.c).at(0), Limits{}, s.profile, boxes, window,
                       is_told);
}

Coverage answer_of_place(const Scene& s, cases::SampleId at) {
    const cases::Draw& draw = s.c.draws[0];
    const FixedPoint p = sample_position(at.x, at.y, at.sample, s.c.target);
    const TriangleSetup setup = set_up(s, false);
    if (draw.layer != at.layer || !setup.window.may_write(at.sample) ||
        cases::takes_away_pixel(draw, at.x, at.y)) {
        return Coverage::must_not;
    }
    if (s.has_boxes) {
        return exact::decide(setup, p, false).coverage;
    }
    const OutlineList outlines = setup.outlines();
    const auto is_decided = [&](const FixedPoint& q) {
        return std::all_of(outlines.begin(), outlines.end(), [&](const Outline* o) {
            return is_decided_by_points(setup, *o, s.profile, q);
        });
    };
    bool is_any = is_decided(p);
    for (const int64_t dx : {-4, 0, 4}) {
        for (const int64_t dy : {-4, 0, 4}) {
            is_any = is_any || (s.is_moved && is_decided({p.x + dx, p.y + dy}));
        }
    }
    return is_any ? Coverage::must : Coverage::either;
}

Coverage answer(const Scene& s, cases::SampleId at) {
    const Coverage of_place = answer_of_place(s, at);
    if (of_place == Coverage::must_not || !cases::takes_away_by_value(s.c.draws[0])) {
        return of_place;
    }
    switch (ValueReference(s.c, Limits{}, s.profile).sign(0, at)) {
        case Sign::negative:
            return Coverage::must_not;
        case Sign::not_negative:
            return of_place;
        case Sign::open:
            break;
    }
    return Coverage::either;
}

// Whether p is on the inner side of all edges of some outline, for some choice of their ends, but
// for those that the reasons name.
bool is_inside_the_others(const Scene& s, cases::SampleId at, const Reasons& reasons) {
    const FixedPoint p = sample_position(at.x, at.y, at.sample, s.c.target);
    const auto is_named = [&](EdgeLabel label) {
        const bool is_plane = label >= kFirstClipEdge;
        const Reason of_edge = is_plane
                                   ? reason_of_plane(static_cast<ClipPlane>(label - kFirstClipEdge))
                                   : Reason{ReasonKind::outside, label};
        return std::any_of(reasons.begin(), reasons.end(), [&](const Reason& r) {
            return r == of_edge || r.kind == ReasonKind::outside_hull;
        });
    };
    const auto corners = [](const Box& b) {
        return std::array{FixedPoint{b.x0, b.y0}, FixedPoint{b.x1, b.y0}, FixedPoint{b.x0, b.y1},
                          FixedPoint{b.x1, b.y1}};
    };
    const TriangleSetup setup = set_up(s, true);
    for (const Outline* const outline : setup.outlines()) {
        const Outline& o = *outline;
        Int128 area = 0;
        for (uint32_t i = 1; i + 1 < o.count; ++i) {
            area += edge_function(middle_of(o.boxes[0]), middle_of(o.boxes[i]),
                                  middle_of(o.boxes[i + 1]));
        }
        bool is_inside = true;
        for (uint32_t i = 0; i < o.count; ++i) {
            bool may_be_inside = is_named(o.edge.at(i));
            for (const FixedPoint& a : corners(o.boxes[i])) {
                for (const FixedPoint& b : corners(o.boxes[(i + 1) % o.count])) {
                    const Int128 e = edge_function(a, b, p);
                    may_be_inside = may_be_inside || area == 0 || (area > 0 ? e >= 0 : e <= 0);
                }
            }
            is_inside = is_inside && may_be_inside;
        }
        if (is_inside) {
            return true;
        }
    }
    // A triangle with a vertex behind the eye has no outline without the planes.
    return setup.outlines().size() == 0;
}

// Another triangle that holds the whole viewport, or (`is_beside`) nothing of it.
void replace(Scene& s, bool is_beside, int orientation) {
    const float x = is_beside ? 2 : -s.far;
    std::vector<glm::vec4>& v = s.draw().positions;
    v = {{x, x, 0.5, 1}, {3 * s.far, x, 0.5, 1}, {x, 3 * s.far, 0.5, 1}};
    const cases::Viewport& port = s.draw().viewport;
    const bool is_mirrored = (port.width < 0) != (port.height < 0);
    if ((orientation < 0) != is_mirrored) {
        std::swap(v[1], v[2]);
    }
}

void set_distances(std::vector<glm::vec4>& all, uint8_t k, float value) {
    for (glm::vec4& d : all) {
        if (k == kNothing) {
            d = glm::vec4(value);
        } else {
            d[static_cast<glm::vec4::length_type>(k)] = value;
        }
    }
}

void take_away(Scene& s, Reason reason, int orientation) {
    cases::Draw& draw = s.draw();
    switch (reason.kind) {
        case ReasonKind::top_left_in:
        case ReasonKind::top_left_out:
            s.profile = Profile::practice;
            return;
        case ReasonKind::passes_cull_distance:
            set_distances(draw.distances.cull, kNothing, -1);
            return;
        case ReasonKind::passes_clip_distance:
            set_distances(draw.distances.clip, kNothing, -1);
            return;
        case ReasonKind::kept_by_alpha:
        case ReasonKind::inside:
        case ReasonKind::touches_pixel:
        case ReasonKind::extra_reached:
        case ReasonKind::fills_pixel:
        case ReasonKind::degenerate_kept:
        case ReasonKind::may_reach:
        case ReasonKind::may_fill:
        case ReasonKind::between_pieces:
            replace(s, true, orientation);
            return;
        case ReasonKind::masked:
            draw.multisample.sample_mask = 0xffffffffU;
            draw.multisample.shader_mask.reset();
            return;
        case ReasonKind::no_alpha:
        case ReasonKind::open_alpha:
            draw.color.alpha_to_coverage = false;
            return;
        case ReasonKind::scissor:
            draw.scissor = {0, 0, s.c.target.width, s.c.target.height};
            return;
        case ReasonKind::viewport:
        case ReasonKind::viewport_border:
            s.has_viewport = false;
            return;
        case ReasonKind::outside:
        case ReasonKind::outside_hull:
        case ReasonKind::no_area:
        case ReasonKind::beyond_size:
        case ReasonKind::unfilled_pixel:
        case ReasonKind::degenerate_culled:
        case ReasonKind::undefined:
        case ReasonKind::unbounded:
            replace(s, false, orientation);
            set_distances(draw.distances.clip, kNothing, 1);
            return;
        case ReasonKind::discarded:
            draw.rasterizer_discard = false;
            return;
        case ReasonKind::fragment_discarded:
        case ReasonKind::value_discarded:
        case ReasonKind::near_zero:
        case ReasonKind::discarded_late:
            draw.discard = cases::Discard::none;
            return;
        case ReasonKind::culled:
        case ReasonKind::open_facing:
            draw.cull = cases::CullMode::none;
            draw.discard = cases::Discard::none;
            return;
        case ReasonKind::cull_distance:
            set_distances(draw.distances.cull, reason.which, 0);
            return;
        case ReasonKind::near_plane:
        case ReasonKind::flushed:
            draw.depth.clip = false;
            draw.depth.clamp = true;
            return;
        case ReasonKind::clip_distance:
        case ReasonKind::near_distance:
            set_distances(draw.distances.clip, reason.which, 0);
            return;
        case ReasonKind::on_edge:
            s.is_moved = true;
            s.has_boxes = false;
            return;
        case ReasonKind::vertex_boxes:
            s.has_boxes = false;
            return;
        case ReasonKind::clip_plane:
        case ReasonKind::other_layer:
        case ReasonKind::complement:
        case ReasonKind::clipped_edge:
        case ReasonKind::shared_vertex:
        case ReasonKind::shared_edge:
        default:
            return;  // elsewhere
    }
}

// Whether the reference answers otherwise once all reasons are taken away.
bool decides(const cases::Case& c, const TriangleExplanation& t, Profile profile,
             cases::SampleId at) {
    const Reasons& reasons = t.decision.reasons;
    const cases::Draw& draw = c.draws[t.triangle.draw];
    if (draw.clear) {
        const cases::Clear& clear = *draw.clear;
        const cases::Rect& r = clear.rects.at(t.triangle.primitive / clear.layers);
        const int64_t column = int64_t{at.x} - r.x, row = int64_t{at.y} - r.y;
        const bool is_beside = column < 0 || column >= r.width || row < 0 || row >= r.height;
        const bool is_elsewhere = draw.layer + t.triangle.primitive % clear.layers != at.layer;
        const bool is_cleared = !is_beside && !is_elsewhere;
        // It makes no hit.
        return t.decision.coverage == Coverage::must_not &&
               t.has(ReasonKind::cleared) == is_cleared &&
               (is_cleared || (is_beside && t.has(ReasonKind::beside_clear)) ||
                (is_elsewhere && t.has(ReasonKind::other_layer)));
    }
    // Another triangle faces as this one does, or as none is culled.
    const Facing facing = t.facing != Facing::depends           ? t.facing
                          : draw.cull == cases::CullMode::front ? Facing::back
                                                                : Facing::front;
    const bool is_clockwise = draw.front_face == cases::FrontFace::clockwise;
    const int orientation = (facing == Facing::front) == is_clockwise ? 1 : -1;
    if (t.has(ReasonKind::clip_plane)) {
        return is_inside_the_others(scene_of(c, t.triangle, profile), at, reasons);
    }
    for (const float far : {3.0F, 4096.0F}) {
        Scene s = scene_of(c, t.triangle, profile);
        s.far = far;
        // What is kept away otherwise is not asked for its values.
        if (cases::discards_by_value(s.draw()) && !t.has(ReasonKind::value_discarded) &&
            !t.has(ReasonKind::near_zero)) {
            s.draw().discard = cases::Discard::none;
        }
        for (const Reason& reason : reasons) {
            if (reason.kind == ReasonKind::other_layer) {
                s.draw().layer = at.layer;
            }
            take_away(s, reason, orientation);
        }
        if (answer(s, at) != t.decision.coverage) {
            return true;
        }
    }
    return false;
}

// Samples of which the expectation says different things, and some at random.
std::vector<size_t> samples_of(const Expectation& e, std::mt19937& random) {
    std::vector<size_t> out;
    std::array<size_t, 3> left{3, 3, 2};  // open, to be hit, not to be hit
    std::uniform_int_distribution<size_t> any(0, e.samples.size() - 1);
    for (size_t k = any(random), n = 0; n < e.samples.size(); ++n, k = (k + 1) % e.samples.size()) {
        const HitBounds& hits = e.samples[k].hits;
        size_t& of_kind = left[hits.total_min != hits.total_max ? 0 : hits.total_max > 0 ? 1 : 2];
        if (of_kind > 0) {
            --of_kind;
            out.push_back(k);
        }
    }
    while (out.size() < kSamples) {
        out.push_back(any(random));
    }
    return out;
}

std::string words(const TriangleExplanation& t) {
    std::string out = "coverage " + std::to_string(static_cast<int>(t.decision.coverage)) + ":";
    for (const Reason& r : t.decision.reasons) {
        out += " " + std::to_string(static_cast<int>(r.kind)) + "/" + std::to_string(r.which);
    }
    return out + " (" + t.sentence + ")";
}

class LeafReasons {
  public:
    LeafReasons(const cases::Case& c, Profile profile) : case_(c), profile_(profile) {}

    void check(std::map<ReasonKind, size_t>& seen) {
        const Expectation e = expect(case_, Limits{}, profile_);
        if (e.samples.size() * e.triangles.size() > kLargest) {
            return;
        }
        std::mt19937 random(static_cast<uint32_t>(e.samples.size() + e.triangles.size()));
        Explainer explainer(case_, Limits{}, profile_);
        for (const size_t k : samples_of(e, random)) {
            const cases::SampleId at = cases::sample_at(case_.target, k);
            const SampleExplanation s = explainer.explain(at);
            const std::string where = case_.id + " at " + std::string(to_string(profile_)) + ", " +
                                      cases::sample_text(case_.target, at);
            EXPECT_EQ(s.hits, e.samples[k].hits) << where;
            size_t told = 0;
            for (const TriangleExplanation& t : s.triangles) {
                // Those beside the sample are many and alike.
                if (told < kTriangles || t.why() != ReasonKind::outside) {
                    ++told;
                    check_triangle(t, at, where);
                    ++seen[t.why()];
                    if (t.depth) {
                        ++seen[t.depth_reason];
                        check_depth(t, at, where);
                    }
                }
            }
            for (const SetExplanation& set : s.sets) {
                check_set(set.set, at, where);
                ++seen[set.set.why];
            }
        }
    }

  private:
    void check_triangle(const TriangleExplanation& t, cases::SampleId at,
                        const std::string& where) const {
        const cases::Draw& draw = case_.draws[t.triangle.draw];
        VertexBoxes boxes(case_, Limits{}, profile_);
        const TriangleSetup setup = ref::set_up(case_, t.triangle, Limits{}, profile_, boxes,
                                                window_of(case_, draw, profile_));
        const bool is_discarded_late = t.fate && t.fate->is_discarded && !t.fate->passes;
        const uint32_t layer =
            draw.layer + (draw.clear ? t.triangle.primitive % draw.clear->layers : 0);
        const bool is_drawn = layer == at.layer && setup.window.may_write(at.sample) &&
                              !cases::takes_away_pixel(draw, at.x, at.y) && !is_discarded_late;
        const FixedPoint p = sample_position(at.x, at.y, at.sample, case_.target);
        Coverage fast = is_drawn ? fast::classify(setup, p) : Coverage::must_not;
        if (fast != Coverage::must_not && cases::takes_away_by_value(draw)) {
            fast = answer(scene_of(case_, t.triangle, profile_), at);
        }
        const bool may_be_either = t.fate && t.fate->is_discarded && t.fate->passes;
        if (fast == Coverage::must && may_be_either && cases::discards_by_value(draw)) {
            fast = Coverage::either;
        }
        EXPECT_EQ(t.decision.coverage, fast) << where << ": " << words(t);
        EXPECT_TRUE(decides(case_, t, profile_, at)) << where << ": " << words(t);
        EXPECT_TRUE(std::is_sorted(t.decision.reasons.begin(), t.decision.reasons.end())) << where;
        EXPECT_FALSE(t.sentence.empty()) << where;
    }

    // Drawn by shaders that discard by another instruction than its relatives, which are no
    // relatives any more, a triangle whose depth is related to theirs may pass or fail.
    void check_depth(const TriangleExplanation& t, cases::SampleId at, const std::string& where) {
        if (t.depth_reason == ReasonKind::depth_ranges || depths_ == kDepths) {
            return;
        }
        ++depths_;
        cases::Case c = case_;
        for (size_t d = 0; d < t.triangle.draw; ++d) {
            c.draws[d].discard_by = c.draws[d].discard_by == cases::DiscardBy::kill
                                        ? cases::DiscardBy::demote
                                        : cases::DiscardBy::kill;
        }
        const SampleExplanation s = explain_sample(c, Limits{}, profile_, at);
        const auto same = std::find_if(s.triangles.begin(), s.triangles.end(),
                                       [&](const auto& e) { return e.index == t.index; });
        ASSERT_NE(same, s.triangles.end()) << where;
        const bool is_of_one_draw = t.triangle.draw == 0;
        EXPECT_TRUE(is_of_one_draw || same->depth != t.depth) << where << ": " << t.depth_text;
    }

    // Alone, one of the members at least would be free.
    void check_set(const FixedSet& set, cases::SampleId at, const std::string& where) const {
        const std::vector<cases::Triangle> triangles = cases::assemble(case_);
        size_t open = 0;
        for (const uint32_t t : set.triangles) {
            const Scene s = scene_of(case_, triangles[t], profile_);
            open += answer(s, at) == Coverage::either ? 1U : 0U;
        }
        EXPECT_GT(open, set.why == ReasonKind::complement && set.least == set.count ? 1U : 0U)
            << where;
        EXPECT_LE(set.least, set.count) << where;
        EXPECT_LT(set.count, set.triangles.size() + (open == 1 ? 1 : 0)) << where;
    }

    const cases::Case& case_;
    Profile profile_;
    size_t depths_ = 0;  // so many were checked
};

// The leaves' indices: the first of each file, then the second of each, small ones first.
std::vector<size_t> by_turn(const std::vector<cases::Case>& suite) {
    std::map<std::string, size_t> turns;  // of a file
    std::vector<std::pair<size_t, size_t>> keys;
    for (const cases::Case& c : suite) {
        const size_t samples = size_t{c.target.width} * c.target.rows() * c.target.samples;
        keys.emplace_back(turns[c.id.substr(0, c.id.find(':'))]++, samples);
    }
    std::vector<size_t> order(suite.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, {}, [&](size_t k) { return keys[k]; });
    return order;
}

TEST(ExhaustiveReasons, DecideWhatTheyAreToldFor) {
    // The others are of values (value_reason_test.cpp) and of findings (diff/attribution.cpp), and
    // the limits here are those of a device that draws what has no area.
    const auto is_asked = [](ReasonKind kind) {
        return (kind <= ReasonKind::shared_edge && kind != ReasonKind::degenerate_culled) ||
               (kind >= ReasonKind::depth_ranges && kind <= ReasonKind::depth_apart);
    };
    std::map<ReasonKind, size_t> seen;
    const auto first_unseen = [&] {
        size_t k = 0;
        while (k <= static_cast<size_t>(kLastReason) &&
               (seen[static_cast<ReasonKind>(k)] > 0 || !is_asked(static_cast<ReasonKind>(k)))) {
            ++k;
        }
        return k;
    };
    const cases::Suite suite = cases::load_suite(test_support::source_dir() + "/cases/suite");
    const auto share = test_support::share_of(12, suite.cases.size());
    // Then the other leaves, until a reason that the share does not show is seen, too: the first of
    // each file, the second, and so on, small ones before large ones.
    const std::vector<size_t> order = by_turn(suite.cases);
    for (const bool is_of_share : {true, false}) {
        for (const size_t index : order) {
            const cases::Case& c = suite.cases[index];
            for (const Profile profile : cases::kProfiles) {
                if (!c.blit && share.has(c.id + std::string(to_string(profile))) == is_of_share &&
                    (is_of_share || first_unseen() <= static_cast<size_t>(kLastReason))) {
                    LeafReasons(c, profile).check(seen);
                }
            }
        }
    }
    EXPECT_GT(first_unseen(), static_cast<size_t>(kLastReason)) << "no leaf shows this reason";
}

}  // namespace
}  // namespace ref::test
