// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "vk_harness/memory/barrier.hpp"
#include "vk_harness/renderer.hpp"

namespace vk_harness {

Result<Submission> Submission::create(const Device& device) {
    const VolkDeviceTable& vk = device.vk();
    Submission submission(device);
    VkCommandPoolCreateInfo pool_info = Typed{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool_info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool_info.queueFamilyIndex = device.capabilities().queue_family;
    if (auto made =
            put(submission.pool_, make(device, Stage::device, "vkCreateCommandPool",
                                       vk.vkCreateCommandPool, vk.vkDestroyCommandPool, pool_info));
        !made) {
        return fail(made.error());
    }
    VkFenceCreateInfo fence_info = Typed{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    if (auto made = put(submission.fence_, make(device, Stage::device, "vkCreateFence",
                                                vk.vkCreateFence, vk.vkDestroyFence, fence_info));
        !made) {
        return fail(made.error());
    }
    return submission;
}

Result<Buffer*> Submission::grow(Buffer& buffer, VkDeviceSize size, VkBufferUsageFlags usage,
                                 HostAccess access) {
    if (buffer.size() < size) {
        constexpr VkDeviceSize kSmallest = 1U << 16;
        constexpr VkDeviceSize kLargestStep = 1U << 26;
        // Memory is taken where it is written to; growing step by step would take it again.
        const VkDeviceSize enough = std::clamp(2 * buffer.size(), kSmallest, kLargestStep);
        buffer = Buffer();  // frees the old one first
        if (auto made =
                put(buffer, Buffer::create(*device_, std::max(size, enough), usage, access));
            !made) {
            return fail(made.error());
        }
    }
    return &buffer;
}

Result<Buffer*> Submission::vertices(VkDeviceSize size) {
    return grow(vertices_, size,
                VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                    VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                HostAccess::write);
}

Result<Buffer*> Submission::readback(VkDeviceSize size) {
    return grow(readback_, size,
                VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                HostAccess::read);
}

void Submission::trim(VkDeviceSize limit) {
    if (vertices_.size() > limit) {
        vertices_ = Buffer();
    }
    if (readback_.size() > limit) {
        readback_ = Buffer();
    }
}

Result<VkCommandBuffer> Submission::begin() {
    const VolkDeviceTable& vk = device_->vk();
    descriptor_pools_.clear();
    used_secondaries_ = 0;
    if (auto reset = check(Stage::submit, vk.vkResetCommandPool(device_->get(), pool_.get(), 0),
                           "vkResetCommandPool");
        !reset) {
        return fail(reset.error());
    }
    used_primaries_ = 0;
    return begin_next();
}

Result<VkCommandBuffer> Submission::begin_next() {
    if (auto made = allocate(primaries_, used_primaries_ + 1, VK_COMMAND_BUFFER_LEVEL_PRIMARY);
        !made) {
        return fail(made.error());
    }
    commands_ = primaries_[used_primaries_++];
    VkCommandBufferBeginInfo info = Typed{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    const VkResult result = device_->vk().vkBeginCommandBuffer(commands_, &info);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::submit, result, "vkBeginCommandBuffer"));
    }
    return commands_;
}

Result<VkCommandBuffer> Submission::next() {
    if (auto submitted = submit(VK_NULL_HANDLE); !submitted) {
        return fail(submitted.error());
    }
    return begin_next();
}

Result<void> Submission::allocate(std::vector<VkCommandBuffer>& buffers, size_t count,
                                  VkCommandBufferLevel level) {
    if (buffers.size() >= count) {
        return {};
    }
    const size_t made = buffers.size();
    buffers.resize(count);
    VkCommandBufferAllocateInfo info = Typed{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool_.get();
    info.level = level;
    info.commandBufferCount = static_cast<uint32_t>(count - made);
    const VkResult result =
        device_->vk().vkAllocateCommandBuffers(device_->get(), &info, buffers.data() + made);
    if (result != VK_SUCCESS) {
        buffers.resize(made);
        return fail(call_failure(Stage::submit, result, "vkAllocateCommandBuffers"));
    }
    return {};
}

Result<std::vector<VkCommandBuffer>> Submission::secondaries(size_t count) {
    const size_t first = used_secondaries_;
    if (auto made = allocate(secondaries_, first + count, VK_COMMAND_BUFFER_LEVEL_SECONDARY);
        !made) {
        return fail(made.error());
    }
    used_secondaries_ += count;
    const auto begin = secondaries_.begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<VkCommandBuffer>(begin, begin + static_cast<std::ptrdiff_t>(count));
}

Result<void> Submission::submit(VkFence fence) {
    const VolkDeviceTable& vk = device_->vk();
    if (auto ended = check(Stage::submit, vk.vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
        !ended) {
        return ended;
    }
    VkSubmitInfo info = Typed{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    return check(Stage::submit, vk.vkQueueSubmit(device_->queue(), 1, &info, fence),
                 "vkQueueSubmit");
}

Result<void> Submission::run() {
    const VolkDeviceTable& vk = device_->vk();
    memory_barrier(*device_, commands_,
                   {VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                        VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                    VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                   {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    if (auto submitted = submit(fence_.get()); !submitted) {
        return submitted;
    }
    // A hang is ended from outside, where the worker has a time limit; should nobody do so, the
    // wait ends all the same, later.
    const VkFence fence = fence_.get();
    const VkResult result =
        vk.vkWaitForFences(device_->get(), 1, &fence, VK_TRUE, device_->longest_wait());
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::submit, result, "vkWaitForFences"));
    }
    return check(Stage::submit, vk.vkResetFences(device_->get(), 1, &fence), "vkResetFences");
}

Result<std::vector<VkDescriptorSet>> Submission::copy_sets(const PipelineCache& pipelines,
                                                           const CasePlan& plan) {
    const auto count = static_cast<uint32_t>(plan.images.size());
    const std::array<VkDescriptorPoolSize, 2> sizes = {
        VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, count},
        VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count}};
    const std::vector<VkDescriptorSetLayout> layouts(count, pipelines.copy_set_layout());
    auto made = make_sets(*device_, sizes, layouts);
    if (!made) {
        return fail(made.error());
    }
    descriptor_pools_.push_back(std::move(made->pool));
    std::vector<VkDescriptorSet>& sets = made->sets;
    const cases::Target& target = plan.test->target;
    const VkDeviceSize samples = VkDeviceSize{target.width} * target.rows() * target.samples;
    for (uint32_t k = 0; k < count; ++k) {
        if (plan.attachments[k].is_resolved() || plan.attachments[k].is_input) {
            continue;  // copied, or read by another shader
        }
        const bool is_stencil = plan.attachments[k].role == Role::stencil;
        write_copy_set(
            *device_, sets[k],
            is_stencil ? plan.images[k]->stencil_view() : plan.images[k]->sample_view(),
            {readback_.get(), plan.readback.offset[k], samples * plan.attachments[k].sample_bytes});
    }
    return std::move(sets);
}

Result<void> Submission::make_input_sets(const PipelineCache& pipelines, CasePlan& plan) {
    if (plan.inputs.empty()) {
        return {};
    }
    const auto count = static_cast<uint32_t>(plan.inputs.size());
    const std::array<VkDescriptorPoolSize, 2> sizes = {
        VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, count},
        VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count}};
    const std::vector<VkDescriptorSetLayout> layouts(count, pipelines.input_set_layout());
    auto made = make_sets(*device_, sizes, layouts);
    if (!made) {
        return fail(made.error());
    }
    descriptor_pools_.push_back(std::move(made->pool));
    const cases::Target& target = plan.test->target;
    const VkDeviceSize samples = VkDeviceSize{target.width} * target.rows() * target.samples;
    std::vector<VkDescriptorImageInfo> images(count);
    std::vector<VkDescriptorBufferInfo> buffers(count);
    std::vector<VkWriteDescriptorSet> writes;
    for (uint32_t n = 0; n < count; ++n) {
        InputRead& input = plan.inputs[n];
        input.set = made->sets[n];
        const size_t k = input.attachment;
        const Attachment& attachment = plan.attachments[k];
        images[n] = {VK_NULL_HANDLE, plan.images[k]->input_view(attachment.aspect()),
                     input_layout(attachment.aspect())};
        buffers[n] = {readback_.get(), plan.readback.offset[k], samples * attachment.sample_bytes};
        VkWriteDescriptorSet write = Typed{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstSet = input.set;
        write.descriptorCount = 1;
        write.descriptorType = VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT;
        write.pImageInfo = &images[n];
        writes.push_back(write);
        write.dstBinding = 1;
        write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        write.pImageInfo = nullptr;
        write.pBufferInfo = &buffers[n];
        writes.push_back(write);
    }
    device_->vk().vkUpdateDescriptorSets(device_->get(), static_cast<uint32_t>(writes.size()),
                                         writes.data(), 0, nullptr);
    return {};
}

}  // namespace vk_harness
