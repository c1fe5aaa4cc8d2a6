// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The line that says how far a hunt has come.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/prepare/outputs.hpp"
#include "fuzz/hunt.hpp"

namespace cli {

class HuntStatus {
  public:
    explicit HuntStatus(const RunOptions& options);
    void show(const fuzz::HuntCounts& counts, const std::vector<fuzz::Entry>& entries,
              const std::string& doing);
    void clear() { progress_.clear(); }
    double seconds() const;  // since it was made

  private:
    Progress progress_;
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace cli
