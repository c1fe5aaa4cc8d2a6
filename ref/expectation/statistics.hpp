// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What queries of pipeline statistics may give (Vulkan specification, "Pipeline Statistics
// Queries"; Direct3D 11.3 functional specification, 20.4.7).
//
// Vulkan says what each counter counts, and that devices differ: a tiler may do a thing several
// times, other commands may count. All this adds, so at vulkan and practice a counter is never less
// than what the draw must do, and nothing bounds it from above:
//
//   vertices and primitives   of complete primitives ("incomplete primitives may be
//                             counted"); of indices that name a vertex twice it counts once
//   vertex invocations        one a vertex: its results may be reused
//   clipping invocations      one a triangle that must cover a sample: devices leave out
//                             others before they clip; none with rasterizer discard
//   clipping primitives       one for each of these that has a vertex inside the clip volume
//   fragment invocations      one a fragment that shows; from practice on one for each of
//                             its samples if sample shading asks for that, and one for what
//                             the shader discards after early tests, which were no
//                             invocations if they did not count
//
// A fragment that shows was shaded, since a query goes with the attachments that count hits: their
// values differ from pixel to pixel, and add up. Else one invocation might do for several fragments
// ("if a fragment shader statically computes the same values"), or a later draw hide it.
//
// Direct3D bounds them. Assembled vertices ("not subtracting any caching") and primitives are exact
// up to what incomplete primitives add; shading and clipping lie between two numbers: an infinite
// vertex cache and none, an infinite guard band and none. Pixel shaders may count the helpers of
// their quads, and fragments that fail the tests. It knows no fans: what they assemble lies between
// a strip's vertices and a list's.
#pragma once

#include <cstddef>
#include <vector>

#include "cases/model/case.hpp"
#include "ref/expectation/counted.hpp"
#include "ref/expectation/expectation.hpp"

namespace ref {

// Nothing bounds it.
inline constexpr uint64_t kNoMost = UINT64_MAX;

// The bounds of the statistic that a draw asks for, with what a device shows. `shown`
// empty: whatever a device may show.
CountBounds statistic_bounds(const cases::Case& c, size_t draw, const Expectation& expectation,
                             const ShownAt& shown);

// What the queries of a case may give, by draw: its statistic, or how many samples, of which a
// query that is not precise gives 0 or any other number; nothing for a draw without a query.
std::vector<CountBounds> query_bounds(const cases::Case& c, const Expectation& expectation,
                                      const ShownAt& shown);

}  // namespace ref
