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
    explicit Sequence(uint64_t seed) : seed_(seed), poses_(seed) {}
    // Those of the next poses. Texts that are no cases are left out, as in a hunt.
    std::vector<Numbered> next(size_t poses);
    uint64_t next_case() const;  // all below have been made

  private:
    uint64_t seed_;
    fuzz::Poses poses_;
};

}  // namespace hunt
