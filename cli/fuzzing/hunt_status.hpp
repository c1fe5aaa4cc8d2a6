// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The line that says how far a hunt has come.
#pragma once

#include <chrono>

#include "cli/options/options.hpp"
#include "fuzz/hunt.hpp"

namespace cli {

// One line while it goes on, on a terminal only.
class HuntStatus {
  public:
    explicit HuntStatus(const FuzzOptions& options);
    void show(const fuzz::HuntCounts& counts, size_t causes);
    void show_words(const char* words);
    void clear() const;
    void restart();
    double seconds() const;  // since it was made, or restarted

  private:
    bool is_shown_ = false;
    std::chrono::steady_clock::time_point begin_;
    double last_ = -1;
};

}  // namespace cli
