// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/stencil.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "cases/fault/change.hpp"
#include "cases/fault/fault.hpp"
#include "ref/stencil/values.hpp"

namespace diff {

namespace {

using cases::operator""_fault;
using ref::ReasonKind;

struct FaultReason {
    cases::Fault fault;
    ReasonKind reason;
};

// From the particular to the general: a device that exchanges faces has other operations as well.
constexpr std::array kFaultReasons = {
    FaultReason{"bounds-ignored"_fault, ReasonKind::stencil_bounded},
    FaultReason{"stencil-faces-exchanged"_fault, ReasonKind::stencil_faced},
    FaultReason{"stencil-masks-ignored"_fault, ReasonKind::stencil_masked},
    FaultReason{"stencil-before-depth"_fault, ReasonKind::stencil_by_depth},
    FaultReason{"stencil-depth-fail-fails"_fault, ReasonKind::stencil_by_depth},
    FaultReason{"stencil-clamps-exchanged"_fault, ReasonKind::stencil_operated},
    FaultReason{"stencil-compare-turned"_fault, ReasonKind::stencil_compared},
    FaultReason{"stencil-test-passes"_fault, ReasonKind::stencil_compared},
};

constexpr size_t kMostTold = 8;  // values of a set

}  // namespace

ReasonKind StencilComparison::reason_of(size_t index, uint32_t value, cases::Profile level) {
    for (size_t k = 0; k < kFaultReasons.size(); ++k) {
        const auto [at, is_new] = others_.try_emplace({k, level});
        std::unique_ptr<Other>& other = at->second;
        if (is_new) {
            cases::Case changed = case_;
            if (cases::take_with(kFaultReasons.at(k).fault, changed)) {
                other = std::make_unique<Other>(std::move(changed), expectation_.limits, level);
            }
        }
        if (!other) {
            continue;
        }
        const ref::Expectation& e = other->expectation.at(index);
        if (stencils_at(e, e.samples[index], std::nullopt)[value]) {
            return kFaultReasons.at(k).reason;
        }
    }
    return ReasonKind::stencil_operated;
}

std::optional<Finding> StencilComparison::judge(size_t index, cases::SampleId id,
                                                const ref::path::SeenHits& seen) {
    const uint32_t got = capture_.stencil[index];
    const auto hits = seen.detail == ref::path::SeenHits::Detail::faces
                          ? std::optional(std::pair(seen.front, seen.back))
                          : std::nullopt;
    const auto allowed = [&](const ref::Expectation& e) {
        return stencils_at(e, e.samples[index], hits);
    };
    const auto is_allowed = [&](const ref::Expectation& e) {
        const ref::stencil::Values values = allowed(e);
        return got < values.size() && values[got];
    };
    if (is_allowed(expectation_)) {
        return std::nullopt;
    }
    Finding finding = finding_at(FindingKind::value, case_.target, id);
    finding.level = loosest_wrong(expectation_.profile, [&](cases::Profile profile) {
        return !is_allowed(attribution_.at(profile, index));
    });
    finding.quantity = "stencil";
    finding.expected =
        ref::stencil::to_text(allowed(attribution_.at(finding.level, index)), ", ", kMostTold);
    finding.got = fmt::format("{}", got);
    tell(finding, reason_of(index, got, finding.level));
    return finding;
}

}  // namespace diff
