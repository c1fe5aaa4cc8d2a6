// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the harness does with a driver that fails: single entry points of a real device are
// replaced.
#include <gmock/gmock.h>

#include "hand_case.hpp"
#include "vk_harness/renderer.hpp"

namespace vk_harness::testing {
namespace {

// A renderer whose device functions a test may replace.
struct Faulty {
    Faulty() {
        auto made = BatchRenderer::create({});
        if (!made) {
            throw std::runtime_error(made.error().message);
        }
        body = std::make_unique<BatchRenderer>(std::move(*made));
    }
    // The table is an ordinary object of the device, const only to the harness.
    VolkDeviceTable& vk() { return const_cast<VolkDeviceTable&>(body->device().vk()); }
    Rendered render(const cases::Case& c) {
        const std::vector<cases::Case> batch = {c};
        return body->render(batch, true, [](std::string_view) {}).front();
    }

    std::unique_ptr<BatchRenderer> body;
};

cases::Case half() {
    return make_case({32, 32, 1}, half_square());
}

TEST(Fault, LostAtSubmitStaysLost) {
    Faulty faulty;
    ASSERT_EQ(faulty.render(half()).status, Rendered::Status::drawn);
    const auto submit = faulty.vk().vkQueueSubmit;
    faulty.vk().vkQueueSubmit = [](VkQueue, uint32_t, const VkSubmitInfo*, VkFence) {
        return VK_ERROR_DEVICE_LOST;
    };
    const Rendered lost = faulty.render(half());
    EXPECT_EQ(lost.status, Rendered::Status::device_lost);
    EXPECT_EQ(lost.reason, "submit: vkQueueSubmit failed with VK_ERROR_DEVICE_LOST");
    faulty.vk().vkQueueSubmit = submit;
    const Rendered after = faulty.render(half());
    EXPECT_EQ(after.status, Rendered::Status::device_lost);
    EXPECT_EQ(after.reason,
              "the device was lost before: vkQueueSubmit failed with VK_ERROR_DEVICE_LOST");
}

TEST(Fault, LostWhileWaiting) {
    Faulty faulty;
    faulty.vk().vkWaitForFences = [](VkDevice, uint32_t, const VkFence*, VkBool32, uint64_t) {
        return VK_ERROR_DEVICE_LOST;
    };
    const Rendered lost = faulty.render(half());
    EXPECT_EQ(lost.status, Rendered::Status::device_lost);
    EXPECT_EQ(lost.reason, "submit: vkWaitForFences failed with VK_ERROR_DEVICE_LOST");
}

TEST(Fault, FailedSubmitIsAnErrorAndPasses) {
    Faulty faulty;
    const auto submit = faulty.vk().vkQueueSubmit;
    faulty.vk().vkQueueSubmit = [](VkQueue, uint32_t, const VkSubmitInfo*, VkFence) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    };
    const Rendered failed = faulty.render(half());
    EXPECT_EQ(failed.status, Rendered::Status::error);
    EXPECT_EQ(failed.reason, "submit: vkQueueSubmit failed with VK_ERROR_OUT_OF_HOST_MEMORY");
    faulty.vk().vkQueueSubmit = submit;
    EXPECT_EQ(count(faulty.render(half()).capture).back, 136U);
}

TEST(Fault, NoMemoryForATargetIsUnsupported) {
    Faulty faulty;
    const auto allocate = faulty.vk().vkAllocateMemory;
    faulty.vk().vkAllocateMemory = [](VkDevice, const VkMemoryAllocateInfo*,
                                      const VkAllocationCallbacks*,
                                      VkDeviceMemory*) { return VK_ERROR_OUT_OF_DEVICE_MEMORY; };
    const Rendered failed = faulty.render(half());
    EXPECT_EQ(failed.status, Rendered::Status::unsupported);
    EXPECT_THAT(failed.reason, ::testing::StartsWith("memory: vkAllocateMemory failed with "
                                                     "VK_ERROR_OUT_OF_DEVICE_MEMORY for "));
    faulty.vk().vkAllocateMemory = allocate;
    EXPECT_EQ(count(faulty.render(half()).capture).back, 136U);
}

TEST(Fault, FailedPipelineIsAnErrorOfItsCase) {
    Faulty faulty;
    faulty.vk().vkCreateGraphicsPipelines =
        [](VkDevice, VkPipelineCache, uint32_t, const VkGraphicsPipelineCreateInfo*,
           const VkAllocationCallbacks*, VkPipeline*) { return VK_ERROR_UNKNOWN; };
    const Rendered failed = faulty.render(half());
    EXPECT_EQ(failed.status, Rendered::Status::error);
    EXPECT_EQ(failed.reason, "pipeline: vkCreateGraphicsPipelines failed with VK_ERROR_UNKNOWN");
}

TEST(Fault, WhatIsNotCopiedIsSeen) {
    Faulty faulty;
    ASSERT_EQ(faulty.render(half()).status, Rendered::Status::drawn);  // leaves old results behind
    faulty.vk().vkCmdCopyImageToBuffer = [](VkCommandBuffer, VkImage, VkImageLayout, VkBuffer,
                                            uint32_t, const VkBufferImageCopy*) {};
    const Rendered rendered = faulty.render(half());
    ASSERT_EQ(rendered.status, Rendered::Status::drawn);
    EXPECT_EQ(count(rendered.capture).not_copied, 32U * 32U);
}

TEST(Fault, WhatIsNotDrawnIsClear) {
    Faulty faulty;
    ASSERT_EQ(faulty.render(half()).status, Rendered::Status::drawn);
    faulty.vk().vkCmdDraw = [](VkCommandBuffer, uint32_t, uint32_t, uint32_t, uint32_t) {};
    EXPECT_EQ(count(faulty.render(half()).capture).clear, 32U * 32U);
}

}  // namespace
}  // namespace vk_harness::testing
