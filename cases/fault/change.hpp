// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies of faults that are changes of a case: what a device with the fault takes the case for.
// Those that rules are exercised by (ref/exercise) keep the triangles and their numbers.
#pragma once

#include "cases/fault/row.hpp"
#include "cases/model/case.hpp"

namespace cases {

bool has_change(Fault fault);

// Makes the case what a device with the fault takes it for; false if that is the case itself, or if
// the fault has no such body.
bool take_with(Fault fault, Case& c);

}  // namespace cases
