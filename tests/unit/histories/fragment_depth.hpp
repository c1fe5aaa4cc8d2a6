// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Depths of fragments and attachments, and what may be known of how they compare.
#pragma once

#include "device.hpp"
#include "scene.hpp"

namespace histories {

struct Depth {
    double number = 0;           // exact
    double computed = 0;         // by a device
    bool is_exact = true;        // nobody computes it: cleared or written by a shader
    const Draw* draw = nullptr;  // whose plane it is
    const Triangle* triangle = nullptr;
};

// Without an error, at x in pixels.
double depth_at(const Triangle& triangle, double x);
// As the scene's format stores it.
double stored_depth(const Scene& scene, double depth);
// What a triangle's depth is at a sample; a device's is another one for each seed, and the same
// for the same triangle again.
Depth computed_depth(const Scene& scene, const Draw& draw, const Triangle& triangle,
                     const Place& place, const Freedom& freedom);
// The relations that `a` may have to `b`.
uint8_t relations(const Scene& scene, const Freedom& freedom, const Depth& a, const Depth& b);

}  // namespace histories
