// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The experiments, one function a concept; each adds its properties to the datasheet. Later ones
// read what earlier ones have found.
#pragma once

#include "probe/base/bench.hpp"

namespace probe {

void measure_grid(const Bench& bench);          // subpixel bits and rounding
void measure_viewport(const Bench& bench);      // bounds of viewports
void measure_ties(const Bench& bench);          // who owns samples on edges
void measure_locations(const Bench& bench);     // of samples
void measure_places(const Bench& bench);        // where inputs are evaluated
void measure_setup(const Bench& bench);         // snapped or unsnapped positions
void measure_transform(const Bench& bench);     // division by w and the viewport's multiply-add
void measure_precision(const Bench& bench);     // of interpolation
void measure_clipping(const Bench& bench);      // guard band, depth and distance planes
void measure_conservative(const Bench& bench);  // sizes, corners, pieces
void measure_depth(const Bench& bench);         // rounding, bias
void measure_colors(const Bench& bench);        // rounding to formats, denormals, sRGB
void measure_blending(const Bench& bench);      // in what numbers
// Constants, the planes' origin, the same bits beside other state.
void measure_inputs(const Bench& bench);
void measure_derivatives(const Bench& bench);  // quads, coarse differences, level of detail
void measure_resolves(const Bench& bench);     // averages
void measure_blits(const Bench& bench);        // coordinates, borders, filter weights

}  // namespace probe
