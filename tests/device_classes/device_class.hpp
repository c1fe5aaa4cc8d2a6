// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a device of the class shows: read from the file that EDGECASE_DEVICE_CLASS names, which
// device_classes.py writes from a TOML file of classes/.
#pragma once

#ifndef VK_ENABLE_BETA_EXTENSIONS
#define VK_ENABLE_BETA_EXTENSIONS  // VK_KHR_portability_subset
#endif
#include <vulkan/vulkan.h>

#include <map>
#include <set>
#include <string>

namespace device_classes {

struct DeviceClass {
    std::string name;
    uint32_t api_version = VK_API_VERSION_1_3;
    std::set<std::string> features, extensions;      // that it has; whatever is not here it lacks
    std::map<std::string, double> limits;            // those that differ from the driver's
    std::map<VkFormat, VkFormatFeatureFlags> lacks;  // of optimally tiled images
    VkSampleCountFlags samples = ~0U;                // of every image
    std::set<std::string> traps;  // features that are shown and must not be used all the same
    bool has(const std::string& feature) const { return features.count(feature) > 0; }
    bool may_use(const std::string& feature) const {
        return has(feature) && traps.count(feature) == 0;
    }
};

// Nothing if there is no such file, which is told on standard error.
const DeviceClass* shown_class();

// The program used what the class does not advertise: told on standard error, and the process ends.
[[noreturn]] void complain(const std::string& used);

}  // namespace device_classes
