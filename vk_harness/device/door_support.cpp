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

std::optional<std::string> missing_door_support(const DoorSupport& support, cases::Door door) {
    using cases::Door;
    const bool is_missing =
        ((door == Door::index_8 || door == Door::index_8_largest) && !support.index_8) ||
        (door == Door::indirect_count && !support.indirect_count) ||
        (door == Door::multi_indirect && !support.multi_indirect) ||
        (door == Door::indirect_after_count &&
         !(support.indirect_count && support.multi_indirect)) ||
        (door == Door::state_output && !support.dynamic_outputs) ||
        (door == Door::pipeline_library && !support.library) ||
        (door == Door::multiview && !support.multiview) ||
        (door == Door::geometry && !support.geometry) ||
        (door == Door::tessellation && !support.tessellation) ||
        (door == Door::transform_feedback && !support.feedback) ||
        (door == Door::shader_objects && !support.shader_objects) ||
        (door == Door::image_linear && !support.linear) ||
        (door == Door::instance_divisor && !support.divisor) ||
        (door == Door::instance_divisor_zero && !support.divisor_zero) ||
        (door == Door::mesh_shader && !support.mesh) ||
        (door == Door::input_attachment && !support.fragment_stores) ||
        (door == Door::memory_imported && !support.host_import) ||
        ((door == Door::multi_draw || door == Door::multi_draw_empty) && !support.multi_draw);
    return is_missing ? std::optional(fmt::format("the device lacks {}", cases::row_of(door).needs))
                      : std::nullopt;
}

}  // namespace vk_harness
