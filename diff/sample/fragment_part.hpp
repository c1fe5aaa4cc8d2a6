// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cases/model/case.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/value.hpp"

namespace diff {

// What of a fragment triangle `t` leaves in a sample: a draw that does not write depth leaves an
// older fragment's depth.
inline ref::FragmentPart part_of(const cases::Case& c, const ref::Expectation& expectation,
                                 uint32_t t) {
    return c.draws[expectation.triangles[t].draw].depth.write ? ref::FragmentPart::all
                                                              : ref::FragmentPart::all_but_depth;
}

}  // namespace diff
