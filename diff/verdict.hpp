// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Expectation x Capture -> Verdict.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/sample.hpp"
#include "ref/color/color.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/position/limits.hpp"
#include "ref/value/reference.hpp"

namespace diff {

enum class FindingKind : uint8_t {
    missing,
    extra,
    double_hit,
    value,
    order
};  // "double" in reports
inline constexpr size_t kFindingKinds = 5;
std::string_view to_string(FindingKind kind);

// One sample (and quantity) that is wrong.
struct Finding {
    FindingKind kind = FindingKind::missing;
    std::string rule;                                 // rule id
    cases::Profile level = cases::Profile::direct3d;  // loosest profile at which it is broken
    uint32_t x = 0, y = 0, sample = 0;
    std::string quantity;  // value findings: "attribute 0.x", "depth", ...; else ""
    std::string expected;
    std::string got;
    // One sentence: the reason (ref/reason/reason.cpp), or what was found; "as at pixel ..." where
    // many are alike.
    std::string why;
    double ratio = 0;                    // value findings: error in budgets
    std::optional<uint32_t> layer = {};  // of a target with several layers
    std::string door = {};               // of a picture through a door that differs: its word
    // Of what the whole case gave, as a query's count: no sample is wrong, and the place is (0, 0).
    bool of_case = false;
    // Of a colour: it may lie beyond the range of binary16, and is no number.
    bool overflows = false;
    static void fields(auto&& visit, auto&... f) {
        visit("kind", f.kind...);
        visit("rule", f.rule...);
        visit("level", f.level...);
        visit("x", f.x...);
        visit("y", f.y...);
        visit("sample", f.sample...);
        visit({"layer", cases::kLeftOutIfEmpty}, f.layer...);
        visit("quantity", f.quantity...);
        visit("expected", f.expected...);
        visit("got", f.got...);
        visit("why", f.why...);
        visit("ratio", f.ratio...);
        visit({"door", cases::kLeftOutIfEmpty}, f.door...);
        visit({"of_case", cases::kLeftOutIfEmpty}, f.of_case...);
        visit({"overflows", cases::kNotReported}, f.overflows...);
    }
};

// The findings of a case that break one rule in one way, each door by itself: what an expected
// failure is known by.
struct FindingGroup {
    FindingKind kind = FindingKind::missing;
    std::string rule;
    cases::Profile level = cases::Profile::direct3d;
    uint64_t count = 0;     // of all such findings, kept or not
    uint64_t known = 0;     // how many of them an expectation file speaks of
    std::string door = {};  // the door through which they are seen, and in no other picture
    static void fields(auto&& visit, auto&... g) {
        visit("kind", g.kind...);
        visit("rule", g.rule...);
        visit("level", g.level...);
        visit("count", g.count...);
        visit("known", g.known...);
        visit({"door", cases::kLeftOutIfEmpty}, g.door...);
    }
    friend bool operator==(const FindingGroup&, const FindingGroup&) = default;
};

// Where a finding is.
inline cases::SampleId sample_of(const Finding& finding) {
    return {finding.x, finding.y, finding.sample, finding.layer.value_or(0)};
}
inline void set_sample(Finding& finding, const cases::Target& target, const cases::SampleId& id) {
    finding.x = id.x;
    finding.y = id.y;
    finding.sample = id.sample;
    if (target.layers > 1) {
        finding.layer = id.layer;
    }
}
inline Finding finding_at(FindingKind kind, const cases::Target& target,
                          const cases::SampleId& id) {
    Finding finding;
    finding.kind = kind;
    set_sample(finding, target, id);
    return finding;
}
inline Finding finding_of_case(FindingKind kind) {
    Finding finding;
    finding.kind = kind;
    finding.of_case = true;
    return finding;
}
// The loosest profile at which something is wrong that is wrong at `at`.
template <class IsWrong>
cases::Profile loosest_wrong(cases::Profile at, const IsWrong& is_wrong) {
    for (const cases::Profile profile : cases::kProfiles) {
        if (profile < at && is_wrong(profile)) {
            return profile;
        }
    }
    return at;
}
// What the comparison saw at a sample, for pictures: one byte a sample.
enum class SampleMark : uint8_t { ok, either, missing, extra, double_hit, value, order };

// What is kept of a case's findings: so many of each group, and so many in all. All are counted.
inline constexpr size_t kMaxOfGroup = 16;
inline constexpr size_t kMaxFindings = 64;
inline constexpr uint64_t kBriefEnough = 4, kBriefMost = 64;

// What a comparison says of a case: all of it that the records of a run keep.
struct Outcome {
    std::vector<Finding> findings;                 // those that are kept, in sample order
    std::array<uint64_t, kFindingKinds> counts{};  // of all, capped or not
    std::vector<FindingGroup> groups;              // the same, by kind, rule and level
    uint64_t finding_total() const {
        return std::accumulate(counts.begin(), counts.end(), uint64_t{0});
    }
    std::optional<uint64_t> wrong_samples;            // which may have several findings each
    cases::Profile level = cases::Profile::direct3d;  // loosest level among all findings
    // Bounding box of the wrong samples, inclusive, zeros if there are none; y counts the rows of
    // the stacked layers.
    uint32_t min_x = 0, min_y = 0, max_x = 0, max_y = 0;
    uint64_t must_samples = 0, either_samples = 0, compared_samples = 0, compared_values = 0;
    double worst_ratio = 0;      // largest accepted or rejected error in budgets (K of this case)
    std::string worst_quantity;  // whose and where: "attribute 0.x at pixel (3, 4)"
    static void fields(auto&& visit, auto&... o) {
        visit("findings", o.findings...);
        visit("counts", o.counts...);
        visit({"groups", cases::kOlderLackIt}, o.groups...);
        visit({"wrong_samples", cases::kOlderLackIt}, o.wrong_samples...);
        visit("level", o.level...);
        visit("min_x", o.min_x...);
        visit("min_y", o.min_y...);
        visit("max_x", o.max_x...);
        visit("max_y", o.max_y...);
        visit("must_samples", o.must_samples...);
        visit("either_samples", o.either_samples...);
        visit("compared_samples", o.compared_samples...);
        visit("compared_values", o.compared_values...);
        visit("worst_ratio", o.worst_ratio...);
        visit("worst_quantity", o.worst_quantity...);
    }
};

struct Verdict : Outcome {
    cases::Profile profile = cases::Profile::direct3d;
    std::string
        error;  // not empty: the case or the capture cannot be judged (status error), and why
    bool shows_nothing = false;  // the error: a picture without any triangle would pass
    std::vector<uint8_t>
        expected_hits;  // nominal hits a sample, saturated at 254; 255 where several are allowed
    std::vector<uint8_t> device_hits;  // saturated at 255
    bool has_counted = true;  // else device_hits say only where the colour is not the clear one
    std::vector<SampleMark> marks;  // [sample]
    // [sample] largest error of the values that were compared there, in budgets (infinite where no
    // number of budgets reaches the value); negative where none was. Empty if the case has none.
    std::vector<float> error_ratios;
    bool has_unmarked = false;       // some wrong samples were counted, but have no mark
    bool has_wrong_samples = false;  // some finding is of a sample: min_x to max_y are set
    bool ok() const { return error.empty() && counts == std::array<uint64_t, kFindingKinds>{}; }

    // Counts a finding of a target; keeps it if keeps() says so. The first finding at a sample
    // gives it its mark; one of the whole case marks none.
    void add(Finding finding, const cases::Target& target);
    bool is_brief = false;  // Wanted::brief
    // Whether the next finding of a group will be kept: it is among the group's first kMaxOfGroup,
    // and fewer than kMaxFindings are kept; in brief it is the first of its level and looser ones.
    // Of any other nobody reads the texts.
    bool keeps(FindingKind kind, std::string_view rule, cases::Profile level) const;
    // Counts `count` findings like `finding`, without a word of each.
    void count(const Finding& finding, uint64_t count);
    // How many samples have a finding, which may have several; nothing where it is not known.
    std::optional<uint64_t> count_wrong_samples() const;
    // The error at a sample, in budgets, is at least `ratio`.
    void raise_error(size_t index, double ratio);

  private:
    void mark(const Finding& finding, const cases::Target& target);
};
// What somebody wants to know of a capture.
enum class Wanted : uint8_t {
    all,
    // All but how large errors are, which takes most of the time of a picture that is wrong at
    // profile vulkan: the ratios, and what names the worst of them, are left out.
    findings_without_ratios,
    // What is broken alone: kinds and rules, with the loosest levels of the first values of each
    // quantity (ValueReference::tell_loosest_levels).
    symptoms,
    // The symptoms, as far as kBriefEnough findings show them if one is of the loosest level, else
    // kBriefMost; the first of the loosest level is kept alone, and few are explained
    // (Attribution::kBrief).
    brief,
    // `error` and the first finding, but for its ratio; the rest says little.
    first_finding
};
// Judges a capture with all planes of the case's target. A case without any sample that must be hit
// is an error, never a pass.
Verdict compare(const cases::Case& c, const ref::Expectation& expectation,
                const capture::CaptureView& capture, Wanted wanted = Wanted::all);
// Judges one sample after another: the oracle of compare(), which judges runs of samples that
// are plainly right at once.
Verdict compare_by_sample(const cases::Case& c, const ref::Expectation& expectation,
                          const capture::CaptureView& capture);

// Checks the hand-drawn picture of a case against the reference (profile direct3d, 8 subpixel
// bits). Nothing if it agrees or the case has none; else one sentence with the first pixel that
// differs, and where that stands in the case's file, which is read for it.
std::optional<cases::Error> check_expected_hits(const cases::Case& c);

}  // namespace diff
