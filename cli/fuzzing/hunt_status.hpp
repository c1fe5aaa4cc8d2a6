// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The line that says how far a hunt has come.
#pragma once

#include <chrono>
#include <string>

#include "cli/options/options.hpp"
#include "cli/prepare/outputs.hpp"
#include "fuzz/hunt.hpp"

namespace cli {

class HuntStatus {
  public:
    explicit HuntStatus(const RunOptions& options);
    void show(const fuzz::HuntCounts& counts, size_t causes);
    void show_words(const std::string& words) { progress_.show_words(words); }
    void clear() { progress_.clear(); }
    void restart() { begin_ = std::chrono::steady_clock::now(); }
    double seconds() const;  // since it was made, or restarted

  private:
    Progress progress_;
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace cli
