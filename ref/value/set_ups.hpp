// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What ValueReference keeps of a case: bases and filters by triangle, sets of candidates, coverage
// by profile. Judging is judge.cpp, what is wrong and at which level mismatch.cpp, what
// to expect expected_values.cpp.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "cases/base/number_text.hpp"
#include "cases/model/sample.hpp"
#include "ref/value/accept/filter.hpp"
#include "ref/value/accept/filter_run.hpp"
#include "ref/value/accept/judge_candidates.hpp"
#include "ref/value/accept/probe.hpp"
#include "ref/value/accept/set_bounds.hpp"
#include "ref/value/fragment/fragment_coverage.hpp"
#include "ref/value/fragment/promise.hpp"
#include "ref/value/places.hpp"
#include "ref/value/reference.hpp"

namespace ref {

namespace value {

// Sets of candidates are large (up to 64 bases) and needed for few triangles: the last ones are
// kept.
template <class T>
class CandidateCache {
  public:
    explicit CandidateCache(size_t capacity) : capacity_(capacity) {}

    template <class Make>
    const CandidateSet<T>& get(uint32_t t, cases::Profile profile, Make make) {
        for (const Entry& e : entries_) {
            if (e.triangle == t && e.profile == profile) {
                return e.set;
            }
        }
        if (entries_.size() == capacity_) {
            entries_.pop_front();
        }
        entries_.push_back({t, profile, make()});
        return entries_.back().set;
    }

    void forget(uint32_t t, cases::Profile profile) {
        std::erase_if(entries_,
                      [&](const Entry& e) { return e.triangle == t && e.profile == profile; });
    }

  private:
    struct Entry {
        uint32_t triangle;
        cases::Profile profile;
        CandidateSet<T> set;
    };
    size_t capacity_;
    std::deque<Entry> entries_;
};

struct Loaded {
    Primitive primitive;
    Filter unsnapped, snapped;
    bool has_filters = false;                      // the two are made when first asked for
    bool has_snapped = false;                      // and it differs from the unsnapped one
    std::optional<std::vector<Promise>> promises;  // filled when first asked for
    // Of what each profile admits, likewise.
    std::array<std::optional<SetBounds>, std::size(cases::kProfiles)> bounds;
};

// A number as read back, and its bits.
inline std::string bits_of(float f) {
    return fmt::format("{} (0x{:08x})", cases::number_text(f), std::bit_cast<uint32_t>(f));
}

// Depth that is stored as it is interpolated: the filters know no other.
inline bool is_plain_depth(const Primitive& primitive) {
    const cases::DepthState& depth = primitive.draw->depth;
    return primitive.depth_format == cases::DepthFormat::d32_float && !depth.bias && !depth.clamp &&
           !replaces_depth(*primitive.draw);
}

// What is wrong with a quantity and why, without the texts.
inline ValueMismatch mismatch_of(const Quantity& q, ReasonKind reason, cases::Profile level) {
    ValueMismatch m;
    m.quantity = q.id;
    m.reason = reason;
    m.level = level;
    m.rule = rule_of(reason, level);
    m.rule = m.rule.empty() ? q.rule : m.rule;
    m.ratio = std::numeric_limits<double>::infinity();
    return m;
}

// What a flat component is: the provoking vertex's.
inline float provoking_value(const Primitive& primitive, const Quantity& q) {
    const auto component = static_cast<glm::vec4::length_type>(q.id.component);
    const auto& values = primitive.draw->attributes[q.id.attribute].values;
    return values[primitive.triangle.provoking][component];
}

// The depth of a plane with the bias of nominal_bias().
mpq_class biased_depth(const Primitive& primitive, const Basis<mpq_class>& basis,
                       const mpq_class& z, cases::Profile profile);

// The depth that a device most likely stores, from the exact one of its plane: with the bias of
// nominal_bias(), clamped, and in fixed point the nearest step.
mpq_class nominal_depth(const Primitive& primitive, const Basis<mpq_class>& basis,
                        const mpq_class& z, cases::Profile profile);

}  // namespace value

struct ValueReference::Impl {
    using Ball = value::Ball;
    using Kind = value::Kind;
    using Loaded = value::Loaded;
    using Profile = cases::Profile;
    using Quantity = value::Quantity;

    const cases::Case& c;
    Limits limits;
    Profile profile;
    std::vector<cases::Triangle> triangles;
    std::vector<std::vector<Quantity>> quantities;  // by draw
    std::vector<std::unique_ptr<Loaded>> loaded;    // by triangle
    std::deque<uint32_t> order;                     // of the loaded ones, oldest first
    static constexpr size_t kKeptTriangles = 16384;
    std::tuple<value::CandidateCache<Ball>, value::CandidateCache<mpq_class>> candidate_caches{
        value::CandidateCache<Ball>(128), value::CandidateCache<mpq_class>(32)};
    std::array<std::unique_ptr<FragmentCoverage>, std::size(cases::kProfiles)>
        coverage;  // by profile
    // The unsnapped bases of the triangle that was described last.
    uint32_t described_triangle = 0;
    std::tuple<std::optional<value::Basis<Ball>>, std::optional<value::Basis<mpq_class>>>
        described_bases;
    uint32_t range_triangle = 0;
    cases::SampleId range_id;
    std::vector<value::Evaluation<Ball>> range_places;
    FragmentPart part = FragmentPart::all;              // of the fragment being judged
    std::function<bool(const ValueMismatch&)> is_told;  // tell_only(); empty: all
    bool tells_ratios = true;                           // tell_ratios()
    // tell_loosest_levels(): of a quantity of a draw that is wrong for some reason, how many values
    // have been asked, and the loosest level of them.
    struct Asked {
        size_t values = 0;
        Profile loosest = Profile::direct3d;
        bool is_enough() const {
            constexpr size_t kOfVulkan = 16, kOfOthers = 256;
            return values >= (loosest == Profile::vulkan ? kOfVulkan : kOfOthers);
        }
    };
    std::optional<std::map<std::tuple<uint32_t, size_t, ReasonKind>, Asked>> loosest_levels;
    ValueSelection selection;
    std::vector<std::vector<Quantity>> selected;  // the quantities of it, by draw

    Impl(const cases::Case& the_case, const Limits& the_limits, Profile the_profile)
        : c(the_case), limits(the_limits), profile(the_profile), triangles(assemble(the_case)) {
        for (const cases::Draw& draw : c.draws) {
            quantities.push_back(value::quantities(draw, c.target));
        }
        loaded.resize(triangles.size());
        selected = quantities;
    }

    const std::vector<Quantity>& quantities_of(uint32_t t) const {
        return quantities[triangles[t].draw];
    }

    Loaded& load(uint32_t t) {
        std::unique_ptr<Loaded>& slot = loaded[t];
        if (slot) {
            return *slot;
        }
        slot = std::make_unique<Loaded>();
        // Samples come row by row: what was not asked for longest is not asked for soon.
        order.push_back(t);
        if (order.size() > kKeptTriangles) {
            loaded[order.front()].reset();
            order.pop_front();
        }
        slot->primitive = value::make_primitive(c, triangles[t], limits);
        return *slot;
    }

    // The same with the filters, which only a fragment's verdict needs.
    const Loaded& load_filters(uint32_t t) {
        Loaded& slot = load(t);
        if (slot.has_filters) {
            return slot;
        }
        slot.has_filters = true;
        const auto inputs = value::plane_inputs<Ball>(slot.primitive, quantities_of(t));
        const auto ideal = value::ideal_vertices<Ball>(slot.primitive);
        slot.unsnapped = make_filter(make_basis(ideal, inputs, kBudgetFactor));
        const auto at = snapped_positions(slot.primitive, limits);
        if (at) {
            const auto moved = value::moved_vertices<Ball>(slot.primitive, *at);
            for (size_t i = 0; i < 3; ++i) {
                // Not provably the same position: a basis of its own.
                slot.has_snapped = slot.has_snapped || is_other(moved.hx[i], ideal.hx[i]) ||
                                   is_other(moved.hy[i], ideal.hy[i]);
            }
            if (slot.has_snapped) {
                slot.snapped = make_filter(make_basis(moved, inputs, kBudgetFactor));
            }
        }
        return slot;
    }

    FragmentCoverage& coverage_at(Profile at) {
        auto& slot = coverage.at(static_cast<size_t>(at));
        if (!slot) {
            slot = std::make_unique<FragmentCoverage>(c, limits, at, triangles);
        }
        return *slot;
    }

    // Where the fragment is, and what a profile says of its coverage if anything depends on it.
    value::Fragment fragment(uint32_t t, cases::SampleId id, Profile at, bool is_exact = false) {
        value::Fragment f = covered_fragment(t, id, at, is_exact);
        const bool has_places = c.target.samples > 1 || has_large_fragments(*f.draw);
        if (at != Profile::direct3d && has_places && value::has_centroid(*f.draw)) {
            f.region = coverage_at(at).region(t, id.x, id.y);
        }
        return f;
    }

    // The same without the part of the pixel that lies in the primitive, which takes rationals.
    value::Fragment covered_fragment(uint32_t t, cases::SampleId id, Profile at, bool is_exact) {
        value::Fragment f;
        f.id = id;
        f.target = &c.target;
        f.draw = &c.draws[triangles[t].draw];
        f.block = cases::fragment_block(*f.draw, id.x, id.y);
        const bool has_mask =
            std::any_of(quantities_of(t).begin(), quantities_of(t).end(),
                        [](const Quantity& q) { return q.kind == Kind::sample_mask; });
        const bool has_centroid =
            (c.target.samples > 1 || has_large_fragments(*f.draw)) && value::has_centroid(*f.draw);
        if (has_mask || has_centroid) {
            FragmentCoverage& cover = coverage_at(at);
            f.coverage = is_exact ? cover.exact(t, id.x, id.y) : cover.of(t, id.x, id.y);
        }
        return f;
    }

    value::ProbePlace probe_place(uint32_t t, cases::SampleId id, Profile at) const {
        return {id, &c.target, &c.draws[triangles[t].draw], limits, at};
    }

    // Whether one of the two nominal bases is proven to explain all numbers of the fragment.
    bool filter(uint32_t t, cases::SampleId id, const FragmentValues& device, FragmentVerdict& out);

    // The unsnapped basis; the last one is kept.
    template <class T>
    const value::Basis<T>& unsnapped_basis(uint32_t t) {
        if (described_triangle != t) {
            described_bases = {};
            described_triangle = t;
        }
        auto& basis = std::get<std::optional<value::Basis<T>>>(described_bases);
        if (!basis) {
            const value::Primitive& primitive = load(t).primitive;
            basis = make_basis(value::ideal_vertices<T>(primitive),
                               value::plane_inputs<T>(primitive, quantities_of(t)), kBudgetFactor);
        }
        return *basis;
    }

    // Whether the part of the fragment that is being judged has the quantity.
    bool is_part(const Quantity& q) const {
        return selection.has(q.id) &&
               (part == FragmentPart::all || q.id.is_depth() == (part == FragmentPart::depth));
    }

    static bool is_other(const Ball& a, const Ball& b) {
        return std::fabs(a.v - b.v) > 0 || a.e > std::fabs(a.v) * 0x1p-40;
    }

    const std::vector<value::Promise>& promises(uint32_t t) {
        Loaded& triangle = load(t);
        if (!triangle.promises) {
            triangle.promises = value::promises_of(triangle.primitive, quantities_of(t));
        }
        return *triangle.promises;
    }

    // Whether the profile asks for a quantity.
    bool is_asked(uint32_t t, size_t index, Profile at) {
        const value::Promise& promise = promises(t)[index];
        return is_part(quantities_of(t)[index]) && promise.is_number &&
               (at != Profile::vulkan || promise.is_guaranteed);
    }
    std::vector<size_t> asked(uint32_t t, Profile at) {
        std::vector<size_t> out(quantities_of(t).size());
        std::iota(out.begin(), out.end(), size_t{0});
        std::erase_if(out, [&](size_t index) { return !is_asked(t, index, at); });
        return out;
    }

    // Where the fragment's inputs may be evaluated at the profile; the last answer is kept.
    const std::vector<value::Evaluation<Ball>>& places_of_range(uint32_t t, cases::SampleId id) {
        if (range_places.empty() || range_triangle != t || !(range_id == id)) {
            range_places = value::evaluations<Ball>(fragment(t, id, profile), profile);
            range_triangle = t;
            range_id = id;
        }
        return range_places;
    }

    template <class T>
    const value::CandidateSet<T>& candidates(uint32_t t, Profile at) {
        return std::get<value::CandidateCache<T>>(candidate_caches).get(t, at, [&] {
            return value::make_candidates<T>(load(t).primitive, quantities_of(t), limits, at);
        });
    }

    // What the Balls of the triangle's set tell or, if they cannot, those of the exact set, which
    // are kept from then on; the last answer if neither can.
    template <class Ask>
    auto ask_balls(uint32_t t, Profile at, Ask ask) {
        auto answer = ask(candidates<Ball>(t, at));
        if (answer || candidates<Ball>(t, at).exact) {
            return answer;
        }
        auto& cache = std::get<value::CandidateCache<Ball>>(candidate_caches);
        cache.forget(t, at);
        return ask(cache.get(t, at, [&] { return value::rounded(candidates<mpq_class>(t, at)); }));
    }

    // What depends on the plane of depth, and all else.
    std::array<std::vector<size_t>, 2> groups_of(uint32_t t, std::span<const size_t> all) const {
        std::array<std::vector<size_t>, 2> groups;
        for (const size_t index : all) {
            groups.at(quantities_of(t)[index].plane == value::kPlaneDepth ? 0 : 1).push_back(index);
        }
        return groups;
    }

    // By Balls, and by rationals where these do not tell; `exact_only`: the oracle, by rationals
    // alone.
    // One candidate explains a fragment, or one explains what depends on the plane of depth
    // (FragCoord.z and the depth that is stored, which fixed-function hardware computes) and one
    // all else: no text says that both are set up from the same positions.
    value::CandidateVerdict wide(uint32_t t, cases::SampleId id, const FragmentValues& device,
                                 Profile at, bool exact_only = false) {
        const std::vector<size_t> all = asked(t, at);
        const value::CandidateVerdict unknown{false, false, ref::BasisKind::unsnapped, {}, {}, {}};
        auto [of_depth, others] = groups_of(t, all);
        std::array<value::GroupVerdict, 2> groups{
            {{std::move(of_depth), unknown}, {std::move(others), unknown}}};
        // At vulkan each value stands alone anyway.
        if (at == Profile::vulkan || groups[0].only.empty() || groups[1].only.empty()) {
            return wide_of(t, id, device, at, all, exact_only);
        }
        value::CandidateVerdict verdict = wide_of(t, id, device, at, all, exact_only, groups);
        if (verdict.ok) {
            return verdict;
        }
        bool is_known = true;  // the first that is not may have the set made more exact
        for (value::GroupVerdict& group : groups) {
            is_known = is_known && group.verdict.is_known;
            if (!is_known) {
                group.verdict = wide_of(t, id, device, at, group.only, exact_only);
            }
        }
        return value::verdict_of_both(groups[0].verdict, groups[1].verdict);
    }

    // `groups` get verdicts of their own where these come with that on all.
    value::CandidateVerdict wide_of(uint32_t t, cases::SampleId id, const FragmentValues& device,
                                    Profile at, const std::vector<size_t>& only, bool exact_only,
                                    std::span<value::GroupVerdict> groups = {}) {
        if (only.empty()) {
            return {true, true, ref::BasisKind::unsnapped, {}, {}, {}};
        }
        const value::ProbePlace place = probe_place(t, id, at);
        const value::Asked asked{quantities_of(t), load(t).primitive.is_projectable, &place,
                                 &device, only};
        const auto judge_by = [&]<class T>(const value::CandidateSet<T>& set) {
            value::CandidateVerdict verdict = judge_candidates(
                set, value::evaluations<T>(fragment(t, id, at, exact_only), at), asked,
                std::is_same_v<T, Ball> ? groups : std::span<value::GroupVerdict>());
            return verdict.is_known ? std::optional(std::move(verdict)) : std::nullopt;
        };
        if (!exact_only) {
            auto verdict = ask_balls(t, at, judge_by);
            if (verdict) {
                return *std::move(verdict);
            }
        }
        return *judge_by(candidates<mpq_class>(t, at));
    }

    // Bounds on all that a profile admits for the triangle.
    const value::SetBounds& bounds(uint32_t t, Profile at);
    // Values that hold all that the profile accepts of a quantity, if a bound is known.
    std::optional<value::Range<double>> outer(uint32_t t, cases::SampleId id, size_t index);

    // Whether each of these values is proven to fail at the profile, whichever set-up is taken.
    bool are_rejected(uint32_t t, cases::SampleId id, const FragmentValues& device, Profile at,
                      const std::vector<size_t>& suspects);

    // Failing values in the order of judge_candidates(): probes are behind all others.
    std::vector<size_t> in_order(uint32_t t, std::vector<size_t> failing) const {
        std::ranges::sort(failing, {}, [&](size_t index) {
            return std::pair(quantities_of(t)[index].kind == Kind::probe, index);
        });
        return failing;
    }

    // What fails of wide(), in any order and in less time: without ratios, unless they decide which
    // candidate is best.
    // `suspects`: what fails at the profile that is judged.
    std::vector<size_t> failing_at(uint32_t t, cases::SampleId id, const FragmentValues& device,
                                   Profile at, const std::vector<size_t>& suspects);

    std::vector<value::RunValue> run_values;  // of the run that is being judged
    size_t count_exact(const Quantity& q, const value::RunValue& got, const FragmentRun& run,
                       float flat) const;
    size_t judge_run(uint32_t t, const FragmentRun& run, std::span<double> ratios);

    void judge_flat(const value::Primitive& primitive, const Quantity& q, float got,
                    FragmentVerdict& out) const;
    void judge_samples(uint32_t t, cases::SampleId id, const FragmentValues& device,
                       bool exact_only, FragmentVerdict& out);
    void judge_coord_depth(uint32_t t, const FragmentValues& device, FragmentVerdict& out);
    void judge_sign(uint32_t t, const FragmentValues& device, FragmentVerdict& out);
    std::vector<Profile> levels_of(uint32_t t, cases::SampleId id, const FragmentValues& device,
                                   const std::vector<size_t>& failing,
                                   const std::vector<ReasonKind>& reasons);
    // levels_of() of a fragment, whatever is known of others.
    std::vector<Profile> ask_levels(uint32_t t, cases::SampleId id, const FragmentValues& device,
                                    const std::vector<size_t>& failing);
    void describe(uint32_t t, cases::SampleId id, const FragmentValues& device,
                  const value::CandidateVerdict& verdict, FragmentVerdict& out);
    template <class T>
    std::optional<ReasonKind> reason_of(uint32_t t, cases::SampleId id,
                                        const FragmentValues& device, size_t index);
    std::string expected_text(uint32_t t, cases::SampleId id, const Quantity& q);
    void add_mismatch(ValueMismatch mismatch, float got,
                      const std::function<std::string()>& expected, FragmentVerdict& out) const;
    FragmentVerdict judge(uint32_t t, cases::SampleId id, const FragmentValues& device,
                          bool exact_only);
};

}  // namespace ref
