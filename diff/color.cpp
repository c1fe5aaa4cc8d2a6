// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/color.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/model/rule_ids.hpp"

namespace diff {

using Kind = ref::ColorVerdict::Kind;

ref::ColorReference& ColorComparison::reference(cases::Profile profile) {
    auto& slot = references_[static_cast<size_t>(profile)];
    if (!slot) {
        const bool is_asked = profile == expectation_.profile;
        slot = std::make_unique<ref::ColorReference>(
            case_, is_asked ? expectation_ : attribution_.at(profile));
    }
    return *slot;
}

std::optional<ref::ColorWitness> ColorComparison::witness_of(size_t index,
                                                             std::optional<uint32_t> writer) const {
    if (!case_.target.has_instruments) {
        return std::nullopt;
    }
    ref::ColorWitness witness;
    witness.hits = static_cast<uint32_t>(capture_.hits[index].x) +
                   static_cast<uint32_t>(capture_.hits[index].y);
    if (witness.hits > 0 && writer) {
        witness.writer = *writer;
        const int32_t attribute = case_.draws[expectation_.triangles[*writer].draw].color.attribute;
        if (attribute >= 0) {
            witness.written = &capture_.attributes[static_cast<size_t>(attribute)][index];
        }
    }
    return witness;
}

std::optional<Finding> ColorComparison::judge(size_t index, cases::SampleId id,
                                              std::optional<uint32_t> writer) {
    const std::optional<ref::ColorWitness> witness = witness_of(index, writer);
    const ref::ColorVerdict verdict =
        reference(expectation_.profile).judge(index, id, capture_.color[index], witness);
    if (verdict.kind != Kind::ok && verdict.kind != Kind::open) {
        return finding_of(index, id, verdict, witness);
    }
    if (!case_.target.has_instruments && case_.target.has_depth &&
        !reference(expectation_.profile)
             .explains_depth(index, id, capture_.depth[index], case_.target.depth_clear)) {
        Finding finding = finding_at(FindingKind::value, case_.target, id);
        finding.rule = cases::rule::depth_linear;
        finding.quantity = "depth";
        finding.level = loosest_wrong([&](ref::ColorReference& at) {
            return !at.explains_depth(index, id, capture_.depth[index], case_.target.depth_clear);
        });
        finding.expected = "the depth of a fragment that the colour allows";
        finding.got = fmt::format("{:.9g}", capture_.depth[index]);
        finding.why = "no triangle that may have written last has this depth here";
        return finding;
    }
    return std::nullopt;
}

cases::Profile ColorComparison::loosest_wrong(
    const std::function<bool(ref::ColorReference&)>& is_wrong) {
    for (const cases::Profile p : {cases::Profile::vulkan, cases::Profile::practice}) {
        if (p < expectation_.profile && is_wrong(reference(p))) {
            return p;
        }
    }
    return expectation_.profile;
}

Finding ColorComparison::finding_of(size_t index, cases::SampleId id,
                                    const ref::ColorVerdict& verdict,
                                    const std::optional<ref::ColorWitness>& witness) {
    Finding finding;
    set_sample(finding, case_.target, id);
    const std::string got = unit_.text_of(capture_.color[index]);
    const uint32_t hits = verdict.hits;
    switch (verdict.kind) {
        case Kind::missing:
            finding.kind = FindingKind::missing;
            attribution_.attribute_hits(finding, hits, 0);
            break;
        case Kind::extra:
            finding.kind = FindingKind::extra;
            attribution_.attribute_hits(finding, hits, 0);
            break;
        case Kind::twice:
            finding.kind = FindingKind::double_hit;
            attribution_.attribute_hits(finding, hits, 0);
            break;
        case Kind::order:
            finding.kind = FindingKind::order;
            finding.rule = cases::rule::order_primitive;
            finding.why = "the fragments were blended in another order than they were drawn";
            break;
        default:
            finding.kind = FindingKind::value;
            finding.rule = verdict.rule;
            finding.why = "no allowed set of fragments leaves this colour";
            break;
    }
    finding.quantity = "color";
    finding.expected = verdict.expected;
    finding.got = got;
    finding.level = loosest_wrong([&](ref::ColorReference& at) {
        return !at.explains(index, id, capture_.color[index], witness);
    });
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

}  // namespace diff
