// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/reference.hpp"

#include <algorithm>
#include <utility>

#include "ref/value/describe.hpp"
#include "ref/value/judge.hpp"
#include "ref/value/judge_run.hpp"
#include "ref/value/ranges.hpp"
#include "ref/value/set_ups.hpp"
#include "ref/value/sign.hpp"

namespace ref {

struct ValueReference::Impl {
    value::SetUps set_ups;
    value::JudgeSettings settings;
    value::RunJudge runs;

    FragmentVerdict judge(uint32_t t, cases::SampleId sample, const FragmentValues& device,
                          FragmentPart part, bool exact_only) {
        return value::judge({set_ups, t, sample, device, settings.selection, part}, settings,
                            exact_only);
    }
};

ValueReference::ValueReference(const cases::Case& c, const Limits& limits, cases::Profile profile)
    : impl_(std::make_unique<Impl>(value::SetUps(c, limits, profile))) {
    judge_only({});
}
ValueReference::~ValueReference() = default;
ValueReference::ValueReference(ValueReference&&) noexcept = default;

void ValueReference::judge_only(const ValueSelection& selection) {
    impl_->settings.selection = selection;
    impl_->settings.selected = impl_->set_ups.quantities();
    for (std::vector<value::Quantity>& draw : impl_->settings.selected) {
        std::erase_if(draw, [&](const value::Quantity& q) { return !selection.has(q.id); });
    }
}

void ValueReference::tell_only(std::function<bool(const ValueMismatch&)> is_told) {
    impl_->settings.is_told = std::move(is_told);
}

void ValueReference::tell_ratios(bool are_told) {
    impl_->settings.tells_ratios = are_told;
}

void ValueReference::tell_loosest_levels() {
    impl_->settings.loosest_levels.emplace();
}

FragmentVerdict ValueReference::judge(uint32_t t, cases::SampleId sample,
                                      const FragmentValues& device, FragmentPart part) {
    return impl_->judge(t, sample, device, part, false);
}

FragmentVerdict ValueReference::judge_exact(uint32_t t, cases::SampleId sample,
                                            const FragmentValues& device, FragmentPart part) {
    return impl_->judge(t, sample, device, part, true);
}

size_t ValueReference::judge_run(uint32_t t, const FragmentRun& run, std::span<double> ratios) {
    const auto& selected = impl_->settings.selected.at(impl_->set_ups.draw_of(t));
    return impl_->runs.judge(impl_->set_ups, selected, t, run, ratios);
}

std::vector<ExpectedValue> ValueReference::expected(uint32_t t, cases::SampleId sample) {
    return value::expected_values(impl_->set_ups, t, sample);
}

ValueRange ValueReference::range(uint32_t t, cases::SampleId sample, const QuantityId& id) {
    return value::ranges_of(impl_->set_ups, t, sample, {&id, 1}, false).at(id.component);
}

std::array<ValueRange, 4> ValueReference::ranges(uint32_t t, cases::SampleId sample,
                                                 size_t attribute, bool may_be_outer) {
    std::array<QuantityId, 4> ids;
    for (size_t k = 0; k < ids.size(); ++k) {
        ids[k] = QuantityId::of_attribute(attribute, k);
    }
    return value::ranges_of(impl_->set_ups, t, sample, ids, may_be_outer);
}

Sign ValueReference::sign(uint32_t t, cases::SampleId sample, bool exact_only) {
    return value::sign_of(impl_->set_ups, t, sample, exact_only);
}

}  // namespace ref
