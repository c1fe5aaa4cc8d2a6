// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/unexpected.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "report/text/causes.hpp"
#include "report/text/sentences.hpp"

namespace report {

UnexpectedResults::UnexpectedResults(const std::vector<std::string>& ids, ConsoleStyle style)
    : style_(std::move(style)) {
    for (size_t k = 0; k < ids.size(); ++k) {
        place_.emplace(ids[k], k);
    }
}

namespace {

// A record without what causes() does not ask for: a broken device has thousands of them.
CaseRecord lean(const CaseRecord& record) {
    CaseRecord out;
    out.id = record.id;
    out.file = record.file;
    out.status = record.status;
    out.known.actual = record.known.actual;
    out.outcome.level = record.outcome.level;
    out.death.signal = record.death.signal;
    out.death.step = record.death.step;
    out.outcome.compared_samples = record.outcome.compared_samples;
    out.outcome.counts = record.outcome.counts;
    out.outcome.groups = record.outcome.groups;
    if (!record.outcome.findings.empty()) {
        out.outcome.findings = {leading_finding(record)};
    }
    return out;
}

}  // namespace

std::string UnexpectedResults::add(const CaseRecord& record) {
    const bool is_told = !is_expected(record.status) && record.status != Status::not_run;
    count_ += is_told ? 1U : 0U;
    const size_t place = place_.at(record.id);
    if (!style_.verbose) {
        if (is_told) {
            kept_.insert_or_assign(place, std::pair(lean(record), console_case(record, style_)));
        }
        return {};
    }
    waiting_.emplace(place, is_told ? console_case(record, style_) : std::string());
    std::string text;
    for (auto at = waiting_.begin(); at != waiting_.end() && at->first == next_;) {
        text += at->second;
        at = waiting_.erase(at);
        ++next_;
    }
    return text;
}

std::string UnexpectedResults::rest() {
    std::string text;
    for (const auto& [place, words] : std::exchange(waiting_, {})) {
        text += words;
    }
    text += worst();
    kept_.clear();
    return text;
}

std::string UnexpectedResults::worst() const {
    Run run;
    for (const auto& [place, kept] : kept_) {
        run.cases.push_back(kept.first);
    }
    std::string text;
    std::set<std::string> told;  // a case may stand in several causes
    const auto tell = [&](const CaseRecord& record) {
        if (told.insert(record.id).second) {
            text += kept_.at(place_.at(record.id)).second;
        }
    };
    const std::vector<Cause> list = causes(run);
    if (kept_.size() <= kHandful) {
        for (const Cause& cause : list) {
            for (const CaseRecord* record : cause.cases) {
                tell(*record);
            }
        }
        return text;
    }
    for (size_t k = 0; k < std::min(list.size(), kHandful); ++k) {
        tell(smallest_case(list[k]));
    }
    return text + (style_.quiet
                       ? "more unexpected results: the report and a run without -q tell them\n"
                       : "more unexpected results: their causes follow; -v tells each\n");
}

}  // namespace report
