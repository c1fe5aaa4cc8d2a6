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

CoreSupport query_core_support(VkPhysicalDevice physical, uint32_t api_version,
                               bool (*has_extension)(VkPhysicalDevice, const char*)) {
    CoreSupport out;
    if (api_version < VK_API_VERSION_1_1) {
        // The shaders are SPIR-V 1.3 (shaders/compile.cmake).
        out.missing.push_back(
            fmt::format("Vulkan 1.1 is needed, the device has {}", short_version(api_version)));
        return out;
    }
    if (api_version < VK_API_VERSION_1_2 &&
        !has_extension(physical, VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME)) {
        out.missing.push_back(
            fmt::format("Vulkan 1.2 or the extension {} is needed, the device has {}",
                        VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME, short_version(api_version)));
    }
    if (!out.missing.empty()) {
        return out;
    }
    out.depth_resolve = api_version >= VK_API_VERSION_1_2 ||
                        has_extension(physical, VK_KHR_DEPTH_STENCIL_RESOLVE_EXTENSION_NAME);
    const auto has = [&](const char* extension) {
        return api_version >= VK_API_VERSION_1_3 || has_extension(physical, extension);
    };
    const bool has_rendering = has(VK_KHR_DYNAMIC_RENDERING_EXTENSION_NAME);
    const bool has_synchronization2 = has(VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME);
    const bool has_maintenance4 = has(VK_KHR_MAINTENANCE_4_EXTENSION_NAME);
    const bool has_states = has(VK_EXT_EXTENDED_DYNAMIC_STATE_EXTENSION_NAME) &&
                            has(VK_EXT_EXTENDED_DYNAMIC_STATE_2_EXTENSION_NAME);
    const bool has_state_features = has_states && api_version < VK_API_VERSION_1_3;
    CoreFeatures asked;
    VkPhysicalDeviceFeatures2 features = Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    if (has_rendering) {
        chain(features, asked.dynamic_rendering);
    }
    if (has_synchronization2) {
        chain(features, asked.synchronization2);
    }
    if (has_maintenance4) {
        chain(features, asked.maintenance4);
    }
    if (has_state_features) {
        chain(features, asked.dynamic_state);
        chain(features, asked.dynamic_state2);
    } else if (has_states) {  // core without a feature
        asked.dynamic_state.extendedDynamicState = VK_TRUE;
        asked.dynamic_state2.extendedDynamicState2 = VK_TRUE;
    }
    vkGetPhysicalDeviceFeatures2(physical, &features);
    out.dynamic_rendering = asked.dynamic_rendering.dynamicRendering == VK_TRUE;
    out.synchronization2 = asked.synchronization2.synchronization2 == VK_TRUE;
    out.maintenance4 = asked.maintenance4.maintenance4 == VK_TRUE;
    out.dynamic_state = asked.dynamic_state.extendedDynamicState == VK_TRUE &&
                        asked.dynamic_state2.extendedDynamicState2 == VK_TRUE;
    out.dynamic_state_features = out.dynamic_state && has_state_features;
    // In an order in which each extension follows those that it needs itself.
    const auto use = [&](bool is_used, const char* extension, uint32_t core_since) {
        if (is_used && api_version < core_since) {
            out.extensions.push_back(extension);
        }
    };
    use(true, VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME, VK_API_VERSION_1_2);
    use(out.depth_resolve, VK_KHR_DEPTH_STENCIL_RESOLVE_EXTENSION_NAME, VK_API_VERSION_1_2);
    use(out.dynamic_rendering, VK_KHR_DYNAMIC_RENDERING_EXTENSION_NAME, VK_API_VERSION_1_3);
    use(out.synchronization2, VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME, VK_API_VERSION_1_3);
    use(out.maintenance4, VK_KHR_MAINTENANCE_4_EXTENSION_NAME, VK_API_VERSION_1_3);
    use(out.dynamic_state, VK_EXT_EXTENDED_DYNAMIC_STATE_EXTENSION_NAME, VK_API_VERSION_1_3);
    use(out.dynamic_state, VK_EXT_EXTENDED_DYNAMIC_STATE_2_EXTENSION_NAME, VK_API_VERSION_1_3);
    if (features.features.independentBlend != VK_TRUE) {
        out.missing.emplace_back("the device lacks the feature independentBlend");
    }
    return out;
}

void enable_core_features(const CoreSupport& support, VkPhysicalDeviceFeatures2& features,
                          std::vector<const char*>& extensions, CoreFeatures& enabled) {
    extensions.insert(extensions.end(), support.extensions.begin(), support.extensions.end());
    if (support.dynamic_rendering) {
        enabled.dynamic_rendering.dynamicRendering = VK_TRUE;
        chain(features, enabled.dynamic_rendering);
    }
    if (support.synchronization2) {
        enabled.synchronization2.synchronization2 = VK_TRUE;
        chain(features, enabled.synchronization2);
    }
    if (support.maintenance4) {  // outputs that the next stage does not read
        enabled.maintenance4.maintenance4 = VK_TRUE;
        chain(features, enabled.maintenance4);
    }
    if (support.dynamic_state_features) {
        enabled.dynamic_state.extendedDynamicState = VK_TRUE;
        enabled.dynamic_state2.extendedDynamicState2 = VK_TRUE;
        chain(features, enabled.dynamic_state);
        chain(features, enabled.dynamic_state2);
    }
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
