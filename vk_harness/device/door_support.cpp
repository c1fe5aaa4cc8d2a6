// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/door_support.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/format/color_format.hpp"
#include "cases/format/vertex_format.hpp"

namespace vk_harness {

using cases::Door;

namespace {

// VkPhysicalDeviceVertexAttributeDivisorPropertiesKHR, which is newer than Debian 12's headers.
struct DivisorProperties {
    VkStructureType type = static_cast<VkStructureType>(1000525000);
    void* pNext = nullptr;
    uint32_t most = 0;
    VkBool32 first_instance = VK_FALSE;
};

constexpr uint32_t kDrawsInOne = 3;  // of a command with several draws, feed.cpp

bool has_linear_attachments(VkPhysicalDevice physical) {
    std::vector<uint32_t> formats = {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32G32_SFLOAT};
    for (const cases::ColorFormatRow& row : cases::kColorFormats) {
        formats.push_back(row.vulkan);
    }
    return std::ranges::any_of(formats, [physical](uint32_t format) {
        VkFormatProperties offered{};
        vkGetPhysicalDeviceFormatProperties(physical, static_cast<VkFormat>(format), &offered);
        return (offered.linearTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) != 0;
    });
}

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

void query_door_limits(VkPhysicalDevice physical, const VkPhysicalDeviceLimits& limits,
                       DoorSupport& doors) {
    doors.multi_indirect = doors.multi_indirect && limits.maxDrawIndirectCount >= kDrawsInOne;
    if (doors.multi_draw) {
        VkPhysicalDeviceMultiDrawPropertiesEXT draws =
            Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTI_DRAW_PROPERTIES_EXT};
        get_properties(physical, draws);
        doors.multi_draw = draws.maxMultiDrawCount >= kDrawsInOne;
    }
    if (has_device_extension(physical, kDivisorExtension)) {
        DivisorProperties divisor;
        get_properties(physical, divisor);
        doors.divisor_first_instance = divisor.first_instance == VK_TRUE;
    }
    if (doors.mesh) {
        VkPhysicalDeviceMeshShaderPropertiesEXT mesh =
            Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_PROPERTIES_EXT};
        get_properties(physical, mesh);
        doors.mesh_layers = mesh.maxMeshOutputLayers;
    }
    if (has_device_extension(physical, VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME)) {
        VkPhysicalDeviceExternalMemoryHostPropertiesEXT host =
            Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_MEMORY_HOST_PROPERTIES_EXT};
        get_properties(physical, host);
        doors.host_import = can_import_vertices(physical);
        doors.host_alignment = host.minImportedHostPointerAlignment;
    }
    doors.vertex_formats = offered_vertex_formats(physical);
    doors.linear = has_linear_attachments(physical);
}

std::optional<std::string> missing_instance_support(const DoorSupport& support,
                                                    const cases::Case& c) {
    const Door door = c.variation.door;
    const bool is_indirect = door == Door::indirect || door == Door::indirect_count ||
                             door == Door::multi_indirect || door == Door::indirect_after_count;
    for (const cases::Draw& draw : c.draws) {
        // VUID-VkDrawIndirectCommand-firstInstance-00501
        if (is_indirect && draw.first_instance > 0 && !support.indirect_first_instance) {
            return "the device lacks drawIndirectFirstInstance";
        }
        for (const cases::Attribute& a : draw.attributes) {
            const uint32_t divisor = a.divisor.value_or(1);
            const bool lacks = divisor == 0 ? !support.divisor_zero : !support.divisor;
            if (divisor != 1 && lacks) {
                return fmt::format(
                    "the device lacks {}",
                    needs_of(divisor == 0 ? Door::instance_divisor_zero : Door::instance_divisor));
            }
            // VUID-vkCmdDraw-pNext-09461
            if (divisor != 1 && draw.first_instance > 0 && !support.divisor_first_instance) {
                return "the device has no divisor but 1 where firstInstance is not 0 "
                       "(supportsNonZeroFirstInstance)";
            }
        }
    }
    return std::nullopt;
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
    {Door::state_rasterization, &DoorSupport::dynamic_rasterization,
     "the states of samples, sample masks, polygon modes, depth clamping and clipping and the "
     "provoking vertex of VK_EXT_extended_dynamic_state3"},
    {Door::pipeline_library, &DoorSupport::library,
     "graphicsPipelineLibrary (VK_EXT_graphics_pipeline_library)"},
    {Door::shader_objects, &DoorSupport::shader_objects, "shaderObject (VK_EXT_shader_object)"},
    {Door::input_attachment, &DoorSupport::fragment_stores, "fragmentStoresAndAtomics"},
    {Door::image_linear, &DoorSupport::linear,
     "images of linear tiling for any of its attachments"},
    {Door::multiview, &DoorSupport::multiview, "multiview"},
    {Door::multiview_all, &DoorSupport::multiview, "multiview"},
    {Door::geometry, &DoorSupport::geometry, "geometryShader"},
    {Door::geometry_strip, &DoorSupport::geometry, "geometryShader"},
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
