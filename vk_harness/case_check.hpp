// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is asked of a case before it may reach a driver: a case that the device cannot draw is
// unsupported, never drawn wrongly, and no index may read beyond the vertices.
#pragma once

#include <optional>

#include "vk_harness/device/device.hpp"
#include "vk_harness/device/rejection.hpp"

namespace vk_harness {

// Why this case must not be drawn on that device; nothing if it may be.
std::optional<Rejection> check_case(const Capabilities& capabilities, const cases::Case& c);

}  // namespace vk_harness
