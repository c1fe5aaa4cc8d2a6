// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Sets of hits of which the whole picture fixes how many there are: pairs of triangles at both
// sides of an edge, and closed chains of them.
#include <algorithm>
#include <iterator>
#include <numeric>

#include "ref/expectation/narrowing.hpp"

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

}  // namespace

uint64_t Narrowing::edge_number(const cases::Triangle& triangle, uint32_t edge) {
    const uint32_t a = vertex_numbers_.of(triangle.draw, triangle.vertex[edge]);
    const uint32_t b = vertex_numbers_.of(triangle.draw, triangle.vertex[(edge + 1) % 3]);
    return uint64_t{std::min(a, b)} << 32U | std::max(a, b);
}

std::span<const Narrowing::EdgeOwner> Narrowing::triangles_at(uint64_t edge) {
    if (edge_owners_.empty()) {
        edge_owners_.reserve(3 * setups_.known().size());
        for (const uint32_t t : setups_.known()) {
            for (uint32_t e = 0; e < 3; ++e) {
                edge_owners_.push_back({edge_number(triangles_[t], e), t});
            }
        }
        std::sort(edge_owners_.begin(), edge_owners_.end(),
                  [](const EdgeOwner& a, const EdgeOwner& b) {
                      return a.edge < b.edge || (a.edge == b.edge && a.triangle < b.triangle);
                  });
    }
    const auto by_edge = [](const EdgeOwner& a, const EdgeOwner& b) { return a.edge < b.edge; };
    const auto [begin, end] =
        std::equal_range(edge_owners_.begin(), edge_owners_.end(), EdgeOwner{edge, 0}, by_edge);
    return {begin, end};
}

std::vector<Narrowing::Fixed> Narrowing::fixed_sets(const FixedPoint& p,
                                                    std::span<const Hit> hits) {
    std::vector<bool> is_paired(hits.size(), false);
    std::vector<Fixed> out = complementary_pairs(p, hits, is_paired);
    join_pairs(p, hits, out);
    std::vector<bool> is_open(hits.size());
    for (size_t m = 0; m < hits.size(); ++m) {
        is_open[m] = hits[m].coverage == Coverage::either && !is_paired[m];
    }
    if (depth_ != nullptr || follows_courses_) {
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
            for (Fixed& set : closed_sets(p, hits, takes_part)) {
                for (const uint32_t m : set.members) {
                    is_left[m] = false;
                }
                out.push_back(std::move(set));
            }
            begin = end;
        }
        is_open = is_left;
    }
    std::vector<Fixed> closed = closed_sets(p, hits, is_open);
    out.insert(out.end(), std::make_move_iterator(closed.begin()),
               std::make_move_iterator(closed.end()));
    if (profile_ == cases::Profile::direct3d) {
        add_decided_sets(p, hits, out);
    }
    return out;
}

void Narrowing::add_decided_sets(const FixedPoint& p, std::span<const Hit> hits,
                                 std::vector<Fixed>& sets) {
    std::vector<bool> takes_part(hits.size(), true);
    for (const Fixed& set : sets) {
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
            for (const EdgeOwner& owner : triangles_at(side.edge)) {
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
    for (const Fixed& set : closed_sets(p, all, takes_part)) {
        Fixed open;
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
            open.count = open.least = set.count - sure;
            sets.push_back(std::move(open));
        }
    }
}

FixedSet Narrowing::told_set(const FixedPoint& p, std::span<const Hit> hits,
                             const Fixed& set) const {
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

std::vector<Narrowing::Fixed> Narrowing::closed_sets(const FixedPoint& p, std::span<const Hit> hits,
                                                     const std::vector<bool>& takes_part) {
    std::vector<Fixed> out;
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
    std::erase_if(out, [&](Fixed& set) {
        const int count = count_of(p, hits, set.members);
        set.count = set.least = static_cast<uint32_t>(std::max(count, 0));
        return count < 0;
    });
    return out;
}

}  // namespace ref
