// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which of several possible answers the observations speak for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "probe/base/datasheet.hpp"

namespace probe {

class Vote {
  public:
    explicit Vote(std::vector<std::string> candidates);

    // One observation, with what each candidate says of it. It is decisive, and counted, if some
    // candidates explain it and others do not; what none explains speaks against all.
    void add(const std::function<bool(size_t candidate)>& explains);

    uint64_t decisive() const { return decisive_; }

    // Fills the answer of a property: the label of the candidate that explains most, if none with
    // another label explains as much, and nearly nothing contradicts it. Else 'cannot tell' with
    // the reason. `label` names candidates; several may have one label.
    void settle(Property& property,
                const std::function<std::string(size_t candidate)>& label = {}) const;
    // The candidate that explains most.
    size_t best() const;

  private:
    std::vector<std::string> candidates_;
    std::vector<uint64_t> explained_;  // of the decisive observations, by candidate
    uint64_t decisive_ = 0;
};

}  // namespace probe
