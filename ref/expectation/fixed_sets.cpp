// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/fixed_sets.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace ref {

namespace {

// The set that member m belongs to, in a forest of parents.
uint32_t root_of(std::vector<uint32_t>& parent, uint32_t m) {
    while (parent[m] != m) {
        parent[m] = parent[parent[m]];
        m = parent[m];
    }
    return m;
}

constexpr int kAnyEdge = 256;

}  // namespace

FixedSets::FixedSets(const cases::Case& c, cases::Profile profile,
                     const std::vector<cases::Triangle>& triangles, TriangleSetups& setups,
                     const Predicates& predicates, ValueDiscards& discards, bool is_by_draw)
    : case_(c),
      profile_(profile),
      triangles_(triangles),
      setups_(setups),
      predicates_(predicates),
      discards_(discards),
      is_by_draw_(is_by_draw),
      edges_(c, triangles, setups, predicates_),
      complements_(c, profile, triangles, setups, predicates_, edges_) {}

bool FixedSets::may_be_taken_away(uint32_t t, const FixedPoint& p) {
    const cases::Draw& draw = case_.draws[triangles_[t].draw];
    const auto x = static_cast<uint32_t>(p.x >> kFixedBits);
    const auto y = static_cast<uint32_t>(p.y >> kFixedBits);
    return setups_[t].window.is_open() || takes_away_pixel(draw, x, y) ||
           (takes_away_by_value(draw) &&
            discards_.at(t, {x, y, sample_, draw.layer}) != Sign::not_negative);
}

bool FixedSets::add_sides(const FixedPoint& p, const Hit& hit, uint32_t member,
                          std::vector<Side>& sides) {
    const TriangleSetup& setup = setups_[hit.triangle];
    // "Coverage is set for all fragments generated from shared edges" of a conservative draw.
    if (setup.area.is_on() || setup.kind != TriangleSetup::Kind::outlines ||
        setup.orientation == 0 || setup.may_be_culled || !setup.window.may_write(sample_) ||
        !setup.window.is_in_core(p)) {
        return false;
    }
    const bool is_literal = profile_ == cases::Profile::vulkan;
    if (is_literal && setup.is_clipped) {
        return false;  // no text promises a shared edge after clipping
    }
    SharedEdges::Near near{};
    for (const Outline* const outline : setup.outlines()) {
        if (std::any_of(outline->cuts.begin(), outline->cuts.end(),
                        [&](const DistanceCut& cut) { return cut.must.at(p) < 0; })) {
            return false;  // a clip distance decides
        }
        // The pairwise rule contradicts itself where many triangles meet in a vertex.
        if (is_literal && std::ranges::any_of(outline->vertices(), [&](const Box& box) {
                return predicates_.is_in_hull({&box, 1}, p);
            })) {
            return false;
        }
        if (!edges_.find_near(p, *outline, kAnyEdge, near)) {
            return false;
        }
    }
    return edges_.add(hit.triangle, near, member, sides);
}

int FixedSets::count_of(const FixedPoint& p, std::span<const Hit> hits,
                        const std::vector<uint32_t>& members) const {
    // Cut by the depth planes or by all, by the clip distances or not: every member in the same
    // way.
    std::array<int, 4> count{};
    bool has_unclipped = true;
    for (const uint32_t m : members) {
        const TriangleSetup& setup = setups_[hits[m].triangle];
        const int open = setup.has_outline ? edges_.winding_of(p, setup, setup.unclipped) : 0;
        const int cut = setup.is_clipped ? edges_.winding_of(p, setup, *setup.clipped) : open;
        const auto tested = [&](int8_t index, int otherwise) {
            return index < 0
                       ? otherwise
                       : edges_.winding_of(p, setup, setup.tested[static_cast<size_t>(index)]);
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

std::vector<FixedHits> FixedSets::of(const FixedPoint& p, uint32_t sample,
                                     std::span<const Hit> hits) {
    sample_ = sample;
    std::vector<bool> is_paired(hits.size(), false);
    std::vector<FixedHits> out = complements_.of(p, sample, hits, is_paired);
    std::vector<bool> is_open(hits.size());
    for (size_t m = 0; m < hits.size(); ++m) {
        is_open[m] = hits[m].coverage == Coverage::either && !is_paired[m];
    }
    if (is_by_draw_) {
        // Sets of one draw alone: meshes drawn one over the other are told apart by depth, or by
        // the stencil.
        std::vector<bool> is_left = is_open;
        for (size_t begin = 0; begin < hits.size();) {
            const uint32_t draw = triangles_[hits[begin].triangle].draw;
            std::vector<bool> takes_part(hits.size(), false);
            size_t end = begin;
            for (; end < hits.size() && triangles_[hits[end].triangle].draw == draw; ++end) {
                takes_part[end] = is_open[end];
            }
            for (FixedHits& set : closed_sets(p, hits, takes_part)) {
                for (const uint32_t m : set.members) {
                    is_left[m] = false;
                }
                out.push_back(std::move(set));
            }
            begin = end;
        }
        is_open = is_left;
    }
    std::vector<FixedHits> closed = closed_sets(p, hits, is_open);
    out.insert(out.end(), std::make_move_iterator(closed.begin()),
               std::make_move_iterator(closed.end()));
    if (profile_ == cases::Profile::direct3d) {
        add_decided_sets(p, hits, out);
    }
    return out;
}

void FixedSets::add_decided_sets(const FixedPoint& p, std::span<const Hit> hits,
                                 std::vector<FixedHits>& sets) {
    std::vector<bool> takes_part(hits.size(), true);
    for (const FixedHits& set : sets) {
        for (const uint32_t m : set.members) {
            takes_part[m] = false;
        }
    }
    const auto is_open = [&](size_t m) {
        return m < hits.size() && takes_part[m] && hits[m].coverage == Coverage::either;
    };
    std::vector<Hit> all(hits.begin(), hits.end());
    std::vector<Side> sides;
    bool has_open = false;
    for (size_t m = 0; m < all.size(); ++m) {
        has_open = has_open || is_open(m);
        if (!takes_part[m]) {
            continue;
        }
        sides.clear();
        add_sides(p, Hit(all[m]), static_cast<uint32_t>(m), sides);
        for (const Side& side : sides) {
            for (const EdgeOwner& owner : edges_.triangles_at(side.edge)) {
                const uint32_t t = owner.triangle;
                const bool is_drawn = setups_[t].kind != TriangleSetup::Kind::nothing;
                if (is_drawn && std::none_of(all.begin(), all.end(),
                                             [&](const Hit& h) { return h.triangle == t; })) {
                    all.push_back({t, Coverage::must_not});
                    takes_part.push_back(true);
                }
            }
        }
    }
    if (!has_open) {
        return;
    }
    for (const FixedHits& set : closed_sets(p, all, takes_part)) {
        FixedHits open;
        uint32_t sure = 0;
        for (const uint32_t m : set.members) {
            sure += all[m].coverage == Coverage::must ? 1U : 0U;
            if (is_open(m)) {
                open.members.push_back(m);
            } else {
                open.decided.push_back(all[m].triangle);
            }
        }
        if (!open.members.empty() && set.count >= sure && set.count - sure <= open.members.size()) {
            open.count = set.count - sure;
            open.least = set.least - std::min(set.least, sure);
            sets.push_back(std::move(open));
        }
    }
}

FixedSet FixedSets::told(const FixedPoint& p, std::span<const Hit> hits,
                         const FixedHits& set) const {
    FixedSet out;
    out.triangles = set.decided;
    uint32_t sure = 0;
    for (const uint32_t m : set.members) {
        out.triangles.push_back(hits[m].triangle);
    }
    bool is_clipped = false;
    bool is_vertex = false;
    for (const uint32_t t : out.triangles) {
        const TriangleSetup& setup = setups_[t];
        is_clipped = is_clipped || setup.is_clipped;
        for (const Outline* const outline : setup.outlines()) {
            for (const Box& box : outline->vertices()) {
                is_vertex = is_vertex || predicates_.is_in_hull({&box, 1}, p);
            }
        }
    }
    for (const uint32_t t : set.decided) {
        sure += std::any_of(hits.begin(), hits.end(), [&](const Hit& h) {
            return h.triangle == t && h.coverage == Coverage::must;
        });
    }
    std::sort(out.triangles.begin(), out.triangles.end());
    out.count = set.count + sure;
    out.least = set.least + sure;
    out.why = set.is_complement ? ReasonKind::complement
              : is_clipped      ? ReasonKind::clipped_edge
              : is_vertex       ? ReasonKind::shared_vertex
                                : ReasonKind::shared_edge;
    return out;
}

std::vector<FixedHits> FixedSets::closed_sets(const FixedPoint& p, std::span<const Hit> hits,
                                              const std::vector<bool>& takes_part) {
    std::vector<FixedHits> out;
    const auto n = static_cast<uint32_t>(hits.size());
    std::vector<Side> sides;
    std::vector<bool> is_free(n, true);
    for (uint32_t m = 0; m < n; ++m) {
        if (takes_part[m]) {
            const size_t before = sides.size();
            is_free[m] = !add_sides(p, hits[m], m, sides);
            if (is_free[m]) {
                sides.resize(before);
            }
        }
    }
    std::vector<uint32_t> parent(n);
    std::iota(parent.begin(), parent.end(), 0U);
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.edge < b.edge; });
    for (size_t begin = 0; begin < sides.size();) {
        size_t end = begin;
        int balance = 0;
        while (end < sides.size() && sides[end].edge == sides[begin].edge) {
            balance += sides[end].is_forward ? 1 : -1;
            ++end;
        }
        for (size_t k = begin; k < end; ++k) {
            parent[root_of(parent, sides[k].member)] = root_of(parent, sides[begin].member);
            if (balance != 0) {
                is_free[sides[k].member] = true;
            }
        }
        begin = end;
    }
    std::vector<bool> is_set_free(n, false);
    for (uint32_t m = 0; m < n; ++m) {
        if (is_free[m]) {
            is_set_free[root_of(parent, m)] = true;
        }
    }
    std::vector<uint32_t> slot(n, n);
    for (uint32_t m = 0; m < n; ++m) {
        const uint32_t root = root_of(parent, m);
        if (!takes_part[m] || is_set_free[root]) {
            continue;
        }
        if (slot[root] == n) {
            slot[root] = static_cast<uint32_t>(out.size());
            out.emplace_back();
        }
        out[slot[root]].members.push_back(m);
    }
    std::erase_if(out, [&](FixedHits& set) {
        const int count = count_of(p, hits, set.members);
        const auto taken = std::ranges::count_if(
            set.members, [&](uint32_t m) { return may_be_taken_away(hits[m].triangle, p); });
        set.count = static_cast<uint32_t>(std::max(count, 0));
        set.least = static_cast<uint32_t>(std::max<int64_t>(count - taken, 0));
        return count < 0;
    });
    return out;
}

}  // namespace ref
