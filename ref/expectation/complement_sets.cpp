// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/complement_sets.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "ref/coverage/outline.hpp"

namespace ref {

namespace {

constexpr EdgeLabel kFirstUserEdge = kFirstClipEdge + static_cast<EdgeLabel>(ClipPlane::user_0);

}  // namespace

ComplementSets::ComplementSets(const cases::Case& c, cases::Profile profile,
                               const std::vector<cases::Triangle>& triangles,
                               TriangleSetups& setups, const Predicates& predicates,
                               SharedEdges& edges)
    : case_(c),
      profile_(profile),
      triangles_(triangles),
      setups_(setups),
      predicates_(predicates),
      edges_(edges),
      complements_(complements_of(c, triangles)) {}

std::vector<FixedHits> ComplementSets::of(const FixedPoint& p, uint32_t sample,
                                          std::span<const Hit> hits, std::vector<bool>& is_paired) {
    sample_ = sample;
    std::vector<FixedHits> out = complementary_pairs(p, hits, is_paired);
    join_pairs(p, hits, out);
    return out;
}

bool ComplementSets::is_inside_whole(const FixedPoint& p, const TriangleSetup& setup) const {
    if (setup.kind != TriangleSetup::Kind::outlines || setup.may_be_culled ||
        setup.tested.empty() || !setup.window.must_touch(p)) {
        return false;
    }
    SharedEdges::Near near{};
    for (const Outline* const outline : setup.outlines()) {
        if (!edges_.find_near(p, *outline, kFirstUserEdge, near)) {
            return false;
        }
    }
    return !near[0] && !near[1] && !near[2] &&
           std::all_of(setup.tested.begin(), setup.tested.end(),
                       [&](const Outline& o) { return predicates_.is_inside_whole(setup, o, p); });
}

std::vector<FixedHits> ComplementSets::complementary_pairs(const FixedPoint& p,
                                                           std::span<const Hit> hits,
                                                           std::vector<bool>& is_paired) const {
    std::vector<FixedHits> out;
    if (complements_.empty()) {
        return out;
    }
    // What is left of a triangle whose vertices may lie on a line, as they are or once they are
    // snapped, is folded where the cuts are snapped, and its other edges may cover a sample that is
    // far from "regions where those primitives are cut by the clip planes".
    const auto may_fold = [&](uint32_t t) {
        const TriangleSetup& setup = setups_[t];
        const int8_t whole = setup.tested_unclipped;
        return whole >= 0 &&
               signs_of(setup.tested[static_cast<size_t>(whole)], setup.grid_step, false).only() ==
                   0;
    };
    for (uint32_t m = 0; m < hits.size(); ++m) {
        const Complement& c = complements_[hits[m].triangle];
        for (uint32_t n = m + 1; n < hits.size() && c.partner != kNoPartner; ++n) {
            if (hits[n].triangle != c.partner || may_fold(hits[m].triangle) ||
                may_fold(c.partner)) {
                continue;
            }
            const auto is_must = [&](uint32_t k) { return hits[k].coverage == Coverage::must; };
            const auto is_kept = [&](uint32_t k) {
                return !takes_away_by_value(case_.draws[triangles_[hits[k].triangle].draw]);
            };
            const bool is_hit = is_must(m) || is_must(n) ||
                                (c.fills && is_kept(m) && is_kept(n) &&
                                 is_inside_whole(p, setups_[hits[m].triangle]) &&
                                 is_inside_whole(p, setups_[hits[n].triangle]));
            out.push_back({{m, n}, 1, is_hit ? 1U : 0U, true});
            is_paired[m] = is_paired[n] = true;
        }
    }
    return out;
}

bool ComplementSets::add_whole_sides(const FixedPoint& p, uint32_t whole, uint32_t member,
                                     std::vector<Side>& sides) {
    // No text promises a shared edge after clipping by the view volume.
    const bool is_literal = profile_ == cases::Profile::vulkan;
    SharedEdges::Near near{};
    for (const uint32_t t : {whole, complements_[whole].partner}) {
        const TriangleSetup& setup = setups_[t];
        if (setup.kind != TriangleSetup::Kind::outlines || setup.orientation == 0 ||
            setup.may_be_culled || setup.tested_unclipped < 0 ||
            takes_away_by_value(case_.draws[triangles_[t].draw]) ||
            !setup.window.may_write(sample_) || !setup.window.must_touch(p) ||
            (is_literal && setup.tested_clipped != setup.tested_unclipped)) {
            return false;
        }
        // The pairwise rule contradicts itself where many triangles meet in a vertex.
        const Outline& uncut = setup.tested[static_cast<size_t>(setup.tested_unclipped)];
        for (const Box& box : uncut.vertices()) {
            if (is_literal && predicates_.is_in_hull({&box, 1}, p)) {
                return false;
            }
        }
        for (const Outline* const outline : setup.outlines()) {
            if (!edges_.find_near(p, *outline, kFirstUserEdge, near)) {
                return false;
            }
        }
    }
    return edges_.add(whole, near, member, sides);
}

int ComplementSets::count_of_wholes(const FixedPoint& p, std::span<const uint32_t> wholes) const {
    int open = 0;
    int cut = 0;  // by the view volume
    for (const uint32_t t : wholes) {
        const TriangleSetup& setup = setups_[t];
        const auto turns = [&](int8_t index) {
            return edges_.winding_of(p, setup, setup.tested[static_cast<size_t>(index)]);
        };
        const int one = turns(setup.tested_unclipped);
        open += one;
        cut += setup.tested_clipped < 0 ? one : turns(setup.tested_clipped);
    }
    return open == cut ? open : -1;
}

std::optional<FixedHits> ComplementSets::joined_set(const FixedPoint& p, std::span<const Hit> hits,
                                                    uint32_t first) {
    std::vector<uint32_t> wholes{first};  // the earlier triangle of each pair
    std::vector<Side> sides;
    for (size_t k = 0; k < wholes.size(); ++k) {
        const size_t before = sides.size();
        if (!add_whole_sides(p, wholes[k], static_cast<uint32_t>(k), sides)) {
            return std::nullopt;
        }
        for (size_t i = before; i < sides.size(); ++i) {
            for (const EdgeOwner& owner : edges_.triangles_at(sides[i].edge)) {
                if (setups_[owner.triangle].kind == TriangleSetup::Kind::nothing) {
                    continue;
                }
                const Complement& c = complements_[owner.triangle];
                if (c.partner == kNoPartner || !c.fills) {
                    return std::nullopt;
                }
                const uint32_t whole = std::min(owner.triangle, c.partner);
                if (triangles_[whole].draw != triangles_[first].draw) {
                    return std::nullopt;
                }
                if (std::find(wholes.begin(), wholes.end(), whole) == wholes.end()) {
                    wholes.push_back(whole);
                }
            }
        }
    }
    for (const Side& side : sides) {
        int balance = 0;
        for (const Side& other : sides) {
            balance += other.edge != side.edge ? 0 : other.is_forward ? 1 : -1;
        }
        if (balance != 0) {
            return std::nullopt;
        }
    }
    if (count_of_wholes(p, wholes) != 1) {
        return std::nullopt;
    }
    FixedHits out;
    out.count = out.least = 1;
    out.is_complement = true;
    for (const uint32_t whole : wholes) {
        for (const uint32_t t : {whole, complements_[whole].partner}) {
            const auto hit = std::find_if(hits.begin(), hits.end(),
                                          [t](const Hit& h) { return h.triangle == t; });
            if (hit == hits.end()) {
                out.decided.push_back(t);
            } else if (hit->coverage == Coverage::must) {
                return std::nullopt;  // its pair is decided by itself
            } else {
                out.members.push_back(static_cast<uint32_t>(hit - hits.begin()));
            }
        }
    }
    std::sort(out.members.begin(), out.members.end());
    return out;
}

void ComplementSets::join_pairs(const FixedPoint& p, std::span<const Hit> hits,
                                std::vector<FixedHits>& pairs) {
    std::vector<bool> is_joined(hits.size());
    std::vector<FixedHits> joined;
    for (const FixedHits& pair : pairs) {
        const uint32_t first = hits[pair.members[0]].triangle;
        if (pair.least > 0 || !complements_[first].fills || is_joined[pair.members[0]]) {
            continue;
        }
        std::optional<FixedHits> set = joined_set(p, hits, first);
        if (!set) {
            continue;
        }
        for (const uint32_t m : set->members) {
            is_joined[m] = true;
        }
        joined.push_back(*std::move(set));
    }
    std::erase_if(pairs, [&](const FixedHits& pair) { return is_joined[pair.members[0]]; });
    std::move(joined.begin(), joined.end(), std::back_inserter(pairs));
}

}  // namespace ref
