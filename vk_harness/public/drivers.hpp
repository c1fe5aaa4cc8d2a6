// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The drivers that the Vulkan loader would look at, by their manifests (the JSON files that name
// their libraries), and the validation layer. Nothing is loaded into this process.
#pragma once

#include "capture/renderer.hpp"

namespace vk_harness {

capture::Installed find_drivers(const capture::RendererOptions& options);

}  // namespace vk_harness
