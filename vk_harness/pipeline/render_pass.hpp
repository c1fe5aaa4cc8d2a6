// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Render pass objects that do what the rendering of a case does: clear, draw, resolve, store.
#pragma once

#include <compare>
#include <vector>

#include "cases/model/case.hpp"
#include "vk_harness/target/attachments.hpp"
#include "vk_harness/target/target_layout.hpp"

namespace vk_harness {

// What distinguishes two render passes. Attachments are numbered as in attachments_of, without
// those that lie in the image of another.
struct PassKey {
    struct Part {
        Role role = Role::color;
        VkFormat format = VK_FORMAT_UNDEFINED;
        bool has_stencil = false;  // an attachment beside it is the stencil of its image
        friend auto operator<=>(const Part&, const Part&) = default;
    };
    std::vector<Part> parts;
    uint32_t samples = 1;
    cases::Resolve color_resolve = cases::Resolve::none, depth_resolve = cases::Resolve::none,
                   stencil_resolve = cases::Resolve::none;
    uint32_t subpasses = 1;  // 1 or 2, which draw to the same attachments; the last one resolves
    bool clears_resolved = false;  // what is resolved into; else that has been cleared before
    // What one more subpass, which draws to none, reads as input attachments; empty: there is none.
    struct Input {
        uint32_t part = 0;
        VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
        friend auto operator<=>(const Input&, const Input&) = default;
    };
    std::vector<Input> inputs = {};
    friend auto operator<=>(const PassKey&, const PassKey&) = default;
};

// Whether the case is rendered by a render pass object.
bool has_pass(const cases::Case& c, const TargetLayout& layout);
PassKey pass_key(const cases::Case& c, const TargetLayout& layout);
// The subpass of draw number `draw`.
uint32_t subpass_of(const cases::Case& c, size_t draw);

// In which the subpass of PassKey::inputs reads such an attachment.
VkImageLayout input_layout(VkImageAspectFlags aspect);

Handle<VkRenderPass> make_render_pass(const Device& device, const PassKey& key);

}  // namespace vk_harness
