// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// One case as commands: upload, draw, copy.
#pragma once

#include <span>
#include <vector>

#include "vk_harness/pipeline_cache.hpp"
#include "vk_harness/readback.hpp"
#include "vk_harness/target.hpp"

namespace vk_harness {

// A draw with the place of its data in the vertex buffer, in bytes.
struct DrawPlan {
    const cases::Draw* draw = nullptr;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkDescriptorSet texture = VK_NULL_HANDLE;  // if an attribute asks for a level of detail
    std::array<VkDeviceSize, 1 + cases::kMaxAttributes> vertices{};  // positions, attributes
    DistancePlaces distances{};
    VkDeviceSize indices = 0;
};

struct CasePlan {
    const cases::Case* test = nullptr;
    size_t slot = 0;  // among the cases of the batch
    uint32_t attribute_count = 0;
    Target* target = nullptr;
    std::vector<DrawPlan> draws;
    ReadbackLayout readback;
};

// Assigns the places of all vertices and indices from byte `begin` on; returns the end.
VkDeviceSize place_vertices(CasePlan& plan, VkDeviceSize begin);
// Writes them there, bits unchanged.
void write_vertices(const CasePlan& plan, std::span<std::byte> memory);

// Records clearing and drawing of a case. Afterwards its attachments are in the layout that
// record_copies expects if `for_copies`.
void record_draws(const Device& device, const PipelineCache& pipelines, VkCommandBuffer commands,
                  const CasePlan& plan, VkBuffer vertices, bool for_copies);

// Records the copies of all samples to the read-back buffer. `sets` holds one descriptor set a
// colour attachment and then one for depth if the target is multisampled, else nothing.
void record_copies(const Device& device, VkPipeline copy_color, VkPipeline copy_depth,
                   VkPipelineLayout copy_layout, VkCommandBuffer commands, const CasePlan& plan,
                   VkBuffer readback, std::span<const VkDescriptorSet> sets);

}  // namespace vk_harness
