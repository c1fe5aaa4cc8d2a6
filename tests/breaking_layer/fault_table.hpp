// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "fault.hpp"

namespace breaking {

// The fault that EDGECASE_BREAK names; one that does nothing if the variable is not set. A name
// that does not exist, or a parameter that is no number from 1 up, is told on standard error and
// gives nothing.
const Fault* chosen_fault();

// Adds one alteration to the file that EDGECASE_BREAK_COUNT names: one byte each, written at once,
// so that several workers and a crash lose none. Its size is the count.
void count_alteration();

}  // namespace breaking
