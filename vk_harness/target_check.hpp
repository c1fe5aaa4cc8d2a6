// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What of a case's target a device cannot have.
#pragma once

#include "vk_harness/device/capabilities.hpp"
#include "vk_harness/device/rejection.hpp"

namespace vk_harness {

// Whether a geometry shader can hand on the case's triangles, and name their layers and viewports.
bool can_have_geometry(const Capabilities& c, const cases::Case& test);

// Throws why the device cannot have the target's size, samples, layers and depth, if it cannot.
void check_target(const Capabilities& c, const cases::Case& test);
// The same of its colour targets, and of what the draws do to them.
void check_color(const Capabilities& c, const cases::Case& test);

}  // namespace vk_harness
