// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Viewports finer than a device keeps them (Vulkan, "Limits", viewportSubPixelBits: "The subpixel
// precision that floating-point viewport bounds are interpreted at is given by this limit"). No
// direction is given, so a bound may be kept as it is or moved to either neighbour on the grid of
// 2^-bits pixels, by less than one of its steps.
#pragma once

#include <vector>

#include "cases/model/case.hpp"
#include "ref/position/limits.hpp"

namespace ref {

// Whether a viewport's bounds on one axis, `origin` and `origin` + `extent`, are multiples of
// 2^-bits pixels. Exact.
bool is_on_viewport_grid(float origin, float extent, int bits);

// The case as devices draw it that keep the bounds of viewports to their grid: all low bounds (x
// and y as they are given) by one of floor, nearest (halves up) and ceil, and all high bounds (x +
// width, y + height) by one of them, the same way for both axes and every draw. Without doubles,
// without the case itself, and without viewports that become empty; nothing if all viewports are on
// the grid.
std::vector<cases::Case> on_viewport_grids(const cases::Case& c, const Limits& limits);

}  // namespace ref
