// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a device needs for the doors of cases/model/door.hpp.
#pragma once

#include <optional>
#include <string>

#include "cases/model/door.hpp"
#include "vk_harness/device/shader_object.hpp"

namespace vk_harness {

// Since the extension VK_EXT_vertex_attribute_divisor became one of Khronos.
inline constexpr const char* kDivisorExtension = "VK_KHR_vertex_attribute_divisor";

struct DoorSupport {
    bool index_8 = false;                  // indexTypeUint8
    bool indirect_count = false;           // drawIndirectCount
    bool multi_indirect = false;           // multiDrawIndirect, with room for three draws
    bool multi_draw = false;               // multiDraw, with room for three draws
    bool dynamic_outputs = false;          // all that pipeline/output_state.hpp sets
    bool dynamic_rasterization = false;    // all that set_dynamic_rasterization() sets
    bool library = false;                  // graphicsPipelineLibrary
    bool multiview = false;                // of two views at least
    bool geometry = false;                 // geometryShader
    bool tessellation = false;             // tessellationShader
    bool feedback = false;                 // transformFeedback
    bool shader_objects = false;           // shaderObject
    bool divisor = false;                  // vertexAttributeInstanceRateDivisor
    bool divisor_zero = false;             // vertexAttributeInstanceRateZeroDivisor
    bool divisor_first_instance = true;    // supportsNonZeroFirstInstance, or nothing asks for it
    bool indirect_first_instance = false;  // drawIndirectFirstInstance
    bool mesh = false;                     // meshShader
    uint32_t mesh_layers = 0;              // maxMeshOutputLayers: a mesh shader names those below
    bool fragment_stores = false;          // fragmentStoresAndAtomics
    bool linear = false;              // linear attachments of some format that cases are drawn to
    bool host_import = false;         // of memory that vertices and indices are read from
    VkDeviceSize host_alignment = 1;  // minImportedHostPointerAlignment
    const char* divisor_extension = VK_EXT_VERTEX_ATTRIBUTE_DIVISOR_EXTENSION_NAME;
    uint32_t vertex_formats = 0;  // that vertices are read in: vertex_format.hpp
};

// What limits what was found to be supported, of a device of Vulkan 1.2 or later; formats, memory.
void query_door_limits(VkPhysicalDevice physical, const VkPhysicalDeviceLimits& limits,
                       DoorSupport& doors);

// Why the device has no such door: one sentence that names what it lacks; nothing if it has it.
std::optional<std::string> missing_door_support(const DoorSupport& support, cases::Door door);
// Why the device cannot draw the instances of a case, through its door if it goes through one.
std::optional<std::string> missing_instance_support(const DoorSupport& support,
                                                    const cases::Case& c);
// Why a mesh shader of the device cannot draw the case to its layers; nothing through other doors.
std::optional<std::string> missing_mesh_layers(const DoorSupport& support, const cases::Case& c);

}  // namespace vk_harness
