// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Handles clip distances, and depth planes, that a device tests at each sample instead of cutting
// the polygon by them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ref/coverage/distance_planes.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/position/clip.hpp"

namespace ref {

// The cuts of the outline whose vertices are `polygon` with positions in `boxes`; planes that no
// sample of the outline fails are left out. Nothing if the planes' values cannot be bounded: then a
// distance may pass or fail anywhere.
std::optional<std::vector<DistanceCut>> distance_cuts(const CutSource& source,
                                                      std::span<const ClippedVertex> polygon,
                                                      std::span<const Box> boxes);

// The same of the depth against the depth planes that cut the triangle. Nothing if a device that
// tests it has no bound or draws no sample: then only the cut polygon is right.
std::optional<std::vector<DistanceCut>> depth_cuts(const CutSource& source,
                                                   std::span<const ClippedVertex> polygon,
                                                   std::span<const Box> boxes,
                                                   std::span<const ClipPlane> planes);

}  // namespace ref
