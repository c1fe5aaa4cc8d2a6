// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/capabilities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cases/model/words.hpp"
#include "vk_harness/device/features.hpp"

namespace vk_harness {

bool has_features(const Capabilities& c, VkFormat format, VkFormatFeatureFlags needed) {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(c.physical, format, &properties);
    return (properties.optimalTilingFeatures & needed) == needed;
}

ImageLimits image_limits(VkPhysicalDevice physical, VkFormat format, VkImageUsageFlags usage,
                         VkImageCreateFlags flags) {
    VkImageFormatProperties properties{};
    const VkResult result = vkGetPhysicalDeviceImageFormatProperties(
        physical, format, VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL, usage, flags, &properties);
    if (result != VK_SUCCESS) {
        return {0, 0, 0, 0, result == VK_ERROR_FORMAT_NOT_SUPPORTED ? VK_SUCCESS : result};
    }
    return {properties.maxExtent.width, properties.maxExtent.height, properties.sampleCounts,
            properties.maxArrayLayers, VK_SUCCESS};
}

std::string failed_query(VkResult result) {
    return call_failure(Stage::device, result, "vkGetPhysicalDeviceImageFormatProperties").message;
}

namespace {

// "1.3.230".
std::string version_text(uint32_t version) {
    std::string text = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version),
                                   VK_API_VERSION_MINOR(version), VK_API_VERSION_PATCH(version));
    if (const uint32_t variant = VK_API_VERSION_VARIANT(version); variant > 0) {
        text += fmt::format(" (variant {})", variant);  // not Vulkan itself
    }
    return text;
}

std::string device_type_name(VkPhysicalDeviceType type) {
    constexpr std::array<const char*, 5> kNames = {"other", "integrated-gpu", "discrete-gpu",
                                                   "virtual-gpu", "cpu"};  // numbered by Vulkan
    return static_cast<size_t>(type) < kNames.size() ? kNames.at(type) : "other";
}

void require_format(Capabilities& c, VkFormat format, std::string_view name,
                    VkFormatFeatureFlags needed, std::string_view purpose) {
    if (!has_features(c, format, needed)) {
        c.info.missing.push_back(
            fmt::format("the device cannot use format {} as {}", name, purpose));
    }
}

void query_properties(Capabilities& c, uint32_t index) {
    VkPhysicalDeviceDriverProperties driver =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceIDProperties id = Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES};
    VkPhysicalDeviceMaintenance3Properties maintenance =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    id.pNext = &maintenance;
    VkPhysicalDeviceProperties first{};
    vkGetPhysicalDeviceProperties(c.physical, &first);
    const bool has_driver =
        first.apiVersion >= VK_API_VERSION_1_2 ||
        has_device_extension(c.physical, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME);
    if (first.apiVersion >= VK_API_VERSION_1_1) {
        if (has_driver) {
            maintenance.pNext = &driver;
        }
        get_properties(c.physical, id);
    } else if (has_driver) {
        get_properties(c.physical, driver);
    }

    DeviceInfo& info = c.info;
    info.index = index;
    info.name = first.deviceName;
    info.driver_name = driver.driverName;
    info.driver_info = driver.driverInfo;
    for (const uint8_t byte : id.deviceUUID) {
        info.uuid += fmt::format("{:02x}", byte);
    }
    info.vendor_id = first.vendorID;
    info.device_id = first.deviceID;
    c.api_version = first.apiVersion;
    info.api_version = version_text(first.apiVersion);
    info.driver_version = first.driverVersion;
    info.driver_id = static_cast<uint32_t>(driver.driverID);
    info.key = fmt::format("{}:{}", info.uuid, info.driver_id);  // drivers share a device's UUID
    info.type = device_type_name(first.deviceType);
    c.limits = first.limits;
    info.subpixel_bits = c.limits.subPixelPrecisionBits;
    info.viewport_subpixel_bits = c.limits.viewportSubPixelBits;
    info.interpolation_offset_bits = c.limits.subPixelInterpolationOffsetBits;
    info.mipmap_bits = c.limits.mipmapPrecisionBits;
    info.max_color_attachments =
        std::min(c.limits.maxColorAttachments, c.limits.maxFragmentOutputAttachments);
    vkGetPhysicalDeviceMemoryProperties(c.physical, &c.memory);
    c.max_allocation = maintenance.maxMemoryAllocationSize;
    for (uint32_t heap = 0; heap < c.memory.memoryHeapCount; ++heap) {
        c.total_memory += c.memory.memoryHeaps[heap].size;
    }
}

// Sample locations in sixteenths of a pixel, one grid cell a pixel.
void query_sample_locations(Capabilities& c) {
    c.has_standard_locations = c.limits.standardSampleLocations == VK_TRUE;
    if (!has_device_extension(c.physical, VK_EXT_SAMPLE_LOCATIONS_EXTENSION_NAME)) {
        return;
    }
    VkPhysicalDeviceSampleLocationsPropertiesEXT locations =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SAMPLE_LOCATIONS_PROPERTIES_EXT};
    get_properties(c.physical, locations);
    constexpr uint32_t kSixteenthBits = 4;
    if (locations.sampleLocationSubPixelBits >= kSixteenthBits) {
        c.location_counts = locations.sampleLocationSampleCounts;
        c.location_range[0] = locations.sampleLocationCoordinateRange[0];
        c.location_range[1] = locations.sampleLocationCoordinateRange[1];
    }
}

void query_optional_features(Capabilities& c) {
    const bool has_old_divisor =
        has_device_extension(c.physical, VK_EXT_VERTEX_ATTRIBUTE_DIVISOR_EXTENSION_NAME);
    if (!has_old_divisor) {  // the name since it became one of Khronos; structures are the same
        c.doors.divisor_extension = kDivisorExtension;
    }
    query_features(c);
    if (!c.core.independent_blend) {
        c.info.missing.emplace_back("the device lacks the feature independentBlend");
    }
    c.core.dynamic_state = c.core.dynamic_state || c.api_version >= VK_API_VERSION_1_3;
    c.info.has_dynamic_rendering = c.core.dynamic_rendering;
    c.info.has_dynamic_state = c.core.dynamic_state;
    query_sample_locations(c);
    c.has_load_none = has_device_extension(c.physical, VK_EXT_LOAD_STORE_OP_NONE_EXTENSION_NAME);
    c.max_viewports = c.multi_viewport ? c.limits.maxViewports : 1;
    c.max_layers = std::min(c.limits.maxFramebufferLayers, c.limits.maxImageArrayLayers);
    query_clip_limits(c.physical, c.limits, c.clip);
    if (c.api_version >= VK_API_VERSION_1_2) {
        query_door_limits(c.physical, c.limits, c.doors);
        c.doors.dynamic_rasterization = c.doors.dynamic_rasterization && c.depth_clip_enable;
    }
    c.doors.geometry = c.info.has_primitive_id;  // the same feature
    c.doors.feedback = c.clip.feedback_keeps_order =
        c.doors.feedback && c.clip.feedback_keeps_order;
    if (c.barycentrics) {
        VkPhysicalDeviceFragmentShaderBarycentricPropertiesKHR order =
            Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADER_BARYCENTRIC_PROPERTIES_KHR};
        get_properties(c.physical, order);
        c.info.has_first_strip_order =
            order.triStripVertexOrderIndependentOfProvokingVertex == VK_TRUE;
    }
}

void query_conservative(Capabilities& c) {
    if (!has_device_extension(c.physical, VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME)) {
        return;
    }
    VkPhysicalDeviceConservativeRasterizationPropertiesEXT conservative =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CONSERVATIVE_RASTERIZATION_PROPERTIES_EXT};
    get_properties(c.physical, conservative);
    c.has_conservative = true;
    c.has_underestimation = conservative.primitiveUnderestimation == VK_TRUE;
    c.info.rasterizes_degenerates = conservative.degenerateTrianglesRasterized == VK_TRUE;
    c.info.overestimation = conservative.primitiveOverestimationSize;
    c.info.overestimation_step = conservative.extraPrimitiveOverestimationSizeGranularity;
    c.most_overestimation = conservative.maxExtraPrimitiveOverestimationSize;
}

void query_fragment_sizes(Capabilities& c) {
    FragmentSizeSupport& out = c.fragment_sizes;
    out.is_supported = out.is_supported && vkGetPhysicalDeviceFragmentShadingRatesKHR != nullptr;
    if (!out.is_supported) {
        return;
    }
    VkPhysicalDeviceFragmentShadingRatePropertiesKHR limits =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADING_RATE_PROPERTIES_KHR};
    get_properties(c.physical, limits);
    out.with_sample_mask = limits.fragmentShadingRateWithSampleMask == VK_TRUE;
    out.with_shader_mask = limits.fragmentShadingRateWithShaderSampleMask == VK_TRUE;
    uint32_t count = 0;
    if (vkGetPhysicalDeviceFragmentShadingRatesKHR(c.physical, &count, nullptr) != VK_SUCCESS) {
        count = 0;
    }
    VkPhysicalDeviceFragmentShadingRateKHR blank =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADING_RATE_KHR};
    std::vector<VkPhysicalDeviceFragmentShadingRateKHR> rates(count, blank);
    if (vkGetPhysicalDeviceFragmentShadingRatesKHR(c.physical, &count, rates.data()) < 0) {
        count = 0;
    }
    rates.resize(std::min(rates.size(), size_t{count}));
    for (const VkPhysicalDeviceFragmentShadingRateKHR& rate : rates) {
        out.sizes.push_back({rate.fragmentSize.width, rate.fragmentSize.height, rate.sampleCounts});
    }
}

void query_support(Capabilities& c) {
    std::vector<std::string>& missing = c.info.missing;
    c.core = query_core_support(c.physical, c.api_version);
    missing.insert(missing.end(), c.core.missing.begin(), c.core.missing.end());
    if (c.core.missing.empty()) {
        query_optional_features(c);
        query_conservative(c);
        query_fragment_sizes(c);
    }

    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(c.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(c.physical, &count, families.data());
    const VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const auto family = std::ranges::find_if(families, [needed](const auto& f) {
        return (f.queueFlags & needed) == needed && f.queueCount > 0;
    });
    if (family == families.end()) {
        missing.emplace_back("the device has no queue for both graphics and compute");
    } else {
        c.queue_family = static_cast<uint32_t>(family - families.begin());
    }
}

// With which sample counts narrow attachments can be drawn to and read back in targets as large as
// those of kColorFormat.
VkSampleCountFlags narrow_sample_counts(const Capabilities& c, const ImageLimits& wide) {
    constexpr VkFormatFeatureFlags kNeeded =
        VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_TRANSFER_SRC_BIT;
    const ImageLimits one =
        image_limits(c.physical, kTwoNumbers,
                     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, 0);
    if (!has_features(c, kTwoNumbers, kNeeded) || one.width < wide.width ||
        one.height < wide.height) {
        return 0;
    }
    const ImageLimits read = image_limits(
        c.physical, kTwoNumbers, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
        VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT);
    return VK_SAMPLE_COUNT_1_BIT | read.samples;
}

void query_targets(Capabilities& c) {
    require_format(c, kColorFormat, "R32G32B32A32_SFLOAT",
                   VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_TRANSFER_SRC_BIT,
                   "a colour attachment that is read back");
    c.blends_wide = has_features(c, kColorFormat, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT);
    c.blends_narrow = has_features(c, kTwoNumbers, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT);
    c.info.hit_counting = c.blends_wide ? "binary32" : "binary16";
    if (!c.blends_wide || !c.blends_narrow) {
        constexpr VkFormatFeatureFlags kCounts = VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT |
                                                 VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT |
                                                 VK_FORMAT_FEATURE_TRANSFER_SRC_BIT;
        constexpr const char* kPurpose = "a blended colour attachment, which counts hits";
        require_format(c, kColorHalves, "R16G16B16A16_SFLOAT", kCounts, kPurpose);
        require_format(c, kTwoHalves, "R16G16_SFLOAT", kCounts, kPurpose);
    }
    require_format(
        c, kDepthFormat, "D32_SFLOAT",
        VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_TRANSFER_SRC_BIT,
        "a depth attachment that is read back");
    if (c.info.max_color_attachments < kFixedAttachments) {
        c.info.missing.push_back(fmt::format("{} colour attachments are needed, the device has {}",
                                             kFixedAttachments, c.info.max_color_attachments));
    }

    const ImageLimits color =
        image_limits(c.physical, kColorFormat,
                     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, 0);
    const ImageLimits depth = image_limits(
        c.physical, kDepthFormat,
        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, 0);
    for (const ImageLimits& limits : {color, depth}) {
        if (limits.failed != VK_SUCCESS) {
            c.info.missing.push_back(failed_query(limits.failed));
        }
    }
    const VkPhysicalDeviceLimits& l = c.limits;
    c.max_width = std::min({l.maxImageDimension2D, l.maxFramebufferWidth, color.width, depth.width,
                            l.maxViewportDimensions[0]});
    c.max_height = std::min({l.maxImageDimension2D, l.maxFramebufferHeight, color.height,
                             depth.height, l.maxViewportDimensions[1]});
    c.info.max_target_size = std::min(c.max_width, c.max_height);

    const ImageLimits color_samples = image_limits(
        c.physical, kColorFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
        VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT);
    c.narrow_sample_counts = narrow_sample_counts(c, color);
    const ImageLimits depth_samples =
        image_limits(c.physical, kDepthFormat,
                     VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, 0);
    c.sample_counts = VK_SAMPLE_COUNT_1_BIT |
                      (color_samples.samples & depth_samples.samples &
                       l.framebufferColorSampleCounts & l.framebufferDepthSampleCounts &
                       l.sampledImageIntegerSampleCounts & l.sampledImageDepthSampleCounts);
    c.location_counts &= c.sample_counts;
}

void query_depth_formats(Capabilities& c) {
    const VkPhysicalDeviceLimits& l = c.limits;
    for (size_t k = 0; k < c.depth_sample_counts.size(); ++k) {
        const VkFormat format = depth_format(static_cast<cases::DepthFormat>(k));
        const VkFormatFeatureFlags needed =
            VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_TRANSFER_SRC_BIT;
        c.depth_sample_counts.at(k) = 0;
        if (!has_features(c, format, needed)) {
            continue;
        }
        const ImageLimits read = image_limits(
            c.physical, format,
            VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, 0);
        c.depth_sample_counts.at(k) =
            VK_SAMPLE_COUNT_1_BIT |
            (read.samples & l.framebufferDepthSampleCounts & l.sampledImageDepthSampleCounts);
    }
    if (!has_features(c, depth_stencil_format(c.beside_stencil),
                      VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)) {
        c.beside_stencil = cases::DepthFormat::d24_unorm;
    }
    c.info.depth_beside_stencil = cases::word_of(c.beside_stencil);
}

}  // namespace

bool FragmentSizeSupport::has(const std::array<uint32_t, 2>& size,
                              VkSampleCountFlags samples) const {
    return (size[0] == 1 && size[1] == 1) || std::ranges::any_of(sizes, [&](const Size& own) {
               return own.width == size[0] && own.height == size[1] && (own.samples & samples) != 0;
           });
}

Capabilities query_capabilities(VkPhysicalDevice physical, uint32_t index) {
    Capabilities c;
    c.physical = physical;
    query_properties(c, index);
    query_support(c);
    query_targets(c);
    query_depth_formats(c);
    return c;
}

}  // namespace vk_harness
