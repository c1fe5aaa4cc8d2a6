// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/record.hpp"

#include <array>
#include <cstring>
#include <utility>

#include "cases/model/matrix.hpp"
#include "vk_harness/target/shader_interface.hpp"
#include "vk_harness/target/target_way.hpp"

namespace vk_harness {

VkDeviceSize place_vertices(CasePlan& plan, VkDeviceSize begin) {
    VkDeviceSize offset = begin;
    for (DrawPlan& draw : plan.draws) {
        if (draw.feed) {
            offset = draw.feed->place(offset);
            continue;
        }
        const VkDeviceSize array = draw.draw->positions.size() * sizeof(glm::vec4);
        for (uint32_t binding = 0; binding <= plan.input_count; ++binding) {
            draw.vertices[binding] = offset;
            offset += array;
        }
        offset = place_distances(*draw.draw, offset, draw.distances);
        draw.indices = offset;
        if (draw.draw->indices) {
            offset += draw.draw->indices->size() * sizeof(uint32_t);
        }
        offset = (offset + 15) & ~VkDeviceSize{15};  // the next array of vec4
    }
    return offset;
}

void write_vertices(const CasePlan& plan, std::span<std::byte> memory, bool is_mirrored) {
    const auto write = [memory](VkDeviceSize offset, const void* data, size_t size) {
        if (size != 0) {
            std::memcpy(memory.data() + offset, data, size);
        }
    };
    for (const DrawPlan& item : plan.draws) {
        const cases::Draw& draw = *item.draw;
        if (item.feed) {
            item.feed->write(memory, is_mirrored);
            continue;
        }
        const size_t array = draw.positions.size() * sizeof(glm::vec4);
        std::vector<glm::vec4> positions = draw.positions;
        for (glm::vec4& p : positions) {
            p.x = is_mirrored ? -p.x : p.x;
            p = draw.matrix ? cases::before_matrix(p) : p;
        }
        write(item.vertices[0], positions.data(), array);
        for (uint32_t k = 0; k < plan.input_count; ++k) {
            const cases::Attribute* attribute = input_attribute(*plan.test, draw, k);
            const bool is_given = attribute != nullptr;
            if (is_given && attribute->source == cases::Source::vertex) {
                write(item.vertices[1 + k], attribute->values.data(), array);
            } else {
                const std::vector<glm::vec4> none(
                    draw.positions.size(), glm::vec4(is_given ? 0.0F : capture::kClearValue));
                write(item.vertices[1 + k], none.data(), array);
            }
        }
        write_distances(draw, item.distances, memory);
        if (draw.indices) {
            write(item.indices, draw.indices->data(), draw.indices->size() * sizeof(uint32_t));
        }
    }
}

void make_door_buffers(const Device& device, const PipelineCache& pipelines, const CasePlan& plan,
                       std::span<const std::byte> memory) {
    for (const DrawPlan& item : plan.draws) {
        if (item.feed) {
            item.feed->make_buffers(device, memory, pipelines.layouts().pulled_set.get());
        }
    }
}

void record_copy(const Device& device, VkCommandBuffer commands, const CasePlan& plan,
                 size_t attachment, const Rows& rows, VkBuffer readback, VkDeviceSize offset) {
    const cases::Target& target = plan.test->target;
    const Attachment& from = plan.attachments[attachment];
    VkBufferImageCopy region{};
    const VkOffset2D origin = image_way(*plan.test).origin();
    region.imageOffset = {origin.x, origin.y + static_cast<int32_t>(rows.first), 0};
    region.imageExtent = {target.width, rows.count, 1};
    region.bufferOffset = offset;
    const Image& image = *plan.images[attachment];
    region.imageSubresource = {from.aspect(), image.range().baseMipLevel,
                               image.range().baseArrayLayer, target.layers};  // stacked
    device.vk().vkCmdCopyImageToBuffer(commands, image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                       readback, 1, &region);
}

void record_copies(const Device& device, PipelineCache& pipelines, VkCommandBuffer commands,
                   const CasePlan& plan, VkBuffer readback, std::span<const VkDescriptorSet> sets) {
    const VolkDeviceTable& vk = device.vk();
    const cases::Target& target = plan.test->target;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        if (!plan.attachments[k].has_words(plan.attachments[k].samples_of(target))) {
            record_copy(device, commands, plan, k, {0, target.height}, readback,
                        plan.readback.offset[k]);
        }
    }
    if (!target.is_read_by_shader()) {
        return;
    }
    const VkOffset2D origin = image_way(*plan.test).origin();
    const std::array<uint32_t, kCopyConstants> constants = {
        target.width, target.height, target.samples, static_cast<uint32_t>(origin.x),
        static_cast<uint32_t>(origin.y)};
    const uint32_t groups_x = (target.width + kCopyGroupSize - 1) / kCopyGroupSize;
    const uint32_t groups_y = (target.height + kCopyGroupSize - 1) / kCopyGroupSize;
    VkPipeline bound = VK_NULL_HANDLE;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        if (plan.attachments[k].is_resolved() || plan.attachments[k].is_input) {
            continue;
        }
        const VkPipeline pipeline = pipelines.get_copy(plan.attachments[k]);
        if (std::exchange(bound, pipeline) != pipeline) {
            vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
            vk.vkCmdPushConstants(commands, pipelines.layouts().copy.get(),
                                  VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(constants),
                                  constants.data());
        }
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                   pipelines.layouts().copy.get(), 0, 1, &sets[k], 0, nullptr);
        vk.vkCmdDispatch(commands, groups_x, groups_y, target.layers);
    }
}

}  // namespace vk_harness
