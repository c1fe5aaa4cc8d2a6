// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cases/model/case.hpp"
#include "cases/model/sample.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace diff {

// What of the last fragment that shows, of triangle `t`, stays in a sample: a draw that does not
// write depth leaves an older fragment's depth, and one that is discarded once its depth is stored
// leaves its own.
inline ref::FragmentPart part_of(const cases::Case& c, const ref::Expectation& expectation,
                                 uint32_t t) {
    return c.draws[expectation.triangles[t].draw].depth.write && !cases::stores_discarded(c)
               ? ref::FragmentPart::all
               : ref::FragmentPart::all_but_depth;
}

}  // namespace diff
