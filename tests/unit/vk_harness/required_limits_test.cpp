// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The barest device that the specification's table "Required Limits" allows, written down from the
// table, and what is one step worse.
#include "vk_harness/limits/required_limits.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

namespace vk_harness {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr uint32_t k1_3 = VK_MAKE_API_VERSION(0, 1, 3, 0), k1_4 = VK_MAKE_API_VERSION(0, 1, 4, 0);

// Of Vulkan 1.0 to 1.3, without any optional feature.
VkPhysicalDeviceLimits barest() {
    VkPhysicalDeviceLimits l{};
    l.maxImageDimension2D = 4096;
    l.maxImageArrayLayers = 256;
    l.maxStorageBufferRange = 1U << 27;
    l.maxPushConstantsSize = 128;
    l.bufferImageGranularity = 131072;
    l.maxVertexInputAttributes = 16;
    l.maxVertexInputBindings = 16;
    l.maxVertexInputAttributeOffset = 2047;
    l.maxVertexInputBindingStride = 2048;
    l.maxVertexOutputComponents = 64;
    l.maxFragmentInputComponents = 64;
    l.maxFragmentOutputAttachments = 4;
    l.maxFragmentCombinedOutputResources = 4;
    l.subPixelPrecisionBits = 4;
    l.subTexelPrecisionBits = 4;
    l.mipmapPrecisionBits = 4;
    l.maxDrawIndexedIndexValue = (1U << 24) - 1;
    l.maxDrawIndirectCount = 1;
    l.maxSamplerLodBias = 2;
    l.maxSamplerAnisotropy = 1;
    l.maxViewports = 1;
    l.maxViewportDimensions[0] = l.maxViewportDimensions[1] = 4096;
    l.viewportBoundsRange[0] = -8192;
    l.viewportBoundsRange[1] = 8191;
    l.minStorageBufferOffsetAlignment = 256;
    l.maxFramebufferWidth = l.maxFramebufferHeight = 4096;
    l.maxFramebufferLayers = 256;
    l.framebufferColorSampleCounts = l.framebufferDepthSampleCounts =
        l.framebufferStencilSampleCounts = l.framebufferNoAttachmentsSampleCounts =
            l.sampledImageColorSampleCounts = l.sampledImageDepthSampleCounts =
                l.sampledImageStencilSampleCounts = VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT;
    l.sampledImageIntegerSampleCounts = VK_SAMPLE_COUNT_1_BIT;
    l.maxColorAttachments = 4;
    l.maxSampleMaskWords = 1;
    return l;
}

std::vector<std::string> names_of(const std::vector<WrongLimit>& wrong) {
    std::vector<std::string> names;
    for (const WrongLimit& limit : wrong) {
        names.push_back(limit.name);
    }
    return names;
}
std::vector<std::string> wrong_names(const VkPhysicalDeviceLimits& l,
                                     const VkPhysicalDeviceFeatures& f = {},
                                     uint32_t version = k1_3, bool is_subset = false) {
    return names_of(wrong_limits(l, f, version, is_subset));
}

TEST(RequiredLimits, TheBarestDeviceMeetsThem) {
    EXPECT_THAT(wrong_names(barest()), IsEmpty());
}

TEST(RequiredLimits, OneStepWorseIsWrong) {
    using Spoil = std::function<void(VkPhysicalDeviceLimits&)>;
#define LESS(member)                                              \
    {                                                             \
        #member, [](VkPhysicalDeviceLimits& l) { l.member -= 1; } \
    }
#define MORE(member)                                              \
    {                                                             \
        #member, [](VkPhysicalDeviceLimits& l) { l.member += 1; } \
    }
#define ONE_SAMPLE(member)                                                            \
    {                                                                                 \
        #member, [](VkPhysicalDeviceLimits& l) { l.member ^= VK_SAMPLE_COUNT_4_BIT; } \
    }
    const std::vector<std::pair<std::string, Spoil>> kSpoils = {
        LESS(maxImageDimension2D),
        LESS(maxImageArrayLayers),
        LESS(maxStorageBufferRange),
        LESS(maxPushConstantsSize),
        MORE(bufferImageGranularity),
        LESS(maxVertexInputAttributes),
        LESS(maxVertexInputBindings),
        LESS(maxVertexInputAttributeOffset),
        LESS(maxVertexInputBindingStride),
        LESS(maxVertexOutputComponents),
        LESS(maxFragmentInputComponents),
        LESS(maxFragmentOutputAttachments),
        LESS(maxFragmentCombinedOutputResources),
        LESS(subPixelPrecisionBits),
        LESS(subTexelPrecisionBits),
        LESS(mipmapPrecisionBits),
        LESS(maxDrawIndexedIndexValue),
        LESS(maxDrawIndirectCount),
        LESS(maxSamplerLodBias),
        LESS(maxSamplerAnisotropy),
        LESS(maxViewports),
        LESS(maxViewportDimensions[0]),
        LESS(maxViewportDimensions[1]),
        MORE(viewportBoundsRange[0]),
        LESS(viewportBoundsRange[1]),
        MORE(minStorageBufferOffsetAlignment),
        LESS(maxFramebufferWidth),
        LESS(maxFramebufferHeight),
        LESS(maxFramebufferLayers),
        ONE_SAMPLE(framebufferColorSampleCounts),
        ONE_SAMPLE(framebufferDepthSampleCounts),
        ONE_SAMPLE(framebufferStencilSampleCounts),
        ONE_SAMPLE(framebufferNoAttachmentsSampleCounts),
        LESS(maxColorAttachments),
        ONE_SAMPLE(sampledImageColorSampleCounts),
        LESS(sampledImageIntegerSampleCounts),
        ONE_SAMPLE(sampledImageDepthSampleCounts),
        ONE_SAMPLE(sampledImageStencilSampleCounts),
        LESS(maxSampleMaskWords),
    };
    for (const auto& [name, spoil] : kSpoils) {
        VkPhysicalDeviceLimits l = barest();
        spoil(l);
        EXPECT_THAT(wrong_names(l), ElementsAre(name));
    }
}

TEST(RequiredLimits, OptionalFeaturesRequireMore) {
    VkPhysicalDeviceFeatures f{};
    for (VkBool32* feature : {&f.geometryShader, &f.dualSrcBlend, &f.fullDrawIndexUint32,
                              &f.multiDrawIndirect, &f.samplerAnisotropy, &f.multiViewport,
                              &f.sampleRateShading, &f.shaderClipDistance, &f.shaderCullDistance}) {
        *feature = VK_TRUE;
    }
    VkPhysicalDeviceLimits l = barest();
    EXPECT_THAT(
        wrong_names(l, f),
        ElementsAre("maxGeometryShaderInvocations", "maxGeometryInputComponents",
                    "maxGeometryOutputComponents", "maxGeometryOutputVertices",
                    "maxGeometryTotalOutputComponents", "maxFragmentDualSrcAttachments",
                    "maxDrawIndexedIndexValue", "maxDrawIndirectCount", "maxSamplerAnisotropy",
                    "maxViewports", "minInterpolationOffset", "maxInterpolationOffset",
                    "subPixelInterpolationOffsetBits", "maxClipDistances", "maxCullDistances",
                    "maxCombinedClipAndCullDistances"));
    l.maxGeometryShaderInvocations = 32;
    l.maxGeometryInputComponents = l.maxGeometryOutputComponents = 64;
    l.maxGeometryOutputVertices = 256;
    l.maxGeometryTotalOutputComponents = 1024;
    l.maxFragmentDualSrcAttachments = 1;
    l.maxDrawIndexedIndexValue = ~0U;
    l.maxDrawIndirectCount = (1U << 16) - 1;
    l.maxSamplerAnisotropy = 16;
    l.maxViewports = 16;
    l.minInterpolationOffset = -0.5F;
    l.maxInterpolationOffset = 0.4375F;  // 0.5 - 2^-4
    l.subPixelInterpolationOffsetBits = 4;
    l.maxClipDistances = l.maxCullDistances = l.maxCombinedClipAndCullDistances = 8;
    EXPECT_THAT(wrong_names(l, f), IsEmpty());
    l.subPixelInterpolationOffsetBits = 5;  // 0.46875 is required of it
    ASSERT_THAT(wrong_names(l, f), ElementsAre("maxInterpolationOffset"));
    EXPECT_EQ(wrong_limits(l, f, k1_3, false)[0].required, "at least 0.46875");
}

TEST(RequiredLimits, Vulkan14RequiresMore) {
    const std::vector<std::string> found = wrong_names(barest(), {}, k1_4);
    EXPECT_THAT(
        found,
        ElementsAre("maxImageDimension2D", "maxImageArrayLayers", "maxPushConstantsSize",
                    "bufferImageGranularity", "maxFragmentCombinedOutputResources",
                    "subTexelPrecisionBits", "mipmapPrecisionBits", "maxSamplerLodBias",
                    "maxViewportDimensions[0]", "maxViewportDimensions[1]",
                    "viewportBoundsRange[0]", "viewportBoundsRange[1]", "maxFramebufferWidth",
                    "maxFramebufferHeight", "maxColorAttachments", "standardSampleLocations"));
    VkPhysicalDeviceLimits l = barest();
    l.maxImageDimension2D = 8192;
    l.maxImageArrayLayers = 2048;
    l.maxPushConstantsSize = 256;
    l.bufferImageGranularity = 4096;
    l.maxFragmentCombinedOutputResources = 16;
    l.subTexelPrecisionBits = 8;
    l.mipmapPrecisionBits = 6;
    l.maxSamplerLodBias = 14;
    l.maxViewportDimensions[0] = l.maxViewportDimensions[1] = 7680;
    l.viewportBoundsRange[0] = -15360;
    l.viewportBoundsRange[1] = 15359;
    l.maxFramebufferWidth = l.maxFramebufferHeight = 7680;
    l.maxColorAttachments = 8;
    l.standardSampleLocations = VK_TRUE;
    EXPECT_THAT(wrong_names(l, {}, k1_4), IsEmpty());
    // Another variant is no Vulkan 1.4.
    EXPECT_THAT(wrong_names(barest(), {}, VK_MAKE_API_VERSION(1, 1, 4, 0)), IsEmpty());
}

TEST(RequiredLimits, ASubsetNeedsFewerBindings) {
    VkPhysicalDeviceLimits l = barest();
    l.maxVertexInputBindings = 8;
    EXPECT_THAT(wrong_names(l, {}, k1_3, true), IsEmpty());
    l.maxVertexInputBindings = 7;
    EXPECT_THAT(wrong_names(l, {}, k1_3, true), ElementsAre("maxVertexInputBindings"));
}

TEST(RequiredLimits, ViewportsGoWithTargetsAndRangesWithViewports) {
    VkPhysicalDeviceLimits l = barest();
    l.maxFramebufferWidth = 16384;
    EXPECT_THAT(wrong_names(l), IsEmpty());  // there is no image that large
    l.maxImageDimension2D = 8192;
    EXPECT_THAT(wrong_names(l), ElementsAre("maxViewportDimensions[0]"));
    l.maxViewportDimensions[0] = 8192;
    EXPECT_THAT(wrong_names(l), ElementsAre("viewportBoundsRange[0]", "viewportBoundsRange[1]"));
    l.viewportBoundsRange[0] = -16384;
    l.viewportBoundsRange[1] = 16383;
    EXPECT_THAT(wrong_names(l), IsEmpty());
}

TEST(RequiredLimits, NaNMeetsNothingAndInfinityWhatIsLess) {
    VkPhysicalDeviceLimits l = barest();
    l.viewportBoundsRange[0] = -INFINITY;
    l.viewportBoundsRange[1] = INFINITY;
    EXPECT_THAT(wrong_names(l), IsEmpty());
    l.viewportBoundsRange[0] = NAN;
    l.viewportBoundsRange[1] = -INFINITY;
    l.maxSamplerLodBias = NAN;
    const std::vector<WrongLimit> wrong = wrong_limits(l, {}, k1_3, false);
    ASSERT_THAT(names_of(wrong), ElementsAre("maxSamplerLodBias", "viewportBoundsRange[0]",
                                             "viewportBoundsRange[1]"));
    EXPECT_EQ(wrong[1].claimed, "nan");
    EXPECT_EQ(wrong[2].claimed, "-inf");
}

}  // namespace
}  // namespace vk_harness
