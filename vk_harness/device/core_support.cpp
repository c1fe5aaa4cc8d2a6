// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/core_support.hpp"

#include <fmt/format.h>

namespace vk_harness {

namespace {

std::string short_version(uint32_t version) {
    return fmt::format("{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version));
}

}  // namespace

CoreSupport query_core_support(VkPhysicalDevice physical, uint32_t api_version) {
    CoreSupport out;
    if (api_version < VK_API_VERSION_1_1) {
        // The shaders are SPIR-V 1.3 (shaders/compile.cmake).
        out.missing.push_back(
            fmt::format("Vulkan 1.1 is needed, the device has {}", short_version(api_version)));
        return out;
    }
    out.depth_resolve = api_version >= VK_API_VERSION_1_2;
    if (api_version >= VK_API_VERSION_1_2) {
        return out;
    }
    if (!has_device_extension(physical, VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME)) {
        out.missing.push_back(
            fmt::format("Vulkan 1.2 or the extension {} is needed, the device has {}",
                        VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME, short_version(api_version)));
        return out;
    }
    out.extensions.push_back(VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME);
    if (has_device_extension(physical, VK_KHR_DEPTH_STENCIL_RESOLVE_EXTENSION_NAME)) {
        out.depth_resolve = true;
        out.extensions.push_back(VK_KHR_DEPTH_STENCIL_RESOLVE_EXTENSION_NAME);
    }
    return out;
}

void use_extension_names(VolkDeviceTable& table) {
    const auto use = [](auto& core, auto extension) {
        if (core == nullptr) {
            core = extension;
        }
    };
    use(table.vkCreateRenderPass2, table.vkCreateRenderPass2KHR);
    use(table.vkCmdBeginRendering, table.vkCmdBeginRenderingKHR);
    use(table.vkCmdEndRendering, table.vkCmdEndRenderingKHR);
    use(table.vkCmdPipelineBarrier2, table.vkCmdPipelineBarrier2KHR);
    use(table.vkCmdSetCullMode, table.vkCmdSetCullModeEXT);
    use(table.vkCmdSetStencilOp, table.vkCmdSetStencilOpEXT);
    use(table.vkCmdBindVertexBuffers2, table.vkCmdBindVertexBuffers2EXT);
    use(table.vkCmdSetFrontFace, table.vkCmdSetFrontFaceEXT);
    use(table.vkCmdSetPrimitiveTopology, table.vkCmdSetPrimitiveTopologyEXT);
    use(table.vkCmdSetPrimitiveRestartEnable, table.vkCmdSetPrimitiveRestartEnableEXT);
    use(table.vkCmdSetRasterizerDiscardEnable, table.vkCmdSetRasterizerDiscardEnableEXT);
    use(table.vkCmdSetDepthCompareOp, table.vkCmdSetDepthCompareOpEXT);
    use(table.vkCmdSetDepthBoundsTestEnable, table.vkCmdSetDepthBoundsTestEnableEXT);
    use(table.vkCmdSetDepthWriteEnable, table.vkCmdSetDepthWriteEnableEXT);
    use(table.vkCmdSetDepthBiasEnable, table.vkCmdSetDepthBiasEnableEXT);
}

}  // namespace vk_harness
