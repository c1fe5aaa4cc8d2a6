// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/whole_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "cases/model/rule_ids.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/words.hpp"
#include "diff/consistency.hpp"
#include "ref/expectation/counted.hpp"
#include "ref/expectation/statistics.hpp"

namespace diff {

namespace {

using ref::CountBounds;

bool has_wrong_hits(const Verdict& verdict) {
    const auto count = [&](FindingKind kind) {
        return verdict.counts.at(static_cast<size_t>(kind));
    };
    return count(FindingKind::missing) + count(FindingKind::extra) +
               count(FindingKind::double_hit) >
           0;
}

// The bounds of the number that a query gives: of one that is not precise 0 or any other, which is
// captured as 1.
CountBounds given(const CountBounds& counted, cases::Query query) {
    return query != cases::Query::occlusion ? counted
                                            : CountBounds{std::min(counted.least, uint64_t{1}),
                                                          std::min(counted.most, uint64_t{1})};
}

std::string to_text(const CountBounds& bounds, cases::Query query) {
    if (query == cases::Query::occlusion) {
        return bounds.most == 0 ? "0" : bounds.least == 0 ? "any number" : "not 0";
    }
    return bounds.most == ref::kNoMost   ? fmt::format("at least {}", bounds.least)
           : bounds.least == bounds.most ? fmt::format("{}", bounds.least)
                                         : fmt::format("{} to {}", bounds.least, bounds.most);
}

std::string why_of_statistic(const CountBounds& bounds, cases::Query query) {
    constexpr std::array<std::string_view, 6> kCounted = {
        "the vertices that input assembly processes",
        "the primitives that input assembly processes",
        "the invocations of the vertex shader",
        "the primitives that reach clipping",
        "the primitives that clipping puts out",
        "the invocations of the fragment shader"};
    const size_t number =
        static_cast<size_t>(query) - static_cast<size_t>(cases::Query::input_vertices);
    return fmt::format("a query of pipeline statistics counts {}: {}", kCounted.at(number),
                       bounds.most == ref::kNoMost
                           ? "never fewer than what the draw must do"
                           : "as many as the draw must do, and no more than it may");
}

std::string why_of(uint64_t got, const CountBounds& counted, const cases::Draw& draw) {
    if (got == capture::kNotCounted) {
        return "the query is not available, although its submission has ended";
    }
    if (cases::is_statistic(draw.query)) {
        return why_of_statistic(counted, draw.query);
    }
    return fmt::format(
        "a query counts the samples of the draw's fragments that survive all tests{}; by what the "
        "picture shows, sample by sample, they are {}",
        cases::stores_discarded(draw) ? ", those among them that the shader discards afterwards"
                                      : "",
        to_text(counted, cases::Query::occlusion_precise));
}

}  // namespace

void add_stray_writes(const cases::Case& c, std::span<const capture::StrayWrite> writes,
                      Verdict& verdict) {
    for (const capture::StrayWrite& w : writes) {
        if (!w.texel.empty()) {
            Finding finding = finding_of_case(FindingKind::value);
            finding.rule = cases::rule::write_outside;
            finding.level = cases::Profile::vulkan;
            finding.quantity = fmt::format("image of {}", w.attachment);
            finding.expected = fmt::format("{:#010x}", w.expected);
            finding.got = fmt::format("{:#010x}", w.got);
            finding.why = fmt::format(
                "no command of the case writes to texel {}, which lies beside the attachment in "
                "its image; {} of those texels changed",
                w.texel, w.words);
            verdict.add(std::move(finding), c.target);
            continue;
        }
        const std::string_view side = w.is_before ? "before" : "after";
        Finding finding = finding_of_case(FindingKind::value);
        finding.rule = cases::rule::write_outside;
        finding.level = cases::Profile::vulkan;
        finding.quantity = fmt::format("memory {} {}", side, w.attachment);
        finding.expected = fmt::format("{:#010x}", w.expected);
        finding.got = fmt::format("{:#010x}", w.got);
        finding.why = fmt::format(
            "a buffer that no command of the case writes to lies {} the attachment in its memory; "
            "{} of its words changed, the nearest {} bytes {}",
            side, w.words, w.distance,
            w.is_before ? "before the first byte" : "after the last byte");
        if (w.renderings > 1) {
            finding.why +=
                fmt::format("; {} renderings were in the submission, and none of them did it alone",
                            w.renderings);
        }
        verdict.add(std::move(finding), c.target);
    }
}

void judge_queries(const cases::Case& c, const capture::CaptureView& capture,
                   Attribution& attribution, const ShownOf& shown_at, Verdict& verdict) {
    if (!cases::asks_queries(c)) {
        return;
    }
    const auto is_right = [&](size_t k, const CountBounds& counted) {
        const CountBounds bounds = given(counted, c.draws[k].query);
        const uint64_t got = capture.counted[k];
        return c.draws[k].query == cases::Query::none || got == capture::kNotAsked ||
               (got != capture::kNotCounted && got >= bounds.least && got <= bounds.most);
    };
    // What is right at a profile is right at the looser ones, too: theirs tell the level alone. But
    // hits that are wrong here and right there leave less open there.
    std::vector<bool> is_settled(c.draws.size(), true);
    const bool is_open = has_wrong_hits(verdict);
    const std::vector<CountBounds> asked =
        ref::query_bounds(c, attribution.at(verdict.profile), shown_at(verdict.profile));
    for (size_t k = 0; k < c.draws.size(); ++k) {
        is_settled[k] =
            c.draws[k].query == cases::Query::none || (!is_open && is_right(k, asked[k]));
    }
    for (const cases::Profile profile : cases::kProfiles) {
        if (profile > verdict.profile || std::ranges::find(is_settled, false) == is_settled.end()) {
            break;
        }
        const std::vector<CountBounds> counted =
            ref::query_bounds(c, attribution.at(profile), shown_at(profile));
        for (size_t k = 0; k < c.draws.size(); ++k) {
            if (is_settled[k] || is_right(k, counted[k])) {
                continue;
            }
            is_settled[k] = true;
            const cases::Query query = c.draws[k].query;
            const CountBounds bounds = given(counted[k], query);
            const uint64_t got = capture.counted[k];
            Finding finding = finding_of_case(FindingKind::value);
            const bool is_statistic = cases::is_statistic(query);
            finding.rule =
                is_statistic ? cases::rule::query_statistics : cases::rule::query_occlusion;
            finding.level = profile;
            finding.quantity = is_statistic ? fmt::format("{} of draw {}", cases::word_of(query), k)
                                            : fmt::format("occlusion query of draw {}", k);
            finding.expected = to_text(bounds, query);
            const bool is_any = query == cases::Query::occlusion && got == 1;
            finding.got = is_any ? "not 0" : count_text(got);
            finding.why = why_of(got, counted[k], c.draws[k]);
            verdict.add(std::move(finding), c.target);
        }
    }
}

}  // namespace diff
