// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which of the cases a run takes, and in which order.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cases/model/case.hpp"

namespace run {

// Which shard (1..count) an id belongs to; does not change when cases are added.
uint32_t shard_of(const std::string& id, uint32_t count);
// Sorts into an order that depends on each id and the seed alone, so that a subset keeps its order.
void shuffle(std::vector<cases::Case>& cases, uint64_t seed);

// Of the selected cases the first and the last leaf of each file, for --quick.
std::vector<size_t> first_and_last(const std::vector<cases::Case>& cases,
                                   const std::vector<size_t>& selected);

}  // namespace run
