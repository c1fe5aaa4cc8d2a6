// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// When a worker that could not start is started again. A graphics processor that hung is reset, and
// its driver may refuse to start for some seconds.
#pragma once

#include <chrono>
#include <cstdint>

namespace run {

class StartPauses {
  public:
    using Clock = std::chrono::steady_clock;

    // Counts a failure, but one before next(): that worker was started beside one that has failed.
    void failed() {
        if (const Clock::time_point now = Clock::now(); now >= next_) {
            next_ = now + kFirst * (1U << failures_);
            ++failures_;
        }
    }
    void succeeded() { failures_ = 0; }
    bool is_over() const { return failures_ >= kMost; }
    // No worker is started before.
    Clock::time_point next() const { return next_; }

  private:
    static constexpr uint32_t kMost =
        8;  // failures in a row; their pauses are half a minute in all
    static constexpr std::chrono::milliseconds kFirst{250};  // twice as long after each
    uint32_t failures_ = 0;
    Clock::time_point next_;
};

}  // namespace run
