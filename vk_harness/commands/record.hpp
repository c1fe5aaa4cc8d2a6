// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is recorded around the rendering of a case: upload and copies.
#pragma once

#include <span>

#include "vk_harness/commands/case_plan.hpp"

namespace vk_harness {

// Assigns the places of all vertices and indices from byte `begin` on; returns the end.
VkDeviceSize place_vertices(CasePlan& plan, VkDeviceSize begin);
// Writes them there, bits unchanged but for a matrix. `is_mirrored`: with the other sign of x.
void write_vertices(const CasePlan& plan, std::span<std::byte> memory, bool is_mirrored = false);

// Gives the doors that need them buffers of their own; `memory` is what was written.
void make_door_buffers(const Device& device, const PipelineCache& pipelines, const CasePlan& plan,
                       std::span<const std::byte> memory);

// Rows of a target, `count` from `first` on.
struct Rows {
    uint32_t first = 0, count = 0;
};

// Records the copy of an attachment of one sample a pixel, of these rows of each of its layers, to
// the read-back buffer from byte `offset` on.
void record_copy(const Device& device, VkCommandBuffer commands, const CasePlan& plan,
                 size_t attachment, const Rows& rows, VkBuffer readback, VkDeviceSize offset);

// Records the copies of all samples to the read-back buffer. If the target is multisampled, `sets`
// holds one descriptor set an attachment, else nothing.
void record_copies(const Device& device, PipelineCache& pipelines, VkCommandBuffer commands,
                   const CasePlan& plan, VkBuffer readback, std::span<const VkDescriptorSet> sets);

}  // namespace vk_harness
