// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device_class.hpp"
#include "vulkan_layer/layer.hpp"

namespace device_classes {

inline constexpr const char* kPortability = VK_KHR_PORTABILITY_SUBSET_EXTENSION_NAME;

// The features of a format that an image of this usage needs.
VkFormatFeatureFlags features_of(VkImageUsageFlags usage);

}  // namespace device_classes
