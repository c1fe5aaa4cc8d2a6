// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The cases that `edgecase fuzz` draws, in their order.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/model/case.hpp"
#include "fuzz/generate/pose.hpp"

namespace hunt {

struct Numbered {
    uint64_t number = 0;
    cases::Case data;
};

class Sequence {
  public:
    // Numbers below `first` and from `end` on are left out.
    Sequence(uint64_t seed, uint64_t first, uint64_t end)
        : seed_(seed), first_(first), end_(end), poses_(seed) {}
    // Those of the next poses. Texts that are no cases are left out, as in a hunt.
    std::vector<Numbered> next(size_t poses);
    uint64_t next_case() const;                       // all below have been made
    const fuzz::Pose& pose() const { return pose_; }  // the last one

  private:
    uint64_t seed_, first_, end_;
    fuzz::Poses poses_;
    fuzz::Pose pose_;
};

}  // namespace hunt
