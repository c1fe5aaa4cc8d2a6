// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Depth bias, depth clamp, the depth test and the store of the software devices, in binary32.
#pragma once

#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

// What one polygon adds to the depth of its fragments. `dzdx`, `dzdy`: gradients of depth;
// `largest_z`: the largest |z| of the polygon.
float depth_bias(const cases::Draw& draw, cases::DepthFormat format, float dzdx, float dzdy,
                 float largest_z, const Device& device);

// Depth of a fragment as it is compared: biased, clamped, rounded to the format.
float fragment_depth(float z, float bias, const cases::Draw& draw, cases::DepthFormat format,
                     const Device& device);

// The nearest depth that the format holds.
float stored_depth(float z, cases::DepthFormat format, const Device& device);

// Whether the stored depth, or what a fault compares instead, lies in the bounds.
bool lies_within(float z, const cases::DepthBounds& bounds, const Device& device);

bool passes_depth_test(const cases::Draw& draw, float z, float stored, const Device& device);

}  // namespace software
