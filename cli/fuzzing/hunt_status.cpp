// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fuzzing/hunt_status.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "cases/base/counted.hpp"

namespace cli {

using cases::counted;

HuntStatus::HuntStatus(const FuzzOptions& options)
    : is_shown_(!options.run.quiet && options.run.progress == ProgressStyle::automatic &&
                ::isatty(STDERR_FILENO) != 0),
      begin_(std::chrono::steady_clock::now()) {}

void HuntStatus::show(const fuzz::HuntCounts& c, size_t causes) {
    const double now = seconds();
    if (!is_shown_ || now - last_ < 0.2) {
        return;
    }
    last_ = now;
    std::fprintf(
        stderr, "\r%s\x1b[K",
        fmt::format("{} judged, {:.0f}/s, {}, {}", counted(c.drawn, "case"),
                    c.drawing_seconds > 0 ? static_cast<double>(c.drawn) / c.drawing_seconds : 0.0,
                    counted(c.poses, "pose"), counted(causes, "cause"))
            .c_str());
    std::fflush(stderr);
}

void HuntStatus::show_words(const char* words) {
    const double now = seconds();
    if (is_shown_ && now - last_ >= 0.2) {
        last_ = now;
        std::fprintf(stderr, "\r%s, %.0f s\x1b[K", words, now);
        std::fflush(stderr);
    }
}

void HuntStatus::clear() const {
    if (is_shown_) {
        std::fputs("\r\x1b[K", stderr);
        std::fflush(stderr);
    }
}

void HuntStatus::restart() {
    begin_ = std::chrono::steady_clock::now();
    last_ = -1;
}

double HuntStatus::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

}  // namespace cli
