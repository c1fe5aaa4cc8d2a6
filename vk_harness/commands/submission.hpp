// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "vk_harness/commands/case_plan.hpp"

namespace vk_harness {

// Commands and memory of one submission, reused by the next.
class Submission {
  public:
    explicit Submission(const Device& device);

    // The vertex buffer of at least `size` bytes; the read-back buffer likewise.
    Buffer& vertices(VkDeviceSize size);
    Buffer& readback(VkDeviceSize size);
    // Frees buffers larger than `limit` bytes.
    void trim(VkDeviceSize limit);

    // `may_repeat`: it may be submitted again.
    VkCommandBuffer begin(bool may_repeat = false);
    // Ends recording, submits, and begins another command buffer, which is executed after it.
    VkCommandBuffer next();
    // Secondary command buffers that are in no use since the last begin().
    std::vector<VkCommandBuffer> secondaries(size_t count);
    // Ends recording, submits, and waits until the device has finished.
    void run();
    // Submits the same once more, and waits.
    void repeat();

    // kMostSurroundings bytes of kSurrounding, to copy from.
    VkBuffer pattern();

    // Descriptor sets for copying the samples of one case; they live until the next begin().
    std::vector<VkDescriptorSet> copy_sets(const PipelineCache& pipelines, const CasePlan& plan);
    // The same for reading its input attachments, into the plan.
    void make_input_sets(const PipelineCache& pipelines, CasePlan& plan);

  private:
    // `count` sets of that layout: what is read, and where it goes.
    std::vector<VkDescriptorSet> sets(VkDescriptorType read, VkDescriptorSetLayout layout,
                                      size_t count);
    // The place of an attachment in the read-back buffer.
    VkDescriptorBufferInfo samples_of(const CasePlan& plan, size_t attachment) const;
    Buffer& grow(Buffer& buffer, VkDeviceSize size, VkBufferUsageFlags usage, HostAccess access);

    // Makes them `count` command buffers at least.
    void allocate(std::vector<VkCommandBuffer>& buffers, size_t count, VkCommandBufferLevel level);
    // Begins a primary command buffer that is in no use since the last begin().
    VkCommandBuffer begin_next(bool may_repeat = false);
    void end();  // recording
    void submit(VkFence fence);

    const Device* device_;
    Handle<VkCommandPool> pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;             // that is recorded
    std::vector<VkCommandBuffer> primaries_, secondaries_;  // owned by the pool
    size_t used_primaries_ = 0, used_secondaries_ = 0;      // since the last begin()
    Handle<VkFence> fence_;
    std::vector<Handle<VkDescriptorPool>> descriptor_pools_;
    Buffer vertices_;
    Buffer readback_;
    Buffer pattern_;
};

}  // namespace vk_harness
