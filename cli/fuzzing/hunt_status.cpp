// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fuzzing/hunt_status.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/base/counted.hpp"

namespace cli {

using cases::counted;

HuntStatus::HuntStatus(const RunOptions& options)
    : progress_(options.quiet ? ProgressStyle::none : options.progress, 0),
      begin_(std::chrono::steady_clock::now()) {}

void HuntStatus::show(const fuzz::HuntCounts& c, const std::vector<fuzz::Entry>& entries,
                      const std::string& doing) {
    const auto known = static_cast<size_t>(std::ranges::count_if(entries, &fuzz::Entry::is_known));
    progress_.show_words(fmt::format(
        "{} judged, {:.0f}/s, {} failed, {} known and {} new, {}", counted(c.drawn, "case"),
        c.drawing_seconds > 0 ? static_cast<double>(c.drawn) / c.drawing_seconds : 0.0, c.failed,
        counted(known, "cause"), entries.size() - known, doing));
}

double HuntStatus::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

}  // namespace cli
