// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pretends that the driver below has VK_EXT_conservative_rasterization, so that the program asks
// for it, enables it and draws with it; the driver draws as ever. What a pipeline asks for is
// written to the file EDGECASE_PRETENDED, a line each. Ends the process where the program's use is
// not valid.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "vulkan_layer/layer.hpp"

namespace pretending {

namespace {

using vulkan_layer::next_of;
using vulkan_layer::OwnCommand;

constexpr const char* kExtension = VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME;
constexpr float kMostExtra = 0.5F;  // maxExtraPrimitiveOverestimationSize
std::atomic<bool> is_enabled = false;

struct Driver : vulkan_layer::Device {
    PFN_vkCreateGraphicsPipelines CreateGraphicsPipelines = nullptr;
};

[[noreturn]] void complain(const char* what) {
    std::fprintf(stderr, "pretending layer: error: %s\n", what);
    std::abort();
}

VKAPI_ATTR void VKAPI_CALL get_properties2(VkPhysicalDevice physical,
                                           VkPhysicalDeviceProperties2* out) {
    next_of<PFN_vkGetPhysicalDeviceProperties2>(physical, "vkGetPhysicalDeviceProperties2")(
        physical, out);
    for (auto* s = static_cast<VkBaseOutStructure*>(out->pNext); s != nullptr; s = s->pNext) {
        if (s->sType ==
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CONSERVATIVE_RASTERIZATION_PROPERTIES_EXT) {
            auto& p = *reinterpret_cast<VkPhysicalDeviceConservativeRasterizationPropertiesEXT*>(s);
            p.primitiveOverestimationSize = 0;
            p.maxExtraPrimitiveOverestimationSize = kMostExtra;
            p.extraPrimitiveOverestimationSizeGranularity = 0.25F;
            p.primitiveUnderestimation = VK_TRUE;
            p.degenerateTrianglesRasterized = VK_FALSE;
        }
    }
}

VKAPI_ATTR VkResult VKAPI_CALL enumerate_extensions(VkPhysicalDevice physical, const char* layer,
                                                    uint32_t* count, VkExtensionProperties* out) {
    return vulkan_layer::answer_extensions(
        physical, layer, count, out, [](std::vector<VkExtensionProperties>& list) {
            list.push_back(vulkan_layer::extension(kExtension,
                                                   VK_EXT_CONSERVATIVE_RASTERIZATION_SPEC_VERSION));
        });
}

void look_at(const VkPipelineRasterizationConservativeStateCreateInfoEXT& state) {
    if (!is_enabled) {
        complain("the extension is used and was not enabled");
    }
    const char* mode = nullptr;
    switch (state.conservativeRasterizationMode) {
        case VK_CONSERVATIVE_RASTERIZATION_MODE_OVERESTIMATE_EXT:
            mode = "overestimate";
            break;
        case VK_CONSERVATIVE_RASTERIZATION_MODE_UNDERESTIMATE_EXT:
            mode = "underestimate";
            break;
        default:
            complain("a pipeline has no mode of conservative rasterization");
    }
    const float extra = state.extraPrimitiveOverestimationSize;
    if (state.flags != 0 || !(extra >= 0 && extra <= kMostExtra)) {
        complain("a pipeline's extra size, or its flags, are not valid");
    }
    if (const char* path = std::getenv("EDGECASE_PRETENDED")) {
        if (std::FILE* file = std::fopen(path, "a")) {
            std::fprintf(file, "%s %g\n", mode, static_cast<double>(extra));
            std::fclose(file);
        }
    }
}

VKAPI_ATTR VkResult VKAPI_CALL create_pipelines(VkDevice device, VkPipelineCache cache,
                                                uint32_t count,
                                                const VkGraphicsPipelineCreateInfo* infos,
                                                const VkAllocationCallbacks* allocator,
                                                VkPipeline* out) {
    for (uint32_t k = 0; k < count; ++k) {
        const VkPipelineRasterizationStateCreateInfo* state = infos[k].pRasterizationState;
        const auto* s =
            state == nullptr ? nullptr : static_cast<const VkBaseInStructure*>(state->pNext);
        for (; s != nullptr; s = s->pNext) {
            if (s->sType ==
                VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_CONSERVATIVE_STATE_CREATE_INFO_EXT) {
                look_at(
                    *reinterpret_cast<const VkPipelineRasterizationConservativeStateCreateInfoEXT*>(
                        s));
            }
        }
    }
    const auto& driver =
        static_cast<const Driver&>(vulkan_layer::device_of(vulkan_layer::dispatch_key(device)));
    return driver.CreateGraphicsPipelines(device, cache, count, infos, allocator, out);
}

const std::vector<OwnCommand>& instance_commands() {
    static const std::vector<OwnCommand> kCommands = {
        VULKAN_LAYER_OWN(GetPhysicalDeviceProperties2, get_properties2),
        VULKAN_LAYER_OWN(EnumerateDeviceExtensionProperties, enumerate_extensions),
    };
    return kCommands;
}

}  // namespace

}  // namespace pretending

namespace vulkan_layer {

bool is_ready() {
    return true;
}

std::span<const char* const> needed_instance_commands() {
    static constexpr const char* kNames[] = {"vkGetPhysicalDeviceProperties2",
                                             "vkEnumerateDeviceExtensionProperties"};
    return kNames;
}

VkResult create_next_device(const Instance& /*instance*/, VkPhysicalDevice /*physical*/,
                            const VkDeviceCreateInfo& asked, const CreateNext& create) {
    std::vector<const char*> extensions(
        asked.ppEnabledExtensionNames, asked.ppEnabledExtensionNames + asked.enabledExtensionCount);
    const auto is_own = [](const char* name) {
        return std::strcmp(name, pretending::kExtension) == 0;
    };
    pretending::is_enabled = std::any_of(extensions.begin(), extensions.end(), is_own);
    extensions.erase(std::remove_if(extensions.begin(), extensions.end(), is_own),
                     extensions.end());
    VkDeviceCreateInfo info = asked;
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    return create(info);
}

std::unique_ptr<Device> load_device(VkDevice device, PFN_vkGetDeviceProcAddr next) {
    auto driver = std::make_unique<pretending::Driver>();
    driver->CreateGraphicsPipelines =
        reinterpret_cast<PFN_vkCreateGraphicsPipelines>(next(device, "vkCreateGraphicsPipelines"));
    return driver;
}

PFN_vkVoidFunction own_instance_command(const char* name) {
    return find_command(pretending::instance_commands(), name);
}

PFN_vkVoidFunction own_device_command(const char* name) {
    static const std::vector<OwnCommand> kCommands = {
        VULKAN_LAYER_OWN(CreateGraphicsPipelines, pretending::create_pipelines)};
    return find_command(kCommands, name);
}

bool shows_device_command(VkDevice /*device*/, const char* /*name*/) {
    return true;
}

}  // namespace vulkan_layer
