// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/door_support.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/format/color_format.hpp"
#include "cases/format/vertex_format.hpp"

namespace vk_harness {

namespace {

constexpr uint32_t kDrawsInOne = 3;  // of a command with several draws, feed.cpp

bool has_linear_attachments(VkPhysicalDevice physical) {
    std::vector<uint32_t> formats = {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32G32_SFLOAT};
    for (const cases::ColorFormatRow& row : cases::kColorFormats) {
        formats.push_back(row.vulkan);
    }
    return std::any_of(formats.begin(), formats.end(), [physical](uint32_t format) {
        VkFormatProperties offered{};
        vkGetPhysicalDeviceFormatProperties(physical, static_cast<VkFormat>(format), &offered);
        return (offered.linearTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) != 0;
    });
}

// The name since the extension became one of Khronos; structures are the same.
constexpr const char* kKhronosDivisor = "VK_KHR_vertex_attribute_divisor";

uint32_t offered_vertex_formats(VkPhysicalDevice physical) {
    uint32_t formats = 0;
    for (const cases::VertexFormatRow& row : cases::kVertexFormats) {
        VkFormatProperties offered{};
        vkGetPhysicalDeviceFormatProperties(physical, static_cast<VkFormat>(row.vulkan), &offered);
        if ((offered.bufferFeatures & VK_FORMAT_FEATURE_VERTEX_BUFFER_BIT) != 0) {
            formats |= cases::bit_of(row.format);
        }
    }
    return formats;
}

bool can_import_vertices(VkPhysicalDevice physical) {
    VkPhysicalDeviceExternalBufferInfo info =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_BUFFER_INFO};
    info.usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
    info.handleType = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
    VkExternalBufferProperties offered = Typed{VK_STRUCTURE_TYPE_EXTERNAL_BUFFER_PROPERTIES};
    vkGetPhysicalDeviceExternalBufferProperties(physical, &info, &offered);
    const VkExternalMemoryFeatureFlags features =
        offered.externalMemoryProperties.externalMemoryFeatures;
    return (features & VK_EXTERNAL_MEMORY_FEATURE_IMPORTABLE_BIT) != 0 &&
           (features & VK_EXTERNAL_MEMORY_FEATURE_DEDICATED_ONLY_BIT) == 0;
}

}  // namespace

DoorSupport query_door_support(VkPhysicalDevice physical, HasExtension has_extension) {
    DoorSupport out;
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_2) {
        return out;
    }
    DoorFeatures optional;
    VkPhysicalDeviceVulkan12Features features12 =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceFeatures2 features = Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    features.pNext = &features12;
    VkPhysicalDeviceMultiDrawPropertiesEXT multi_draw =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTI_DRAW_PROPERTIES_EXT};
    if (has_extension(physical, VK_EXT_INDEX_TYPE_UINT8_EXTENSION_NAME)) {
        chain(features, optional.index_8);
    }
    if (has_extension(physical, VK_EXT_MULTI_DRAW_EXTENSION_NAME)) {
        chain(features, optional.multi_draw);
        get_properties(physical, multi_draw);
    }
    const bool has_library =
        has_extension(physical, VK_KHR_PIPELINE_LIBRARY_EXTENSION_NAME) &&
        has_extension(physical, VK_EXT_GRAPHICS_PIPELINE_LIBRARY_EXTENSION_NAME);
    if (has_library) {
        chain(features, optional.library);
    }
    chain(features, optional.multiview);
    if (has_extension(physical, VK_EXT_TRANSFORM_FEEDBACK_EXTENSION_NAME)) {
        chain(features, optional.feedback);
    }
    const bool has_objects = properties.apiVersion >= VK_API_VERSION_1_3 &&
                             has_extension(physical, kShaderObjectExtension);
    if (has_objects) {
        chain(features, optional.shader_objects);
    }
    // Before 1.3 the first of these structures is chained for what every case needs.
    const bool has_dynamic_outputs =
        properties.apiVersion >= VK_API_VERSION_1_3 &&
        has_extension(physical, VK_EXT_EXTENDED_DYNAMIC_STATE_2_EXTENSION_NAME) &&
        has_extension(physical, VK_EXT_EXTENDED_DYNAMIC_STATE_3_EXTENSION_NAME);
    if (has_dynamic_outputs) {
        chain(features, optional.dynamic_state2);
        chain(features, optional.dynamic_state3);
    }
    if (has_extension(physical, VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME)) {
        VkPhysicalDeviceExternalMemoryHostPropertiesEXT host =
            Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_MEMORY_HOST_PROPERTIES_EXT};
        get_properties(physical, host);
        out.host_import = can_import_vertices(physical);
        out.host_alignment = host.minImportedHostPointerAlignment;
    }
    for (const char* name : {VK_EXT_VERTEX_ATTRIBUTE_DIVISOR_EXTENSION_NAME, kKhronosDivisor}) {
        if (out.divisor_extension == nullptr && has_extension(physical, name)) {
            out.divisor_extension = name;
            chain(features, optional.divisor);
        }
    }
    const bool has_mesh = has_extension(physical, VK_EXT_MESH_SHADER_EXTENSION_NAME);
    if (has_mesh) {
        VkPhysicalDeviceMeshShaderPropertiesEXT mesh =
            Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_PROPERTIES_EXT};
        get_properties(physical, mesh);
        out.mesh_layers = mesh.maxMeshOutputLayers;
        chain(features, optional.mesh);
    }
    out.vertex_formats = offered_vertex_formats(physical);
    out.linear = has_linear_attachments(physical);
    vkGetPhysicalDeviceFeatures2(physical, &features);
    const VkPhysicalDeviceExtendedDynamicState3FeaturesEXT& three = optional.dynamic_state3;
    out.dynamic_outputs = optional.dynamic_state2.extendedDynamicState2LogicOp == VK_TRUE &&
                          three.extendedDynamicState3ColorBlendEnable == VK_TRUE &&
                          three.extendedDynamicState3ColorBlendEquation == VK_TRUE &&
                          three.extendedDynamicState3ColorWriteMask == VK_TRUE &&
                          three.extendedDynamicState3LogicOpEnable == VK_TRUE &&
                          three.extendedDynamicState3AlphaToOneEnable == VK_TRUE &&
                          three.extendedDynamicState3AlphaToCoverageEnable == VK_TRUE &&
                          three.extendedDynamicState3SampleMask == VK_TRUE;
    // maxVertexAttribDivisor is at least 65535.
    out.divisor = optional.divisor.vertexAttributeInstanceRateDivisor == VK_TRUE;
    // Without the first feature a divisor is 1 (VUID-VkVertexInputBindingDivisorDescription
    // -vertexAttributeInstanceRateDivisor-02229), so the second one alone offers nothing.
    out.divisor_zero =
        out.divisor && optional.divisor.vertexAttributeInstanceRateZeroDivisor == VK_TRUE;
    out.mesh = optional.mesh.meshShader == VK_TRUE;
    out.fragment_stores = features.features.fragmentStoresAndAtomics == VK_TRUE;
    out.feedback = optional.feedback.transformFeedback == VK_TRUE;
    out.shader_objects = optional.shader_objects.shader_object == VK_TRUE;
    out.library = has_library && optional.library.graphicsPipelineLibrary == VK_TRUE;
    // maxMultiviewViewCount is at least 6.
    out.multiview = optional.multiview.multiview == VK_TRUE;
    out.tessellation = features.features.tessellationShader == VK_TRUE;
    out.index_8 = optional.index_8.indexTypeUint8 == VK_TRUE;
    out.indirect_count = features12.drawIndirectCount == VK_TRUE;
    out.multi_indirect = features.features.multiDrawIndirect == VK_TRUE &&
                         properties.limits.maxDrawIndirectCount >= kDrawsInOne;
    out.multi_draw =
        optional.multi_draw.multiDraw == VK_TRUE && multi_draw.maxMultiDrawCount >= kDrawsInOne;
    return out;
}

void enable_door_features(const DoorSupport& support, VkPhysicalDeviceFeatures2& features,
                          VkPhysicalDeviceVulkan12Features& features12,
                          std::vector<const char*>& extensions, DoorFeatures& enabled) {
    features.features.multiDrawIndirect = support.multi_indirect ? VK_TRUE : VK_FALSE;
    features12.drawIndirectCount = support.indirect_count ? VK_TRUE : VK_FALSE;
    if (support.index_8) {
        enabled.index_8.indexTypeUint8 = VK_TRUE;
        chain(features, enabled.index_8);
        extensions.push_back(VK_EXT_INDEX_TYPE_UINT8_EXTENSION_NAME);
    }
    if (support.dynamic_outputs) {
        enabled.dynamic_state2.extendedDynamicState2LogicOp = VK_TRUE;
        chain(features, enabled.dynamic_state2);
        extensions.push_back(VK_EXT_EXTENDED_DYNAMIC_STATE_2_EXTENSION_NAME);
        VkPhysicalDeviceExtendedDynamicState3FeaturesEXT& three = enabled.dynamic_state3;
        three.extendedDynamicState3ColorBlendEnable = VK_TRUE;
        three.extendedDynamicState3ColorBlendEquation = VK_TRUE;
        three.extendedDynamicState3ColorWriteMask = VK_TRUE;
        three.extendedDynamicState3LogicOpEnable = VK_TRUE;
        three.extendedDynamicState3AlphaToOneEnable = VK_TRUE;
        three.extendedDynamicState3AlphaToCoverageEnable = VK_TRUE;
        three.extendedDynamicState3SampleMask = VK_TRUE;
        chain(features, three);
        extensions.push_back(VK_EXT_EXTENDED_DYNAMIC_STATE_3_EXTENSION_NAME);
    }
    if (support.library) {
        enabled.library.graphicsPipelineLibrary = VK_TRUE;
        chain(features, enabled.library);
        extensions.push_back(VK_KHR_PIPELINE_LIBRARY_EXTENSION_NAME);
        extensions.push_back(VK_EXT_GRAPHICS_PIPELINE_LIBRARY_EXTENSION_NAME);
    }
    if (support.multiview) {
        enabled.multiview.multiview = VK_TRUE;
        chain(features, enabled.multiview);
    }
    features.features.tessellationShader = support.tessellation ? VK_TRUE : VK_FALSE;
    if (support.feedback) {
        enabled.feedback.transformFeedback = VK_TRUE;
        chain(features, enabled.feedback);
        extensions.push_back(VK_EXT_TRANSFORM_FEEDBACK_EXTENSION_NAME);
    }
    features.features.fragmentStoresAndAtomics = support.fragment_stores ? VK_TRUE : VK_FALSE;
    if (support.divisor || support.divisor_zero) {
        enabled.divisor.vertexAttributeInstanceRateDivisor = support.divisor ? VK_TRUE : VK_FALSE;
        enabled.divisor.vertexAttributeInstanceRateZeroDivisor =
            support.divisor_zero ? VK_TRUE : VK_FALSE;
        chain(features, enabled.divisor);
        extensions.push_back(support.divisor_extension);
    }
    if (support.mesh) {
        enabled.mesh.meshShader = VK_TRUE;
        chain(features, enabled.mesh);
        extensions.push_back(VK_EXT_MESH_SHADER_EXTENSION_NAME);
    }
    if (support.shader_objects) {
        enabled.shader_objects.shader_object = VK_TRUE;
        chain(features, enabled.shader_objects);
        extensions.push_back(kShaderObjectExtension);
    }
    if (support.host_import) {
        extensions.push_back(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
    }
    if (support.multi_draw) {
        enabled.multi_draw.multiDraw = VK_TRUE;
        chain(features, enabled.multi_draw);
        extensions.push_back(VK_EXT_MULTI_DRAW_EXTENSION_NAME);
    }
}

std::optional<std::string> missing_mesh_layers(const DoorSupport& support, const cases::Case& c) {
    if (c.variation.door != cases::Door::mesh_shader) {
        return std::nullopt;
    }
    for (const cases::Draw& draw : c.draws) {
        if (draw.layer > 0 && draw.layer >= support.mesh_layers) {
            return fmt::format(
                "a mesh shader of the device names {} layers (maxMeshOutputLayers), "
                "and a draw goes to number {}",
                support.mesh_layers, draw.layer);
        }
    }
    return std::nullopt;
}

namespace {

using cases::Door;

struct Need {
    Door door;
    bool DoorSupport::*support;
    std::string_view words;  // all that the door needs
};
constexpr Need kNeeds[] = {
    {Door::index_8, &DoorSupport::index_8, "indexTypeUint8 (VK_EXT_index_type_uint8)"},
    {Door::index_8_largest, &DoorSupport::index_8, "indexTypeUint8 (VK_EXT_index_type_uint8)"},
    {Door::memory_imported, &DoorSupport::host_import,
     "the import of memory of the host for vertices and indices (VK_EXT_external_memory_host)"},
    {Door::instance_divisor, &DoorSupport::divisor,
     "vertexAttributeInstanceRateDivisor (VK_EXT_vertex_attribute_divisor)"},
    {Door::instance_divisor_zero, &DoorSupport::divisor_zero,
     "vertexAttributeInstanceRateDivisor and vertexAttributeInstanceRateZeroDivisor "
     "(VK_EXT_vertex_attribute_divisor)"},
    {Door::indirect_count, &DoorSupport::indirect_count, "drawIndirectCount"},
    {Door::multi_indirect, &DoorSupport::multi_indirect, "multiDrawIndirect"},
    {Door::indirect_after_count, &DoorSupport::indirect_count,
     "drawIndirectCount and multiDrawIndirect"},
    {Door::indirect_after_count, &DoorSupport::multi_indirect,
     "drawIndirectCount and multiDrawIndirect"},
    {Door::multi_draw, &DoorSupport::multi_draw, "multiDraw (VK_EXT_multi_draw)"},
    {Door::multi_draw_empty, &DoorSupport::multi_draw, "multiDraw (VK_EXT_multi_draw)"},
    {Door::state_output, &DoorSupport::dynamic_outputs,
     "the states of blending, logical operations, sample masks and alpha to coverage and to one of "
     "VK_EXT_extended_dynamic_state3, and extendedDynamicState2LogicOp"},
    {Door::pipeline_library, &DoorSupport::library,
     "graphicsPipelineLibrary (VK_EXT_graphics_pipeline_library)"},
    {Door::shader_objects, &DoorSupport::shader_objects, "shaderObject (VK_EXT_shader_object)"},
    {Door::input_attachment, &DoorSupport::fragment_stores, "fragmentStoresAndAtomics"},
    {Door::image_linear, &DoorSupport::linear,
     "images of linear tiling for any of its attachments"},
    {Door::multiview, &DoorSupport::multiview, "multiview"},
    {Door::geometry, &DoorSupport::geometry, "geometryShader"},
    {Door::tessellation, &DoorSupport::tessellation, "tessellationShader"},
    {Door::transform_feedback, &DoorSupport::feedback,
     "transformFeedback (VK_EXT_transform_feedback)"},
    {Door::mesh_shader, &DoorSupport::mesh, "meshShader (VK_EXT_mesh_shader)"},
};

}  // namespace

std::string_view needs_of(Door door) {
    const auto* const need = std::ranges::find(kNeeds, door, &Need::door);
    return need == std::end(kNeeds) ? std::string_view() : need->words;
}

std::optional<std::string> missing_door_support(const DoorSupport& support, Door door) {
    const bool is_missing = std::ranges::any_of(
        kNeeds, [&](const Need& need) { return need.door == door && !(support.*need.support); });
    return is_missing ? std::optional(fmt::format("the device lacks {}", needs_of(door)))
                      : std::nullopt;
}

}  // namespace vk_harness
