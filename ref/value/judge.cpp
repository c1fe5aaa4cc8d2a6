// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The verdict on one fragment. Stages: binary64 against the unsnapped and the snapped basis
// (accepts only what is proven); all bases of the profile in Balls; the same in rationals.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "ref/number/fixed_point.hpp"
#include "ref/value/sample_values.hpp"
#include "ref/value/set_ups.hpp"

namespace ref {

using cases::Profile;
using value::Ball;
using value::bits_of;
using value::is_plain_depth;
using value::Kind;
using value::Quantity;

void ValueReference::Impl::judge_samples(uint32_t t, cases::SampleId id,
                                         const FragmentValues& device, bool exact_only,
                                         FragmentVerdict& out) {
    std::array<std::optional<value::Fragment>, std::size(cases::kProfiles)> fragments;
    for (const Quantity& q : quantities_of(t)) {
        if (!value::is_sample_kind(q.kind) || !is_part(q)) {
            continue;
        }
        // What is allowed at a profile is allowed at every looser one.
        auto& strict = fragments.at(static_cast<size_t>(profile));
        if (!strict) {
            strict = covered_fragment(t, id, profile, exact_only);
        }
        if (may_be(*strict, q, device, profile)) {
            continue;
        }
        // The loosest profile that forbids it.
        for (const Profile at : cases::kProfiles) {
            auto& f = fragments.at(static_cast<size_t>(at));
            if (!f) {
                f = covered_fragment(t, id, at, exact_only);
            }
            if (at > profile || may_be(*f, q, device, at)) {
                continue;
            }
            add_mismatch(
                value::mismatch_of(q, ReasonKind::value_exact, at), q.get(device),
                [&] { return allowed_text(*f, q, at); }, out);
            break;
        }
    }
}

// One invocation has one gl_FragCoord: what it writes to gl_FragDepth is what it writes to the
// capture, clamped and stored.
void ValueReference::Impl::judge_coord_depth(uint32_t t, const FragmentValues& device,
                                             FragmentVerdict& out) {
    const cases::Draw& draw = c.draws[triangles[t].draw];
    if (!replaces_depth_by_coord(draw) || part != FragmentPart::all || !selection.depth ||
        !selection.frag_coord || !std::isfinite(device.frag_coord.z)) {
        return;
    }
    const value::StoredDepth stored(draw, c.target.depth_format, device.frag_coord.z);
    if (!stored.may_be(device.depth, profile)) {
        const auto depth = std::ranges::find_if(quantities_of(t),
                                                [](const Quantity& q) { return q.id.is_depth(); });
        const Profile level =
            stored.may_be(device.depth, Profile::vulkan) ? profile : Profile::vulkan;
        add_mismatch(
            value::mismatch_of(*depth, ReasonKind::value_coord_depth, level), device.depth,
            [&] { return stored.text(); }, out);
    }
}

// One invocation has one value of an input: where it is negative, the fragment was discarded.
void ValueReference::Impl::judge_sign(uint32_t t, const FragmentValues& device,
                                      FragmentVerdict& out) {
    const cases::Draw& draw = c.draws[triangles[t].draw];
    if (!discards_by_value(draw) || part == FragmentPart::depth ||
        !selection.attributes.at(draw.discard_attribute)) {
        return;
    }
    const float got = device.attributes.at(draw.discard_attribute).x;
    if (std::isfinite(got) && got <= -cases::kLeastNormal) {
        const QuantityId id = QuantityId::of_attribute(draw.discard_attribute, 0);
        const auto found = std::ranges::find(quantities_of(t), id, &Quantity::id);
        add_mismatch(
            value::mismatch_of(*found, ReasonKind::value_not_discarded, Profile::vulkan), got,
            [] { return std::string("0 or more"); }, out);
    }
}

namespace {

void tell_worst(const value::WorstError& worst, FragmentVerdict& out) {
    out.worst_ratio = worst.ratio;
    out.worst_quantity = worst.quantity;
}

}  // namespace

bool ValueReference::Impl::filter(uint32_t t, cases::SampleId id, const FragmentValues& device,
                                  FragmentVerdict& out) {
    const value::Loaded& triangle = load_filters(t);
    const FixedPoint fixed = sample_position(id.x, id.y, id.sample, c.target);
    const value::Point<double> centre{id.x + 0.5, id.y + 0.5};
    const value::Point<double> sample{pixels(fixed.x), pixels(fixed.y)};
    value::FilterPoints places{centre, sample, centre};
    if (c.target.samples > 1 || cases::has_large_fragments(*triangle.primitive.draw)) {
        // The likeliest alternative; the others are left to the next stage.
        const auto nominal =
            value::evaluations<Ball>(fragment(t, id, Profile::direct3d), Profile::direct3d).front();
        places = {{nominal.attributes[0].x.v, nominal.attributes[0].y.v},
                  sample,
                  {nominal.centroid[0].x.v, nominal.centroid[0].y.v}};
    }
    const std::span<const Quantity> all(selected.at(triangles[t].draw));
    const value::ProbePlace place = probe_place(t, id, profile);
    const auto accepts = [&](const value::Filter& filter, value::WorstError& worst) {
        return filter_accepts(filter, all, places, device, kBudgetFactor, worst) &&
               filter_accepts_probes(filter, all, place, device, kBudgetFactor, worst);
    };
    value::WorstError worst;
    bool is_decided = accepts(triangle.unsnapped, worst);
    if (triangle.has_snapped && !(is_decided && worst.ratio <= 1)) {
        value::WorstError snapped;
        if (accepts(triangle.snapped, snapped) && (!is_decided || snapped.ratio < worst.ratio)) {
            is_decided = true;
            out.basis = BasisKind::snapped;
            worst = snapped;
        }
    }
    tell_worst(worst, out);
    return is_decided;
}

FragmentVerdict ValueReference::Impl::judge(uint32_t t, cases::SampleId id,
                                            const FragmentValues& device, bool exact_only) {
    FragmentVerdict out;
    const value::Loaded& triangle = load(t);
    if (!triangle.primitive.is_finite) {
        return out;  // nothing is promised of a triangle with NaN or infinite positions
    }
    const std::vector<Quantity>& all = quantities_of(t);
    for (const Quantity& q : all) {
        if (is_part(q) && q.kind == Kind::flat) {
            judge_flat(triangle.primitive, q, q.get(device), out);
        }
    }
    judge_samples(t, id, device, exact_only, out);
    judge_coord_depth(t, device, out);
    judge_sign(t, device, out);
    const bool is_decided = !exact_only && part == FragmentPart::all &&
                            is_plain_depth(triangle.primitive) && filter(t, id, device, out);
    // Accepted, but above one budget: another basis may explain it better.
    if (profile == Profile::vulkan && !tells_ratios && !exact_only) {
        if (!is_decided) {
            value::CandidateVerdict verdict;
            verdict.failing = in_order(t, failing_at(t, id, device, profile, asked(t, profile)));
            verdict.ratios.assign(verdict.failing.size(), HUGE_VAL);
            describe(t, id, device, verdict, out);
        }
    } else if (!is_decided || out.worst_ratio > 1) {
        const value::CandidateVerdict verdict = wide(t, id, device, profile, exact_only);
        out.basis = verdict.basis;
        tell_worst(verdict.worst, out);
        if (!verdict.ok) {
            describe(t, id, device, verdict, out);
        }
    }
    out.ok = out.mismatches.empty();
    for (const ValueMismatch& m : out.mismatches) {
        if (m.ratio > out.worst_ratio) {
            tell_worst({m.ratio, m.quantity}, out);
        }
    }
    return out;
}

ValueReference::ValueReference(const cases::Case& c, const Limits& limits, Profile profile)
    : impl_(std::make_unique<Impl>(c, limits, profile)) {}
ValueReference::~ValueReference() = default;
ValueReference::ValueReference(ValueReference&&) noexcept = default;

void ValueReference::judge_only(const ValueSelection& selection) {
    impl_->selection = selection;
    impl_->selected = impl_->quantities;
    for (std::vector<Quantity>& draw : impl_->selected) {
        std::erase_if(draw, [&](const Quantity& q) { return !selection.has(q.id); });
    }
}

void ValueReference::tell_only(std::function<bool(const ValueMismatch&)> is_told) {
    impl_->is_told = std::move(is_told);
}

void ValueReference::tell_ratios(bool are_told) {
    impl_->tells_ratios = are_told;
}

void ValueReference::tell_loosest_levels() {
    impl_->loosest_levels.emplace();
}

FragmentVerdict ValueReference::judge(uint32_t t, cases::SampleId sample,
                                      const FragmentValues& device, FragmentPart part) {
    impl_->part = part;
    return impl_->judge(t, sample, device, false);
}

FragmentVerdict ValueReference::judge_exact(uint32_t t, cases::SampleId sample,
                                            const FragmentValues& device, FragmentPart part) {
    impl_->part = part;
    return impl_->judge(t, sample, device, true);
}

}  // namespace ref
