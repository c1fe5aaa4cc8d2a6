// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/record.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>

#include "vk_harness/commands/viewports.hpp"
#include "vk_harness/device/sample_locations.hpp"
#include "vk_harness/memory/barrier.hpp"
#include "vk_harness/target/resolve.hpp"
#include "vk_harness/target/shader_interface.hpp"

namespace vk_harness {

namespace {

VkPrimitiveTopology to_vulkan(cases::Topology topology) {
    constexpr std::array kTopologies = {VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
                                        VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
                                        VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN};
    static_assert(kTopologies.size() == static_cast<size_t>(cases::Topology::triangle_fan) + 1);
    return kTopologies.at(static_cast<size_t>(topology));
}

VkCullModeFlags to_vulkan(cases::CullMode mode) {
    constexpr std::array kModes = {VK_CULL_MODE_NONE, VK_CULL_MODE_FRONT_BIT, VK_CULL_MODE_BACK_BIT,
                                   VK_CULL_MODE_FRONT_AND_BACK};
    static_assert(kModes.size() == static_cast<size_t>(cases::CullMode::front_and_back) + 1);
    return kModes.at(static_cast<size_t>(mode));
}

VkFrontFace to_vulkan(cases::FrontFace face) {
    return face == cases::FrontFace::clockwise ? VK_FRONT_FACE_CLOCKWISE
                                               : VK_FRONT_FACE_COUNTER_CLOCKWISE;
}

VkRenderingAttachmentInfo attachment(VkImageView view, VkImageLayout layout, VkClearValue clear) {
    VkRenderingAttachmentInfo info = Typed{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = view;
    info.imageLayout = layout;
    info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    info.clearValue = clear;
    return info;
}

// The scissors that a draw is repeated under: its own, cut by each tile of the variation.
std::vector<VkRect2D> scissors_of(const cases::Draw& draw, const cases::Case& test) {
    const cases::Rect& own = draw.scissor;
    const auto [tile_width, tile_height] = test.variation.tile;
    if (tile_width == 0 || tile_height == 0) {
        return {{{own.x, own.y}, {own.width, own.height}}};
    }
    // 64 bits: a scissor may end at 2^31 - 1, beyond the target.
    const auto cut = [](int64_t begin, int64_t size, int64_t tile, int64_t tile_size) {
        return std::pair(std::max(begin, tile), std::min(begin + size, tile + tile_size));
    };
    std::vector<VkRect2D> scissors;
    for (int64_t y = 0; y < test.target.height; y += tile_height) {
        const auto [top, bottom] = cut(own.y, own.height, y, tile_height);
        for (int64_t x = 0; x < test.target.width; x += tile_width) {
            const auto [left, right] = cut(own.x, own.width, x, tile_width);
            if (left < right && top < bottom) {
                scissors.push_back(
                    {{static_cast<int32_t>(left), static_cast<int32_t>(top)},
                     {static_cast<uint32_t>(right - left), static_cast<uint32_t>(bottom - top)}});
            }
        }
    }
    return scissors;
}

// One barrier for all attachments of the case.
void barrier(const Device& device, VkCommandBuffer commands, const CasePlan& plan,
             const ImageUse& color_before, const ImageUse& color_after,
             const ImageUse& depth_before, const ImageUse& depth_after,
             const ImageUse* after_resolve = nullptr) {
    // A depth image made for sample locations is told them whenever its layout changes.
    const std::vector<VkSampleLocationEXT> places =
        sample_places(plan.test->target.sample_locations);
    const VkSampleLocationsInfoEXT locations = sample_locations_info(places);
    std::vector<VkImageMemoryBarrier2> barriers;
    const auto add = [&](const Image& image, bool resolved, const ImageUse& before,
                         const ImageUse& after) {
        VkImageMemoryBarrier2 b =
            image_barrier(image.get(), {image.aspect(), 0, 1, 0, image.layers()}, before, after);
        if (!places.empty() && !resolved && (image.aspect() & VK_IMAGE_ASPECT_DEPTH_BIT) != 0) {
            b.pNext = &locations;
        }
        barriers.push_back(b);
    };
    for (size_t k = 0; k < plan.images.size(); ++k) {
        const Attachment& attachment = plan.attachments[k];
        if (attachment.role == Role::stencil) {
            continue;  // goes with depth
        }
        const bool depth = attachment.is_depth();
        if (attachment.is_resolved() && after_resolve) {
            add(*plan.images[k], true, depth ? depth_before : color_before, *after_resolve);
            continue;
        }
        add(*plan.images[k], attachment.is_resolved(), depth ? depth_before : color_before,
            depth ? depth_after : color_after);
    }
    record_barriers(device, commands, barriers);
}

constexpr ImageUse kColorDrawn = {
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
constexpr ImageUse kDepthDrawn = {
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT |
        VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,  // where depth is resolved
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
        VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
// The previous user of the attachments, if any: a draw (render_bare) or a copy. Contents are
// dropped.
constexpr ImageUse kReused = {
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT |
        VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
    VK_IMAGE_LAYOUT_UNDEFINED};
constexpr ImageUse kCopied = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                              VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
constexpr ImageUse kSampled = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                               VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};

// Clears what is resolved into, by a rendering without draws, and waits for it.
void clear_resolved(const Device& device, VkCommandBuffer commands, const CasePlan& plan) {
    const VolkDeviceTable& vk = device.vk();
    const cases::Target& target = plan.test->target;
    std::optional<VkRenderingAttachmentInfo> color, depth;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        const Attachment& a = plan.attachments[k];
        if (a.is_resolved()) {
            (a.is_depth() ? depth : color) =
                attachment(plan.images[k]->view(),
                           a.is_depth() ? kDepthDrawn.layout : kColorDrawn.layout, a.clear);
        }
    }
    if (!color && !depth) {
        return;
    }
    VkRenderingInfo rendering = Typed{VK_STRUCTURE_TYPE_RENDERING_INFO};
    rendering.renderArea = {{0, 0}, {target.width, target.height}};
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = color ? 1 : 0;
    rendering.pColorAttachments = color ? &*color : nullptr;
    rendering.pDepthAttachment = depth ? &*depth : nullptr;
    vk.vkCmdBeginRendering(commands, &rendering);
    vk.vkCmdEndRendering(commands);
    const MemoryUse cleared{kDepthDrawn.stage, kDepthDrawn.access};
    memory_barrier(device, commands, cleared, cleared);
}

void record_draw(const Device& device, const PipelineCache& pipelines, VkCommandBuffer commands,
                 const DrawPlan& plan, const cases::Case& test, uint32_t draw_index,
                 uint32_t binding_count, VkBuffer vertices) {
    const VolkDeviceTable& vk = device.vk();
    const cases::Draw& draw = *plan.draw;
    const uint32_t count =
        static_cast<uint32_t>(draw.indices ? draw.indices->size() : draw.positions.size());
    if (count == 0) {
        return;
    }
    vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, plan.pipeline);
    if (plan.texture != VK_NULL_HANDLE) {
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.layout(), 0,
                                   1, &plan.texture, 0, nullptr);
    }
    vk.vkCmdSetCullMode(commands, to_vulkan(draw.cull));
    vk.vkCmdSetFrontFace(commands, to_vulkan(draw.front_face));
    vk.vkCmdSetPrimitiveTopology(commands, to_vulkan(draw.topology));
    const bool has_restart = plan.feed ? plan.feed->has_restart() : draw.primitive_restart;
    vk.vkCmdSetPrimitiveRestartEnable(commands, has_restart ? VK_TRUE : VK_FALSE);
    vk.vkCmdSetRasterizerDiscardEnable(commands, draw.rasterizer_discard ? VK_TRUE : VK_FALSE);
    const cases::DepthState& depth = draw.depth;
    vk.vkCmdSetDepthCompareOp(commands, static_cast<VkCompareOp>(depth.compare));
    vk.vkCmdSetDepthWriteEnable(commands,
                                depth.write && !test.variation.masks_depth ? VK_TRUE : VK_FALSE);
    const cases::DepthBias bias = depth.bias.value_or(cases::DepthBias{});
    vk.vkCmdSetDepthBiasEnable(commands, depth.bias ? VK_TRUE : VK_FALSE);
    if (bias.is_controlled()) {
        record_controlled_bias(device.set_depth_bias2(), commands, bias);
    } else {
        vk.vkCmdSetDepthBias(commands, bias.constant, bias.clamp, bias.slope);
    }
    shaders::DrawConstants constants;
    constants.index =
        plan.is_split ? static_cast<uint32_t>(test.draws.size()) << 16 | draw_index : draw_index;
    constants.layer = draw.layer;
    constants.viewport_index = draw.viewport_index;
    for (int k = 0; k < 4; ++k) {
        const float value = draw.color.value[k];
        constants.color[k] =
            plan.has_integer_color ? static_cast<uint32_t>(value) : std::bit_cast<uint32_t>(value);
    }
    for (size_t k = 0; k < draw.attributes.size(); ++k) {
        constants.offsets[k][0] = draw.attributes[k].probe_offset[0];
        constants.offsets[k][1] = draw.attributes[k].probe_offset[1];
        constants.sample_numbers[k] = static_cast<int32_t>(draw.attributes[k].probe_sample);
    }
    constants.sample_mask = draw.multisample.shader_mask.value_or(0xffffffffU);
    vk.vkCmdPushConstants(commands, pipelines.layout(), kDrawStages, 0, sizeof constants,
                          &constants);
    const glm::vec4 blend = draw.color.blend ? draw.color.blend->constants : glm::vec4(0);
    vk.vkCmdSetBlendConstants(commands, &blend.x);
    const auto scissors = scissors_of(draw, test);
    if (plan.feed) {
        plan.feed->bind(device, commands, vertices);
        for (const VkRect2D& scissor : scissors) {
            bind_viewports(device, commands, test, draw, scissor);
            plan.feed->draw(device, commands, vertices);
        }
        return;
    }
    std::array<VkBuffer, 1 + cases::kMaxAttributes> buffers{};
    buffers.fill(vertices);
    vk.vkCmdBindVertexBuffers(commands, 0, binding_count, buffers.data(), plan.vertices.data());
    for (const auto& [distances, binding] : {std::pair(draw.distances.clip_count, kClipBinding),
                                             std::pair(draw.distances.cull_count, kCullBinding)}) {
        if (distances > 0) {
            vk.vkCmdBindVertexBuffers(commands, binding, 1, &vertices,
                                      &plan.distances[binding - kClipBinding]);
        }
    }
    if (draw.indices) {
        vk.vkCmdBindIndexBuffer(commands, vertices, plan.indices, VK_INDEX_TYPE_UINT32);
    }
    for (const VkRect2D& scissor : scissors) {
        bind_viewports(device, commands, test, draw, scissor);
        if (draw.indices) {
            vk.vkCmdDrawIndexed(commands, count, 1, 0, 0, 0);
        } else {
            vk.vkCmdDraw(commands, count, 1, 0, 0);
        }
    }
}

}  // namespace

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

void write_vertices(const CasePlan& plan, std::span<std::byte> memory) {
    const auto write = [memory](VkDeviceSize offset, const void* data, size_t size) {
        if (size != 0) {
            std::memcpy(memory.data() + offset, data, size);
        }
    };
    for (const DrawPlan& item : plan.draws) {
        const cases::Draw& draw = *item.draw;
        if (item.feed) {
            item.feed->write(memory);
            continue;
        }
        const size_t array = draw.positions.size() * sizeof(glm::vec4);
        write(item.vertices[0], draw.positions.data(), array);
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

Result<void> make_door_buffers(const Device& device, const CasePlan& plan,
                               std::span<const std::byte> memory) {
    for (const DrawPlan& item : plan.draws) {
        if (item.feed) {
            if (auto made = item.feed->make_buffers(device, memory); !made) {
                return made;
            }
        }
    }
    return {};
}

void record_draws(const Device& device, const PipelineCache& pipelines, VkCommandBuffer commands,
                  const CasePlan& plan, VkBuffer vertices, bool for_copies) {
    const VolkDeviceTable& vk = device.vk();
    const cases::Target& target = plan.test->target;
    barrier(device, commands, plan, kReused, kColorDrawn, kReused, kDepthDrawn);

    clear_resolved(device, commands, plan);
    std::vector<VkRenderingAttachmentInfo> colors;
    std::optional<VkRenderingAttachmentInfo> depth, stencil;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        const Attachment& a = plan.attachments[k];
        VkImageView view = plan.images[k]->view();
        switch (a.role) {
            case Role::depth:
                depth = attachment(view, kDepthDrawn.layout, a.clear);
                break;
            case Role::stencil:
                stencil = attachment(view, kDepthDrawn.layout, a.clear);
                break;
            case Role::resolved_color:  // the last colour attachment is the colour target
                resolve_into(view, kColorDrawn.layout, target.color_resolve, colors.back());
                break;
            case Role::resolved_depth:
                resolve_into(view, kDepthDrawn.layout, target.depth_resolve, *depth);
                break;
            default:
                colors.push_back(attachment(view, kColorDrawn.layout, a.clear));
                break;
        }
    }
    VkRenderingInfo rendering = Typed{VK_STRUCTURE_TYPE_RENDERING_INFO};
    rendering.renderArea = {{0, 0}, {target.width, target.height}};
    rendering.layerCount = target.layers;
    rendering.colorAttachmentCount = static_cast<uint32_t>(colors.size());
    rendering.pColorAttachments = colors.data();
    rendering.pDepthAttachment = depth ? &*depth : nullptr;
    rendering.pStencilAttachment = stencil ? &*stencil : nullptr;
    vk.vkCmdBeginRendering(commands, &rendering);
    for (uint32_t k = 0; k < plan.draws.size(); ++k) {
        record_draw(device, pipelines, commands, plan.draws[k], *plan.test, k, 1 + plan.input_count,
                    vertices);
    }
    vk.vkCmdEndRendering(commands);

    if (for_copies) {
        // Samples are read by a shader; guards (guard.hpp) are copied whatever the target is.
        ImageUse after = target.samples > 1 ? kSampled : kCopied;
        after.stage |= kCopied.stage;
        barrier(device, commands, plan, kColorDrawn, after, kDepthDrawn, after, &kCopied);
    }
}

void record_copy(const Device& device, VkCommandBuffer commands, const CasePlan& plan,
                 size_t attachment, const Rows& rows, VkBuffer readback, VkDeviceSize offset) {
    const cases::Target& target = plan.test->target;
    const Attachment& from = plan.attachments[attachment];
    const VkImageAspectFlags aspect = from.role == Role::stencil ? VK_IMAGE_ASPECT_STENCIL_BIT
                                      : from.is_depth()          ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                                 : VK_IMAGE_ASPECT_COLOR_BIT;
    VkBufferImageCopy region{};
    region.imageOffset = {0, static_cast<int32_t>(rows.first), 0};
    region.imageExtent = {target.width, rows.count, 1};
    region.bufferOffset = offset;
    region.imageSubresource = {aspect, 0, 0, target.layers};  // stacked
    device.vk().vkCmdCopyImageToBuffer(commands, plan.images[attachment]->get(), kCopied.layout,
                                       readback, 1, &region);
}

void record_copies(const Device& device, std::span<const VkPipeline> pipelines,
                   VkPipelineLayout copy_layout, VkCommandBuffer commands, const CasePlan& plan,
                   VkBuffer readback, std::span<const VkDescriptorSet> sets) {
    const VolkDeviceTable& vk = device.vk();
    const cases::Target& target = plan.test->target;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        if (plan.attachments[k].samples_of(target) == 1) {
            record_copy(device, commands, plan, k, {0, target.height}, readback,
                        plan.readback.offset[k]);
        }
    }
    if (target.samples == 1) {
        return;
    }
    const std::array<uint32_t, kCopyConstants> constants = {target.width, target.height,
                                                            target.samples};
    const uint32_t groups_x = (target.width + kCopyGroupSize - 1) / kCopyGroupSize;
    const uint32_t groups_y = (target.height + kCopyGroupSize - 1) / kCopyGroupSize;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        if (plan.attachments[k].is_resolved()) {
            continue;
        }
        if (k == 0 || pipelines[k] != pipelines[k - 1]) {
            vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines[k]);
            vk.vkCmdPushConstants(commands, copy_layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                  sizeof(constants), constants.data());
        }
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, copy_layout, 0, 1,
                                   &sets[k], 0, nullptr);
        vk.vkCmdDispatch(commands, groups_x, groups_y, target.layers);
    }
}

}  // namespace vk_harness
