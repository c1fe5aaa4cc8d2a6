// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/api.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <vector>

namespace vk_harness {

std::string result_name(VkResult result) {
    static const std::map<VkResult, const char*> kNames = {
        {VK_SUCCESS, "VK_SUCCESS"},
        {VK_NOT_READY, "VK_NOT_READY"},
        {VK_TIMEOUT, "VK_TIMEOUT"},
        {VK_INCOMPLETE, "VK_INCOMPLETE"},
        {VK_ERROR_OUT_OF_HOST_MEMORY, "VK_ERROR_OUT_OF_HOST_MEMORY"},
        {VK_ERROR_OUT_OF_DEVICE_MEMORY, "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
        {VK_ERROR_INITIALIZATION_FAILED, "VK_ERROR_INITIALIZATION_FAILED"},
        {VK_ERROR_DEVICE_LOST, "VK_ERROR_DEVICE_LOST"},
        {VK_ERROR_MEMORY_MAP_FAILED, "VK_ERROR_MEMORY_MAP_FAILED"},
        {VK_ERROR_LAYER_NOT_PRESENT, "VK_ERROR_LAYER_NOT_PRESENT"},
        {VK_ERROR_EXTENSION_NOT_PRESENT, "VK_ERROR_EXTENSION_NOT_PRESENT"},
        {VK_ERROR_FEATURE_NOT_PRESENT, "VK_ERROR_FEATURE_NOT_PRESENT"},
        {VK_ERROR_INCOMPATIBLE_DRIVER, "VK_ERROR_INCOMPATIBLE_DRIVER"},
        {VK_ERROR_TOO_MANY_OBJECTS, "VK_ERROR_TOO_MANY_OBJECTS"},
        {VK_ERROR_FORMAT_NOT_SUPPORTED, "VK_ERROR_FORMAT_NOT_SUPPORTED"},
        {VK_ERROR_FRAGMENTED_POOL, "VK_ERROR_FRAGMENTED_POOL"},
        {VK_ERROR_OUT_OF_POOL_MEMORY, "VK_ERROR_OUT_OF_POOL_MEMORY"},
        {VK_ERROR_FRAGMENTATION, "VK_ERROR_FRAGMENTATION"},
        {VK_ERROR_UNKNOWN, "VK_ERROR_UNKNOWN"}};
    const auto found = kNames.find(result);
    return found != kNames.end() ? found->second : code_of(result);
}

std::string code_of(VkResult result) {
    return result == VK_SUCCESS ? "" : "VkResult " + std::to_string(static_cast<int>(result));
}

Failure call_failure(Stage stage, VkResult result, std::string_view call) {
    return {stage,
            std::string(call) + " failed with " + result_name(result),
            {},
            code_of(result),
            result == VK_ERROR_DEVICE_LOST};
}

void check(Stage stage, VkResult result, std::string_view call) {
    if (result != VK_SUCCESS) {
        fail(call_failure(stage, result, call));
    }
}

bool has_device_extension(VkPhysicalDevice physical, const char* name) {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
    return std::ranges::any_of(extensions, [name](const auto& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

void load_vulkan(const Options& options) {
    if (!options.icd.empty()) {
        // The first name is read by loaders since 1.3.207, the second by older ones.
        setenv("VK_DRIVER_FILES", options.icd.c_str(), 1);
        setenv("VK_ICD_FILENAMES", options.icd.c_str(), 1);
    }
    const VkResult result = volkInitialize();
    if (result != VK_SUCCESS) {
        fail(Stage::loader,
             "the Vulkan loader libvulkan.so.1 was not found; install it (Debian: libvulkan1)",
             result);
    }
}

}  // namespace vk_harness
