// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/record/levels.hpp"

#include <algorithm>

namespace report {

namespace {

bool has_any(const CaseRecord& record) {
    return record.outcome.finding_total() > 0 || !record.outcome.findings.empty();
}

}  // namespace

bool is_judged(const CaseRecord& record) {
    switch (actual_status(record)) {
        case Status::pass:
        case Status::fail:
            return true;
        case Status::flake:  // the findings are of one drawing, and its status of several
            return has_any(record);
        default:
            return false;
    }
}

bool has_findings(const CaseRecord& record, cases::Profile level, Of which) {
    if (!is_judged(record) || !has_any(record)) {
        return false;
    }
    const bool is_news = which == Of::news;
    if (is_news && is_expected(record.status)) {
        return false;
    }
    if (record.outcome.groups.empty()) {  // journals that do not tell
        return record.outcome.level == level;
    }
    return std::ranges::any_of(record.outcome.groups, [&](const diff::FindingGroup& group) {
        return group.level == level && (!is_news || group.known < group.count);
    });
}

std::optional<cases::Profile> level_of(const CaseRecord& record, Of which) {
    for (const cases::Profile level : cases::kProfiles) {
        if (has_findings(record, level, which)) {
            return level;
        }
    }
    return std::nullopt;
}

Levels levels(const Run& run) {
    Levels found;
    for (size_t k = 0; k < found.rows.size(); ++k) {
        LevelCount& row = found.rows.at(k);
        row.level = cases::kProfiles[k];
        row.is_judged = row.level <= run.profile;
    }
    for (const CaseRecord& record : run.cases) {
        const Status actual = actual_status(record);
        if (!is_judged(record)) {
            const bool is_left_out = actual == Status::unsupported || actual == Status::skip;
            found.unjudged += is_left_out ? 0U : 1U;
            continue;
        }
        ++found.judged;
        for (LevelCount& row : found.rows) {
            if (has_findings(record, row.level, Of::all)) {
                const bool is_new = has_findings(record, row.level, Of::news);
                (is_new ? row.unexpected : row.expected).push_back(&record);
            }
        }
    }
    return found;
}

cases::Profile fail_level(const Run& run) {
    return run.fail_at.value_or(run.profile);
}

bool makes_fail(const CaseRecord& record, cases::Profile fail_level) {
    if (is_expected(record.status)) {
        return false;
    }
    const auto news = record.status == Status::fail ? level_of(record, Of::news) : std::nullopt;
    return !news || *news <= fail_level;
}

bool makes_fail(const Run& run, const CaseRecord& record) {
    return makes_fail(record, fail_level(run));
}

}  // namespace report
