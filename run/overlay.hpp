// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What else than its edges decides where a triangle shows: viewport, and the planes that clip it.
// Exact, for the page to draw and to tell.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/triangle.hpp"
#include "ref/position/clip.hpp"
#include "report/record/evidence.hpp"

namespace run {

// Whether every position and clip distance of the triangle is a finite number.
bool is_finite(const ref::ClipInput& input);

// The planes of its draw's clip volume beyond which a vertex of the triangle lies. None if a number
// is not finite, or the triangle has no area as it is seen.
std::vector<report::PlaneCut> cuts_of(const cases::Draw& draw, const cases::Triangle& t);

// x0, y0, x1, y1: x and y as given, the other corner by their exact sums.
std::array<std::string, 4> corners_of(const cases::Viewport& viewport);

}  // namespace run
