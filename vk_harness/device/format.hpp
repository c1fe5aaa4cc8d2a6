// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Vulkan's names of colour formats.
#pragma once

#include "cases/model/case.hpp"
#include "vk_harness/device/capabilities.hpp"

namespace vk_harness {

VkFormat to_vulkan(cases::ColorFormat format);
// The unsigned format through which single samples of a colour format are read, so that no bit can
// change on the way.
VkFormat bits_format(VkFormat format);

}  // namespace vk_harness
