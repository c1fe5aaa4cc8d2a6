// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/unexpected.hpp"

#include <utility>

namespace report {

UnexpectedResults::UnexpectedResults(const std::vector<std::string>& ids, ConsoleStyle style)
    : style_(std::move(style)) {
    for (size_t k = 0; k < ids.size(); ++k) {
        place_.emplace(ids[k], k);
    }
}

std::string UnexpectedResults::add(const CaseRecord& record) {
    const bool is_told = !is_expected(record.status) && record.status != Status::not_run;
    count_ += is_told ? 1U : 0U;
    waiting_.emplace(place_.at(record.id), is_told ? console_case(record, style_) : std::string());
    std::string text;
    for (auto at = waiting_.begin(); at != waiting_.end() && at->first == next_;) {
        text += tell(at->second);
        at = waiting_.erase(at);
        ++next_;
    }
    return text;
}

std::string UnexpectedResults::rest() {
    std::string text;
    for (const auto& [place, words] : std::exchange(waiting_, {})) {
        text += tell(words);
    }
    return text;
}

std::string UnexpectedResults::tell(const std::string& text) {
    if (text.empty()) {
        return {};
    }
    ++told_;
    if (style_.verbose || told_ <= kHandful) {
        return text;
    }
    return told_ == kHandful + 1 ? "more unexpected results: their causes follow at the end; -v "
                                   "tells each\n"
                                 : std::string();
}

}  // namespace report
