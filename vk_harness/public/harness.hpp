// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Headless Vulkan 1.3: draws cases on a real driver and reads every sample back. Used only in
// child processes (workers, and the bare drawing of `bench`); nothing else in the program loads the
// Vulkan loader (through volk, at run time).
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "capture/renderer.hpp"
#include "cases/model/door.hpp"

namespace vk_harness {

using capture::DeviceInfo;
using capture::Failure;
using capture::PlaneStore;
using capture::Rendered;
using capture::Result;
using capture::Stage;
using capture::Step;
using capture::WrongLimit;
using Options = capture::RendererOptions;

// All devices of the machine; for doctor and for error texts.
Result<std::vector<DeviceInfo>> list_devices(const Options& options);

// The drivers that the loader would look at, by their manifests (the JSON files that name their
// libraries), and the validation layer. Nothing is loaded into this process.
capture::Installed find_drivers(const Options& options);

// The renderer of the device that the options choose. Loads the driver.
Result<std::unique_ptr<capture::Renderer>> make_renderer(const Options& options);

// What a door needs of a device beyond what every case needs, as features and extensions; empty:
// nothing.
std::string_view needs_of(cases::Door door);

}  // namespace vk_harness
