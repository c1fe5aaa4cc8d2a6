// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Handles clip distances, and depth planes, that a device tests at each sample instead of cutting
// the polygon by them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/position/clip.hpp"
#include "ref/position/position.hpp"

namespace ref {

// What the cuts of one outline are computed from.
struct CutSource {
    const ClipInput& triangle;
    const cases::Viewport& viewport;
    cases::Profile profile;
    // Where the device may have the triangle's own vertices; of one behind the eye, that of its
    // negative. Nothing if it may be anywhere.
    std::array<std::optional<Box>, 3> vertex;
    const Window& window;
};

// The cuts of the outline whose vertices are `polygon` with positions in `boxes`; planes that no
// sample of the outline fails are left out. Nothing if the planes' values cannot be bounded: then a
// distance may pass or fail anywhere.
std::optional<std::vector<DistanceCut>> distance_cuts(const CutSource& source,
                                                      std::span<const ClippedVertex> polygon,
                                                      std::span<const Box> boxes);

// The same of the depth against the depth planes that cut the triangle: "no cut" where no sample of
// the outline fails them. Nothing if a vertex lies behind the eye or has no bounded position: then
// only the cut polygon is right.
std::optional<std::vector<DistanceCut>> depth_cuts(const CutSource& source,
                                                   std::span<const ClippedVertex> polygon,
                                                   std::span<const Box> boxes,
                                                   std::span<const ClipPlane> planes);

}  // namespace ref
