// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures what a rasterizer does where it may choose, or where its limits only promise.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "probe/base/bench.hpp"

namespace probe {

// The names of all experiments; those that read what others have found come after them.
std::vector<std::string_view> experiments();

// Carries out the experiments that `takes` names, or all; the properties come in the order of
// kSections.
Datasheet measure(const Draw& draw, const Promises& promises,
                  const std::function<bool(std::string_view experiment)>& takes = {});

}  // namespace probe
