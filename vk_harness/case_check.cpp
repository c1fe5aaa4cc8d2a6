// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/case_check.hpp"

#include <algorithm>

#include "cases/model/derive.hpp"
#include "vk_harness/commands/blit.hpp"
#include "vk_harness/draw_check.hpp"
#include "vk_harness/pipeline/pipeline_key.hpp"
#include "vk_harness/target/resolve.hpp"
#include "vk_harness/target/shader_interface.hpp"
#include "vk_harness/target/target_way.hpp"
#include "vk_harness/target_check.hpp"

namespace vk_harness {

namespace {

// No sample can be hit more often: the triangles of all draws, counted generously.
size_t most_hits(const cases::Case& c) {
    size_t triangles = 0;
    for (const cases::Draw& draw : c.draws) {
        const size_t corners = draw.instances * draw.element_count();
        triangles += draw.topology == cases::Topology::triangle_list ? corners / 3 : corners;
    }
    return triangles;
}

}  // namespace

// Hits and ids have to fit into the numbers that tell them.
std::optional<Rejection> check_counting(const Capabilities& device, const cases::Case& c,
                                        const TargetLayout& layout) {
    if (!c.target.has_instruments) {
        return std::nullopt;
    }
    if (layout.halves && c.target.samples > 1 && !device.portability.view_reinterpretation) {
        return unsupported(
            "hits of single samples cannot be read without the feature "
            "imageViewFormatReinterpretation (VK_KHR_portability_subset)");
    }
    const HitCode& code = layout.halves ? kBinary16Hits : kBinary32Hits;
    const uint32_t most = layout.split ? code.most : code.most_packed;
    if (const size_t hits = most_hits(c); hits > most) {
        const bool may_help = hits <= code.most;  // to have a number for each face
        return unsupported(
            "the case may hit a sample {} times, and the device {} up to {}{}", hits,
            layout.halves ? "blends 16-bit floats only, in which hits are counted" : "counts hits",
            may_help ? most : code.most,
            may_help ? "; leave out an attribute or the colour target" : "");
    }
    size_t ids = c.draws.size();
    for (const cases::Draw& draw : c.draws) {
        ids = std::max(ids, draw.indices ? std::max(draw.indices->size(), draw.positions.size())
                                         : draw.positions.size());
    }
    if (layout.halves && !layout.split && ids > kMaxHalfId) {
        return unsupported(
            "a draw has {} vertices, and the device blends 16-bit floats only, which tell {} apart",
            ids, kMaxHalfId);
    }
    return std::nullopt;
}

namespace {

void check_all(const Capabilities& capabilities, const cases::Case& c, bool reads_hits) {
    for (const cases::Draw& draw : c.draws) {
        check_draw(capabilities, draw);
        check_fragment_size(capabilities.fragment_sizes, draw, c.target);
        if (draw.other_colors.size() != c.target.other_colors.size()) {
            throw invalid("a draw writes to {} colour targets of {}", draw.other_colors.size() + 1,
                          c.target.color_count());
        }
        const std::vector<uint32_t> drawn = cases::drawn_attributes(c.target, draw);
        if (std::ranges::any_of(drawn, [&](uint32_t k) { return k >= draw.attributes.size(); })) {
            throw invalid("a draw's colour comes from an attribute that it does not have");
        }
    }
    c.blit ? check_blit(capabilities, c) : check_color(capabilities, c);
    check_resolve_and_stencil(capabilities, c.target);
    if (c.draws.size() >= kMaxId) {
        throw unsupported("the case has {} draws, the harness tells {} apart", c.draws.size(),
                          kMaxId - 1);
    }
    const uint32_t most = capabilities.viewport_output || can_have_geometry(capabilities, c)
                              ? capabilities.max_viewports
                              : 1;
    if (const uint32_t viewports = viewport_count(c); viewports > most) {
        throw unsupported(
            "the case chooses from {} viewports by gl_ViewportIndex, the device from {} (features "
            "multiViewport and shaderOutputViewportIndex)",
            viewports, most);
    }
    const TargetLayout layout = target_layout(capabilities, c);
    if (c.target.has_operations() && layout.has_pass) {
        throw unsupported(
            "the device lacks dynamicRendering, without which load and store operations are not "
            "drawn here");
    }
    if (c.target.loads_nothing() && !capabilities.has_load_none) {
        throw unsupported(
            "the device lacks VK_EXT_load_store_op_none, which the load operation none needs");
    }
    for (const cases::Draw& draw : c.draws) {
        if (draw.layer >= c.target.layers) {
            throw invalid("a draw goes to layer {} of {}", draw.layer, c.target.layers);
        }
        if (draw.clear) {
            continue;
        }
        const PipelineKey key = pipeline_key(c, draw, layout);
        refuse_without(key.discard_by == cases::DiscardBy::demote && !capabilities.discard.demote,
                       "shaderDemoteToHelperInvocation");
        refuse_without(
            key.discard_by == cases::DiscardBy::terminate && !capabilities.discard.terminate,
            "shaderTerminateInvocation");
        if (vertex_code(key).empty() || (needs_fragments(key) && fragment_code(key).empty())) {
            throw Rejection{
                Rendered::Status::not_built,
                "a draw asks for a combination of shader features that no shader was built for; "
                "put them into different draws"};
        }
    }
    refuse(missing_clip_support(capabilities.clip, c));
    // What is cleared by a draw has to be no rounded number, which a depth of D24S8 may be.
    if (c.variation.door == cases::Door::clear_draw && !cases::can_take(c.variation.door, c)) {
        throw unsupported(
            "the device's depth beside a stencil rounds the clear value, and a draw may round "
            "another way than a clear");
    }
    refuse(missing_instance_support(capabilities.doors, c));
    if (c.variation.door != cases::Door::none) {
        refuse(missing_door_support(capabilities.doors, c.variation.door));
        refuse(closed_by(layout, c.variation.door));
        refuse(missing_mesh_layers(capabilities.doors, c));
        refuse(missing_images(capabilities, c));
    }
    check_target(capabilities, c);
    // Last, since it says something of the harness, not of the device alone.
    if (auto rejection = check_counting(capabilities, c, layout); rejection && reads_hits) {
        throw *rejection;
    }
}

}  // namespace

std::optional<Rejection> check_case(const Capabilities& capabilities, const cases::Case& c,
                                    bool reads_hits) {
    try {
        check_all(capabilities, c, reads_hits);
        return std::nullopt;
    } catch (Rejection& rejection) {
        return std::move(rejection);
    }
}

}  // namespace vk_harness
