// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/memory/descriptor.hpp"

namespace vk_harness {

DescriptorSets make_sets(const Device& device, std::initializer_list<VkDescriptorType> types,
                         VkDescriptorSetLayout layout, uint32_t count) {
    const VolkDeviceTable& vk = device.vk();
    std::vector<VkDescriptorPoolSize> sizes;
    for (const VkDescriptorType type : types) {
        sizes.push_back({type, count});
    }
    VkDescriptorPoolCreateInfo pool_info = Typed{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = count;
    pool_info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    pool_info.pPoolSizes = sizes.data();
    DescriptorSets out;
    out.pool = make(device, Stage::memory, "vkCreateDescriptorPool", vk.vkCreateDescriptorPool,
                    vk.vkDestroyDescriptorPool, pool_info);
    const std::vector<VkDescriptorSetLayout> layouts(count, layout);
    VkDescriptorSetAllocateInfo info = Typed{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = out.pool.get();
    info.descriptorSetCount = count;
    info.pSetLayouts = layouts.data();
    out.sets.resize(count);
    check(Stage::memory, vk.vkAllocateDescriptorSets(device.get(), &info, out.sets.data()),
          "vkAllocateDescriptorSets");
    return out;
}

VkWriteDescriptorSet& DescriptorWrites::add(VkDescriptorSet set, uint32_t binding,
                                            VkDescriptorType type) {
    VkWriteDescriptorSet& write = writes_.emplace_back();
    write = Typed{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = type;
    return write;
}

void DescriptorWrites::add(VkDescriptorSet set, uint32_t binding, VkDescriptorType type,
                           const VkDescriptorImageInfo& image) {
    add(set, binding, type).pImageInfo = &images_.emplace_back(image);
}

void DescriptorWrites::add(VkDescriptorSet set, uint32_t binding,
                           const VkDescriptorBufferInfo& buffer, VkDescriptorType type) {
    add(set, binding, type).pBufferInfo = &buffers_.emplace_back(buffer);
}

void DescriptorWrites::write(const Device& device) const {
    device.vk().vkUpdateDescriptorSets(device.get(), static_cast<uint32_t>(writes_.size()),
                                       writes_.data(), 0, nullptr);
}

}  // namespace vk_harness
