// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/exercise/difference.hpp"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

namespace ref {

namespace {

bool is_same_number(float a, float b) {
    return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

// The triangles whose depth may be stored at a sample.
std::span<const uint32_t> depths_of(const Expectation& e, const SampleExpectation& sample) {
    return sample.depth_count == 0 && !sample.depth_may_be_clear ? e.writers_of(sample)
                                                                 : e.depth_writers_of(sample);
}

// Whether the stencil may be one that is a finding.
bool may_break_stencil(const Expectation& right, const Expectation& wrong, size_t index) {
    const stencil::Values one = stencils_at(right, right.samples[index], std::nullopt);
    const stencil::Values other = stencils_at(wrong, wrong.samples[index], std::nullopt);
    return (other & ~one).any();
}

// Whether the depth may be the clear value: nothing has stored another, or perhaps nothing has.
bool may_be_clear(const SampleExpectation& sample) {
    return sample.depth_may_be_clear || (sample.depth_count == 0 && sample.writers_count == 0);
}

// Whether something that `wrong` allows at a decided sample is a finding in hits, writer or whose
// depth is stored, or in the stencil.
bool may_break(const Expectation& right, const Expectation& wrong, size_t index) {
    const SampleExpectation& one = right.samples[index];
    const SampleExpectation& other = wrong.samples[index];
    if (!(one.hits == other.hits) || may_break_stencil(right, wrong, index)) {
        return true;
    }
    return (may_be_clear(other) && !may_be_clear(one)) ||
           !std::ranges::includes(right.writers_of(one), wrong.writers_of(other)) ||
           !std::ranges::includes(depths_of(right, one), depths_of(wrong, other));
}

// Whether no number of hits that `wrong` allows is one that `right` does.
bool are_apart(const HitBounds& right, const HitBounds& wrong) {
    return right.total_max < wrong.total_min || wrong.total_max < right.total_min ||
           right.front_max < wrong.front_min || wrong.front_max < right.front_min ||
           right.back_max < wrong.back_min || wrong.back_max < right.back_min ||
           right.signed_max < wrong.signed_min || wrong.signed_max < right.signed_min;
}

// Whether all that `wrong` allows at a sample is a finding, whatever an undecided sample of `right`
// may show: each path of `wrong` has a number of hits that `right` forbids, or a
// stencil that does not go with that number.
bool must_break(const Expectation& right, const Expectation& wrong, size_t index) {
    const SampleExpectation& one = right.samples[index];
    const SampleExpectation& other = wrong.samples[index];
    const std::span<const path::Outcome> paths = wrong.stencils_of(other);
    if (paths.empty()) {
        return are_apart(one.hits, other.hits);
    }
    return !one.is_free && !other.is_free &&
           std::ranges::all_of(paths, [&](const path::Outcome& path) {
               return !one.hits.allows(path.front, path.back) ||
                      (stencils_at(right, one, std::pair(path.front, path.back)) & path.values)
                          .none();
           });
}

}  // namespace

Shown& Original::shown() {
    if (!shown_) {
        shown_ = std::make_unique<Shown>(case_, expected_);
    }
    return *shown_;
}

ValueReference& Original::values() {
    if (!values_) {
        values_ = std::make_unique<ValueReference>(case_, expected_.limits, expected_.profile);
        values_->tell_only([](const ValueMismatch&) { return false; });
    }
    return *values_;
}

Difference::Difference(Original& original, cases::Case other, Differ differ, std::string_view rule)
    : original_(original), other_(std::move(other)), differ_(differ), rule_(rule) {
    const Expectation& expected = original.expected();
    const cases::Case& c = original.of();
    if (differ != Differ::values) {
        without_ = expect(other_, expected.limits, expected.profile);
    }
    if ((c.target.color && (!c.target.has_instruments || differ == Differ::colors)) ||
        (!c.target.has_instruments && differ == Differ::hits)) {
        other_shown_ = std::make_unique<Shown>(other_, without_ ? *without_ : expected);
    }
    for (const cases::Draw& draw : c.draws) {
        asked_.push_back(asked(draw));
    }
    if ((c.target.has_instruments || !c.target.color) &&
        (differ == Differ::values || differ == Differ::depths)) {
        other_values_ = std::make_unique<ValueReference>(other_, expected.limits, expected.profile);
    }
}

std::vector<value::Quantity> Difference::asked(const cases::Draw& draw) const {
    std::vector<value::Quantity> out = value::quantities(draw, original_.of().target);
    std::erase_if(out, [&](const value::Quantity& q) {
        const bool is_asked = differ_ == Differ::depths ? q.id.is_depth() : q.rule == rule_;
        return !is_asked || !is_shown(original_.of(), draw, q.id) ||
               (q.id.is_depth() && !draw.depth.write);
    });
    return out;
}

// Whether all numbers that the other case may have for a quantity are wrong, or none; nothing where
// that has to be looked at.
std::optional<bool> Difference::differs_by_range(uint32_t t, cases::SampleId id,
                                                 const value::Quantity& q) {
    const ValueRange right = original_.values().range(t, id, q.id);
    const ValueRange wrong = other_values_->range(t, id, q.id);
    if (!right.is_promised || !wrong.is_promised) {
        return std::nullopt;
    }
    if (wrong.high < right.low || right.high < wrong.low) {
        return true;
    }
    return wrong.low >= right.low && wrong.high <= right.high ? std::optional(false) : std::nullopt;
}

// Whether numbers that the other case may have, put among those of this one, are wrong: any, or
// else those that it most likely has.
bool Difference::shows_value(uint32_t t, cases::SampleId id) {
    const uint32_t d = original_.expected().triangles[t].draw;
    bool is_open = false;
    for (const value::Quantity& q : asked_[d]) {
        const std::optional<bool> differs = differs_by_range(t, id, q);
        if (differs.value_or(false)) {
            return true;
        }
        is_open = is_open || !differs;
    }
    return is_open && shows_likely_value(t, id);
}

bool Difference::shows_likely_value(uint32_t t, cases::SampleId id) {
    const uint32_t d = original_.expected().triangles[t].draw;
    ValueReference& values = original_.values();
    FragmentValues right;
    for (const ExpectedValue& value : values.expected(t, id)) {
        if (value.part.empty()) {
            number_of(right, value.quantity) = static_cast<float>(value.nearest);
        }
    }
    FragmentValues wrong = right;
    bool is_other = false;
    for (const ExpectedValue& value : other_values_->expected(t, id)) {
        if (value.part.empty() &&
            std::ranges::find(asked_[d], value.quantity, &value::Quantity::id) != asked_[d].end()) {
            float& number = number_of(wrong, value.quantity);
            const auto theirs = static_cast<float>(value.nearest);
            is_other = is_other || !is_same_number(number, theirs);
            number = theirs;
        }
    }
    const FragmentPart part =
        original_.of().draws[d].depth.write ? FragmentPart::all : FragmentPart::all_but_depth;
    return is_other && !values.judge(t, id, wrong, part).ok && values.judge(t, id, right, part).ok;
}

bool Difference::shows_values(const SampleExpectation& sample, cases::SampleId id) {
    const Expectation& expected = original_.expected();
    const auto writers = differ_ == Differ::depths && sample.depth_count > 0
                             ? expected.depth_writers_of(sample)
                             : expected.writers_of(sample);
    return std::ranges::any_of(writers, [&](uint32_t t) { return shows_value(t, id); });
}

// Whether the colours that the other case gives to the fragments of this one are wrong.
bool Difference::shows_colors_of(size_t index, cases::SampleId id) {
    Shown& shown = original_.shown();
    const std::vector<uint32_t> drawn = shown.drawn(index);
    return std::ranges::any_of(drawn,
                               [&](uint32_t t) {
                                   return !asked_[original_.expected().triangles[t].draw].empty();
                               }) &&
           shown.tells(index, id, drawn, *other_shown_);
}

bool Difference::shows(size_t index) {
    const SampleExpectation& sample = original_.expected().samples[index];
    if (!sample.hits.is_decided()) {
        return differ_ == Differ::hits && must_break(original_.expected(), *without_, index);
    }
    const cases::SampleId id = cases::sample_at(original_.of().target, index);
    if (differ_ == Differ::hits && original_.of().target.has_stencil &&
        may_break_stencil(original_.expected(), *without_, index)) {
        return true;
    }
    if (other_shown_) {
        return differ_ == Differ::values
                   ? shows_colors_of(index, id)
                   : original_.shown().tells(index, id, other_shown_->drawn(index), *other_shown_);
    }
    switch (differ_) {
        case Differ::hits:
            return may_break(original_.expected(), *without_, index);
        case Differ::depths:
            return may_break(original_.expected(), *without_, index) || shows_values(sample, id);
        case Differ::values:
            return shows_values(sample, id);
        case Differ::colors:
            return false;  // there is no colour
    }
    return false;
}

namespace {

// Whether a draw shows by another draw's depth test, or in another state: discarded, neither
// blended nor with a logical operation, with all components written.
bool shows_otherwise(Original& original, uint32_t draw) {
    cases::Case discarded = original.of();
    discarded.draws[draw].rasterizer_discard = true;
    cases::Case plain = original.of();
    plain.draws[draw].color.blend.reset();
    plain.draws[draw].color.logic.reset();
    plain.draws[draw].color.alpha_to_one = false;
    plain.draws[draw].color.alpha_to_coverage = false;
    plain.draws[draw].color.write_mask = 0xf;
    for (cases::Case* other : {&discarded, &plain}) {
        Difference difference(original, std::move(*other), Differ::hits, {});
        for (size_t k = 0; k < original.expected().samples.size(); ++k) {
            if (difference.shows(k)) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

std::vector<Sight> sights_of_draws(Original& original) {
    const Expectation& expectation = original.expected();
    std::vector<Sight> sights(original.of().draws.size(), Sight::covers_nothing);
    size_t open = sights.size();
    Shown& shown = original.shown();
    for (size_t k = 0; k < expectation.samples.size() && open > 0; ++k) {
        const SampleExpectation& expected = expectation.samples[k];
        if (expected.hits.total_min == 0 || !expected.hits.is_decided()) {
            continue;
        }
        const cases::SampleId id = cases::sample_at(original.of().target, k);
        for (const uint32_t t : shown.drawn(k)) {
            Sight& sight = sights[expectation.triangles[t].draw];
            if (sight == Sight::something) {
                continue;
            }
            sight = Sight::nothing;
            if (shown.shows(k, id, t) || shown.shows_twice(k, id, t) ||
                (shown.leaves_a_mark(id, t) && shown.shows_order(k, id))) {
                sight = Sight::something;
                --open;
            }
        }
    }
    for (uint32_t d = 0; d < sights.size(); ++d) {
        if (sights[d] == Sight::nothing && shows_otherwise(original, d)) {
            sights[d] = Sight::something;
        }
    }
    return sights;
}

}  // namespace ref
