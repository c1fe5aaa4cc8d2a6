// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/order.hpp"

#include <algorithm>
#include <utility>

#include "cases/base/checksum.hpp"

namespace run {

uint32_t shard_of(const std::string& id, uint32_t count) {
    return static_cast<uint32_t>(cases::stable_hash(id, 0) % count) + 1;
}

void shuffle(std::vector<cases::Case>& cases, uint64_t seed) {
    const auto key = [seed](const cases::Case& c) {
        return std::pair(cases::stable_hash(c.id, seed + 1), c.id);
    };
    std::sort(cases.begin(), cases.end(),
              [&](const cases::Case& a, const cases::Case& b) { return key(a) < key(b); });
}

std::vector<size_t> first_and_last(const std::vector<cases::Case>& cases,
                                   const std::vector<size_t>& selected) {
    std::vector<size_t> out;
    for (size_t n = 0; n < selected.size(); ++n) {
        const auto is_other_file = [&](size_t m) {
            return cases[selected[m]].claim.where.file != cases[selected[n]].claim.where.file;
        };
        if (n == 0 || n + 1 == selected.size() || is_other_file(n - 1) || is_other_file(n + 1)) {
            out.push_back(selected[n]);
        }
    }
    return out;
}

}  // namespace run
