// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a physical device offers, and the formats that the harness draws to.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/sample.hpp"
#include "vk_harness/device/clip_support.hpp"
#include "vk_harness/device/core_support.hpp"
#include "vk_harness/device/depth_bias_control.hpp"
#include "vk_harness/device/door_support.hpp"
#include "vk_harness/device/instance.hpp"

namespace vk_harness {

// VkPhysicalDevicePortabilitySubsetFeaturesKHR, as far as the harness needs it; all there on a
// device that is no such subset.
struct PortabilitySupport {
    bool is_subset = false;
    bool triangle_fans = true;
    bool interpolation_functions = true;  // shaderSampleRateInterpolationFunctions
    bool view_reinterpretation = true;    // imageViewFormatReinterpretation
    bool multisampled_arrays = true;      // multisampleArrayImage
    bool constant_alpha_factors = true;   // constantAlphaColorBlendFactors
};

// The instructions besides OpKill by which a fragment shader may discard.
struct DiscardSupport {
    bool demote = false;     // shaderDemoteToHelperInvocation
    bool terminate = false;  // shaderTerminateInvocation
};

// VK_KHR_fragment_shading_rate, with pipelineFragmentShadingRate.
struct FragmentSizeSupport {
    bool is_supported = false;
    // fragmentShadingRateWithSampleMask and fragmentShadingRateWithShaderSampleMask: without them
    // fragments have one pixel where the one or the other masks.
    bool with_sample_mask = false, with_shader_mask = false;
    // What the device has, each with its sample counts; nothing stands for one pixel.
    struct Size {
        uint32_t width = 1, height = 1;
        VkSampleCountFlags samples = 0;
    };
    std::vector<Size> sizes;
    bool has(const std::array<uint32_t, 2>& size, VkSampleCountFlags samples) const;
};

// As far as the harness needs it.
struct Capabilities {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    DeviceInfo info;
    uint32_t api_version = 0;  // VkPhysicalDeviceProperties::apiVersion
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
    uint32_t queue_family = 0;
    uint32_t max_width = 0, max_height = 0;             // of a target
    VkDeviceSize max_allocation = 0, total_memory = 0;  // bytes
    VkSampleCountFlags sample_counts = 0;  // all attachments, drawn and read sample by sample
    // VK_EXT_sample_locations; none of its counts without the extension.
    VkSampleCountFlags location_counts = 0;
    float location_range[2] = {0, 0};  // pixels
    // Sample counts with which kTwoNumbers, drawn to and read back, does what kColorFormat does.
    VkSampleCountFlags narrow_sample_counts = 0;
    bool blends_wide = true;                             // kColorFormat can be blended: counts hits
    bool blends_narrow = true;                           // kTwoNumbers, too
    bool has_standard_locations = false;                 // standardSampleLocations
    std::vector<cases::SampleLocations> told_locations;  // without them: by gl_SamplePosition
    bool has_load_none = false;                          // VK_EXT_load_store_op_none
    bool has_sample_shading = false;                     // sampleRateShading
    bool has_conservative = false;                       // VK_EXT_conservative_rasterization, with
    bool has_underestimation = false;                    // primitiveUnderestimation,
    float most_overestimation = 0;  // maxExtraPrimitiveOverestimationSize, pixels
    // By cases::DepthFormat: sample counts that can be drawn and read back; 0 if the device has not
    // got the format.
    std::array<VkSampleCountFlags, 3> depth_sample_counts{VK_SAMPLE_COUNT_1_BIT};
    // What a stencil without depth lies beside: every device draws to D32_SFLOAT_S8_UINT or to
    // D24_UNORM_S8_UINT ("Required Format Support").
    cases::DepthFormat beside_stencil = cases::DepthFormat::d32_float;
    bool depth_clamp = false, depth_bias_clamp = false, depth_clip_enable = false;
    bool list_restart = false;  // primitiveTopologyListRestart
    bool depth_bounds = false;
    bool logic_op = false;
    bool alpha_to_one = false;
    bool dual_source = false;          // dualSrcBlend
    bool precise_queries = false;      // occlusionQueryPrecise
    bool pipeline_statistics = false;  // pipelineStatisticsQuery
    DepthBiasSupport depth_bias;
    PortabilitySupport portability;
    CoreSupport core;
    bool multi_viewport = false;
    uint32_t max_viewports = 1;  // 1 without multiViewport
    uint32_t max_layers = 1;     // of a target
    // shaderOutputLayer and shaderOutputViewportIndex: gl_Layer and gl_ViewportIndex in a vertex
    // shader. Without them a geometry shader names both (DoorSupport::geometry).
    bool layer_output = false, viewport_output = false;
    ClipSupport clip;
    DiscardSupport discard;
    DoorSupport doors;
    bool barycentrics = false;  // VK_KHR_fragment_shader_barycentric
    FragmentSizeSupport fragment_sizes;
};

// Whether optimally tiled images of the format have all these features.
bool has_features(const Capabilities& c, VkFormat format, VkFormatFeatureFlags needed);

// Largest size, sample counts and layers of an optimally tiled 2D image; nothing if the device has
// no such image, and why if the question itself failed, which says nothing about images.
struct ImageLimits {
    uint32_t width = 0, height = 0;
    VkSampleCountFlags samples = 0;
    uint32_t layers = 0;
    VkResult failed = VK_SUCCESS;
};
ImageLimits image_limits(VkPhysicalDevice physical, VkFormat format, VkImageUsageFlags usage,
                         VkImageCreateFlags flags);
// The sentence of ImageLimits::failed.
std::string failed_query(VkResult result);

Capabilities query_capabilities(VkPhysicalDevice physical, uint32_t index);

// Formats of the attachments (capture/capture.hpp).
inline constexpr VkFormat kColorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkFormat depth_format(cases::DepthFormat format) {
    return static_cast<VkFormat>(cases::row_of(format).vulkan);
}
constexpr VkFormat depth_stencil_format(cases::DepthFormat format) {
    return static_cast<VkFormat>(cases::row_of(format).with_stencil);
}
// The format of attachments that hold two numbers a sample, if the device has it.
inline constexpr VkFormat kTwoNumbers = VK_FORMAT_R32G32_SFLOAT;
// What counts hits instead where these two cannot be blended; blending of 16-bit floats is required
// of every device ("Required Format Support").
inline constexpr VkFormat kColorHalves = VK_FORMAT_R16G16B16A16_SFLOAT;
inline constexpr VkFormat kTwoHalves = VK_FORMAT_R16G16_SFLOAT;
// Colour attachments before the attributes, at least: writer_and_hits, frag_coord.
inline constexpr uint32_t kFixedAttachments = 2;

}  // namespace vk_harness
