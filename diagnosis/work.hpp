// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What drawing and judging a case costs, as far as it can be told before.
#pragma once

#include <cstdint>

#include "cases/model/case.hpp"

namespace diagnosis {

// Of one picture of a case: its samples, and eight for a vertex.
inline uint64_t cost_of(const cases::Case& c) {
    uint64_t cost = uint64_t{c.target.width} * c.target.rows() * c.target.samples;
    for (const cases::Draw& d : c.draws) {
        cost += 8 * d.instances * d.element_count();
    }
    return cost;
}

// What is spent beside samples: a picture has its memory, and its reference is exact arithmetic.
inline constexpr uint64_t kPictureWork = 64;
inline constexpr uint64_t kReferences = 8;  // one costs so many pictures

inline uint64_t work_of_picture(const cases::Case& c) {
    return kPictureWork + cost_of(c);
}
inline uint64_t work_of_subject(const cases::Case& c) {
    return kReferences * work_of_picture(c);
}

}  // namespace diagnosis
