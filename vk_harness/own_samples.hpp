// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the samples are of a device that does not promise the standard locations: it says so
// itself, by gl_SamplePosition, which is "the sub-pixel position of the sample being shaded"
// (Vulkan specification, "Built-In Variables", SamplePosition). What it then draws is held to that.
#pragma once

#include <span>

#include "vk_harness/batch_renderer.hpp"

namespace vk_harness {

// The locations that gl_SamplePosition told, pixel by pixel; empty if they differ among pixels or
// are not in sixteenths of a pixel.
cases::SampleLocations told_locations(std::span<const glm::vec4> positions, uint32_t samples);

// Where the samples are of a device that does not promise the standard locations: into its
// DeviceInfo, or why it could not be asked.
void ask_sample_locations(BatchRenderer& renderer);

}  // namespace vk_harness
