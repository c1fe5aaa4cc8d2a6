// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pretends that the driver below has VK_EXT_conservative_rasterization and
// VK_KHR_fragment_shading_rate, so that the program asks for them, enables them and draws with
// them; the driver draws as ever. What a pipeline asks for is written to the file
// EDGECASE_PRETENDED, a line each. Ends the process where the program's use is not valid. The
// limits that EDGECASE_PRETENDED_LIMITS names are claimed in place of the driver's.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "vulkan_layer/layer.hpp"

namespace pretending {

namespace {

using vulkan_layer::next_of;
using vulkan_layer::OwnCommand;

constexpr const char* kExtension = VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME;
constexpr float kMostExtra = 0.5F;  // maxExtraPrimitiveOverestimationSize
constexpr const char* kSizes = VK_KHR_FRAGMENT_SHADING_RATE_EXTENSION_NAME;
std::atomic<bool> is_enabled = false, has_sizes = false;

// Largest first, as they have to be.
struct Size {
    VkExtent2D pixels;
    VkSampleCountFlags samples;
};
constexpr Size kFragmentSizes[] = {{{4, 4}, VK_SAMPLE_COUNT_1_BIT},
                                   {{2, 2}, VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT},
                                   {{2, 1}, VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT},
                                   {{1, 1}, ~0U}};

struct Driver : vulkan_layer::Device {
    PFN_vkCreateGraphicsPipelines CreateGraphicsPipelines = nullptr;
};

[[noreturn]] void complain(const char* what) {
    std::fprintf(stderr, "pretending layer: error: %s\n", what);
    std::abort();
}

// One claim of EDGECASE_PRETENDED_LIMITS: "maxViewports=1", "viewportBoundsRange[0]=nan"; "all=255"
// is every byte.
void claim(VkPhysicalDeviceProperties& properties, const std::string& name, double value) {
    VkPhysicalDeviceLimits& l = properties.limits;
    if (name == "all") {
        std::memset(&l, static_cast<int>(value), sizeof l);
        return;
    }
    if (name == "apiVersion") {
        properties.apiVersion = static_cast<uint32_t>(value);
        return;
    }
#define PRETENDED_LIMIT(member)                                                       \
    if (name == #member) {                                                            \
        l.member = static_cast<std::remove_reference_t<decltype((l.member))>>(value); \
        return;                                                                       \
    }
    PRETENDED_LIMIT(subPixelPrecisionBits)
    PRETENDED_LIMIT(viewportSubPixelBits)
    PRETENDED_LIMIT(subPixelInterpolationOffsetBits)
    PRETENDED_LIMIT(mipmapPrecisionBits)
    PRETENDED_LIMIT(maxFramebufferWidth)
    PRETENDED_LIMIT(maxViewports)
    PRETENDED_LIMIT(viewportBoundsRange[0])
    PRETENDED_LIMIT(viewportBoundsRange[1])
    PRETENDED_LIMIT(framebufferColorSampleCounts)
#undef PRETENDED_LIMIT
    complain("EDGECASE_PRETENDED_LIMITS names a limit that the layer does not know");
}

void claim_limits(VkPhysicalDeviceProperties& properties) {
    const char* const claims = std::getenv("EDGECASE_PRETENDED_LIMITS");
    std::istringstream in(claims == nullptr ? "" : claims);
    for (std::string word; std::getline(in, word, ',');) {
        const size_t equals = std::min(word.find('='), word.size() - 1);
        claim(properties, word.substr(0, equals), std::strtod(word.c_str() + equals + 1, nullptr));
    }
}

VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice physical,
                                          VkPhysicalDeviceProperties* out) {
    next_of<PFN_vkGetPhysicalDeviceProperties>(physical, "vkGetPhysicalDeviceProperties")(physical,
                                                                                          out);
    claim_limits(*out);
}

VKAPI_ATTR void VKAPI_CALL get_properties2(VkPhysicalDevice physical,
                                           VkPhysicalDeviceProperties2* out) {
    next_of<PFN_vkGetPhysicalDeviceProperties2>(physical, "vkGetPhysicalDeviceProperties2")(
        physical, out);
    claim_limits(out->properties);
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
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADING_RATE_PROPERTIES_KHR) {
            auto& p = *reinterpret_cast<VkPhysicalDeviceFragmentShadingRatePropertiesKHR*>(s);
            p.maxFragmentSize = {4, 4};
            p.maxFragmentSizeAspectRatio = 2;
            p.maxFragmentShadingRateCoverageSamples = 16;
            p.maxFragmentShadingRateRasterizationSamples = VK_SAMPLE_COUNT_4_BIT;
            p.fragmentShadingRateWithSampleMask = VK_TRUE;
            p.fragmentShadingRateWithShaderSampleMask = VK_FALSE;
        }
    }
}

VKAPI_ATTR void VKAPI_CALL get_features2(VkPhysicalDevice physical,
                                         VkPhysicalDeviceFeatures2* out) {
    next_of<PFN_vkGetPhysicalDeviceFeatures2>(physical, "vkGetPhysicalDeviceFeatures2")(physical,
                                                                                        out);
    for (auto* s = static_cast<VkBaseOutStructure*>(out->pNext); s != nullptr; s = s->pNext) {
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADING_RATE_FEATURES_KHR) {
            auto& f = *reinterpret_cast<VkPhysicalDeviceFragmentShadingRateFeaturesKHR*>(s);
            f.pipelineFragmentShadingRate = VK_TRUE;
        }
    }
}

VKAPI_ATTR VkResult VKAPI_CALL get_sizes(VkPhysicalDevice /*physical*/, uint32_t* count,
                                         VkPhysicalDeviceFragmentShadingRateKHR* out) {
    constexpr auto kCount = static_cast<uint32_t>(std::size(kFragmentSizes));
    if (out == nullptr) {
        *count = kCount;
        return VK_SUCCESS;
    }
    *count = std::min(*count, kCount);
    for (uint32_t k = 0; k < *count; ++k) {
        if (out[k].sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADING_RATE_KHR) {
            complain("a fragment shading rate has another sType");
        }
        out[k].sampleCounts = kFragmentSizes[k].samples;
        out[k].fragmentSize = kFragmentSizes[k].pixels;
    }
    return *count < kCount ? VK_INCOMPLETE : VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL enumerate_extensions(VkPhysicalDevice physical, const char* layer,
                                                    uint32_t* count, VkExtensionProperties* out) {
    return vulkan_layer::answer_extensions(
        physical, layer, count, out, [](std::vector<VkExtensionProperties>& list) {
            list.push_back(vulkan_layer::extension(kExtension,
                                                   VK_EXT_CONSERVATIVE_RASTERIZATION_SPEC_VERSION));
            list.push_back(
                vulkan_layer::extension(kSizes, VK_KHR_FRAGMENT_SHADING_RATE_SPEC_VERSION));
        });
}

void note(const char* line) {
    if (const char* path = std::getenv("EDGECASE_PRETENDED")) {
        if (std::FILE* file = std::fopen(path, "a")) {
            std::fprintf(file, "%s\n", line);
            std::fclose(file);
        }
    }
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
    char line[64];
    std::snprintf(line, sizeof line, "%s %g", mode, static_cast<double>(extra));
    note(line);
}

void look_at(const VkPipelineFragmentShadingRateStateCreateInfoKHR& state, uint32_t samples) {
    if (!has_sizes) {
        complain("a fragment size is used and its extension was not enabled");
    }
    const bool is_listed =
        std::any_of(std::begin(kFragmentSizes), std::end(kFragmentSizes), [&](const Size& size) {
            return size.pixels.width == state.fragmentSize.width &&
                   size.pixels.height == state.fragmentSize.height && (size.samples & samples) != 0;
        });
    if (!is_listed) {
        complain("a pipeline has a fragment size that the device lacks");
    }
    for (const VkFragmentShadingRateCombinerOpKHR op : state.combinerOps) {
        if (op != VK_FRAGMENT_SHADING_RATE_COMBINER_OP_KEEP_KHR) {
            complain("a pipeline's fragment size is combined with nothing");
        }
    }
    char line[64];
    std::snprintf(line, sizeof line, "size %u %u", state.fragmentSize.width,
                  state.fragmentSize.height);
    note(line);
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
    for (uint32_t k = 0; k < count; ++k) {
        const auto* s = static_cast<const VkBaseInStructure*>(infos[k].pNext);
        for (; s != nullptr; s = s->pNext) {
            if (s->sType ==
                VK_STRUCTURE_TYPE_PIPELINE_FRAGMENT_SHADING_RATE_STATE_CREATE_INFO_KHR) {
                const auto* m = infos[k].pMultisampleState;
                look_at(
                    *reinterpret_cast<const VkPipelineFragmentShadingRateStateCreateInfoKHR*>(s),
                    m == nullptr ? ~0U : static_cast<uint32_t>(m->rasterizationSamples));
            }
        }
    }
    const auto& driver =
        static_cast<const Driver&>(vulkan_layer::device_of(vulkan_layer::dispatch_key(device)));
    return driver.CreateGraphicsPipelines(device, cache, count, infos, allocator, out);
}

const std::vector<OwnCommand>& instance_commands() {
    static const std::vector<OwnCommand> kCommands = {
        VULKAN_LAYER_OWN(GetPhysicalDeviceProperties, get_properties),
        VULKAN_LAYER_OWN(GetPhysicalDeviceProperties2, get_properties2),
        VULKAN_LAYER_OWN(GetPhysicalDeviceFeatures2, get_features2),
        VULKAN_LAYER_OWN(GetPhysicalDeviceFragmentShadingRatesKHR, get_sizes),
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
    static constexpr const char* kNames[] = {
        "vkGetPhysicalDeviceProperties", "vkGetPhysicalDeviceProperties2",
        "vkGetPhysicalDeviceFeatures2", "vkEnumerateDeviceExtensionProperties"};
    return kNames;
}

VkResult create_next_device(const Instance& /*instance*/, VkPhysicalDevice /*physical*/,
                            const VkDeviceCreateInfo& asked, const CreateNext& create) {
    std::vector<const char*> extensions(
        asked.ppEnabledExtensionNames, asked.ppEnabledExtensionNames + asked.enabledExtensionCount);
    const auto take = [&extensions](const char* own) {
        return std::erase_if(extensions,
                             [own](const char* name) { return std::strcmp(name, own) == 0; }) > 0;
    };
    pretending::is_enabled = take(pretending::kExtension);
    pretending::has_sizes = take(pretending::kSizes);
    VkDeviceCreateInfo info = asked;
    // A driver refuses a feature that it lacks: the structure is taken out while the device is
    // made.
    VkBaseOutStructure first{VK_STRUCTURE_TYPE_APPLICATION_INFO,
                             static_cast<VkBaseOutStructure*>(const_cast<void*>(info.pNext))};
    VkBaseOutStructure *before = &first, *taken = nullptr;
    for (; before->pNext != nullptr && taken == nullptr; before = before->pNext) {
        if (before->pNext->sType ==
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADING_RATE_FEATURES_KHR) {
            taken = before->pNext;
            break;
        }
    }
    if (taken != nullptr) {
        before->pNext = taken->pNext;
    }
    info.pNext = first.pNext;
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    const VkResult result = create(info);
    if (taken != nullptr) {
        before->pNext = taken;
    }
    return result;
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
