// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What draws without a driver, and what it has drawn as a capture.
#pragma once

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "rasterizers/algorithms/device.hpp"

namespace rasterizers {

// Draws a case as the reference expects it: of several allowed answers the first, values rounded to
// binary32. No driver is involved; a perfect device of 8 subpixel bits.
capture::Capture draw_by_reference(const cases::Case& c);

// Draws a case as an algorithm does; only without a rasterizers::unsupported_reason().
capture::Capture draw_by_algorithm(const cases::Case& c, const rasterizers::Device& device);

}  // namespace rasterizers
