// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace diff {

namespace {

SampleMark mark_of(FindingKind kind) {
    switch (kind) {
        case FindingKind::missing:
            return SampleMark::missing;
        case FindingKind::extra:
            return SampleMark::extra;
        case FindingKind::double_hit:
            return SampleMark::double_hit;
        case FindingKind::value:
            return SampleMark::value;
        case FindingKind::order:
            return SampleMark::order;
    }
    return SampleMark::ok;
}

}  // namespace

std::string_view to_string(FindingKind kind) {
    switch (kind) {
        case FindingKind::missing:
            return "missing";
        case FindingKind::extra:
            return "extra";
        case FindingKind::double_hit:
            return "double";
        case FindingKind::value:
            return "value";
        case FindingKind::order:
            return "order";
    }
    return "";
}

void Verdict::raise_error(size_t index, double ratio) {
    if (index < error_ratios.size()) {
        error_ratios[index] = std::max(error_ratios[index], static_cast<float>(ratio));
    }
}

void Verdict::add(Finding finding, const cases::Target& target) {
    const cases::SampleId id = sample_of(finding);
    const size_t index = cases::index_of(target, id);
    if (finding.kind == FindingKind::value && finding.ratio > 0) {
        raise_error(index, finding.ratio);
    }
    const bool first = ok();
    const uint32_t row = id.layer * target.height + id.y;
    min_x = first ? id.x : std::min(min_x, id.x);
    min_y = first ? row : std::min(min_y, row);
    max_x = first ? id.x : std::max(max_x, id.x);
    max_y = first ? row : std::max(max_y, row);
    level = first ? finding.level : std::min(level, finding.level);
    ++counts.at(static_cast<size_t>(finding.kind));
    if (index < marks.size() &&
        (marks[index] == SampleMark::ok || marks[index] == SampleMark::either)) {
        marks[index] = mark_of(finding.kind);
    }
    if (findings.size() < kMaxFindings) {
        findings.push_back(std::move(finding));
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
