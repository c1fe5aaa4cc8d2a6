// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is asked of a physical device, answered as the class would; and the device that is made of
// it, which may enable nothing else.
#include "shown.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <vector>

#include "features.hpp"

namespace device_classes {

namespace {

using vulkan_layer::next_of;

bool lacks(VkFormat format, VkFormatFeatureFlags features) {
    const auto found = shown_class()->lacks.find(format);
    return found != shown_class()->lacks.end() && (found->second & features) != 0;
}

// The class's value of a limit where it is narrower than the driver's, which is all that the driver
// below can do: flags and what may be at most so much get smaller, what is at least so much larger.
template <typename T>
void narrow(const char* name, T& limit) {
    const auto found = shown_class()->limits.find(name);
    if (found == shown_class()->limits.end()) {
        return;
    }
    const auto own = static_cast<T>(found->second);
    const std::string_view text = name;
    if (text == "supportedDepthResolveModes") {
        limit = static_cast<T>(static_cast<uint64_t>(limit) & static_cast<uint64_t>(own));
    } else if (text.starts_with("min") || text.starts_with("optimal") ||
               text.ends_with("Range[0]")) {
        limit = std::max(limit, own);
    } else {
        limit = std::min(limit, own);
    }
}

void show_limits(VkPhysicalDeviceProperties& properties) {
    const DeviceClass& shown = *shown_class();
    if (properties.apiVersion >= shown.api_version + VK_MAKE_API_VERSION(0, 0, 1, 0)) {
        properties.apiVersion = shown.api_version | VK_API_VERSION_PATCH(properties.apiVersion);
    }
    VkPhysicalDeviceLimits& l = properties.limits;
#define DEVICE_CLASSES_LIMIT(name) narrow(#name, l.name);
    DEVICE_CLASSES_LIMIT(maxImageDimension2D)
    DEVICE_CLASSES_LIMIT(maxImageArrayLayers)
    DEVICE_CLASSES_LIMIT(maxFramebufferWidth)
    DEVICE_CLASSES_LIMIT(maxFramebufferHeight)
    DEVICE_CLASSES_LIMIT(maxFramebufferLayers)
    DEVICE_CLASSES_LIMIT(maxColorAttachments)
    DEVICE_CLASSES_LIMIT(maxFragmentOutputAttachments)
    DEVICE_CLASSES_LIMIT(maxStorageBufferRange)
    DEVICE_CLASSES_LIMIT(maxPushConstantsSize)
    DEVICE_CLASSES_LIMIT(maxViewports)
    DEVICE_CLASSES_LIMIT(maxViewportDimensions[0])
    DEVICE_CLASSES_LIMIT(maxViewportDimensions[1])
    DEVICE_CLASSES_LIMIT(viewportBoundsRange[0])
    DEVICE_CLASSES_LIMIT(viewportBoundsRange[1])
    DEVICE_CLASSES_LIMIT(minInterpolationOffset)
    DEVICE_CLASSES_LIMIT(maxInterpolationOffset)
    DEVICE_CLASSES_LIMIT(subPixelInterpolationOffsetBits)
    DEVICE_CLASSES_LIMIT(maxClipDistances)
    DEVICE_CLASSES_LIMIT(maxCullDistances)
    DEVICE_CLASSES_LIMIT(maxCombinedClipAndCullDistances)
    DEVICE_CLASSES_LIMIT(standardSampleLocations)
    DEVICE_CLASSES_LIMIT(minStorageBufferOffsetAlignment)
    DEVICE_CLASSES_LIMIT(optimalBufferCopyOffsetAlignment)
#undef DEVICE_CLASSES_LIMIT
    for (VkSampleCountFlags* counts :
         {&l.framebufferColorSampleCounts, &l.framebufferDepthSampleCounts,
          &l.framebufferStencilSampleCounts, &l.sampledImageColorSampleCounts,
          &l.sampledImageIntegerSampleCounts, &l.sampledImageDepthSampleCounts,
          &l.sampledImageStencilSampleCounts}) {
        *counts &= shown.samples;
    }
}

VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice physical,
                                          VkPhysicalDeviceProperties* out) {
    next_of<PFN_vkGetPhysicalDeviceProperties>(physical, "vkGetPhysicalDeviceProperties")(physical,
                                                                                          out);
    show_limits(*out);
}

VKAPI_ATTR void VKAPI_CALL get_properties2(VkPhysicalDevice physical,
                                           VkPhysicalDeviceProperties2* out) {
    next_of<PFN_vkGetPhysicalDeviceProperties2>(physical, "vkGetPhysicalDeviceProperties2")(
        physical, out);
    show_limits(out->properties);
    for (auto* s = static_cast<VkBaseOutStructure*>(out->pNext); s != nullptr; s = s->pNext) {
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_STENCIL_RESOLVE_PROPERTIES) {
            auto& p = *reinterpret_cast<VkPhysicalDeviceDepthStencilResolveProperties*>(s);
            narrow("supportedDepthResolveModes", p.supportedDepthResolveModes);
            narrow("independentResolveNone", p.independentResolveNone);
        } else if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_PROPERTIES_EXT) {
            auto& p = *reinterpret_cast<VkPhysicalDeviceProvokingVertexPropertiesEXT*>(s);
            narrow("provokingVertexModePerPipeline", p.provokingVertexModePerPipeline);
        } else if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES) {
            auto& p = *reinterpret_cast<VkPhysicalDeviceMaintenance3Properties*>(s);
            narrow("maxMemoryAllocationSize", p.maxMemoryAllocationSize);
        }
    }
}

VKAPI_ATTR void VKAPI_CALL get_features2(VkPhysicalDevice physical,
                                         VkPhysicalDeviceFeatures2* out) {
    next_of<PFN_vkGetPhysicalDeviceFeatures2>(physical, "vkGetPhysicalDeviceFeatures2")(physical,
                                                                                        out);
    const DeviceClass& shown = *shown_class();
    for (void* s = out; s != nullptr; s = static_cast<VkBaseOutStructure*>(s)->pNext) {
        // The driver below is no portability subset and fills none in: it has all of it.
        const bool is_subset = static_cast<VkBaseOutStructure*>(s)->sType ==
                               VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PORTABILITY_SUBSET_FEATURES_KHR;
        each_feature(s, [&](const char* name, VkBool32& value) {
            value = (is_subset || value == VK_TRUE) && shown.has(name) ? VK_TRUE : VK_FALSE;
        });
    }
}

VKAPI_ATTR void VKAPI_CALL get_features(VkPhysicalDevice physical, VkPhysicalDeviceFeatures* out) {
    VkPhysicalDeviceFeatures2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    get_features2(physical, &all);
    *out = all.features;
}

VKAPI_ATTR void VKAPI_CALL get_format_properties(VkPhysicalDevice physical, VkFormat format,
                                                 VkFormatProperties* out) {
    next_of<PFN_vkGetPhysicalDeviceFormatProperties>(
        physical, "vkGetPhysicalDeviceFormatProperties")(physical, format, out);
    const auto found = shown_class()->lacks.find(format);
    if (found != shown_class()->lacks.end()) {
        out->optimalTilingFeatures &= ~found->second;
    }
}

VKAPI_ATTR VkResult VKAPI_CALL get_image_properties(VkPhysicalDevice physical, VkFormat format,
                                                    VkImageType type, VkImageTiling tiling,
                                                    VkImageUsageFlags usage,
                                                    VkImageCreateFlags flags,
                                                    VkImageFormatProperties* out) {
    *out = {};
    if (lacks(format, features_of(usage))) {
        return VK_ERROR_FORMAT_NOT_SUPPORTED;
    }
    const VkResult result = next_of<PFN_vkGetPhysicalDeviceImageFormatProperties>(
        physical, "vkGetPhysicalDeviceImageFormatProperties")(physical, format, type, tiling, usage,
                                                              flags, out);
    const DeviceClass& shown = *shown_class();
    out->sampleCounts &= shown.samples;
    const auto at_most = [&shown](uint32_t& value, const char* limit) {
        const auto found = shown.limits.find(limit);
        if (found != shown.limits.end()) {
            value = std::min(value, static_cast<uint32_t>(found->second));
        }
    };
    at_most(out->maxExtent.width, "maxImageDimension2D");
    at_most(out->maxExtent.height, "maxImageDimension2D");
    at_most(out->maxArrayLayers, "maxImageArrayLayers");
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL enumerate_extensions(VkPhysicalDevice physical, const char* layer,
                                                    uint32_t* count, VkExtensionProperties* out) {
    const auto& shown = shown_class()->extensions;
    return vulkan_layer::answer_extensions(
        physical, layer, count, out, [&shown](std::vector<VkExtensionProperties>& list) {
            std::erase_if(list, [&shown](const VkExtensionProperties& e) {
                return shown.count(e.extensionName) == 0;
            });
            if (shown.count(kPortability) > 0) {
                list.push_back(vulkan_layer::extension(kPortability, 1));
            }
        });
}

const vulkan_layer::OwnCommand kCommands[] = {
    VULKAN_LAYER_OWN(GetPhysicalDeviceProperties, get_properties),
    VULKAN_LAYER_OWN(GetPhysicalDeviceProperties2, get_properties2),
    VULKAN_LAYER_OWN(GetPhysicalDeviceFeatures, get_features),
    VULKAN_LAYER_OWN(GetPhysicalDeviceFeatures2, get_features2),
    VULKAN_LAYER_OWN(GetPhysicalDeviceFormatProperties, get_format_properties),
    VULKAN_LAYER_OWN(GetPhysicalDeviceImageFormatProperties, get_image_properties),
    VULKAN_LAYER_OWN(EnumerateDeviceExtensionProperties, enumerate_extensions),
};

}  // namespace

VkFormatFeatureFlags features_of(VkImageUsageFlags usage) {
    VkFormatFeatureFlags out = 0;
    for (const auto& [bit, feature] :
         {std::pair<VkImageUsageFlags, VkFormatFeatureFlags>{VK_IMAGE_USAGE_SAMPLED_BIT,
                                                             VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT},
          {VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT},
          {VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
           VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT}}) {
        out |= (usage & bit) != 0 ? feature : 0;
    }
    return out;
}

}  // namespace device_classes

namespace vulkan_layer {

bool is_ready() {
    return device_classes::shown_class() != nullptr;
}

std::span<const char* const> needed_instance_commands() {
    static const std::vector<const char*> kNames = [] {
        std::vector<const char*> names;
        for (const OwnCommand& command : device_classes::kCommands) {
            names.push_back(command.first);
        }
        return names;
    }();
    return kNames;
}

VkResult create_next_device(const Instance& /*instance*/, VkPhysicalDevice /*physical*/,
                            const VkDeviceCreateInfo& asked, const CreateNext& create) {
    using namespace device_classes;
    const DeviceClass& shown = *shown_class();
    VkDeviceCreateInfo own = asked;
    std::vector<const char*> extensions;
    for (uint32_t k = 0; k < asked.enabledExtensionCount; ++k) {
        const char* name = asked.ppEnabledExtensionNames[k];
        if (shown.extensions.count(name) == 0) {
            complain(std::string("the extension ") + name);
        }
        if (std::strcmp(name, kPortability) != 0) {
            extensions.push_back(name);
        }
    }
    own.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    own.ppEnabledExtensionNames = extensions.data();
    for (auto* link = reinterpret_cast<VkBaseOutStructure*>(&own); link->pNext != nullptr;) {
        VkBaseOutStructure* s = link->pNext;
        each_feature(s, [&shown](const char* name, VkBool32& value) {
            if (value == VK_TRUE && !shown.has(name)) {
                complain(std::string("the feature ") + name);
            }
        });
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PORTABILITY_SUBSET_FEATURES_KHR) {
            link->pNext = s->pNext;  // the driver below does not know it
        } else {
            link = s;
        }
    }
    return create(own);
}

PFN_vkVoidFunction own_instance_command(const char* name) {
    return find_command(device_classes::kCommands, name);
}

}  // namespace vulkan_layer
