// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fuzzing/hunt_status.hpp"

#include <fmt/format.h>

#include "cases/base/counted.hpp"

namespace cli {

using cases::counted;

HuntStatus::HuntStatus(const RunOptions& options)
    : progress_(options.quiet ? ProgressStyle::none : options.progress, 0),
      begin_(std::chrono::steady_clock::now()) {}

void HuntStatus::show(const fuzz::HuntCounts& c, size_t causes) {
    progress_.show_words(
        fmt::format("{} judged, {:.0f}/s, {}, {}", counted(c.drawn, "case"),
                    c.drawing_seconds > 0 ? static_cast<double>(c.drawn) / c.drawing_seconds : 0.0,
                    counted(c.poses, "pose"), counted(causes, "cause")));
}

double HuntStatus::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

}  // namespace cli
