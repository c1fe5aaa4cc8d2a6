// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace run {

// A few globs that match each id of `wanted` and no other one of `all`, so that many cases with one
// cause need few lines: "fam/name:*", "fam/name:a=1,*", or ids where nothing shorter fits. Shortest
// first among those that match equally many; `wanted` is a subset of `all`.
std::vector<std::string> cover_by_globs(const std::vector<std::string>& wanted,
                                        const std::vector<std::string>& all);

}  // namespace run
