// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/color.hpp"

#include <array>
#include <numeric>
#include <optional>
#include <vector>

#include "ref/coverage/fast/fast.hpp"
#include "ref/expectation/on_demand.hpp"
#include "ref/expectation/scene.hpp"
#include "ref/expectation/stored_depths.hpp"

namespace diff {

using Kind = ref::ColorVerdict::Kind;

ref::ColorReference& ColorComparison::reference(cases::Profile profile, size_t index) {
    const ref::Expectation& expectation = attribution_.at(profile, index);
    auto& slot = references_[static_cast<size_t>(profile)];
    if (!slot) {
        slot = std::make_unique<ref::ColorReference>(case_, expectation);
    }
    return *slot;
}

std::optional<Finding> ColorComparison::judge(size_t index, cases::SampleId id,
                                              const WitnessAt& witness) {
    const ref::ColorVerdict verdict =
        reference(expectation_.profile, index)
            .judge(index, id, capture_.color[index], witness(expectation_.profile));
    return verdict.kind == Kind::ok || verdict.kind == Kind::open
               ? std::nullopt
               : std::optional(finding_of(index, id, verdict, witness));
}

Finding ColorComparison::finding_of(size_t index, cases::SampleId id,
                                    const ref::ColorVerdict& verdict, const WitnessAt& witness) {
    Finding finding;
    set_sample(finding, case_.target, id);
    // The loosest are asked first: what is wrong there needs no expectation of the profiles in
    // between.
    const cases::Profile level = loosest_wrong(expectation_.profile, [&](cases::Profile profile) {
        const std::array<uint32_t, 4>& codes = capture_.color[index];
        ref::ColorReference& reference = this->reference(profile, index);
        const ref::ColorWitness told = witness(profile);
        return !reference.may_explain(index, id, codes, told) ||
               !reference.explains(index, id, codes, told);
    });
    switch (verdict.kind) {
        case Kind::missing:
        case Kind::extra:
        case Kind::twice:
            finding.kind = verdict.kind == Kind::missing ? FindingKind::missing
                           : verdict.kind == Kind::extra ? FindingKind::extra
                                                         : FindingKind::double_hit;
            attribution_.attribute_color(finding, verdict.hits, level, verdict.triangle);
            if (finding.rule.empty()) {
                finding.rule = verdict.rule;
            }
            break;
        case Kind::order:
            finding.kind = FindingKind::order;
            tell(finding, ref::ReasonKind::color_order);
            break;
        default:
            finding.kind = FindingKind::value;
            tell(finding, ref::ReasonKind::color_none);
            finding.rule = verdict.rule;
            break;
    }
    finding.quantity = "color";
    finding.expected = verdict.expected;
    finding.got = unit_.text_of(capture_.color[index]);
    finding.overflows = verdict.may_overflow && unit_.has_overflown(capture_.color[index]);
    finding.level = level;
    return finding;
}

uint8_t ColorComparison::hits_for_pictures(size_t index) {
    const std::array<uint32_t, 4>& codes = capture_.color[index];
    if (codes == last_clear_) {
        return 0;
    }
    if (codes == last_drawn_) {
        return 1;
    }
    const bool is_clear = unit_.allows(cleared_, codes);
    (is_clear ? last_clear_ : last_drawn_) = codes;
    return is_clear ? 0 : 1;
}

namespace {

// Samples of a target without instruments in which nothing is drawn.
class EmptyPicture {
  public:
    EmptyPicture(const cases::Case& c, const ref::Expectation& expectation)
        : target_(c.target),
          expectation_(expectation),
          values_(c, expectation.limits, expectation.profile) {
        if (c.target.color) {
            reference_.emplace(c, expectation);
            const ref::color::Unit unit{c.target.color->format, expectation.profile};
            clear_ = unit.codes_of(unit.cleared(*c.target.color));
        }
    }

    bool is_allowed(size_t index) {
        const cases::SampleId id = cases::sample_at(target_, index);
        const ref::SampleExpectation& expected = expectation_.samples[index];
        return (!reference_ || reference_->explains(index, id, clear_)) &&
               (!target_.has_depth ||
                ref::StoredDepths(expectation_, values_)
                    .allows(expected, id,
                            cases::nearest_depth(target_.depth_clear, target_.depth_format),
                            true)) &&
               (!target_.has_stencil ||
                ref::stencils_at(expectation_, expected, {})[target_.stencil_clear]);
    }

  private:
    const cases::Target& target_;
    const ref::Expectation& expectation_;
    std::optional<ref::ColorReference> reference_;  // if there is a colour
    ref::ValueReference values_;
    std::array<uint32_t, 4> clear_{};
};

}  // namespace

bool may_stay_clear(const cases::Case& c, const ref::Expectation& expectation) {
    EmptyPicture picture(c, expectation);
    for (size_t index = 0; index < expectation.samples.size(); ++index) {
        if (!picture.is_allowed(index)) {
            return false;
        }
    }
    return true;
}

bool fails_if_empty(const cases::Case& c, cases::Profile profile) {
    ref::Scene scene(c, ref::Limits{}, profile, false);
    ref::OnDemand expected(scene);
    const ref::Expectation& so_far = expected.at(0);
    std::optional<EmptyPicture> picture;
    if (!c.target.has_instruments) {
        picture.emplace(c, so_far);
    }
    bool is_seen = !picture;
    std::vector<bool> is_asked(so_far.samples.size());
    const auto tells = [&](const ref::fast::Span& span, uint32_t x) {
        const size_t index = (size_t{span.y} * c.target.width + x) * c.target.samples + span.sample;
        if (is_asked[index]) {
            return false;
        }
        is_asked[index] = true;
        expected.at(index);
        is_seen = is_seen || !picture->is_allowed(index);
        return is_seen && so_far.must_samples > 0;
    };
    // Samples that no triangle touches tell nothing. The middles of the spans mostly do at once.
    for (const ref::fast::Span& span : scene.spans) {
        if (span.x0 < span.x1 && tells(span, std::midpoint(span.x0, span.x1))) {
            return true;
        }
    }
    for (const ref::fast::Span& span : scene.spans) {
        for (uint32_t x = span.x0; x < span.x1; ++x) {
            if (tells(span, x)) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace diff
