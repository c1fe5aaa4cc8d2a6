// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Cases that are made of others: a few changes each, or, of a file with a table [fuzz], what that
// leaves open. A seed and a number make a case, given the same cases to start from.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "cases/load/open_values.hpp"
#include "fuzz/change/change.hpp"
#include "fuzz/generate/source.hpp"

namespace fuzz {

struct Start {
    cases::Case data;
    // The whole file, if it has a table [fuzz]. Leaves of a file share it.
    std::shared_ptr<const Document> open = {};
};
using Starts = std::shared_ptr<const std::vector<Start>>;

// One error for each value of [fuzz] with which the loader takes none of the leaves of a file, the
// other names being nominal: of each list, and the ends of each range. `leaves`: of one file, which
// has a table [fuzz]; at least one.
cases::Errors check_open_values(const std::vector<Start>& leaves);

class ChangedSource : public Source {
  public:
    // At least one start.
    ChangedSource(uint64_t seed, Starts starts);
    // The cases of a group have one start, and a change of state or two in common.
    uint64_t group_size() const override { return 16; }
    void enter(uint64_t group) override;
    Made make(uint64_t number) const override;

  private:
    const Start& start_of(uint64_t group);
    Made make_change(uint64_t number) const;
    Made make_open(uint64_t number) const;

    uint64_t seed_;
    Starts starts_;
    std::vector<size_t> order_;  // of the starts in this cycle through all of them
    uint64_t cycle_ = UINT64_MAX;
    // --- of the group ---
    const Start* start_ = nullptr;
    Document document_;  // of the start, with what the group has in common; empty: none was found
    Document other_;     // of another start; empty: none
    Words words_;        // what was changed in common
    uint64_t refused_ = 0;
    std::vector<cases::OpenName> open_;
};

}  // namespace fuzz
