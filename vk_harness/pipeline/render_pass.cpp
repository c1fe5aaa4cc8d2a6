// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/render_pass.hpp"

#include <algorithm>
#include <optional>

#include "vk_harness/target/resolve.hpp"

namespace vk_harness {

using cases::Door;

namespace {

constexpr VkImageLayout kColorLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
constexpr VkImageLayout kDepthLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

bool is_depth_stencil(Role role) {
    return role == Role::depth || role == Role::stencil || role == Role::resolved_depth ||
           role == Role::resolved_stencil;
}

VkAttachmentDescription2 description_of(const PassKey::Part& part, const PassKey& key) {
    VkAttachmentDescription2 out = Typed{VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_2};
    const bool is_resolved = part.role >= Role::resolved_color;
    const VkAttachmentLoadOp load = is_resolved && !key.clears_resolved
                                        ? VK_ATTACHMENT_LOAD_OP_LOAD
                                        : VK_ATTACHMENT_LOAD_OP_CLEAR;
    out.format = part.format;
    out.samples = static_cast<VkSampleCountFlagBits>(is_resolved ? 1 : key.samples);
    const bool is_stencil = part.role == Role::stencil || part.role == Role::resolved_stencil;
    const bool is_used = !is_stencil;
    out.loadOp = is_used ? load : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    out.storeOp = is_used ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    const bool has_stencil = part.has_stencil || is_stencil;
    out.stencilLoadOp = has_stencil ? load : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    out.stencilStoreOp =
        has_stencil ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    out.initialLayout = out.finalLayout = is_depth_stencil(part.role) ? kDepthLayout : kColorLayout;
    return out;
}

VkAttachmentReference2 reference(uint32_t number, VkImageLayout layout) {
    VkAttachmentReference2 out = Typed{VK_STRUCTURE_TYPE_ATTACHMENT_REFERENCE_2};
    out.attachment = number;
    out.layout = layout;
    return out;
}

// What the subpasses refer to: not to be moved.
struct References {
    std::vector<uint32_t> preserved;
    std::vector<VkAttachmentReference2> colors, resolves, inputs;
    std::optional<VkAttachmentReference2> depth, resolved_depth;
    VkSubpassDescriptionDepthStencilResolve depth_resolve =
        Typed{VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE};

    explicit References(const PassKey& key) {
        size_t judged = 0;  // among the colours
        for (uint32_t k = 0; k < key.parts.size(); ++k) {
            switch (key.parts[k].role) {
                case Role::depth:
                case Role::stencil:
                    depth = reference(k, kDepthLayout);
                    break;
                case Role::resolved_depth:
                case Role::resolved_stencil:
                    resolved_depth = reference(k, kDepthLayout);
                    break;
                case Role::resolved_color:
                    resolves.assign(colors.size(), reference(VK_ATTACHMENT_UNUSED, kColorLayout));
                    resolves.at(judged) = reference(k, kColorLayout);
                    break;
                case Role::color:
                    judged = colors.size();
                    colors.push_back(reference(k, kColorLayout));
                    break;
                default:
                    colors.push_back(reference(k, kColorLayout));
                    break;
            }
        }
        for (const PassKey::Input& input : key.inputs) {
            inputs.push_back(reference(input.part, input_layout(input.aspect)));
            inputs.back().aspectMask = input.aspect;
        }
        for (uint32_t k = 0; k < key.parts.size(); ++k) {
            if (std::ranges::none_of(key.inputs,
                                     [k](const auto& input) { return input.part == k; })) {
                preserved.push_back(k);
            }
        }
        if (resolved_depth) {
            depth_resolve.depthResolveMode = resolve_mode(key.depth_resolve);
            depth_resolve.stencilResolveMode = resolve_mode(key.stencil_resolve);
            depth_resolve.pDepthStencilResolveAttachment = &*resolved_depth;
        }
    }

    VkSubpassDescription2 reading() const {
        VkSubpassDescription2 out = Typed{VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_2};
        out.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
        out.inputAttachmentCount = static_cast<uint32_t>(inputs.size());
        out.pInputAttachments = inputs.data();
        // What is neither read nor preserved would be undefined, and is copied behind the pass.
        out.preserveAttachmentCount = static_cast<uint32_t>(preserved.size());
        out.pPreserveAttachments = preserved.data();
        return out;
    }

    VkSubpassDescription2 subpass(bool resolved) const {
        VkSubpassDescription2 out = Typed{VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_2};
        out.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
        out.colorAttachmentCount = static_cast<uint32_t>(colors.size());
        out.pColorAttachments = colors.data();
        out.pDepthStencilAttachment = depth ? &*depth : nullptr;
        if (resolved && !resolves.empty()) {
            out.pResolveAttachments = resolves.data();
        }
        if (resolved && resolved_depth) {
            out.pNext = &depth_resolve;
        }
        return out;
    }
};

}  // namespace

bool has_pass(const cases::Case& c, const TargetLayout& layout) {
    return layout.has_pass || c.variation.door == Door::render_pass ||
           c.variation.door == Door::subpasses || c.variation.door == Door::input_attachment;
}

PassKey pass_key(const cases::Case& c, const TargetLayout& layout) {
    PassKey key;
    for (const Attachment& a : attachments_of(c, layout)) {
        if (a.is_beside_depth) {
            key.parts.back().has_stencil = true;
        } else {
            key.parts.push_back({a.role, a.format, false});
        }
        if (a.is_input) {
            key.inputs.push_back({static_cast<uint32_t>(key.parts.size() - 1), a.aspect()});
        }
    }
    key.samples = c.target.samples;
    key.color_resolve = c.target.color_resolve;
    key.depth_resolve = c.target.depth_resolve;
    key.stencil_resolve = c.target.stencil_resolve;
    key.clears_resolved = layout.has_pass;
    key.subpasses = c.variation.door == Door::subpasses ? 2 : 1;
    return key;
}

uint32_t subpass_of(const cases::Case& c, size_t draw) {
    return c.variation.door == Door::subpasses && (draw > 0 || c.draws.size() == 1) ? 1 : 0;
}

VkImageLayout input_layout(VkImageAspectFlags aspect) {
    return aspect == VK_IMAGE_ASPECT_COLOR_BIT ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
                                               : VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
}

Handle<VkRenderPass> make_render_pass(const Device& device, const PassKey& key) {
    std::vector<VkAttachmentDescription2> descriptions;
    for (const PassKey::Part& part : key.parts) {
        descriptions.push_back(description_of(part, key));
    }
    const References references(key);
    std::vector<VkSubpassDescription2> subpasses;
    for (uint32_t k = 0; k < key.subpasses; ++k) {
        subpasses.push_back(references.subpass(k + 1 == key.subpasses));
    }
    if (!key.inputs.empty()) {
        subpasses.push_back(references.reading());
    }
    VkSubpassDependency2 next = Typed{VK_STRUCTURE_TYPE_SUBPASS_DEPENDENCY_2};
    next.srcSubpass = 0;
    next.dstSubpass = 1;
    next.srcStageMask = next.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                            VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                            VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
    next.srcAccessMask = next.dstAccessMask =
        VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
        VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    next.dependencyFlags = VK_DEPENDENCY_BY_REGION_BIT;
    std::vector<VkSubpassDependency2> dependencies;
    if (key.subpasses > 1) {
        dependencies.push_back(next);
    }
    if (!key.inputs.empty()) {
        VkSubpassDependency2 read = next;
        read.dstStageMask = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
        read.dstAccessMask = VK_ACCESS_INPUT_ATTACHMENT_READ_BIT;
        // A region is a sample where all are drawn singly; the shader reads all of a pixel.
        read.dependencyFlags =
            key.samples > 1 ? 0U : VkDependencyFlags{VK_DEPENDENCY_BY_REGION_BIT};
        dependencies.push_back(read);
        // What has been read changes its layout at the end, and is copied then.
        VkSubpassDependency2 end = next;
        end.srcSubpass = 1;
        end.dstSubpass = VK_SUBPASS_EXTERNAL;
        end.srcStageMask = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
        end.srcAccessMask = VK_ACCESS_INPUT_ATTACHMENT_READ_BIT;
        end.dependencyFlags = 0;
        dependencies.push_back(end);
    }

    VkRenderPassCreateInfo2 info = Typed{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO_2};
    info.attachmentCount = static_cast<uint32_t>(descriptions.size());
    info.pAttachments = descriptions.data();
    info.subpassCount = static_cast<uint32_t>(subpasses.size());
    info.pSubpasses = subpasses.data();
    info.dependencyCount = static_cast<uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    return make(device, Stage::pipeline, "vkCreateRenderPass2", device.vk().vkCreateRenderPass2,
                device.vk().vkDestroyRenderPass, info);
}

}  // namespace vk_harness
