// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/verdict.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace diff {

namespace {

// In the order of FindingKind.
constexpr std::array<std::string_view, kFindingKinds> kKindNames = {"missing", "extra", "double",
                                                                    "value", "order"};

SampleMark mark_of(FindingKind kind) {  // the marks of findings have the order of their kinds
    return static_cast<SampleMark>(static_cast<size_t>(SampleMark::missing) +
                                   static_cast<size_t>(kind));
}
static_assert(static_cast<size_t>(SampleMark::order) ==
              static_cast<size_t>(SampleMark::missing) + static_cast<size_t>(FindingKind::order));

}  // namespace

std::string_view to_string(FindingKind kind) {
    return kKindNames.at(static_cast<size_t>(kind));
}

void Verdict::raise_error(size_t index, double ratio) {
    if (index < error_ratios.size()) {
        error_ratios[index] = std::max(error_ratios[index], static_cast<float>(ratio));
    }
}

bool Verdict::keeps(FindingKind kind, std::string_view rule, cases::Profile of_level) const {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const FindingGroup& g) {
        return g.kind == kind && g.rule == rule && g.level == of_level;
    });
    if (is_brief) {  // the loosest level leads
        return findings.empty() || of_level < std::ranges::min(findings, {}, &Finding::level).level;
    }
    return findings.size() < kMaxFindings && (group == groups.end() || group->count < kMaxOfGroup);
}

void Verdict::add(Finding finding, const cases::Target& target) {
    level = ok() ? finding.level : std::min(level, finding.level);
    if (!finding.of_case) {
        mark(finding, target);
    }
    const bool is_kept = keeps(finding.kind, finding.rule, finding.level);
    count(finding, 1);
    if (is_kept) {
        findings.push_back(std::move(finding));
    }
}

void Verdict::mark(const Finding& finding, const cases::Target& target) {
    const cases::SampleId id = sample_of(finding);
    const size_t index = cases::index_of(target, id);
    if (finding.kind == FindingKind::value && finding.ratio > 0) {
        raise_error(index, finding.ratio);
    }
    const bool first = !std::exchange(has_wrong_samples, true);
    const uint32_t row = id.layer * target.height + id.y;
    min_x = first ? id.x : std::min(min_x, id.x);
    min_y = first ? row : std::min(min_y, row);
    max_x = first ? id.x : std::max(max_x, id.x);
    max_y = first ? row : std::max(max_y, row);
    if (index < marks.size() &&
        (marks[index] == SampleMark::ok || marks[index] == SampleMark::either)) {
        marks[index] = mark_of(finding.kind);
    }
}

void Verdict::count(const Finding& finding, uint64_t count) {
    counts.at(static_cast<size_t>(finding.kind)) += count;
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const FindingGroup& g) {
        return g.kind == finding.kind && g.rule == finding.rule && g.level == finding.level &&
               g.door == finding.door;
    });
    if (group != groups.end()) {
        group->count += count;
    } else {
        groups.push_back({finding.kind, finding.rule, finding.level, count, 0, finding.door});
    }
}

std::optional<uint64_t> Verdict::count_wrong_samples() const {
    if (has_unmarked || marks.empty()) {
        return std::nullopt;
    }
    return static_cast<uint64_t>(std::count_if(marks.begin(), marks.end(), [](SampleMark mark) {
        return mark != SampleMark::ok && mark != SampleMark::either;
    }));
}

}  // namespace diff
