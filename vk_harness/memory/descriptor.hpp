// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Descriptor sets, and what is written to them.
#pragma once

#include <deque>
#include <initializer_list>
#include <vector>

#include "vk_harness/device/device.hpp"

namespace vk_harness {

// Sets of one layout, with the pool that owns them.
struct DescriptorSets {
    Handle<VkDescriptorPool> pool;
    std::vector<VkDescriptorSet> sets;
};
// `types`: those of the layout's bindings.
DescriptorSets make_sets(const Device& device, std::initializer_list<VkDescriptorType> types,
                         VkDescriptorSetLayout layout, uint32_t count = 1);

// Descriptors that are written by one call.
class DescriptorWrites {
  public:
    void add(VkDescriptorSet set, uint32_t binding, VkDescriptorType type,
             const VkDescriptorImageInfo& image);
    // A buffer, or a part of it.
    void add(VkDescriptorSet set, uint32_t binding, const VkDescriptorBufferInfo& buffer,
             VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    void write(const Device& device) const;

  private:
    VkWriteDescriptorSet& add(VkDescriptorSet set, uint32_t binding, VkDescriptorType type);

    std::deque<VkDescriptorImageInfo> images_;  // stable addresses
    std::deque<VkDescriptorBufferInfo> buffers_;
    std::vector<VkWriteDescriptorSet> writes_;
};

}  // namespace vk_harness
