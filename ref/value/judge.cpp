// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "cases/base/float_bits.hpp"
#include "cases/base/number_text.hpp"
#include "ref/number/fixed_point.hpp"
#include "ref/value/describe.hpp"
#include "ref/value/sample_values.hpp"

namespace ref::value {

using cases::Profile;
using cases::same_bits;

namespace {

// A number as read back, and its bits.
std::string bits_of(float f) {
    return fmt::format("{} (0x{:08x})", cases::number_text(f), std::bit_cast<uint32_t>(f));
}

class FragmentJudge {
  public:
    FragmentJudge(const DrawnFragment& fragment, JudgeSettings& settings, bool exact_only)
        : f_(fragment),
          set_ups_(fragment.set_ups),
          settings_(settings),
          profile_(fragment.set_ups.profile()),
          exact_only_(exact_only) {}

    FragmentVerdict judge() {
        if (!f_.primitive().is_finite) {
            return out_;  // nothing is promised of a triangle with NaN or infinite positions
        }
        for (const Quantity& q : f_.quantities()) {
            if (q.kind == Kind::flat && f_.has(q)) {
                judge_flat(q, q.get(f_.device));
            }
        }
        judge_samples();
        judge_coord_depth();
        judge_sign();
        judge_planes();
        out_.ok = out_.mismatches.empty();
        for (const ValueMismatch& m : out_.mismatches) {
            if (m.ratio > out_.worst_ratio) {
                tell_worst({m.ratio, m.quantity});
            }
        }
        return std::move(out_);
    }

  private:
    void judge_flat(const Quantity& q, float got) {
        const Primitive& primitive = f_.primitive();
        const float want = provoking_value(primitive, q.id);
        if (same_bits(got, want) || !std::isfinite(want)) {
            return;  // NaN and infinity need not arrive
        }
        const bool may_be_zero = std::fabs(want) < cases::kLeastNormal;
        if (may_be_zero && !(std::fabs(got) > 0) && !std::isnan(got)) {
            return;  // denormals may be flushed, the sign of zero may be lost
        }
        ReasonKind reason = ReasonKind::value_flat;
        const auto component = static_cast<glm::vec4::length_type>(q.id.component);
        for (const uint32_t v : primitive.triangle.vertex) {
            if (v != primitive.triangle.provoking &&
                same_bits(primitive.draw->attributes[q.id.attribute].values[v][component], got)) {
                reason = primitive.draw->provoking == cases::ProvokingVertex::first
                             ? ReasonKind::value_of_not_first
                             : ReasonKind::value_of_not_last;
            }
        }
        add(mismatch_of(q, reason, Profile::vulkan), got, [&] {
            return bits_of(want) + " of the provoking vertex " +
                   std::to_string(primitive.triangle.provoking);
        });
    }

    // Of values that are one of a few exact numbers.
    void judge_samples() {
        std::array<std::optional<Fragment>, std::size(cases::kProfiles)> fragments;
        const auto may_be_at = [&](const Quantity& q, Profile at) {
            auto& fragment = fragments.at(static_cast<size_t>(at));
            if (!fragment) {
                fragment = set_ups_.covered_fragment(f_.t, f_.id, at, exact_only_);
            }
            return may_be(*fragment, q, f_.device, at);
        };
        for (const Quantity& q : f_.quantities()) {
            // What is allowed at a profile is allowed at every looser one.
            if (!is_sample_kind(q.kind) || !f_.has(q) || may_be_at(q, profile_)) {
                continue;
            }
            const Profile at = *std::ranges::find_if(
                cases::kProfiles, [&](Profile loose) { return !may_be_at(q, loose); });
            add(mismatch_of(q, ReasonKind::value_exact, at), q.get(f_.device),
                [&] { return allowed_text(*fragments.at(static_cast<size_t>(at)), q, at); });
        }
    }

    // One invocation has one gl_FragCoord: what it writes to gl_FragDepth is what it writes to the
    // capture, clamped and stored.
    void judge_coord_depth() {
        const cases::Draw& draw = *f_.primitive().draw;
        const FragmentValues& device = f_.device;
        if (!replaces_depth_by_coord(draw) || f_.part != FragmentPart::all || !f_.selection.depth ||
            !f_.selection.frag_coord || !std::isfinite(device.frag_coord.z)) {
            return;
        }
        const StoredDepth stored(draw, set_ups_.target().depth_format, device.frag_coord.z);
        if (!stored.may_be(device.depth, profile_)) {
            const Profile level =
                stored.may_be(device.depth, Profile::vulkan) ? profile_ : Profile::vulkan;
            add(mismatch_of(quantity(QuantityId{}), ReasonKind::value_coord_depth, level),
                device.depth, [&] { return stored.text(); });
        }
    }

    // One invocation has one value of an input: where it is negative, the fragment was discarded.
    void judge_sign() {
        const cases::Draw& draw = *f_.primitive().draw;
        if (!discards_by_value(draw) || f_.part == FragmentPart::depth ||
            !f_.selection.attributes.at(draw.discard_attribute)) {
            return;
        }
        const float got = f_.device.attributes.at(draw.discard_attribute).x;
        if (std::isfinite(got) && got <= -cases::kLeastNormal) {
            const Quantity& q = quantity(QuantityId::of_attribute(draw.discard_attribute, 0));
            add(mismatch_of(q, ReasonKind::value_not_discarded, Profile::vulkan), got,
                [] { return std::string("0 or more"); });
        }
    }

    void judge_planes() {
        const bool is_decided = !exact_only_ && is_plain_depth(f_.primitive()) && filter();
        if (profile_ == Profile::vulkan && !settings_.tells_ratios && !exact_only_) {
            if (!is_decided) {
                const std::vector<size_t> failing = f_.failing_alone();
                describe(failing, std::vector<double>(failing.size(), HUGE_VAL));
            }
        } else if (!is_decided || out_.worst_ratio > 1) {
            // What is accepted, but above one budget, another basis may explain better.
            const CandidateVerdict verdict = f_.verdict(profile_, exact_only_);
            out_.basis = verdict.basis;
            tell_worst(verdict.worst);
            describe(verdict.failing, verdict.ratios);
        }
    }

    // Whether one of the two nominal bases is proven to explain all numbers of the fragment's part.
    bool filter() {
        const Filters& filters = set_ups_.filters(f_.t);
        const cases::Target& target = set_ups_.target();
        const FixedPoint fixed = sample_position(f_.id.x, f_.id.y, f_.id.sample, target);
        const Point<double> centre{f_.id.x + 0.5, f_.id.y + 0.5};
        const Point<double> sample{pixels(fixed.x), pixels(fixed.y)};
        FilterPoints places{centre, sample, centre};
        if (target.samples > 1 || cases::has_large_fragments(*f_.primitive().draw)) {
            // The likeliest alternative; the others are left to the next stage.
            const auto nominal = set_ups_.places<Ball>(f_.t, f_.id, Profile::direct3d).front();
            places = {{nominal.attributes[0].x.v, nominal.attributes[0].y.v},
                      sample,
                      {nominal.centroid[0].x.v, nominal.centroid[0].y.v}};
        }
        std::span<const Quantity> judged(settings_.selected.at(set_ups_.draw_of(f_.t)));
        std::vector<Quantity> of_part;
        if (f_.part != FragmentPart::all) {
            std::ranges::copy_if(judged, std::back_inserter(of_part),
                                 [&](const Quantity& q) { return f_.has(q); });
            judged = of_part;
        }
        const ProbePlace place = set_ups_.probe_place(f_.t, f_.id, profile_);
        const auto accepts = [&](const Filter& filter, WorstError& worst) {
            return filter_accepts(filter, judged, places, f_.device, kBudgetFactor, worst) &&
                   filter_accepts_probes(filter, judged, place, f_.device, kBudgetFactor, worst);
        };
        WorstError worst;
        bool is_decided = accepts(filters.unsnapped, worst);
        if (filters.snapped && !(is_decided && worst.ratio <= 1)) {
            WorstError snapped;
            if (accepts(*filters.snapped, snapped) &&
                (!is_decided || snapped.ratio < worst.ratio)) {
                is_decided = true;
                out_.basis = BasisKind::snapped;
                worst = snapped;
            }
        }
        tell_worst(worst);
        return is_decided;
    }

    void describe(const std::vector<size_t>& failing, const std::vector<double>& ratios) {
        std::vector<ReasonKind> reasons;
        for (const size_t index : failing) {
            reasons.push_back(reason_of(f_, index));
        }
        auto& loosest = settings_.loosest_levels;
        const std::vector<Profile> levels =
            loosest ? loosest->of(f_, failing, reasons) : f_.levels_of(failing);
        for (size_t k = 0; k < failing.size(); ++k) {
            const Quantity& q = f_.quantities()[failing[k]];
            ValueMismatch m = mismatch_of(q, reasons[k], levels[k]);
            m.ratio = ratios[k];
            add(std::move(m), q.get(f_.device),
                [&] { return expected_text(set_ups_, f_.t, f_.id, q); });
        }
    }

    const Quantity& quantity(const QuantityId& id) const {
        return *std::ranges::find(f_.quantities(), id, &Quantity::id);
    }

    template <class Text>
    void add(ValueMismatch mismatch, float got, Text expected) {
        if (!settings_.is_told || settings_.is_told(mismatch)) {
            mismatch.expected = expected();
            mismatch.got = bits_of(got);
        }
        out_.mismatches.push_back(std::move(mismatch));
    }

    void tell_worst(const WorstError& worst) {
        out_.worst_ratio = worst.ratio;
        out_.worst_quantity = worst.quantity;
    }

    const DrawnFragment& f_;
    SetUps& set_ups_;
    JudgeSettings& settings_;
    Profile profile_;
    bool exact_only_;
    FragmentVerdict out_;
};

}  // namespace

FragmentVerdict judge(const DrawnFragment& fragment, JudgeSettings& settings, bool exact_only) {
    return FragmentJudge(fragment, settings, exact_only).judge();
}

}  // namespace ref::value
