// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/limits/required_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vk_harness {

namespace {

enum class Bound { least, most, bits, truth };

// A row of the specification's table "Required Limits". binary64 holds each of these numbers.
struct RequiredLimit {
    const char* name;
    double claimed;
    Bound bound;
    double required;
    std::string when = {};  // what it is required with, where that is not every device
};

bool is_met(const RequiredLimit& r) {
    switch (r.bound) {
        case Bound::least:
            return r.claimed >= r.required;
        case Bound::most:
            return r.claimed <= r.required;
        case Bound::bits: {
            const auto required = static_cast<uint32_t>(r.required);
            return (static_cast<uint32_t>(r.claimed) & required) == required;
        }
        case Bound::truth:
            break;
    }
    return r.claimed > 0;
}

WrongLimit wrong(const RequiredLimit& r) {
    const std::string of = r.when.empty() ? "of every device" : r.when;
    const auto hex = [](double bits) { return fmt::format("{:#x}", static_cast<uint32_t>(bits)); };
    switch (r.bound) {
        case Bound::least:
            return {r.name, fmt::format("at least {}", r.required), fmt::format("{}", r.claimed),
                    of};
        case Bound::most:
            return {r.name, fmt::format("at most {}", r.required), fmt::format("{}", r.claimed),
                    of};
        case Bound::bits:
            return {r.name, "the bits " + hex(r.required), hex(r.claimed), of};
        case Bound::truth:
            break;
    }
    return {r.name, "VK_TRUE", "VK_FALSE", of};
}

}  // namespace

std::vector<WrongLimit> wrong_limits(const VkPhysicalDeviceLimits& l,
                                     const VkPhysicalDeviceFeatures& f, uint32_t api_version,
                                     bool is_subset) {
    // A variant other than 0 is another API, whose versions are not Vulkan's.
    const bool is_1_4 =
        VK_API_VERSION_VARIANT(api_version) == 0 && api_version >= VK_MAKE_API_VERSION(0, 1, 4, 0);
    std::vector<RequiredLimit> rows;
    const auto add = [&](const char* name, double claimed, Bound bound, double required,
                         std::string when = {}) {
        rows.push_back({name, claimed, bound, required, std::move(when)});
    };
    // Some numbers are stricter since 1.4.
    const auto since_1_4 = [&](const char* name, double claimed, Bound bound, double before,
                               double required) {
        add(name, claimed, bound, is_1_4 ? required : before, is_1_4 ? "of Vulkan 1.4" : "");
    };
    // And some are required of a device with an optional feature.
    const auto with = [&](VkBool32 feature, const char* feature_name, const char* name,
                          double claimed, Bound bound, double otherwise, double required) {
        const bool has = feature == VK_TRUE;
        add(name, claimed, bound, has ? required : otherwise,
            fmt::format("of a device with{} the feature {}", has ? "" : "out", feature_name));
    };
    using enum Bound;
#define LIMIT(member) #member, static_cast<double>(l.member)
#define FEATURE(member) f.member, #member
    since_1_4(LIMIT(maxImageDimension2D), least, 4096, 8192);
    since_1_4(LIMIT(maxImageArrayLayers), least, 256, 2048);
    add(LIMIT(maxStorageBufferRange), least, 0x1p27);
    since_1_4(LIMIT(maxPushConstantsSize), least, 128, 256);
    since_1_4(LIMIT(bufferImageGranularity), most, 131072, 4096);
    add(LIMIT(maxVertexInputAttributes), least, 16);
    add(LIMIT(maxVertexInputBindings), least, is_subset ? 8 : 16,
        is_subset ? "with VK_KHR_portability_subset" : "");
    add(LIMIT(maxVertexInputAttributeOffset), least, 2047);
    add(LIMIT(maxVertexInputBindingStride), least, 2048);
    add(LIMIT(maxVertexOutputComponents), least, 64);
    with(FEATURE(geometryShader), LIMIT(maxGeometryShaderInvocations), least, 0, 32);
    with(FEATURE(geometryShader), LIMIT(maxGeometryInputComponents), least, 0, 64);
    with(FEATURE(geometryShader), LIMIT(maxGeometryOutputComponents), least, 0, 64);
    with(FEATURE(geometryShader), LIMIT(maxGeometryOutputVertices), least, 0, 256);
    with(FEATURE(geometryShader), LIMIT(maxGeometryTotalOutputComponents), least, 0, 1024);
    add(LIMIT(maxFragmentInputComponents), least, 64);
    add(LIMIT(maxFragmentOutputAttachments), least, 4);
    with(FEATURE(dualSrcBlend), LIMIT(maxFragmentDualSrcAttachments), least, 0, 1);
    since_1_4(LIMIT(maxFragmentCombinedOutputResources), least, 4, 16);
    add(LIMIT(subPixelPrecisionBits), least, 4);
    since_1_4(LIMIT(subTexelPrecisionBits), least, 4, 8);
    since_1_4(LIMIT(mipmapPrecisionBits), least, 4, 6);
    with(FEATURE(fullDrawIndexUint32), LIMIT(maxDrawIndexedIndexValue), least, 0x1p24 - 1,
         0x1p32 - 1);
    with(FEATURE(multiDrawIndirect), LIMIT(maxDrawIndirectCount), least, 1, 0x1p16 - 1);
    since_1_4(LIMIT(maxSamplerLodBias), least, 2, 14);
    with(FEATURE(samplerAnisotropy), LIMIT(maxSamplerAnisotropy), least, 1, 16);
    with(FEATURE(multiViewport), LIMIT(maxViewports), least, 1, 16);
    // They must "be greater than or equal to the largest image which can be created and used as a
    // framebuffer attachment"; a framebuffer of this size has one.
    const double viewport = is_1_4 ? 7680 : 4096;
    const auto as_attachment = [&](const char* name, double claimed, uint32_t framebuffer) {
        const uint32_t attachment = std::min(framebuffer, l.maxImageDimension2D);
        if (attachment > viewport) {
            add(name, claimed, least, attachment, "of a device with attachments that large");
        } else {
            since_1_4(name, claimed, least, 4096, 7680);
        }
    };
    as_attachment(LIMIT(maxViewportDimensions[0]), l.maxFramebufferWidth);
    as_attachment(LIMIT(maxViewportDimensions[1]), l.maxFramebufferHeight);
    // "At least [-2 x size, 2 x size - 1]"
    const uint32_t largest = std::max(l.maxViewportDimensions[0], l.maxViewportDimensions[1]);
    const double size = std::max(static_cast<double>(largest), viewport);
    const std::string sized = fmt::format("of a device with viewports of {} pixels", size);
    add(LIMIT(viewportBoundsRange[0]), most, -2 * size, sized);
    add(LIMIT(viewportBoundsRange[1]), least, 2 * size - 1, sized);
    add(LIMIT(minStorageBufferOffsetAlignment), most, 256);
    // "0.5 - (1 ULP)" of subPixelInterpolationOffsetBits, which are 4 at least.
    const int places = static_cast<int>(std::clamp(l.subPixelInterpolationOffsetBits, 4U, 64U));
    with(FEATURE(sampleRateShading), LIMIT(minInterpolationOffset), most, 0, -0.5);
    with(FEATURE(sampleRateShading), LIMIT(maxInterpolationOffset), least, 0,
         0.5 - std::ldexp(1.0, -places));
    with(FEATURE(sampleRateShading), LIMIT(subPixelInterpolationOffsetBits), least, 0, 4);
    since_1_4(LIMIT(maxFramebufferWidth), least, 4096, 7680);
    since_1_4(LIMIT(maxFramebufferHeight), least, 4096, 7680);
    add(LIMIT(maxFramebufferLayers), least, 256);
    constexpr auto kOneAndFour = double{VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT};
    add(LIMIT(framebufferColorSampleCounts), Bound::bits, kOneAndFour);
    add(LIMIT(framebufferDepthSampleCounts), Bound::bits, kOneAndFour);
    add(LIMIT(framebufferStencilSampleCounts), Bound::bits, kOneAndFour);
    add(LIMIT(framebufferNoAttachmentsSampleCounts), Bound::bits, kOneAndFour);
    since_1_4(LIMIT(maxColorAttachments), least, 4, 8);
    add(LIMIT(sampledImageColorSampleCounts), Bound::bits, kOneAndFour);
    add(LIMIT(sampledImageIntegerSampleCounts), Bound::bits, VK_SAMPLE_COUNT_1_BIT);
    add(LIMIT(sampledImageDepthSampleCounts), Bound::bits, kOneAndFour);
    add(LIMIT(sampledImageStencilSampleCounts), Bound::bits, kOneAndFour);
    add(LIMIT(maxSampleMaskWords), least, 1);
    with(FEATURE(shaderClipDistance), LIMIT(maxClipDistances), least, 0, 8);
    with(FEATURE(shaderCullDistance), LIMIT(maxCullDistances), least, 0, 8);
    with(FEATURE(shaderCullDistance), LIMIT(maxCombinedClipAndCullDistances), least, 0, 8);
    if (is_1_4) {
        add(LIMIT(standardSampleLocations), truth, 1, "of Vulkan 1.4");
    }
#undef FEATURE
#undef LIMIT
    std::vector<WrongLimit> found;
    for (const RequiredLimit& row : rows) {
        if (!is_met(row)) {
            found.push_back(wrong(row));
        }
    }
    return found;
}

}  // namespace vk_harness
