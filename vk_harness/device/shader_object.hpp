// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// VK_EXT_shader_object: shaders without pipelines. Debian 12's Vulkan headers are older than the
// extension (revision 1, extension 483), so what is used of it is declared here.
#pragma once

#include "vk_harness/device/api.hpp"

namespace vk_harness {

inline constexpr const char* kShaderObjectExtension = "VK_EXT_shader_object";
// The Vulkan headers that have it first; a validation layer that is older knows nothing of it.
inline constexpr uint32_t kShaderObjectHeaders = VK_MAKE_API_VERSION(0, 1, 3, 246);

// VkPhysicalDeviceShaderObjectFeaturesEXT.
struct ShaderObjectFeatures {
    VkStructureType sType = static_cast<VkStructureType>(1000482000);
    void* pNext = nullptr;
    VkBool32 shader_object = VK_FALSE;
};

// VkShaderEXT.
VK_DEFINE_NON_DISPATCHABLE_HANDLE(ShaderObject)

// VkShaderCreateInfoEXT.
struct ShaderObjectInfo {
    VkStructureType sType = static_cast<VkStructureType>(1000482002);
    const void* pNext = nullptr;
    VkFlags flags = 0;
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_VERTEX_BIT;
    VkShaderStageFlags next_stages = 0;
    int32_t code_type = 1;  // VK_SHADER_CODE_TYPE_SPIRV_EXT
    size_t code_size = 0;   // bytes
    const void* code = nullptr;
    const char* name = "main";
    uint32_t set_count = 0;
    const VkDescriptorSetLayout* sets = nullptr;
    uint32_t range_count = 0;
    const VkPushConstantRange* ranges = nullptr;
    const VkSpecializationInfo* specialization = nullptr;
};

// Null unless the device has the feature.
struct ShaderObjectCalls {
    VkResult(VKAPI_PTR* create)(VkDevice, uint32_t, const ShaderObjectInfo*,
                                const VkAllocationCallbacks*, ShaderObject*) = nullptr;
    Handle<ShaderObject>::Destroy destroy = nullptr;
    void(VKAPI_PTR* bind)(VkCommandBuffer, uint32_t, const VkShaderStageFlagBits*,
                          const ShaderObject*) = nullptr;
};

}  // namespace vk_harness
