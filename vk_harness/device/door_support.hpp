// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a device needs for the doors of cases/model/door.hpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/model/door.hpp"
#include "vk_harness/device/clip_support.hpp"
#include "vk_harness/device/shader_object.hpp"

namespace vk_harness {

struct DoorSupport {
    bool index_8 = false;             // indexTypeUint8
    bool indirect_count = false;      // drawIndirectCount
    bool multi_indirect = false;      // multiDrawIndirect, with room for three draws
    bool multi_draw = false;          // multiDraw, with room for three draws
    bool dynamic_outputs = false;     // all that pipeline/output_state.hpp sets
    bool library = false;             // graphicsPipelineLibrary
    bool multiview = false;           // of two views at least
    bool geometry = false;            // geometryShader
    bool tessellation = false;        // tessellationShader
    bool feedback = false;            // transformFeedback
    bool shader_objects = false;      // shaderObject
    bool divisor = false;             // vertexAttributeInstanceRateDivisor
    bool divisor_zero = false;        // vertexAttributeInstanceRateZeroDivisor
    bool mesh = false;                // meshShader
    uint32_t mesh_layers = 0;         // maxMeshOutputLayers: a mesh shader names those below
    bool fragment_stores = false;     // fragmentStoresAndAtomics
    bool linear = false;              // linear attachments of some format that cases are drawn to
    bool host_import = false;         // of memory that vertices and indices are read from
    VkDeviceSize host_alignment = 1;  // minImportedHostPointerAlignment
    const char* divisor_extension = nullptr;  // by which it has either divisor
    uint32_t vertex_formats = 0;              // that vertices are read in: vertex_format.hpp
};

DoorSupport query_door_support(VkPhysicalDevice physical, HasExtension has_extension);

// Features to enable, as a chain that must outlive vkCreateDevice and must not be moved.
struct DoorFeatures {
    VkPhysicalDeviceIndexTypeUint8FeaturesEXT index_8 =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_INDEX_TYPE_UINT8_FEATURES_EXT};
    VkPhysicalDeviceMultiDrawFeaturesEXT multi_draw =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTI_DRAW_FEATURES_EXT};
    VkPhysicalDeviceExtendedDynamicState2FeaturesEXT dynamic_state2 =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_2_FEATURES_EXT};
    VkPhysicalDeviceExtendedDynamicState3FeaturesEXT dynamic_state3 =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_3_FEATURES_EXT};
    VkPhysicalDeviceGraphicsPipelineLibraryFeaturesEXT library =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_GRAPHICS_PIPELINE_LIBRARY_FEATURES_EXT};
    ShaderObjectFeatures shader_objects;
    VkPhysicalDeviceTransformFeedbackFeaturesEXT feedback =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TRANSFORM_FEEDBACK_FEATURES_EXT};
    VkPhysicalDeviceVertexAttributeDivisorFeaturesEXT divisor =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VERTEX_ATTRIBUTE_DIVISOR_FEATURES_EXT};
    VkPhysicalDeviceMeshShaderFeaturesEXT mesh =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_FEATURES_EXT};
    VkPhysicalDeviceMultiviewFeatures multiview =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES};
};
// Puts what is supported before `features`' chain, and the names of its extensions into the list.
void enable_door_features(const DoorSupport& support, VkPhysicalDeviceFeatures2& features,
                          VkPhysicalDeviceVulkan12Features& features12,
                          std::vector<const char*>& extensions, DoorFeatures& enabled);

// Why the device has no such door: one sentence that names what it lacks; nothing if it has it.
std::optional<std::string> missing_door_support(const DoorSupport& support, cases::Door door);
// Why a mesh shader of the device cannot draw the case to its layers; nothing through other doors.
std::optional<std::string> missing_mesh_layers(const DoorSupport& support, const cases::Case& c);

}  // namespace vk_harness
