// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Hypotheses with a size that is found from the wrong values of a case: everything lies a little
// off, or values are evaluated a little off.
#pragma once

#include <vector>

#include "diagnosis/hypothesis.hpp"
#include "diagnosis/match.hpp"

namespace diagnosis {

// Positions that are half a pixel or a whole one off, to a side or, by half a pixel, to both: the
// usual mistakes, where no value of a failed case tells by how much.
std::vector<Hypothesis> usual_shifts(int subpixel_bits);

// Finds how far all positions would have to be moved for a right device to have the values that
// the record tells, by least squares (Gauss and Newton: a value's change with the place is measured
// by drawing the case at another place), and offers that distance and those of few binary digits
// near it: as positions that are moved, and as values that are evaluated at the opposite place.
// Nothing where no value is told, or where no distance below 4 pixels fits.
std::vector<Hypothesis> fitted_hypotheses(const Subject& subject, int subpixel_bits);

}  // namespace diagnosis
