// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the harness does with a driver that fails: single entry points of a real device are
// replaced.
#include <gmock/gmock.h>

#include <algorithm>

#include "hand_case.hpp"
#include "vk_harness/batch_renderer.hpp"

namespace vk_harness::testing {
namespace {

// A renderer whose device functions a test may replace.
struct Faulty {
    // The table is an ordinary object of the device, const only to the harness.
    VolkDeviceTable& vk() { return const_cast<VolkDeviceTable&>(body->device().vk()); }
    Rendered render(const cases::Case& c) {
        const std::vector<cases::Case> batch = {c};
        return body->render(batch, true, [](std::string_view) {}).front();
    }

    std::unique_ptr<BatchRenderer> body = std::make_unique<BatchRenderer>(Options{});
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

TEST(Fault, NoMemoryForATargetIsAnError) {
    Faulty faulty;
    const auto allocate = faulty.vk().vkAllocateMemory;
    faulty.vk().vkAllocateMemory = [](VkDevice, const VkMemoryAllocateInfo*,
                                      const VkAllocationCallbacks*,
                                      VkDeviceMemory*) { return VK_ERROR_OUT_OF_DEVICE_MEMORY; };
    const Rendered failed = faulty.render(half());
    EXPECT_EQ(failed.status, Rendered::Status::error);
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

// A device that writes a word of its own beside an attachment at the end of a rendering. The guards
// are what the harness fills: two buffers an attachment, before and after it.
struct StrayDevice {
    static inline PFN_vkCmdFillBuffer fill = nullptr;
    static inline PFN_vkCmdEndRendering end = nullptr;
    static inline std::vector<VkBuffer> guards;
    static inline size_t damaged = 0;  // number of the guard
    static inline VkDeviceSize offset = 0;
    static inline VkDeviceSize bytes = 4;
    static inline int renderings_until = 0;  // the damage is done; below 0: never

    explicit StrayDevice(Faulty& faulty) {
        guards.clear();
        renderings_until = -1;
        fill = faulty.vk().vkCmdFillBuffer;
        end = faulty.vk().vkCmdEndRendering;
        faulty.vk().vkCmdFillBuffer = [](VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize at,
                                         VkDeviceSize size, uint32_t word) {
            if (std::find(guards.begin(), guards.end(), buffer) == guards.end()) {
                guards.push_back(buffer);
            }
            fill(commands, buffer, at, size, word);
        };
        faulty.vk().vkCmdEndRendering = [](VkCommandBuffer commands) {
            end(commands);
            if (renderings_until >= 0 && renderings_until-- == 0) {
                fill(commands, guards.at(damaged), offset, bytes, 0x12345678U);
            }
        };
    }
    static void damage(size_t guard, VkDeviceSize at, int after_renderings = 0,
                       VkDeviceSize size = 4) {
        damaged = guard;
        offset = at;
        bytes = size;
        renderings_until = after_renderings;
    }
};

TEST(Fault, WhatIsWrittenBesideAnAttachmentIsSeen) {
    Faulty faulty;
    StrayDevice device(faulty);
    const Rendered clean = faulty.render(half());
    ASSERT_EQ(clean.status, Rendered::Status::drawn);
    EXPECT_TRUE(clean.stray_writes.empty());
    ASSERT_GE(device.guards.size(), 4U);
    EXPECT_EQ(device.guards.size() % 2, 0U);

    const size_t last = device.guards.size() - 1;
    StrayDevice::damage(last, 8);
    const Rendered after = faulty.render(half());
    EXPECT_EQ(after.status, Rendered::Status::drawn);
    ASSERT_EQ(after.stray_writes.size(), 1U);
    EXPECT_EQ(after.stray_writes[0],
              (capture::StrayWrite{"depth", false, 8, kGuardWord, 0x12345678U, 1, 1}));

    StrayDevice::damage(0, kGuardBytes - 12);
    const Rendered before = faulty.render(half());
    ASSERT_EQ(before.stray_writes.size(), 1U);
    EXPECT_EQ(before.stray_writes[0],
              (capture::StrayWrite{"writer", true, 12, kGuardWord, 0x12345678U, 1, 1}));

    EXPECT_TRUE(faulty.render(half()).stray_writes.empty());  // the pattern is there again
    EXPECT_EQ(device.guards.size(), last + 1);
}

// A clear of one more column changes texels beside the attachment, in each image that is looked at
// and not too large for it.
TEST(Fault, TexelsBesideAnAttachmentAreSeen) {
    using cases::Door;
    Faulty faulty;
    cases::Case c = half();
    for (const Door door : {Door::target_larger, Door::target_last_tile, Door::image_layer,
                            Door::image_level, Door::multiview}) {
        c.variation.door = door;
        const Rendered clean = faulty.render(c);
        if (clean.status != Rendered::Status::unsupported) {
            EXPECT_EQ(clean.status, Rendered::Status::drawn) << clean.reason;
            EXPECT_TRUE(clean.stray_writes.empty());
        }
    }
    c.variation.door = Door::target_larger;
    static PFN_vkCmdBeginRendering begin;
    begin = faulty.vk().vkCmdBeginRendering;
    faulty.vk().vkCmdBeginRendering = [](VkCommandBuffer commands, const VkRenderingInfo* info) {
        VkRenderingInfo wider = *info;
        ++wider.renderArea.extent.width;
        begin(commands, &wider);
    };
    const Rendered wider = faulty.render(c);
    faulty.vk().vkCmdBeginRendering = begin;
    ASSERT_EQ(wider.status, Rendered::Status::drawn) << wider.reason;
    ASSERT_EQ(wider.stray_writes.size(), 2U);
    EXPECT_EQ(wider.stray_writes[0].attachment, "hits");
    EXPECT_EQ(wider.stray_writes[1].attachment, "depth");
    for (const capture::StrayWrite& write : wider.stray_writes) {
        EXPECT_EQ(write.texel, "(32, 0) of layer 0, level 0");
        EXPECT_EQ(write.expected, 0x3a3a3a3aU);
        EXPECT_NE(write.got, write.expected);
        EXPECT_EQ(write.words, 32U);
    }
    EXPECT_TRUE(faulty.render(c).stray_writes.empty());
}

// Of several words the one next to the attachment is told, and how many there are.
TEST(Fault, OfSeveralWordsTheNearestIsTold) {
    Faulty faulty;
    StrayDevice device(faulty);
    ASSERT_EQ(faulty.render(half()).status, Rendered::Status::drawn);
    StrayDevice::damage(device.guards.size() - 1, 20, 0, 12);
    const Rendered after = faulty.render(half());
    ASSERT_EQ(after.stray_writes.size(), 1U);
    EXPECT_EQ(after.stray_writes[0].distance, 20U);
    EXPECT_EQ(after.stray_writes[0].words, 3U);
    StrayDevice::damage(0, kGuardBytes - 20, 0, 12);
    const Rendered before = faulty.render(half());
    ASSERT_EQ(before.stray_writes.size(), 1U);
    EXPECT_EQ(before.stray_writes[0].distance, 12U);
    EXPECT_EQ(before.stray_writes[0].words, 3U);
}

TEST(Fault, BesideAnAttachmentTheRenderingThatDidItIsFound) {
    Faulty faulty;
    StrayDevice device(faulty);
    const std::vector<cases::Case> batch = {half(), make_case({16, 16, 1}, half_square()),
                                            make_case({32, 32, 1}, half_square())};
    const auto render = [&] { return faulty.body->render(batch, true, [](std::string_view) {}); };
    for (const Rendered& r : render()) {
        EXPECT_EQ(r.status, Rendered::Status::drawn);
        EXPECT_TRUE(r.stray_writes.empty());
    }
    // Once only: drawn alone none of them does it, so those that use the attachment are told.
    StrayDevice::damage(1, 0, 2);
    const std::vector<Rendered> once = render();
    ASSERT_EQ(once[0].stray_writes.size(), 1U);
    EXPECT_EQ(once[0].stray_writes[0].renderings, 3U);
    EXPECT_TRUE(once[1].stray_writes.empty());
    EXPECT_EQ(once[2].stray_writes, once[0].stray_writes);
    for (const Rendered& r : render()) {
        EXPECT_TRUE(r.stray_writes.empty());
    }
    // Every submission's only or third rendering: the second case's attachments, by whoever.
    faulty.vk().vkCmdEndRendering = [](VkCommandBuffer commands) {
        StrayDevice::end(commands);
        StrayDevice::fill(commands, StrayDevice::guards[1], 0, 4, 0x12345678U);
    };
    const std::vector<Rendered> each = render();
    ASSERT_EQ(each[0].stray_writes.size(), 1U);
    EXPECT_EQ(each[0].stray_writes[0].renderings, 1U);
    EXPECT_TRUE(each[1].stray_writes.empty());  // alone it is not its attachment
    EXPECT_EQ(each[2].stray_writes.size(), 1U);
}

TEST(Fault, GuardsThatAreNotCopiedAreAnError) {
    Faulty faulty;
    faulty.vk().vkCmdCopyBuffer = [](VkCommandBuffer, VkBuffer, VkBuffer, uint32_t,
                                     const VkBufferCopy*) {};
    const Rendered rendered = faulty.render(half());
    EXPECT_EQ(rendered.status, Rendered::Status::error);
    EXPECT_THAT(rendered.reason,
                ::testing::StartsWith("readback: the memory beside an attachment was not copied"));
}

TEST(Guard, PlacesAreCloseAndAligned) {
    const VkMemoryRequirements image{1000, 64, 1};
    const VkMemoryRequirements buffer{kGuardBytes, 16, 1};
    const GuardPlaces close = place_guards(image, buffer, 1);
    EXPECT_EQ(close.before, 0U);
    EXPECT_EQ(close.image, kGuardBytes);
    EXPECT_EQ(close.after, kGuardBytes + 1008);
    EXPECT_EQ(close.size, close.after + kGuardBytes);
    // Linear and optimal resources never share a page of bufferImageGranularity.
    const GuardPlaces far = place_guards({1000, 65536, 1}, buffer, 16384);
    EXPECT_EQ(far.image, 65536U);
    EXPECT_EQ(far.before, 65536U - kGuardBytes);
    EXPECT_EQ(far.after, 65536U + 16384U);
    const GuardPlaces paged = place_guards(image, buffer, 16384);
    EXPECT_EQ(paged.image, 16384U);
    EXPECT_EQ(paged.before, 16384U - kGuardBytes);
    EXPECT_EQ(paged.after, 32768U);
}

}  // namespace
}  // namespace vk_harness::testing
