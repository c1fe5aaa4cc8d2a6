// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/rendering.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "vk_harness/commands/draw_commands.hpp"
#include "vk_harness/commands/render_pass.hpp"
#include "vk_harness/device/sample_locations.hpp"
#include "vk_harness/memory/barrier.hpp"
#include "vk_harness/target/resolve.hpp"
#include "vk_harness/target/target_way.hpp"

namespace vk_harness {

using cases::Door;

namespace {

VkRenderingAttachmentInfo attachment(VkImageView view, VkImageLayout layout, VkClearValue clear,
                                     VkAttachmentLoadOp load = VK_ATTACHMENT_LOAD_OP_CLEAR) {
    VkRenderingAttachmentInfo info = Typed{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = view;
    info.imageLayout = layout;
    info.loadOp = load;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    info.clearValue = clear;
    return info;
}

// Surroundings are copied to the image (fill_surroundings).
constexpr ImageUse kFilled = {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};

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
    const auto add = [&](size_t k, const ImageUse& use, const ImageUse& after) {
        const Image& image = *plan.images[k];
        const bool resolved = plan.attachments[k].is_resolved();
        const bool is_filled = use.layout == VK_IMAGE_LAYOUT_UNDEFINED && plan.is_filled(k);
        const ImageUse& before = is_filled ? kFilled : use;
        VkImageMemoryBarrier2 b = image_barrier(image.get(), image.drawn(), before, after);
        if (!places.empty() && !resolved && (image.aspect() & VK_IMAGE_ASPECT_DEPTH_BIT) != 0) {
            b.pNext = &locations;
        }
        barriers.push_back(b);
    };
    for (size_t k = 0; k < plan.images.size(); ++k) {
        const Attachment& attachment = plan.attachments[k];
        if (attachment.is_beside_depth) {
            continue;
        }
        const bool depth = attachment.is_depth_stencil();
        if (attachment.is_resolved() && after_resolve) {
            add(k, depth ? depth_before : color_before, *after_resolve);
            continue;
        }
        add(k, depth ? depth_before : color_before, depth ? depth_after : color_after);
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

// Writes to the memory of attachments as other images. Their own contents are undefined then, as
// they are when they are drawn to next (Vulkan specification, "Memory Aliasing").
void spoil_aliases(const Device& device, VkCommandBuffer commands, const CasePlan& plan) {
    constexpr ImageUse kCleared = {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                   VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
    constexpr ImageUse kAnyUse = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                  VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
                                  VK_IMAGE_LAYOUT_UNDEFINED};
    constexpr VkImageSubresourceRange kAll = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS,
                                              0, VK_REMAINING_ARRAY_LAYERS};
    std::vector<VkImageMemoryBarrier2> barriers;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        const VkImage alias = plan.images[k]->alias();
        if (alias != VK_NULL_HANDLE && !plan.attachments[k].is_beside_depth) {
            barriers.push_back(image_barrier(alias, kAll, kAnyUse, kCleared));
        }
    }
    if (barriers.empty()) {
        return;
    }
    record_barriers(device, commands, barriers);
    VkClearColorValue color{};
    std::fill(std::begin(color.float32), std::end(color.float32), 0.625F);
    for (const VkImageMemoryBarrier2& b : barriers) {
        device.vk().vkCmdClearColorImage(commands, b.image, kCleared.layout, &color, 1, &kAll);
    }
    memory_barrier(device, commands, {kCleared.stage, kCleared.access},
                   {kAnyUse.stage, kAnyUse.access});
}

// Has the vertices written that are drawn, in a rendering of its own: within one no barrier could
// stand between writing and reading them.
void record_feedback(const Device& device, VkCommandBuffer commands, const CasePlan& plan,
                     VkBuffer vertices) {
    VkRenderingInfo rendering = Typed{VK_STRUCTURE_TYPE_RENDERING_INFO};
    rendering.renderArea = {{0, 0}, {1, 1}};
    rendering.layerCount = 1;
    device.vk().vkCmdBeginRendering(commands, &rendering);
    for (const DrawPlan& item : plan.draws) {
        if (item.feedback != VK_NULL_HANDLE && !item.draw->positions.empty()) {
            item.feed->record_feedback(device, commands, item.feedback, vertices);
        }
    }
    device.vk().vkCmdEndRendering(commands);
    memory_barrier(
        device, commands,
        {VK_PIPELINE_STAGE_2_TRANSFORM_FEEDBACK_BIT_EXT,
         VK_ACCESS_2_TRANSFORM_FEEDBACK_WRITE_BIT_EXT},
        {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT});
}

// Clears what is resolved into, by a rendering without draws, and waits for it; or leaves that to
// the render pass object.
void clear_resolved(const Device& device, VkCommandBuffer commands, const CasePlan& plan) {
    if (plan.pass_clears_resolved) {
        return;
    }
    const VolkDeviceTable& vk = device.vk();
    std::optional<VkRenderingAttachmentInfo> color, depth, stencil;
    for (size_t k = 0; k < plan.images.size(); ++k) {
        const Attachment& a = plan.attachments[k];
        if (a.is_resolved()) {
            (a.is_depth()     ? depth
             : a.is_stencil() ? stencil
                              : color) =
                attachment(plan.images[k]->view(),
                           a.is_depth_stencil() ? kDepthDrawn.layout : kColorDrawn.layout, a.clear);
        }
    }
    if (!color && !depth && !stencil) {
        return;
    }
    VkRenderingInfo rendering = Typed{VK_STRUCTURE_TYPE_RENDERING_INFO};
    rendering.renderArea = render_area(*plan.test);
    rendering.layerCount = plan.test->target.layers;
    rendering.viewMask = view_mask(*plan.test);
    rendering.colorAttachmentCount = color ? 1 : 0;
    rendering.pColorAttachments = color ? &*color : nullptr;
    rendering.pDepthAttachment = depth ? &*depth : nullptr;
    rendering.pStencilAttachment = stencil ? &*stencil : nullptr;
    vk.vkCmdBeginRendering(commands, &rendering);
    vk.vkCmdEndRendering(commands);
    const MemoryUse cleared{kDepthDrawn.stage, kDepthDrawn.access};
    memory_barrier(device, commands, cleared, cleared);
}

// What is loaded is never cleared to what it holds.
VkClearValue own_clear(const Attachment& a) {
    return is_loaded(a.load) ? other_clear(a) : a.clear;
}
// What an earlier pass leaves: what is loaded.
VkClearValue earlier_clear(const Attachment& a) {
    return is_loaded(a.load) ? a.clear : other_clear(a);
}

constexpr VkAttachmentLoadOp kLoadOps[] = {VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_LOAD_OP_LOAD,
                                           VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                           VK_ATTACHMENT_LOAD_OP_NONE_EXT};
constexpr VkAttachmentStoreOp kStoreOps[] = {
    VK_ATTACHMENT_STORE_OP_STORE, VK_ATTACHMENT_STORE_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_NONE};

// What a rendering begins with, with all that it points to: not to be moved.
class Attached {
  public:
    // `load`: of all attachments, which are stored then; nothing: each has its own operations.
    Attached(const CasePlan& plan, std::optional<VkAttachmentLoadOp> load, VkRenderingFlags flags,
             bool resolves = true, VkClearValue (*clear_of)(const Attachment&) = own_clear) {
        const cases::Target& target = plan.test->target;
        const auto begun = [&](const Attachment& a, VkImageView view, VkImageLayout layout) {
            VkRenderingAttachmentInfo info = attachment(
                view, layout, clear_of(a), load.value_or(kLoadOps[static_cast<size_t>(a.load)]));
            info.storeOp = load ? info.storeOp : kStoreOps[static_cast<size_t>(a.store)];
            return info;
        };
        size_t judged = 0;  // among the colour attachments
        for (size_t k = 0; k < plan.images.size(); ++k) {
            const Attachment& a = plan.attachments[k];
            VkImageView view = plan.images[k]->view();
            switch (a.role) {
                case Role::depth:
                    depth_ = begun(a, view, kDepthDrawn.layout);
                    break;
                case Role::stencil:
                    stencil_ = begun(a, view, kDepthDrawn.layout);
                    break;
                case Role::resolved_color:
                    if (resolves) {
                        resolve_into(view, kColorDrawn.layout, target.color_resolve,
                                     colors_.at(judged));
                    }
                    break;
                case Role::color:
                    judged = colors_.size();
                    colors_.push_back(begun(a, view, kColorDrawn.layout));
                    break;
                case Role::resolved_depth:
                    if (resolves) {
                        resolve_into(view, kDepthDrawn.layout, target.depth_resolve, *depth_);
                    }
                    break;
                case Role::resolved_stencil:
                    if (resolves) {
                        resolve_into(view, kDepthDrawn.layout, target.stencil_resolve, *stencil_);
                    }
                    break;
                default:
                    colors_.push_back(begun(a, view, kColorDrawn.layout));
                    break;
            }
        }
        info_.flags = flags;
        info_.renderArea = render_area(*plan.test);
        info_.layerCount = target.layers;
        info_.viewMask = view_mask(*plan.test);
        info_.colorAttachmentCount = static_cast<uint32_t>(colors_.size());
        info_.pColorAttachments = colors_.data();
        info_.pDepthAttachment = depth_ ? &*depth_ : nullptr;
        info_.pStencilAttachment = stencil_ ? &*stencil_ : nullptr;
    }
    Attached(const Attached&) = delete;
    Attached& operator=(const Attached&) = delete;
    ~Attached() = default;
    const VkRenderingInfo& info() const { return info_; }

  private:
    std::vector<VkRenderingAttachmentInfo> colors_;
    std::optional<VkRenderingAttachmentInfo> depth_, stencil_;
    VkRenderingInfo info_ = Typed{VK_STRUCTURE_TYPE_RENDERING_INFO};
};

// Clears all attachments of a rendering that has begun.
void clear_by_command(const Device& device, VkCommandBuffer commands, const CasePlan& plan) {
    const cases::Target& target = plan.test->target;
    std::vector<VkClearAttachment> clears;
    uint32_t color = 0;
    for (const Attachment& a : plan.attachments) {
        if (a.is_resolved()) {
            continue;
        }
        if (a.role == Role::depth || a.role == Role::stencil) {
            clears.push_back({static_cast<VkImageAspectFlags>(a.role == Role::depth
                                                                  ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                                  : VK_IMAGE_ASPECT_STENCIL_BIT),
                              0, a.clear});
        } else {
            clears.push_back({VK_IMAGE_ASPECT_COLOR_BIT, color++, a.clear});
        }
    }
    const VkClearRect all = {{{0, 0}, {target.width, target.height}}, 0, target.layers};
    device.vk().vkCmdClearAttachments(commands, static_cast<uint32_t>(clears.size()), clears.data(),
                                      1, &all);
}

// The same by triangles over the target, one for each colour, and one for depth and stencil.
void clear_by_draws(const Device& device, const PipelineCache& pipelines, VkCommandBuffer commands,
                    const CasePlan& plan) {
    const VolkDeviceTable& vk = device.vk();
    const cases::Target& target = plan.test->target;
    // A pixel further on each side, if the device has room: a sample on the border of the view
    // volume need not be covered, and some lie on that of their pixel.
    const auto& most = device.capabilities().limits.maxViewportDimensions;
    const float margin = target.width + 2 <= most[0] && target.height + 2 <= most[1] ? 1.0F : 0.0F;
    const VkViewport viewport = {-margin,
                                 -margin,
                                 static_cast<float>(target.width) + 2 * margin,
                                 static_cast<float>(target.height) + 2 * margin,
                                 0,
                                 1};
    const VkRect2D scissor = {{0, 0}, {target.width, target.height}};
    for (const ClearDraw& clear : plan.clears) {
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, clear.pipeline);
        vk.vkCmdSetViewport(commands, 0, 1, &viewport);
        vk.vkCmdSetScissor(commands, 0, 1, &scissor);
        if (clear.has_stencil) {
            vk.vkCmdSetStencilReference(commands, VK_STENCIL_FACE_FRONT_AND_BACK, clear.stencil);
        }
        vk.vkCmdPushConstants(commands, pipelines.layouts().draw.get(), draw_stages(device), 0,
                              sizeof clear.bits, clear.bits.data());
        vk.vkCmdDraw(commands, 3, 1, 0, 0);
    }
}

// Records draws [first, end) to a secondary command buffer that inherits the rendering.
void record_secondary(const Device& device, const PipelineCache& pipelines,
                      VkCommandBuffer secondary, const CasePlan& plan, uint32_t first, uint32_t end,
                      VkBuffer vertices) {
    const VolkDeviceTable& vk = device.vk();
    std::vector<VkFormat> formats;
    VkCommandBufferInheritanceRenderingInfo rendering =
        Typed{VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_RENDERING_INFO};
    for (const Attachment& a : plan.attachments) {
        if (a.role == Role::depth) {
            rendering.depthAttachmentFormat = a.format;
        } else if (a.role == Role::stencil) {
            rendering.stencilAttachmentFormat = a.format;
        } else if (!a.is_resolved()) {
            formats.push_back(a.format);
        }
    }
    rendering.colorAttachmentCount = static_cast<uint32_t>(formats.size());
    rendering.pColorAttachmentFormats = formats.data();
    rendering.rasterizationSamples = static_cast<VkSampleCountFlagBits>(plan.test->target.samples);
    VkCommandBufferInheritanceInfo inheritance =
        Typed{VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO};
    inheritance.pNext = &rendering;
    VkCommandBufferBeginInfo begin = Typed{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    const bool is_reused = plan.test->variation.door == Door::secondary_reused;
    begin.flags = VkCommandBufferUsageFlags{VK_COMMAND_BUFFER_USAGE_RENDER_PASS_CONTINUE_BIT} |
                  (is_reused ? VK_COMMAND_BUFFER_USAGE_SIMULTANEOUS_USE_BIT
                             : VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT);
    begin.pInheritanceInfo = &inheritance;
    check(Stage::submit, vk.vkBeginCommandBuffer(secondary, &begin), "vkBeginCommandBuffer");
    for (uint32_t k = first; k < end; ++k) {
        record_draw(device, pipelines, secondary, plan, k, vertices);
    }
    check(Stage::submit, vk.vkEndCommandBuffer(secondary), "vkEndCommandBuffer");
}

void render_by_secondaries(const Device& device, const PipelineCache& pipelines,
                           VkCommandBuffer commands, const CasePlan& plan, VkBuffer vertices) {
    const auto draws = static_cast<uint32_t>(plan.draws.size());
    const auto count = static_cast<uint32_t>(plan.secondaries.size());
    for (uint32_t k = 0; k < count; ++k) {
        record_secondary(device, pipelines, plan.secondaries[k], plan, count == 1 ? 0 : k,
                         count == 1 ? draws : k + 1, vertices);
    }
    const Attached attached(plan, VK_ATTACHMENT_LOAD_OP_CLEAR,
                            VK_RENDERING_CONTENTS_SECONDARY_COMMAND_BUFFERS_BIT);
    const auto execute = [&] {
        device.vk().vkCmdBeginRendering(commands, &attached.info());
        device.vk().vkCmdExecuteCommands(commands, count, plan.secondaries.data());
        device.vk().vkCmdEndRendering(commands);
    };
    execute();
    if (plan.test->variation.door == Door::secondary_reused) {
        // Nothing of the first time may be left: targets, what they are resolved into, counts.
        barrier(device, commands, plan, kColorDrawn, kColorDrawn, kDepthDrawn, kDepthDrawn);
        clear_resolved(device, commands, plan);
        if (plan.queries) {
            plan.queries->reset(commands);
        }
        execute();
    }
}

// A rendering without draws, which clears, then one for each draw. With `next` each has a command
// buffer of its own.
void render_in_pieces(const Device& device, const PipelineCache& pipelines,
                      VkCommandBuffer& commands, const CasePlan& plan, VkBuffer vertices,
                      bool suspends, const NextCommands& next = {}) {
    const auto draws = static_cast<uint32_t>(plan.draws.size());
    for (uint32_t piece = 0; piece <= draws; ++piece) {
        VkRenderingFlags flags = 0;
        if (suspends) {
            flags = (piece > 0 ? VkRenderingFlags{VK_RENDERING_RESUMING_BIT} : 0U) |
                    (piece < draws ? VkRenderingFlags{VK_RENDERING_SUSPENDING_BIT} : 0U);
        } else if (piece > 0) {
            if (next) {
                commands = next();
            }
            barrier(device, commands, plan, kColorDrawn, kColorDrawn, kDepthDrawn, kDepthDrawn);
        }
        // All parts of a suspended rendering begin alike.
        const bool loads = piece > 0 && !suspends;
        const Attached attached(plan,
                                loads ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR,
                                flags, suspends || piece == draws);
        device.vk().vkCmdBeginRendering(commands, &attached.info());
        if (piece > 0) {
            record_draw(device, pipelines, commands, plan, piece - 1, vertices);
        }
        device.vk().vkCmdEndRendering(commands);
    }
}

void render_at_once(const Device& device, const PipelineCache& pipelines, VkCommandBuffer commands,
                    const CasePlan& plan, VkBuffer vertices) {
    const Door door = plan.test->variation.door;
    const bool clears = door == Door::clear_commands || door == Door::clear_draw;
    if (clears || plan.test->target.has_operations()) {
        // Contents that are undefined shall not be by chance those of the plain picture.
        const Attached other(plan, VK_ATTACHMENT_LOAD_OP_CLEAR, 0, false,
                             clears ? other_clear : earlier_clear);
        device.vk().vkCmdBeginRendering(commands, &other.info());
        device.vk().vkCmdEndRendering(commands);
        barrier(device, commands, plan, kColorDrawn, kColorDrawn, kDepthDrawn, kDepthDrawn);
    }
    const Attached attached(
        plan, clears ? std::optional(VK_ATTACHMENT_LOAD_OP_DONT_CARE) : std::nullopt, 0);
    device.vk().vkCmdBeginRendering(commands, &attached.info());
    if (door == Door::clear_commands) {
        clear_by_command(device, commands, plan);
    } else if (door == Door::clear_draw) {
        clear_by_draws(device, pipelines, commands, plan);
    }
    for (uint32_t k = 0; k < plan.draws.size(); ++k) {
        record_draw(device, pipelines, commands, plan, k, vertices);
    }
    device.vk().vkCmdEndRendering(commands);
}

}  // namespace

size_t secondaries_of(const CasePlan& plan) {
    switch (plan.test->variation.door) {
        case Door::secondary:
        case Door::secondary_reused:
            return 1;
        case Door::secondary_each:
            return plan.draws.size();
        default:
            return 0;
    }
}

void record_draws(const Device& device, const PipelineCache& pipelines, VkCommandBuffer& commands,
                  const CasePlan& plan, VkBuffer vertices, bool for_copies,
                  const NextCommands& next) {
    if (plan.test->variation.door == Door::transform_feedback) {
        record_feedback(device, commands, plan, vertices);
    }
    spoil_aliases(device, commands, plan);
    barrier(device, commands, plan, kReused, kColorDrawn, kReused, kDepthDrawn);
    clear_resolved(device, commands, plan);
    if (plan.queries) {
        plan.queries->reset(commands);
    }
    const Door door = plan.test->variation.door;
    if (!plan.secondaries.empty()) {
        render_by_secondaries(device, pipelines, commands, plan, vertices);
    } else if (door == Door::pass_split || door == Door::pass_suspended ||
               door == Door::submissions) {
        render_in_pieces(device, pipelines, commands, plan, vertices, door == Door::pass_suspended,
                         door == Door::submissions ? next : NextCommands());
    } else if (plan.framebuffer) {
        render_by_pass(device, pipelines, commands, plan, vertices);
    } else {
        render_at_once(device, pipelines, commands, plan, vertices);
    }
    if (for_copies) {
        // Samples are read by a shader; guards (guard.hpp) are copied whatever the target is.
        ImageUse after = plan.test->target.is_read_by_shader() ? kSampled : kCopied;
        after.stage |= kCopied.stage;
        barrier(device, commands, plan, kColorDrawn, after, kDepthDrawn, after, &kCopied);
    }
}

}  // namespace vk_harness
