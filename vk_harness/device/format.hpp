// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Colour formats of cases as Vulkan has them.
#pragma once

#include "cases/format/color_format.hpp"
#include "vk_harness/device/capabilities.hpp"

namespace vk_harness {

constexpr VkFormat to_vulkan(cases::ColorFormat format) {
    return static_cast<VkFormat>(cases::row_of(format).vulkan);
}
// The unsigned format through which single samples of a colour format are read, so that no bit can
// change on the way.
VkFormat bits_format(VkFormat format);

}  // namespace vk_harness
