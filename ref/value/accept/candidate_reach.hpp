// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds which numbers the candidates of a set accept, quantity by quantity, at one evaluation, and
// what of it holds at the next one, too. judge_candidates.cpp and judge_separately.cpp use it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "ref/value/accept/probe.hpp"
#include "ref/value/accept/reach.hpp"

namespace ref::value {

// The lists of points of an evaluation.
enum : size_t { kAttributes, kFragCoord, kSample, kCentroid, kPlaces };

template <class T>
std::span<const Point<T>> points_at(const Evaluation<T>& where, size_t place) {
    switch (place) {
        case kFragCoord:
            return where.frag_coord;
        case kSample:
            return {&where.sample, 1};
        case kCentroid:
            return where.centroid;
        default:
            return where.attributes;
    }
}

// The list at which a quantity is evaluated.
template <class T>
size_t place_of(const Quantity& q, const Evaluation<T>& where) {
    // A depth that is not the sample's is a gl_FragCoord.z.
    const bool is_coord = q.id.of == QuantityId::Of::frag_coord || q.id.is_depth();
    return q.at_sample                             ? kSample
           : q.at_centroid                         ? kCentroid
           : is_coord && !where.frag_coord.empty() ? kFragCoord
                                                   : kAttributes;
}

// Memory that one call of add_candidate() leaves to the next one: there are thousands.
template <class T>
struct CandidateScratch {
    std::vector<T> widest;
    std::array<std::vector<Site<T>>, kPlaces> sites;
};

// Adds what a candidate accepts for every judged quantity.
template <class T>
void add_candidate(const CandidateSet<T>& set, const Candidate<T>& candidate,
                   const Evaluation<T>& where, const Asked& asked, CandidateScratch<T>& scratch,
                   std::vector<Reach<T>>& reaches) {
    const std::span<const Quantity> quantities = asked.quantities;
    auto& [widest, sites] = scratch;
    widest.assign(quantities.size(), T{});
    const bool at_sample = is_same(where.attributes, where.sample);
    const bool centroid_at_sample = is_same(where.centroid, where.sample);
    std::array<bool, kPlaces> is_needed{};
    for (size_t i = 0; i < quantities.size(); ++i) {
        if (is_judged(asked, i)) {
            is_needed.at(place_of(quantities[i], where)) = true;
        }
    }
    for (const Basis<T>& basis : candidate.bases) {
        const Plane<T>& inv_w = basis.planes[kPlaneInvW];
        for (size_t place = 0; place < kPlaces; ++place) {
            sites[place].clear();
            if (is_needed[place]) {
                for (const Point<T>& p : points_at(where, place)) {
                    sites[place].push_back(make_site(basis, inv_w, p, set.factor));
                }
                spread_budgets(inv_w, set.factor, sites[place]);
            }
        }
        for (size_t i = 0; i < quantities.size(); ++i) {
            const Quantity& q = quantities[i];
            if (is_judged(asked, i) && reaches[i].is_known) {
                const std::span<const Site<T>> at(sites[place_of(q, where)]);
                const bool is_own = q.at_sample || (q.at_centroid ? centroid_at_sample : at_sample);
                add_reach(set, basis, q, at, set.hulls[i], is_own,
                          set.covers_samples && candidate.name == ref::BasisKind::snapped,
                          asked.got(i), widest[i], reaches[i]);
            }
        }
    }
    for (size_t i = 0; i < quantities.size(); ++i) {
        const Quantity& q = quantities[i];
        // A noperspective value of a triangle that reaches behind the eye has no plane that agrees
        // with the vertices: only their hull is claimed.
        const bool free_plane =
            q.kind == Kind::linear && q.id.is_attribute() && !asked.is_projectable;
        reaches[i].is_free = reaches[i].is_free || (is_judged(asked, i) && candidate.is_free);
        if (is_judged(asked, i) && (free_plane || candidate.is_unbounded)) {
            if (takes_bias(set, q)) {
                reaches[i].is_free = true;  // of a gradient without bounds
                continue;
            }
            add_hull(set.hulls[i], widest[i], asked.got(i), reaches[i].all);
        }
    }
}

inline bool is_identical(const Ball& a, const Ball& b) {
    return std::bit_cast<uint64_t>(a.v) == std::bit_cast<uint64_t>(b.v) &&
           std::bit_cast<uint64_t>(a.e) == std::bit_cast<uint64_t>(b.e);
}
inline bool is_identical(const mpq_class& a, const mpq_class& b) {
    return a == b;
}
template <class T>
bool is_identical(std::span<const Point<T>> a, std::span<const Point<T>> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
        return is_identical(p.x, q.x) && is_identical(p.y, q.y);
    });
}

// What one evaluation leaves to the next one. Of a set of candidates, a quantity's reach depends on
// the points where it is evaluated and on whether they are the sample itself (add_candidate), and
// what probes accept on the points of `attributes` and `sample`, or on no point of the evaluation
// at all (judge_probes): evaluations of several places for one input share all the others.
template <class T>
struct Shared {
    std::vector<size_t> fresh;  // judged quantities whose points differ
    bool has_fresh_probes = true;

    Shared(const Asked& asked, const Evaluation<T>* before, const Evaluation<T>& now) {
        const std::span<const Quantity> quantities = asked.quantities;
        std::array<bool, kPlaces> is_kept{};
        for (size_t place = 0; before != nullptr && place < kPlaces; ++place) {
            is_kept.at(place) = is_identical(points_at(*before, place), points_at(now, place));
        }
        has_fresh_probes = !is_kept[kSample] ||
                           (!is_kept[kAttributes] &&
                            std::any_of(quantities.begin(), quantities.end(), [](const auto& q) {
                                return q.kind == Kind::probe && looks_around(q.probe);
                            }));
        for (size_t i = 0; i < quantities.size(); ++i) {
            const Quantity& q = quantities[i];
            if (!is_judged(asked, i)) {
                continue;
            }
            const size_t place = place_of(q, now);
            // FragCoord's list goes with what the attributes' is to the sample.
            const bool is_same_reach = is_kept.at(place) && is_kept[kSample] &&
                                       place_of(q, *before) == place &&
                                       (place != kFragCoord || is_kept[kAttributes]);
            if (!is_same_reach) {
                fresh.push_back(i);
            }
        }
    }

  private:
    static bool looks_around(cases::Probe probe) {
        return probe == cases::Probe::lod || derivative_of(probe).has_value();
    }
};

}  // namespace ref::value
