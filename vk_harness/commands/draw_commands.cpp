// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/draw_commands.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>
#include <vector>

#include "cases/model/derive.hpp"
#include "cases/model/matrix.hpp"
#include "vk_harness/device/depth_bias_control.hpp"
#include "vk_harness/pipeline/object_state.hpp"
#include "vk_harness/target/shader_interface.hpp"

namespace vk_harness {

using cases::Door;

namespace {

// The scissors that a draw is repeated under: its own, cut by each tile of the variation.
std::vector<VkRect2D> scissors_of(const cases::Draw& draw, const cases::Case& test) {
    const cases::Rect& own = draw.scissor;
    const auto [tile_width, tile_height] = test.variation.tile;
    if (tile_width == 0 || tile_height == 0) {
        return {moved(test, to_vulkan(own))};
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
                scissors.push_back(moved(
                    test,
                    {{static_cast<int32_t>(left), static_cast<int32_t>(top)},
                     {static_cast<uint32_t>(right - left), static_cast<uint32_t>(bottom - top)}}));
            }
        }
    }
    return scissors;
}

// The bits of what a fragment writes to a target of this format.
void write_bits(cases::ColorFormat format, const glm::vec4& value, uint32_t (&to)[4]) {
    for (int k = 0; k < 4; ++k) {
        to[k] = cases::is_integer(format) ? static_cast<uint32_t>(static_cast<int32_t>(value[k]))
                                          : std::bit_cast<uint32_t>(value[k]);
    }
}

void push_constants(const Device& device, const PipelineCache& pipelines, VkCommandBuffer commands,
                    const DrawPlan& plan, const cases::Case& test, uint32_t draw_index) {
    const cases::Draw& draw = *plan.draw;
    if (draw.matrix) {  // its fragment shader reads none
        device.vk().vkCmdPushConstants(commands, pipelines.layouts().draw.get(),
                                       draw_stages(device), 0, sizeof cases::kMatrix,
                                       cases::kMatrix.data());
        return;
    }
    shaders::DrawConstants constants;
    constants.index =
        plan.is_split ? static_cast<uint32_t>(test.draws.size()) << 16 | draw_index : draw_index;
    constants.layer = draw.layer;
    constants.viewport_index = draw.viewport_index;
    constants.instance_vertices = static_cast<uint32_t>(draw.vertex_count());
    constants.first_instance = draw.first_instance;
    for (size_t k = 0; k < draw.attributes.size(); ++k) {
        constants.probes.offsets[k][0] = draw.attributes[k].probe_offset[0];
        constants.probes.offsets[k][1] = draw.attributes[k].probe_offset[1];
        constants.probes.sample_numbers[k] = static_cast<int32_t>(draw.attributes[k].probe_sample);
    }
    for (uint32_t location = 0; location < test.target.color_count(); ++location) {
        write_bits(test.target.color_at(location).format,
                   cases::output_at(test.target, draw, location).value,
                   location == 0 ? constants.color : constants.other_colors[location - 1]);
    }
    if (draw.color.blend) {
        for (int k = 0; k < 4; ++k) {
            constants.second[k] = draw.color.blend->second[k];
        }
    }
    constants.sample_mask = draw.multisample.shader_mask.value_or(0xffffffffU);
    constants.discarded = static_cast<uint32_t>(draw.discard);
    constants.discarded_by = input_of_discard(test, draw);
    if (draw.frag_depth) {
        constants.depth = draw.frag_depth->value;
        constants.other_depth = draw.frag_depth->other;
        constants.other_where = static_cast<uint32_t>(draw.frag_depth->where);
        constants.depth_is_coord = draw.frag_depth->is_coord ? 1 : 0;
    }
    device.vk().vkCmdPushConstants(commands, pipelines.layouts().draw.get(), draw_stages(device), 0,
                                   sizeof constants, &constants);
}

void bind_inputs(const Device& device, VkCommandBuffer commands, const DrawPlan& plan,
                 uint32_t binding_count, VkBuffer vertices) {
    const VolkDeviceTable& vk = device.vk();
    if (plan.feed) {
        plan.feed->bind(device, commands, vertices);
        return;
    }
    const cases::Draw& draw = *plan.draw;
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
}

void draw_once(const Device& device, VkCommandBuffer commands, const DrawPlan& plan,
               VkBuffer vertices) {
    const cases::Draw& draw = *plan.draw;
    if (plan.feed) {
        plan.feed->draw(device, commands, vertices);
    } else if (draw.indices) {
        device.vk().vkCmdDrawIndexed(commands, static_cast<uint32_t>(draw.indices->size()), 1, 0, 0,
                                     0);
    } else {
        device.vk().vkCmdDraw(commands, static_cast<uint32_t>(draw.positions.size()), 1, 0, 0);
    }
}

// A driver that keeps the representation of a bias for later draws shall show it in its own case,
// and not in the next one of the command buffer.
void reset_bias_representation(const Device& device, VkCommandBuffer commands,
                               const cases::Case& test, uint32_t draw_index) {
    const auto is_controlled = [](const cases::Draw& draw) {
        return draw.depth.bias && draw.depth.bias->is_controlled();
    };
    if (draw_index + 1 == test.draws.size() && std::ranges::any_of(test.draws, is_controlled)) {
        record_controlled_bias(device.set_depth_bias2(), commands, {});
    }
}

// vkCmdClearAttachments, of attachments of the case alone.
void record_clear(const Device& device, VkCommandBuffer commands, const CasePlan& of,
                  const cases::Draw& draw) {
    const cases::Clear& clear = *draw.clear;
    std::vector<VkClearAttachment> cleared;
    VkClearAttachment beside{0, 0, {}};  // depth and stencil
    uint32_t location = 0;
    for (const Attachment& a : of.attachments) {
        if (a.role == Role::depth && clear.depth) {
            beside.aspectMask |= VK_IMAGE_ASPECT_DEPTH_BIT;
            beside.clearValue.depthStencil.depth = *clear.depth;
        } else if (a.role == Role::stencil && clear.stencil) {
            beside.aspectMask |= VK_IMAGE_ASPECT_STENCIL_BIT;
            beside.clearValue.depthStencil.stencil = *clear.stencil;
        } else if (a.role == Role::color && clear.color) {
            VkClearAttachment& color =
                cleared.emplace_back(VkClearAttachment{VK_IMAGE_ASPECT_COLOR_BIT, location, {}});
            write_bits(of.test->target.color->format, *clear.color, color.clearValue.color.uint32);
        }
        ++location;
    }
    if (beside.aspectMask != 0) {
        cleared.push_back(beside);
    }
    std::vector<VkClearRect> rects;
    for (const cases::Rect& rect : clear.rects) {
        rects.push_back({moved(*of.test, to_vulkan(rect)), draw.layer, clear.layers});
    }
    if (!cleared.empty()) {
        device.vk().vkCmdClearAttachments(commands, static_cast<uint32_t>(cleared.size()),
                                          cleared.data(), static_cast<uint32_t>(rects.size()),
                                          rects.data());
    }
}

}  // namespace

void record_draw(const Device& device, const PipelineCache& pipelines, VkCommandBuffer commands,
                 const CasePlan& of, uint32_t draw_index, VkBuffer vertices) {
    const VolkDeviceTable& vk = device.vk();
    const cases::Case& test = *of.test;
    const DrawPlan& plan = of.draws[draw_index];
    const cases::Draw& draw = *plan.draw;
    if (draw.clear) {
        record_clear(device, commands, of, draw);
        return;
    }
    if (draw.indices ? draw.indices->empty() : draw.positions.empty()) {
        if (of.queries) {
            of.queries->begin(commands, draw_index);
            of.queries->end(commands, draw_index);
        }
        return;
    }
    const Door door = test.variation.door;
    const auto bind = [&](VkPipeline pipeline) {
        if (plan.object_key) {
            bind_objects(device, commands, plan.objects);
            set_object_state(device, commands, *plan.object_key);
        } else {
            vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        }
        if (plan.texture != VK_NULL_HANDLE) {
            vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                       pipelines.layouts().draw.get(), 0, 1, &plan.texture, 0,
                                       nullptr);
        }
        if (of.colors) {
            of.colors->bind(commands, draw_index);
        }
        if (plan.feed) {
            plan.feed->bind_pulled(device, commands, pipelines.layouts().pulled.get());
        }
    };
    DrawState state = draw_state(test, draw);
    const bool is_dynamic = door != Door::state_static;
    push_constants(device, pipelines, commands, plan, test, draw_index);
    bind_inputs(device, commands, plan, 1 + of.input_count, vertices);
    if (door == Door::state_after_static) {
        bind(plan.other_pipeline);
        draw_once(device, commands, plan, vertices);
    }
    // Elsewhere behind the pipeline, of which lavapipe asks when a query begins
    // (docs/findings/lavapipe-query-before-pipeline.md).
    bool has_begun = false;
    const auto begin_query = [&] {
        if (of.queries && !std::exchange(has_begun, true)) {
            of.queries->begin(commands, draw_index);
        }
    };
    if (door == Door::query_first) {
        begin_query();
    }
    if (door != Door::state_first) {
        bind(plan.pipeline);
    }
    if (plan.outputs) {
        set_outputs(device, commands, *plan.outputs);
    }
    if (plan.rasterization) {
        set_dynamic_rasterization(device, commands, *plan.rasterization);
    }
    if (door == Door::state_stale) {
        const DrawState other =
            other_state(state, device.capabilities().core.dynamic_state ? Leaves::rasterization_off
                                                                        : Leaves::scissors_empty);
        set_state(device, commands, other, {});
        set_viewports(device, commands, other);
        draw_once(device, commands, plan, vertices);
    }
    if (is_dynamic) {
        set_state(device, commands, state, draw.depth.bias.value_or(cases::DepthBias{}));
    }
    for (const VkRect2D& scissor : scissors_of(draw, test)) {
        if (is_dynamic) {
            replace_scissor(state, draw, scissor);
            plan.object_key ? set_counted_viewports(device, commands, state)
                            : set_viewports(device, commands, state);
        }
        if (door == Door::state_first) {
            bind(plan.pipeline);
        }
        begin_query();
        draw_once(device, commands, plan, vertices);
    }
    begin_query();  // if no scissor is left of the draw
    if (of.queries) {
        of.queries->end(commands, draw_index);
    }
    reset_bias_representation(device, commands, test, draw_index);
}

}  // namespace vk_harness
