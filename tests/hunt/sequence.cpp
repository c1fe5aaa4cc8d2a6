// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "hunt/sequence.hpp"

#include <optional>
#include <string>
#include <utility>

#include "cases/base/parallel.hpp"
#include "fuzz/generate/generator.hpp"
#include "fuzz/generate/source.hpp"

namespace hunt {

uint64_t Sequence::next_case() const {
    return poses_.count() * fuzz::kGeometries;
}

std::vector<Numbered> Sequence::next(size_t poses) {
    std::vector<Numbered> all;
    for (size_t k = 0; k < poses; ++k) {
        const uint64_t pose_number = poses_.count();
        pose_ =
            poses_.next([&](const fuzz::Pose& p) { return fuzz::is_case(seed_, p, pose_number); });
        std::vector<std::optional<cases::Case>> made(fuzz::kGeometries);
        cases::for_each_index(made.size(), [&](size_t n) {
            const uint64_t number = pose_number * fuzz::kGeometries + n;
            if (number < first_ || number >= end_) {
                return;
            }
            made[n] = fuzz::load_one(fuzz::case_text(seed_, pose_, pose_number, number),
                                     std::to_string(number));
        });
        for (size_t n = 0; n < made.size(); ++n) {
            if (made[n]) {
                all.push_back({pose_number * fuzz::kGeometries + n, std::move(*made[n])});
            }
        }
    }
    return all;
}

}  // namespace hunt
