// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Clip distances and depth as functions of framebuffer coordinates, with what a device may have
// instead of them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/number/rational.hpp"
#include "ref/position/clip.hpp"
#include "ref/position/position.hpp"

namespace ref {

// What the planes of one outline are computed from.
struct CutSource {
    const ClipInput& triangle;
    const cases::Viewport& viewport;
    cases::Profile profile;
    // Where the device may have the triangle's own vertices; of one behind the eye, that of its
    // negative. Nothing if it may be anywhere.
    std::array<std::optional<Box>, 3> vertex;
    const Window& window;
};

// x px + y py + c at the sample (px, py), pixels; what a device has instead of it is off by at most
// `error` at every sample of the outline.
struct LinearBound {
    mpq_class x, y, c, error;
};

// N = sum b_i d_i/w_i of each clip distance, and D = sum b_i/w_i last, in the outline whose
// vertices are `polygon` with positions in `boxes`. Empty if they have no bound.
std::vector<LinearBound> distance_planes(const CutSource& source,
                                         std::span<const ClippedVertex> polygon,
                                         std::span<const Box> boxes);

// z/w, likewise. Nothing if a vertex lies behind the eye or has no bounded position.
std::optional<LinearBound> depth_plane(const CutSource& source,
                                       std::span<const ClippedVertex> polygon,
                                       std::span<const Box> boxes);

}  // namespace ref
