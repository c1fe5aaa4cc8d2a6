// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/core_support.hpp"

#include <fmt/format.h>

#include <array>

namespace vk_harness {

namespace {

// What is used, by the version that has it in core; before, the extension is needed. In an order in
// which each extension follows those that it needs itself.
struct Promoted {
    const char* extension;
    uint32_t core_since;
};
constexpr std::array kPromoted = {
    Promoted{VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME, VK_API_VERSION_1_2},
    Promoted{VK_KHR_DEPTH_STENCIL_RESOLVE_EXTENSION_NAME, VK_API_VERSION_1_2},
    Promoted{VK_KHR_DYNAMIC_RENDERING_EXTENSION_NAME, VK_API_VERSION_1_3},
    Promoted{VK_EXT_EXTENDED_DYNAMIC_STATE_EXTENSION_NAME, VK_API_VERSION_1_3},
    Promoted{VK_EXT_EXTENDED_DYNAMIC_STATE_2_EXTENSION_NAME, VK_API_VERSION_1_3},
};

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
    for (const Promoted& p : kPromoted) {
        if (api_version >= p.core_since) {
            continue;
        }
        if (has_extension(physical, p.extension)) {
            out.extensions.push_back(p.extension);
        } else {
            out.missing.push_back(
                fmt::format("Vulkan {} or the extension {} is needed, the device has {}",
                            short_version(p.core_since), p.extension, short_version(api_version)));
        }
    }
    if (!out.missing.empty()) {
        return out;
    }
    out.dynamic_state2_extension = api_version < VK_API_VERSION_1_3;
    const bool has_synchronization2 =
        api_version >= VK_API_VERSION_1_3 ||
        has_extension(physical, VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME);
    const bool has_maintenance4 = api_version >= VK_API_VERSION_1_3 ||
                                  has_extension(physical, VK_KHR_MAINTENANCE_4_EXTENSION_NAME);
    CoreFeatures asked;
    VkPhysicalDeviceFeatures2 features = Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    chain(features, asked.dynamic_rendering);
    if (has_synchronization2) {
        chain(features, asked.synchronization2);
    }
    if (has_maintenance4) {
        chain(features, asked.maintenance4);
    }
    if (out.dynamic_state2_extension) {
        chain(features, asked.dynamic_state);
        chain(features, asked.dynamic_state2);
    } else {  // core without a feature
        asked.dynamic_state.extendedDynamicState = VK_TRUE;
        asked.dynamic_state2.extendedDynamicState2 = VK_TRUE;
    }
    vkGetPhysicalDeviceFeatures2(physical, &features);
    out.synchronization2 = asked.synchronization2.synchronization2 == VK_TRUE;
    out.maintenance4 = asked.maintenance4.maintenance4 == VK_TRUE;
    for (const auto& [has, extension] :
         {std::pair(out.synchronization2, VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME),
          {out.maintenance4, VK_KHR_MAINTENANCE_4_EXTENSION_NAME}}) {
        if (has && api_version < VK_API_VERSION_1_3) {
            out.extensions.push_back(extension);
        }
    }
    for (const auto& [has, name] :
         {std::pair(asked.dynamic_rendering.dynamicRendering, "dynamicRendering"),
          {asked.dynamic_state.extendedDynamicState, "extendedDynamicState"},
          {asked.dynamic_state2.extendedDynamicState2, "extendedDynamicState2"},
          {features.features.independentBlend, "independentBlend"}}) {
        if (has != VK_TRUE) {
            out.missing.push_back(fmt::format("the device lacks the feature {}", name));
        }
    }
    return out;
}

void enable_core_features(const CoreSupport& support, VkPhysicalDeviceFeatures2& features,
                          std::vector<const char*>& extensions, CoreFeatures& enabled) {
    extensions.insert(extensions.end(), support.extensions.begin(), support.extensions.end());
    enabled.dynamic_rendering.dynamicRendering = VK_TRUE;
    chain(features, enabled.dynamic_rendering);
    if (support.synchronization2) {
        enabled.synchronization2.synchronization2 = VK_TRUE;
        chain(features, enabled.synchronization2);
    }
    if (support.maintenance4) {  // outputs that the next stage does not read
        enabled.maintenance4.maintenance4 = VK_TRUE;
        chain(features, enabled.maintenance4);
    }
    if (support.dynamic_state2_extension) {
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
