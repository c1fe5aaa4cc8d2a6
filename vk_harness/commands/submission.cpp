// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/submission.hpp"

#include <algorithm>

#include "vk_harness/memory/barrier.hpp"

namespace vk_harness {

Submission::Submission(const Device& device) : device_(&device) {
    const VolkDeviceTable& vk = device.vk();
    VkCommandPoolCreateInfo pool_info = Typed{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool_info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool_info.queueFamilyIndex = device.capabilities().queue_family;
    pool_ = make(device, Stage::device, "vkCreateCommandPool", vk.vkCreateCommandPool,
                 vk.vkDestroyCommandPool, pool_info);
    const VkFenceCreateInfo fence_info = Typed{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    fence_ = make(device, Stage::device, "vkCreateFence", vk.vkCreateFence, vk.vkDestroyFence,
                  fence_info);
}

Buffer& Submission::grow(Buffer& buffer, VkDeviceSize size, VkBufferUsageFlags usage,
                         HostAccess access) {
    if (buffer.size() < size) {
        constexpr VkDeviceSize kSmallest = 1U << 16;
        constexpr VkDeviceSize kLargestStep = 1U << 26;
        // Memory is taken where it is written to; growing step by step would take it again.
        const VkDeviceSize enough = std::clamp(2 * buffer.size(), kSmallest, kLargestStep);
        buffer = Buffer();  // frees the old one first
        buffer = Buffer::create(*device_, std::max(size, enough), usage, access);
    }
    return buffer;
}

Buffer& Submission::vertices(VkDeviceSize size) {
    return grow(vertices_, size,
                VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                    VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                HostAccess::write);
}

Buffer& Submission::readback(VkDeviceSize size) {
    return grow(readback_, size,
                VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                HostAccess::read);
}

VkBuffer Submission::pattern() {
    if (pattern_.size() == 0) {
        pattern_ = Buffer::create(*device_, kMostSurroundings, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                  HostAccess::write);
        std::ranges::fill(pattern_.bytes(), kSurrounding);
        pattern_.flush();
    }
    return pattern_.get();
}

void Submission::trim(VkDeviceSize limit) {
    if (vertices_.size() > limit) {
        vertices_ = Buffer();
    }
    if (readback_.size() > limit) {
        readback_ = Buffer();
    }
}

VkCommandBuffer Submission::begin(bool may_repeat) {
    const VolkDeviceTable& vk = device_->vk();
    descriptor_pools_.clear();
    used_secondaries_ = 0;
    check(Stage::submit, vk.vkResetCommandPool(device_->get(), pool_.get(), 0),
          "vkResetCommandPool");
    used_primaries_ = 0;
    return begin_next(may_repeat);
}

VkCommandBuffer Submission::begin_next(bool may_repeat) {
    allocate(primaries_, used_primaries_ + 1, VK_COMMAND_BUFFER_LEVEL_PRIMARY);
    commands_ = primaries_[used_primaries_++];
    VkCommandBufferBeginInfo info = Typed{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    info.flags = may_repeat ? 0U : uint32_t{VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(Stage::submit, device_->vk().vkBeginCommandBuffer(commands_, &info),
          "vkBeginCommandBuffer");
    return commands_;
}

VkCommandBuffer Submission::next() {
    end();
    submit(VK_NULL_HANDLE);
    return begin_next();
}

void Submission::allocate(std::vector<VkCommandBuffer>& buffers, size_t count,
                          VkCommandBufferLevel level) {
    if (buffers.size() >= count) {
        return;
    }
    std::vector<VkCommandBuffer> more(count - buffers.size());
    VkCommandBufferAllocateInfo info = Typed{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool_.get();
    info.level = level;
    info.commandBufferCount = static_cast<uint32_t>(more.size());
    check(Stage::submit, device_->vk().vkAllocateCommandBuffers(device_->get(), &info, more.data()),
          "vkAllocateCommandBuffers");
    buffers.insert(buffers.end(), more.begin(), more.end());
}

std::vector<VkCommandBuffer> Submission::secondaries(size_t count) {
    const size_t first = used_secondaries_;
    allocate(secondaries_, first + count, VK_COMMAND_BUFFER_LEVEL_SECONDARY);
    used_secondaries_ += count;
    const auto begin = secondaries_.begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<VkCommandBuffer>(begin, begin + static_cast<std::ptrdiff_t>(count));
}

void Submission::end() {
    check(Stage::submit, device_->vk().vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
}

void Submission::submit(VkFence fence) {
    const VolkDeviceTable& vk = device_->vk();
    VkSubmitInfo info = Typed{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    check(Stage::submit, vk.vkQueueSubmit(device_->queue(), 1, &info, fence), "vkQueueSubmit");
}

void Submission::run() {
    memory_barrier(*device_, commands_,
                   {VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                        VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                    VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                   {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    end();
    repeat();
}

void Submission::repeat() {
    const VolkDeviceTable& vk = device_->vk();
    submit(fence_.get());
    // A hang is ended from outside, where the worker has a time limit; should nobody do so, the
    // wait ends all the same, later.
    const VkFence fence = fence_.get();
    check(Stage::submit,
          vk.vkWaitForFences(device_->get(), 1, &fence, VK_TRUE, device_->longest_wait()),
          "vkWaitForFences");
    check(Stage::submit, vk.vkResetFences(device_->get(), 1, &fence), "vkResetFences");
}

std::vector<VkDescriptorSet> Submission::sets(VkDescriptorType read, VkDescriptorSetLayout layout,
                                              size_t count) {
    DescriptorSets made = make_sets(*device_, {read, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}, layout,
                                    static_cast<uint32_t>(count));
    descriptor_pools_.push_back(std::move(made.pool));
    return std::move(made.sets);
}

VkDescriptorBufferInfo Submission::samples_of(const CasePlan& plan, size_t attachment) const {
    const cases::Target& target = plan.test->target;
    const VkDeviceSize samples = VkDeviceSize{target.width} * target.rows() * target.samples;
    return {readback_.get(), plan.readback.offset[attachment],
            samples * plan.attachments[attachment].sample_bytes};
}

std::vector<VkDescriptorSet> Submission::copy_sets(const PipelineCache& pipelines,
                                                   const CasePlan& plan) {
    constexpr VkDescriptorType kRead = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    std::vector<VkDescriptorSet> out =
        sets(kRead, pipelines.layouts().copy_set.get(), plan.images.size());
    for (size_t k = 0; k < plan.images.size(); ++k) {
        if (plan.attachments[k].is_resolved() || plan.attachments[k].is_input) {
            continue;  // copied, or read by another shader
        }
        const bool is_stencil = plan.attachments[k].role == Role::stencil;
        DescriptorWrites writes;
        writes.add(out[k], 0, kRead,
                   {VK_NULL_HANDLE,
                    is_stencil ? plan.images[k]->stencil_view() : plan.images[k]->sample_view(),
                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
        writes.add(out[k], 1, samples_of(plan, k));
        writes.write(*device_);
    }
    return out;
}

void Submission::make_input_sets(const PipelineCache& pipelines, CasePlan& plan) {
    if (plan.inputs.empty()) {
        return;
    }
    constexpr VkDescriptorType kRead = VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT;
    const std::vector<VkDescriptorSet> made =
        sets(kRead, pipelines.layouts().input_set.get(), plan.inputs.size());
    DescriptorWrites writes;
    for (size_t n = 0; n < plan.inputs.size(); ++n) {
        InputRead& input = plan.inputs[n];
        input.set = made[n];
        const VkImageAspectFlags aspect = plan.attachments[input.attachment].aspect();
        writes.add(input.set, 0, kRead,
                   {VK_NULL_HANDLE, plan.images[input.attachment]->input_view(aspect),
                    input_layout(aspect)});
        writes.add(input.set, 1, samples_of(plan, input.attachment));
    }
    writes.write(*device_);
}

}  // namespace vk_harness
