// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whose depth a sample holds, where that need not be the last writer's.
#pragma once

#include "ref/expectation/expectation.hpp"

namespace cli {

// Whether the depth that a sample holds may be another one than the last writer's: the writer's
// draw may not write depth, and what early tests have stored may be discarded then.
bool has_own_depth(const cases::Case& c, const ref::Expectation& expectation, size_t index);

// Whether a sample may hold the depth of a triangle.
bool may_hold_depth(const cases::Case& c, const ref::Expectation& expectation, size_t index,
                    uint32_t triangle);

}  // namespace cli
