// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/narrowing.hpp"

#include <algorithm>
#include <array>

namespace ref {

namespace {

void add_single(HitBounds& b, const TriangleSetup::Faces& can_be, bool is_must) {
    b.total_max += 1;
    b.front_max += can_be.front ? 1 : 0;
    b.back_max += can_be.back ? 1 : 0;
    b.signed_max += can_be.front ? 1 : 0;
    b.signed_min -= can_be.back ? 1 : 0;
    if (!is_must) {
        return;
    }
    b.total_min += 1;
    if (!can_be.back) {
        b.front_min += 1;
        b.signed_min += 1;
    }
    if (!can_be.front) {
        b.back_min += 1;
        b.signed_max -= 1;
    }
}

// From `least` to `most` of some triangles, at most `front` of them as front and `back` as back
// faces.
void add_set(HitBounds& b, uint32_t front, uint32_t back, uint32_t least, uint32_t most) {
    const auto beyond = [](uint32_t n, uint32_t others) { return n > others ? n - others : 0; };
    const uint32_t front_max = std::min(front, most);
    const uint32_t back_max = std::min(back, most);
    const uint32_t front_min = beyond(least, back);
    const uint32_t back_min = beyond(least, front);
    b.total_min += least;
    b.total_max += most;
    b.front_min += front_min;
    b.front_max += front_max;
    b.back_min += back_min;
    b.back_max += back_max;
    // The most of one kind, and of the other what is then missing from the least.
    b.signed_min += static_cast<int32_t>(beyond(least, back_max)) - static_cast<int32_t>(back_max);
    b.signed_max +=
        static_cast<int32_t>(front_max) - static_cast<int32_t>(beyond(least, front_max));
}

}  // namespace

Narrowing::Narrowing(const cases::Case& c, cases::Profile profile,
                     const std::vector<cases::Triangle>& triangles, TriangleSetups& setups,
                     Predicates predicates, DepthTest* depth, ValueDiscards& discards)
    : case_(c),
      profile_(profile),
      triangles_(triangles),
      setups_(setups),
      predicates_(predicates),
      complements_(complements_of(c, triangles)),
      depth_(depth),
      discards_(discards),
      follows_courses_(follows_courses(c)),
      stores_discarded_(stores_discarded(c)),
      vertex_numbers_(c) {}

bool Narrowing::may_be_taken_away(uint32_t t, const FixedPoint& p) {
    const cases::Draw& draw = case_.draws[triangles_[t].draw];
    const auto x = static_cast<uint32_t>(p.x >> kFixedBits);
    const auto y = static_cast<uint32_t>(p.y >> kFixedBits);
    return takes_away_pixel(draw, x, y) ||
           (takes_away_by_value(draw) &&
            discards_.at(t, {x, y, sample_, draw.layer}) != Sign::not_negative);
}

bool Narrowing::add_sides(const FixedPoint& p, const Hit& hit, uint32_t member,
                          std::vector<Side>& sides) {
    const TriangleSetup& setup = setups_[hit.triangle];
    const cases::Triangle& triangle = triangles_[hit.triangle];
    // "Coverage is set for all fragments generated from shared edges" of a conservative draw.
    if (setup.area.is_on() || setup.kind != TriangleSetup::Kind::outlines ||
        setup.orientation == 0 || setup.may_be_culled || !setup.window.may_write(sample_) ||
        !setup.window.must_touch(p) || may_be_taken_away(hit.triangle, p)) {
        return false;
    }
    const bool is_literal = profile_ == cases::Profile::vulkan;
    if (is_literal && setup.is_clipped) {
        return false;  // no text promises a shared edge after clipping
    }
    std::array<bool, 3> has_edge{};
    for (const Outline* const outline : setup.outlines()) {
        const Outline& o = *outline;
        if (std::any_of(o.cuts.begin(), o.cuts.end(),
                        [&](const DistanceCut& cut) { return cut.must.at(p) < 0; })) {
            return false;  // a clip distance decides
        }
        for (uint32_t i = 0; i < o.count; ++i) {
            const std::array<Box, 2> ends{o.boxes[i], o.boxes[(i + 1) % o.count]};
            // The pairwise rule contradicts itself where many triangles meet in a vertex.
            if (is_literal && predicates_.is_in_hull(std::span<const Box>(ends.data(), 1), p)) {
                return false;
            }
            if (!predicates_.is_in_hull(ends, p)) {
                continue;
            }
            if (o.edge[i] >= kFirstClipEdge) {
                return false;
            }
            has_edge[o.edge[i]] = true;
        }
    }
    for (uint32_t e = 0; e < 3; ++e) {
        if (!has_edge[e]) {
            continue;
        }
        const uint32_t a = vertex_numbers_.of(triangle.draw, triangle.vertex[e]);
        const uint32_t b = vertex_numbers_.of(triangle.draw, triangle.vertex[(e + 1) % 3]);
        sides.push_back({edge_number(triangle, e), (a < b) == (setup.orientation > 0), member});
    }
    return has_edge[0] || has_edge[1] || has_edge[2];
}

int Narrowing::winding_of(const FixedPoint& p, const TriangleSetup& setup,
                          const Outline& outline) const {
    // One choice of positions that is the same for equal vertices: the low corners.
    std::array<FixedPoint, kMaxClippedVertices> polygon;
    for (uint32_t i = 0; i < outline.count; ++i) {
        polygon[i] = {outline.boxes[i].x0, outline.boxes[i].y0};
    }
    const std::span<const FixedPoint> vertices(polygon.data(), outline.count);
    return setup.orientation * predicates_.winding(vertices, p);
}

int Narrowing::count_of(const FixedPoint& p, std::span<const Hit> hits,
                        const std::vector<uint32_t>& members) const {
    // Cut by the depth planes or by all, by the clip distances or not: every member in the same
    // way.
    std::array<int, 4> count{};
    bool has_unclipped = true;
    for (const uint32_t m : members) {
        const TriangleSetup& setup = setups_[hits[m].triangle];
        const int open = setup.has_outline ? winding_of(p, setup, setup.unclipped) : 0;
        const int cut = setup.is_clipped ? winding_of(p, setup, *setup.clipped) : open;
        const auto tested = [&](int8_t index, int otherwise) {
            return index < 0 ? otherwise
                             : winding_of(p, setup, setup.tested[static_cast<size_t>(index)]);
        };
        const int tested_open = tested(setup.tested_unclipped, open);
        has_unclipped = has_unclipped && setup.has_outline;
        count[0] += cut;
        count[1] += tested(setup.tested_clipped, cut);
        count[2] += open;
        count[3] += tested_open;
    }
    const size_t models = has_unclipped ? 4 : 2;
    if (std::any_of(count.begin(), count.begin() + models, [&](int c) { return c != count[0]; })) {
        return -1;
    }
    return count[0] >= 0 && count[0] <= static_cast<int>(members.size()) ? count[0] : -1;
}

DepthResolution Narrowing::resolve_depth(const FixedPoint& p, std::span<const Hit> hits,
                                         const std::vector<Fixed>& sets) {
    std::vector<DepthCandidate> candidates;
    for (const Hit& hit : hits) {
        candidates.push_back({hit.triangle, hit.coverage == Coverage::must});
    }
    for (size_t k = 0; k < sets.size(); ++k) {
        const Fixed& set = sets[k];
        for (const uint32_t m : set.members) {
            candidates[m].is_absent = set.count == 0;
            candidates[m].is_sure = set.least == set.members.size();
            candidates[m].one_of = set.count == 1 ? static_cast<int>(k) : -1;
            candidates[m].is_one_sure = set.least == 1;
        }
    }
    return depth_->resolve(p, candidates);
}

void Narrowing::apply_depth(const FixedPoint& p, std::span<const Hit> hits,
                            std::vector<Fixed>& sets, std::vector<Coverage>& coverage,
                            std::vector<uint32_t>& depth_writers, SampleExpectation& out,
                            JudgeReasons* reasons) {
    const DepthResolution depth = resolve_depth(p, hits, sets);
    if (reasons != nullptr) {
        reasons->depth = depth;
    }
    for (size_t m = 0; m < hits.size(); ++m) {
        if (depth.outcomes[m] == DepthOutcome::fails) {
            coverage[m] = Coverage::must_not;
        } else if (depth.outcomes[m] == DepthOutcome::open) {
            coverage[m] = Coverage::either;
        }
    }
    // A set of which some may fail the test no longer has a fixed number of hits.
    std::erase_if(sets, [&](const Fixed& set) {
        const auto passes = [&](uint32_t m) { return depth.outcomes[m] == DepthOutcome::passes; };
        const bool is_whole =
            set.count == 0 || std::all_of(set.members.begin(), set.members.end(), passes);
        const bool is_sure = set.least == set.members.size();
        for (const uint32_t m : set.members) {
            if (!is_whole && passes(m)) {
                coverage[m] = is_sure ? Coverage::must : Coverage::either;
            }
        }
        return !is_whole;
    });
    out.depth_begin = static_cast<uint32_t>(depth_writers.size());
    for (const uint32_t m : depth.stored) {
        depth_writers.push_back(hits[m].triangle);
    }
    out.depth_count = static_cast<uint32_t>(depth.stored.size());
    out.depth_may_be_clear = depth.may_be_clear;
}

bool Narrowing::is_anywhere(std::span<const Hit> hits) const {
    const auto open = std::count_if(hits.begin(), hits.end(),
                                    [](const Hit& h) { return h.coverage == Coverage::either; });
    // Alone, an open triangle can only be settled by partners that are decided.
    const auto least = profile_ == cases::Profile::direct3d || !complements_.empty() ? 1 : 2;
    return depth_ == nullptr && open < least && !stores_discarded_;
}

SampleExpectation Narrowing::judge(const FixedPoint& p, uint32_t s, std::span<const Hit> hits,
                                   const JudgedLists& lists, JudgeReasons* reasons) {
    SampleExpectation out;
    std::vector<uint32_t>& writers = lists.writers;
    sample_ = s;
    fates_.clear();
    if (follows_courses_ && !hits.empty() && is_anywhere(hits)) {
        return judge_by_stencil(p, hits, {}, lists, reasons);
    }
    out.writers_begin = static_cast<uint32_t>(writers.size());
    if (is_anywhere(hits)) {
        uint32_t first = 0;
        for (uint32_t m = 0; m < hits.size(); ++m) {
            const bool is_must = hits[m].coverage == Coverage::must;
            add_single(out.hits, setups_[hits[m].triangle].faces(is_further(hits, m)), is_must);
            first = is_must ? m : first;
        }
        for (uint32_t m = first; m < hits.size(); ++m) {
            writers.push_back(hits[m].triangle);
        }
        out.writers_count = static_cast<uint32_t>(writers.size()) - out.writers_begin;
        return out;
    }
    std::vector<Fixed> sets = fixed_sets(p, hits);
    for (size_t k = 0; reasons != nullptr && k < sets.size(); ++k) {
        reasons->sets.push_back(told_set(p, hits, sets[k]));
    }
    if (follows_courses_ && !hits.empty()) {
        return judge_by_stencil(p, hits, sets, lists, reasons);
    }
    std::vector<Coverage> coverage(hits.size());
    for (size_t m = 0; m < hits.size(); ++m) {
        coverage[m] = hits[m].coverage;
    }
    if (depth_ != nullptr && !hits.empty()) {
        apply_depth(p, hits, sets, coverage, lists.depth_writers, out, reasons);
    }
    std::vector<bool> is_counted(hits.size(), false);
    uint32_t first = 0;  // nothing before it can have written last
    for (const Fixed& set : sets) {
        uint32_t front = 0;
        uint32_t back = 0;
        for (const uint32_t m : set.members) {
            is_counted[m] = true;
            front += setups_[hits[m].triangle].can_be_front ? 1U : 0U;
            back += setups_[hits[m].triangle].can_be_back ? 1U : 0U;
            if (set.count == 0) {
                coverage[m] = Coverage::must_not;
            }
        }
        add_set(out.hits, front, back, set.least, set.count);
        if (set.least > 0) {
            first = std::max(first, set.members[set.least - 1]);
        }
    }
    for (uint32_t m = 0; m < hits.size(); ++m) {
        if (!is_counted[m] && coverage[m] != Coverage::must_not) {
            add_single(out.hits, setups_[hits[m].triangle].faces(is_further(hits, m)),
                       coverage[m] == Coverage::must);
            first = coverage[m] == Coverage::must ? std::max(first, m) : first;
        }
    }
    for (uint32_t m = first; m < hits.size(); ++m) {
        if (coverage[m] != Coverage::must_not) {
            writers.push_back(hits[m].triangle);
        }
    }
    out.writers_count = static_cast<uint32_t>(writers.size()) - out.writers_begin;
    return out;
}

}  // namespace ref
