// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Clips in rationals, bounds included: what clip_triangle says in whole numbers and Balls.
#pragma once

#include <span>
#include <vector>

#include "ref/position/clip.hpp"

namespace ref::test {

std::vector<ClippedVertex> rational_clip(const ClipInput& triangle, const cases::Viewport& viewport,
                                         cases::Profile profile, std::span<const ClipPlane> planes);

}  // namespace ref::test
