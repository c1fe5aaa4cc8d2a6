// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ref/coverage/fast/half_plane.hpp"

namespace ref::fast {

// As coverage_sets, of a conservative draw: sets of the centres of pixels.
CoverageSets pixel_sets(const TriangleSetup& setup);

}  // namespace ref::fast
