// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is made on a device: whatever the class does not advertise is complained about.
#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <vector>

#include "shown.hpp"

namespace device_classes {

namespace {

struct Driver : vulkan_layer::Device {
    PFN_vkCreateImage CreateImage = nullptr;
    PFN_vkCreateShaderModule CreateShaderModule = nullptr;
    PFN_vkCreateQueryPool CreateQueryPool = nullptr;
    PFN_vkCreateRenderPass2 CreateRenderPass2 = nullptr;
    PFN_vkCreateGraphicsPipelines CreateGraphicsPipelines = nullptr;
    PFN_vkCmdSetPrimitiveTopology CmdSetPrimitiveTopology = nullptr;
};

template <typename Handle>
const Driver& driver_of(Handle handle) {
    return static_cast<const Driver&>(vulkan_layer::device_of(vulkan_layer::dispatch_key(handle)));
}

bool lacks(VkFormat format, VkFormatFeatureFlags features) {
    const auto found = shown_class()->lacks.find(format);
    return found != shown_class()->lacks.end() && (found->second & features) != 0;
}

std::string format_text(VkFormat format) {
    return "the format " + std::to_string(static_cast<int>(format));
}

void need(bool is_used, const char* feature) {
    if (is_used && !shown_class()->may_use(feature)) {
        complain(std::string("the feature ") + feature);
    }
}

void need_samples(VkSampleCountFlags count) {
    if ((shown_class()->samples & count) == 0) {
        complain("the sample count " + std::to_string(count));
    }
}

VKAPI_ATTR VkResult VKAPI_CALL create_image(VkDevice device, const VkImageCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkImage* out) {
    if (lacks(info->format, features_of(info->usage))) {
        complain(format_text(info->format) + " with usage " + std::to_string(info->usage));
    }
    need_samples(info->samples);
    if (shown_class()->extensions.count(kPortability) > 0) {
        need(info->samples != VK_SAMPLE_COUNT_1_BIT && info->arrayLayers > 1,
             "multisampleArrayImage");
    }
    return driver_of(device).CreateImage(device, info, allocator, out);
}

// The capabilities of a module that stand for features.
VKAPI_ATTR VkResult VKAPI_CALL create_shader_module(VkDevice device,
                                                    const VkShaderModuleCreateInfo* info,
                                                    const VkAllocationCallbacks* allocator,
                                                    VkShaderModule* out) {
    const DeviceClass& shown = *shown_class();
    const size_t words = info->codeSize / sizeof(uint32_t);
    constexpr uint32_t kOpCapability = 17;
    constexpr size_t kHeader = 5;
    // Of the version word: 1.3 for Vulkan 1.1, 1.5 for 1.2, 1.6 for 1.3.
    const uint32_t version = info->pCode[1] >> 8U & 0xffU;
    const uint32_t minor = VK_API_VERSION_MINOR(shown.api_version);
    if (version > (minor == 0 ? 0U : minor == 1 ? 3U : minor == 2 ? 5U : 6U)) {
        complain("SPIR-V 1." + std::to_string(version));
    }
    for (size_t at = kHeader; at < words;) {
        const uint32_t word = info->pCode[at];
        if ((word & 0xffffU) == kOpCapability) {
            const uint32_t capability = info->pCode[at + 1];
            need(capability == 2, "geometryShader");
            need(capability == 32, "shaderClipDistance");
            need(capability == 33, "shaderCullDistance");
            need(capability == 35, "sampleRateShading");
            need(capability == 52 && shown.extensions.count(kPortability) > 0,
                 "shaderSampleRateInterpolationFunctions");
            need(capability == 69, "shaderOutputLayer");
            need(capability == 70, "shaderOutputViewportIndex");
            need(capability == 4422, "pipelineFragmentShadingRate");
            need(capability == 5284, "fragmentShaderBarycentric");
            need(capability == 5379, "shaderDemoteToHelperInvocation");
        }
        constexpr uint32_t kOpTerminateInvocation = 4416;
        need((word & 0xffffU) == kOpTerminateInvocation, "shaderTerminateInvocation");
        at += std::max(word >> 16U, 1U);
    }
    return driver_of(device).CreateShaderModule(device, info, allocator, out);
}

// Formats of the colour attachments of each subpass, by render pass.
class PassFormats {
  public:
    using Subpasses = std::vector<std::vector<VkFormat>>;

    void put(VkRenderPass pass, Subpasses formats) {
        const std::lock_guard lock(mutex_);
        formats_[pass] = std::move(formats);
    }
    std::vector<VkFormat> of(VkRenderPass pass, uint32_t subpass) {
        const std::lock_guard lock(mutex_);
        return formats_[pass].at(subpass);
    }

  private:
    std::mutex mutex_;
    std::map<VkRenderPass, Subpasses> formats_;
};

PassFormats& pass_formats() {
    static PassFormats formats;
    return formats;
}

VKAPI_ATTR VkResult VKAPI_CALL create_render_pass_2(VkDevice device,
                                                    const VkRenderPassCreateInfo2* info,
                                                    const VkAllocationCallbacks* allocator,
                                                    VkRenderPass* out) {
    PassFormats::Subpasses formats;
    for (uint32_t k = 0; k < info->subpassCount; ++k) {
        const VkSubpassDescription2& subpass = info->pSubpasses[k];
        std::vector<VkFormat>& of_subpass = formats.emplace_back();
        for (uint32_t a = 0; a < subpass.colorAttachmentCount; ++a) {
            const uint32_t number = subpass.pColorAttachments[a].attachment;
            of_subpass.push_back(number == VK_ATTACHMENT_UNUSED
                                     ? VK_FORMAT_UNDEFINED
                                     : info->pAttachments[number].format);
        }
    }
    const VkResult result = driver_of(device).CreateRenderPass2(device, info, allocator, out);
    if (result == VK_SUCCESS) {
        pass_formats().put(*out, std::move(formats));
    }
    return result;
}

std::vector<VkFormat> color_formats(const VkGraphicsPipelineCreateInfo& info) {
    if (info.renderPass != VK_NULL_HANDLE) {
        return pass_formats().of(info.renderPass, info.subpass);
    }
    for (auto* s = static_cast<const VkBaseInStructure*>(info.pNext); s != nullptr; s = s->pNext) {
        if (s->sType == VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO) {
            const auto& rendering = *reinterpret_cast<const VkPipelineRenderingCreateInfo*>(s);
            return {rendering.pColorAttachmentFormats,
                    rendering.pColorAttachmentFormats + rendering.colorAttachmentCount};
        }
    }
    return {};
}

void check_colors(const VkGraphicsPipelineCreateInfo& info) {
    const std::vector<VkFormat> formats = color_formats(info);
    const auto most = shown_class()->limits.find("maxColorAttachments");
    if (most != shown_class()->limits.end() && static_cast<double>(formats.size()) > most->second) {
        complain(std::to_string(formats.size()) + " colour attachments");
    }
    for (size_t k = 0; k < formats.size(); ++k) {
        if (lacks(formats[k], VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT)) {
            complain(format_text(formats[k]) + " as a colour attachment");
        }
        const VkPipelineColorBlendAttachmentState& blend = info.pColorBlendState->pAttachments[k];
        for (const VkBlendFactor factor : {blend.srcColorBlendFactor, blend.dstColorBlendFactor,
                                           blend.srcAlphaBlendFactor, blend.dstAlphaBlendFactor}) {
            need(factor >= VK_BLEND_FACTOR_SRC1_COLOR, "dualSrcBlend");
        }
        need(info.pColorBlendState->logicOpEnable == VK_TRUE, "logicOp");
        if (blend.blendEnable == VK_TRUE &&
            lacks(formats[k], VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT)) {
            complain(format_text(formats[k]) + ", blended,");
        }
    }
}

// Beyond those of Vulkan 1.0.
constexpr VkDynamicState kExtendedStates[] = {
    VK_DYNAMIC_STATE_CULL_MODE,          VK_DYNAMIC_STATE_FRONT_FACE,
    VK_DYNAMIC_STATE_PRIMITIVE_TOPOLOGY, VK_DYNAMIC_STATE_DEPTH_COMPARE_OP,
    VK_DYNAMIC_STATE_DEPTH_WRITE_ENABLE, VK_DYNAMIC_STATE_DEPTH_BOUNDS_TEST_ENABLE,
    VK_DYNAMIC_STATE_STENCIL_OP,         VK_DYNAMIC_STATE_VERTEX_INPUT_BINDING_STRIDE};
constexpr VkDynamicState kExtendedStates2[] = {VK_DYNAMIC_STATE_PRIMITIVE_RESTART_ENABLE,
                                               VK_DYNAMIC_STATE_RASTERIZER_DISCARD_ENABLE,
                                               VK_DYNAMIC_STATE_DEPTH_BIAS_ENABLE};

void check_states(const VkPipelineDynamicStateCreateInfo* states) {
    for (uint32_t k = 0; states != nullptr && k < states->dynamicStateCount; ++k) {
        const auto is_in = [&](const auto& some) {
            return std::find(std::begin(some), std::end(some), states->pDynamicStates[k]) !=
                   std::end(some);
        };
        need(is_in(kExtendedStates), "extendedDynamicState");
        need(is_in(kExtendedStates2), "extendedDynamicState2");
    }
}

void check_pipeline(const VkGraphicsPipelineCreateInfo& info) {
    if (info.pMultisampleState != nullptr) {
        need(info.pMultisampleState->sampleShadingEnable == VK_TRUE, "sampleRateShading");
        need(info.pMultisampleState->alphaToOneEnable == VK_TRUE, "alphaToOne");
        need_samples(info.pMultisampleState->rasterizationSamples);
    }
    if (info.pRasterizationState != nullptr) {
        need(info.pRasterizationState->depthClampEnable == VK_TRUE, "depthClamp");
        need(info.pRasterizationState->polygonMode != VK_POLYGON_MODE_FILL, "fillModeNonSolid");
    }
    need(info.pDepthStencilState != nullptr &&
             info.pDepthStencilState->depthBoundsTestEnable == VK_TRUE,
         "depthBounds");
    need(info.pViewportState != nullptr && info.pViewportState->viewportCount > 1, "multiViewport");
    need(shown_class()->extensions.count(kPortability) > 0 && info.pInputAssemblyState != nullptr &&
             info.pInputAssemblyState->topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN,
         "triangleFans");
    check_states(info.pDynamicState);
    if (info.pColorBlendState != nullptr) {
        check_colors(info);
    }
}

VKAPI_ATTR VkResult VKAPI_CALL create_graphics_pipelines(VkDevice device, VkPipelineCache cache,
                                                         uint32_t count,
                                                         const VkGraphicsPipelineCreateInfo* infos,
                                                         const VkAllocationCallbacks* allocator,
                                                         VkPipeline* out) {
    std::for_each(infos, infos + count, check_pipeline);
    return driver_of(device).CreateGraphicsPipelines(device, cache, count, infos, allocator, out);
}

VKAPI_ATTR void VKAPI_CALL set_primitive_topology(VkCommandBuffer commands,
                                                  VkPrimitiveTopology topology) {
    if (shown_class()->extensions.count(kPortability) > 0) {
        need(topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN, "triangleFans");
    }
    driver_of(commands).CmdSetPrimitiveTopology(commands, topology);
}

VKAPI_ATTR VkResult VKAPI_CALL create_query_pool(VkDevice device, const VkQueryPoolCreateInfo* info,
                                                 const VkAllocationCallbacks* allocator,
                                                 VkQueryPool* out) {
    need(info->queryType == VK_QUERY_TYPE_PIPELINE_STATISTICS, "pipelineStatisticsQuery");
    return driver_of(device).CreateQueryPool(device, info, allocator, out);
}

const vulkan_layer::OwnCommand kCommands[] = {
    VULKAN_LAYER_OWN(CreateQueryPool, create_query_pool),
    VULKAN_LAYER_OWN(CreateRenderPass2, create_render_pass_2),
    VULKAN_LAYER_OWN(CreateRenderPass2KHR, create_render_pass_2),
    VULKAN_LAYER_OWN(CreateImage, create_image),
    VULKAN_LAYER_OWN(CreateShaderModule, create_shader_module),
    VULKAN_LAYER_OWN(CreateGraphicsPipelines, create_graphics_pipelines),
    VULKAN_LAYER_OWN(CmdSetPrimitiveTopology, set_primitive_topology),
    VULKAN_LAYER_OWN(CmdSetPrimitiveTopologyEXT, set_primitive_topology),
};

// Commands by the version whose core has them, as far as the program may use them.
struct CoreCommand {
    const char* name;
    uint32_t since;
};
constexpr CoreCommand kCore[] = {
    {"vkGetImageMemoryRequirements2", VK_API_VERSION_1_1},
    {"vkGetBufferMemoryRequirements2", VK_API_VERSION_1_1},
    {"vkBindBufferMemory2", VK_API_VERSION_1_1},
    {"vkBindImageMemory2", VK_API_VERSION_1_1},
    {"vkGetDeviceQueue2", VK_API_VERSION_1_1},
    {"vkCreateRenderPass2", VK_API_VERSION_1_2},
    {"vkCmdBeginRenderPass2", VK_API_VERSION_1_2},
    {"vkCmdDrawIndirectCount", VK_API_VERSION_1_2},
    {"vkCmdDrawIndexedIndirectCount", VK_API_VERSION_1_2},
    {"vkResetQueryPool", VK_API_VERSION_1_2},
    {"vkCmdBeginRendering", VK_API_VERSION_1_3},
    {"vkCmdEndRendering", VK_API_VERSION_1_3},
    {"vkCmdPipelineBarrier2", VK_API_VERSION_1_3},
    {"vkQueueSubmit2", VK_API_VERSION_1_3},
    {"vkCmdCopyBuffer2", VK_API_VERSION_1_3},
    {"vkCmdCopyImage2", VK_API_VERSION_1_3},
    {"vkCmdCopyImageToBuffer2", VK_API_VERSION_1_3},
    {"vkCmdBlitImage2", VK_API_VERSION_1_3},
    {"vkCmdSetCullMode", VK_API_VERSION_1_3},
    {"vkCmdSetFrontFace", VK_API_VERSION_1_3},
    {"vkCmdSetPrimitiveTopology", VK_API_VERSION_1_3},
    {"vkCmdSetPrimitiveRestartEnable", VK_API_VERSION_1_3},
    {"vkCmdSetRasterizerDiscardEnable", VK_API_VERSION_1_3},
    {"vkCmdSetDepthTestEnable", VK_API_VERSION_1_3},
    {"vkCmdSetDepthCompareOp", VK_API_VERSION_1_3},
    {"vkCmdSetDepthBoundsTestEnable", VK_API_VERSION_1_3},
    {"vkCmdSetDepthWriteEnable", VK_API_VERSION_1_3},
    {"vkCmdSetDepthBiasEnable", VK_API_VERSION_1_3},
    {"vkCmdSetStencilTestEnable", VK_API_VERSION_1_3},
    {"vkCmdSetStencilOp", VK_API_VERSION_1_3},
    {"vkCmdBindVertexBuffers2", VK_API_VERSION_1_3},
};

}  // namespace

}  // namespace device_classes

namespace vulkan_layer {

std::unique_ptr<Device> load_device(VkDevice device, PFN_vkGetDeviceProcAddr next) {
    auto driver = std::make_unique<device_classes::Driver>();
    const auto load = [&](auto& command, const char* name) {
        command = reinterpret_cast<std::decay_t<decltype(command)>>(next(device, name));
    };
    load(driver->CreateImage, "vkCreateImage");
    load(driver->CreateShaderModule, "vkCreateShaderModule");
    load(driver->CreateQueryPool, "vkCreateQueryPool");
    load(driver->CreateRenderPass2, "vkCreateRenderPass2");
    load(driver->CreateGraphicsPipelines, "vkCreateGraphicsPipelines");
    load(driver->CmdSetPrimitiveTopology, "vkCmdSetPrimitiveTopology");
    return driver;
}

PFN_vkVoidFunction own_device_command(const char* name) {
    return find_command(device_classes::kCommands, name);
}

bool shows_device_command(VkDevice /*device*/, const char* name) {
    const auto* const end = std::end(device_classes::kCore);
    const auto* const found =
        std::find_if(std::begin(device_classes::kCore), end,
                     [name](const auto& command) { return std::strcmp(command.name, name) == 0; });
    return found == end || device_classes::shown_class()->api_version >= found->since;
}

}  // namespace vulkan_layer
