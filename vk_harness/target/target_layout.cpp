// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/target/target_layout.hpp"

#include <algorithm>

#include "cases/format/color_format.hpp"
#include "cases/model/derive.hpp"
#include "vk_harness/target/shader_interface.hpp"

namespace vk_harness {

namespace {

// A draw and a primitive of it are one number that binary32 holds (decode_packed_id), and the draw
// and their number one push constant. No draw has more primitives than indices or vertices.
bool ids_fit(const cases::Case& test) {
    size_t most = 0;
    for (const cases::Draw& draw : test.draws) {
        most = std::max(most, draw.element_count());
    }
    return test.draws.size() < 0x10000 &&
           (most + 2) * std::max(test.draws.size(), size_t{1}) < kMaxId;
}

// Pipelines that discard for good have no samples, and those of a dynamic rendering have to have
// those of the attachments (VUID-vkCmdDraw-multisampledRenderToSingleSampled-07285).
bool discards_several_samples(const cases::Case& test) {
    return test.target.samples > 1 &&
           std::ranges::any_of(test.draws, &cases::Draw::rasterizer_discard);
}

TargetLayout::Unused unused_state(const Capabilities& c, const cases::Case& test) {
    TargetLayout::Unused out;
    if (test.variation.door != cases::Door::state_unused) {
        return out;
    }
    out.bounds = c.depth_bounds;
    out.logic = c.logic_op;
    for (uint32_t k = 0; test.target.color && k < test.target.color_count(); ++k) {
        const cases::ColorFormat format = test.target.color_at(k).format;
        const cases::ComponentKind kind = cases::row_of(format).kind;
        // 0 times an infinite destination is no number, and +0 is added to -0: not with floats.
        const bool is_normalized =
            kind == cases::ComponentKind::unorm || kind == cases::ComponentKind::srgb;
        const bool can_blend = has_features(c, static_cast<VkFormat>(cases::row_of(format).vulkan),
                                            VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT);
        out.blends |= (is_normalized && can_blend ? 1U : 0U) << k;
    }
    return out;
}

}  // namespace

std::optional<std::string> closed_by(const TargetLayout& layout, cases::Door door) {
    using cases::Door;
    switch (door) {
        case Door::secondary:
        case Door::secondary_each:
        case Door::secondary_reused:
        case Door::pass_split:
        case Door::pass_suspended:
        case Door::clear_commands:
        case Door::clear_draw:
        case Door::submissions:
        case Door::pipeline_library:
        case Door::transform_feedback:
            if (layout.has_pass) {
                return "the device renders the case by a render pass object, and this door by "
                       "dynamic rendering alone";
            }
            break;
        case Door::shader_objects:
            if (layout.holds_state) {
                return "the device lacks extendedDynamicState, which this door needs";
            }
            [[fallthrough]];
        case Door::multiview:
        case Door::multiview_all:
            if (layout.has_pass || layout.has_geometry) {
                return "the device renders the case by a render pass object or a geometry shader, "
                       "and this door by neither";
            }
            break;
        case Door::render_pass:
            if (layout.has_pass) {
                return "the device renders the case by a render pass object without the door, too";
            }
            break;
        case Door::geometry:
        case Door::geometry_strip:
            if (layout.has_geometry) {
                return "the device has a geometry shader name layers and viewports without the "
                       "door, too";
            }
            break;
        case Door::stride_dynamic:
            if (layout.holds_state) {
                return "the device lacks extendedDynamicState, which this door needs";
            }
            break;
        default:
            break;
    }
    return std::nullopt;
}

uint32_t TargetLayout::numbers(uint32_t attribute) const {
    return pairs ? 2U : attribute < components.size() ? components.at(attribute) : 4U;
}

VkFormat TargetLayout::attribute_format(uint32_t attribute) const {
    return numbers(attribute) == 2 ? kTwoNumbers : kColorFormat;
}

cases::DepthFormat depth_beside_stencil(const Capabilities& c, const cases::Target& target) {
    return target.has_depth ? target.depth_format : c.beside_stencil;
}

TargetLayout target_layout(const Capabilities& c, const cases::Case& test) {
    TargetLayout layout;
    layout.unused = unused_state(c, test);
    layout.holds_state = !c.core.dynamic_state;
    layout.has_pass =
        !c.core.dynamic_rendering || (layout.holds_state && discards_several_samples(test));
    layout.has_geometry =
        (names_layers(test) && !c.layer_output) || (viewport_count(test) > 1 && !c.viewport_output);
    if (test.variation.door == cases::Door::exact_formats) {
        layout.vertex_formats = c.doors.vertex_formats;
    } else if (test.variation.door == cases::Door::stage_unused) {
        layout.most_colors =
            std::min({c.info.max_color_attachments, c.limits.maxFragmentOutputAttachments,
                      c.limits.maxFragmentCombinedOutputResources});
    }
    if (test.target.has_stencil) {
        layout.stencil_format = depth_stencil_format(depth_beside_stencil(c, test.target));
    }
    layout.halves = test.target.has_instruments && !c.blends_wide;
    if (!test.target.has_instruments || !ids_fit(test) ||
        (c.narrow_sample_counts & test.target.samples) == 0) {
        return layout;
    }
    const uint32_t attributes = std::min(cases::attributes_of(test), cases::kMaxAttributes);
    bool has_wide = false;
    for (uint32_t k = 0; k < attributes; ++k) {
        const bool is_wide = std::ranges::any_of(test.draws, [k](const auto& d) {
            return k < d.attributes.size() && !cases::has_two_numbers(d.attributes[k]);
        });
        layout.components.at(k) = is_wide ? 4 : 2;
        has_wide = has_wide || is_wide;
    }
    const uint32_t all = kSplitAttachments + attributes + test.target.color_count();
    const uint32_t limit = std::min(kMaxSplitAttachments, c.info.max_color_attachments);
    layout.split = all <= limit;
    layout.pairs = has_wide && all + attributes <= limit;
    layout.halves = layout.split ? !c.blends_narrow : !c.blends_wide;
    return layout;
}

}  // namespace vk_harness
