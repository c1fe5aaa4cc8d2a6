// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A rasterizer as drivers are written: binary32 vertices, snapping to integers, int64 edge
// functions with a fill-rule bias, 8x8 tiles, attribute planes in binary32. It shares no arithmetic
// with ref/, so that the reference, the comparison and the suite are tried against a third opinion.
#pragma once

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

// Draws the case, or blits; what its target has no attachment for is drawn, too
// (rasterizers::drop_unattached).
capture::Capture render(const cases::Case& c, const Device& device);

}  // namespace software
