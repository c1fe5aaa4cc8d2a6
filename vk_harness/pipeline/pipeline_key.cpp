// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/pipeline/pipeline_key.hpp"

#include <algorithm>
#include <bit>

#include "cases/format/color_format.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/sample.hpp"
#include "vk_harness/device/format.hpp"
#include "vk_harness/target/shader_interface.hpp"
#include "vk_harness/target/target_way.hpp"

namespace vk_harness {

namespace {

AttributeKey attribute_key(const cases::Attribute& attribute) {
    AttributeKey key;
    key.interpolation = attribute.interpolation;
    key.auxiliary = attribute.auxiliary;
    key.source = attribute.source;
    key.probe = attribute.probe;
    return key;
}

PipelineWay pipeline_way(cases::Door door) {
    switch (door) {
        case cases::Door::unoptimized:
            return PipelineWay::unoptimized;
        case cases::Door::pipeline_library:
            return PipelineWay::library;
        case cases::Door::pipeline_derived:
            return PipelineWay::derived;
        case cases::Door::pipeline_cached:
            return PipelineWay::cached;
        default:
            return PipelineWay::usual;
    }
}

StageWay stage_way(cases::Door door) {
    switch (door) {
        case cases::Door::geometry:
            return StageWay::geometry;
        case cases::Door::geometry_strip:
            return StageWay::geometry_strip;
        case cases::Door::tessellation:
            return StageWay::tessellation;
        case cases::Door::mesh_shader:
            return StageWay::mesh;
        default:
            return StageWay::vertex;
    }
}

ColorKey color_key(const cases::ColorTarget& target, const cases::ColorOutput& output) {
    ColorKey key;
    key.format = to_vulkan(target.format);
    key.output = output_of(key.format);
    key.write_mask = output.write_mask;
    if (output.blend) {
        key.blends = true;
        const cases::BlendEquation& c = output.blend->color;
        const cases::BlendEquation& a = output.blend->alpha;
        key.equation = {static_cast<uint8_t>(c.source),      static_cast<uint8_t>(c.destination),
                        static_cast<uint8_t>(c.op),          static_cast<uint8_t>(a.source),
                        static_cast<uint8_t>(a.destination), static_cast<uint8_t>(a.op)};
    }
    return key;
}

// The location of the first colour: behind those of the instruments.
uint32_t first_color(const PipelineKey& key) {
    return key.instruments ? (key.layout.split ? kSplitAttachments : kPackedAttachments) +
                                 key.attribute_count * key.layout.attribute_attachments()
                           : 0;
}

// Whether no attachment of the rendering has depth, and none stencil, in whatever image.
bool tests_nothing(const PipelineKey& key) {
    return !key.has_depth && !key.has_stencil;
}

// State that is on and changes nothing; what of it is dynamic draw_state() switches on. Sources,
// all Vulkan specification: without an attachment the coverage is left as it is ("Stencil Test"),
// the test skipped ("Depth Test") or passed ("Depth Bounds Test"). "Blend Operations": ONE and ZERO
// add up to the source where no destination is infinite or no number. "Logical Operations": COPY is
// the source, formats that take no such operations get the colour unmodified, and blending counts
// as off while they are on, for all attachments.
void switch_on_unused(PipelineKey& key) {
    key.unused_tests = true;
    const TargetLayout::Unused& device = key.layout.unused;
    const bool may_copy = device.logic && !key.instruments && !key.logic &&
                          std::ranges::none_of(key.colors, &ColorKey::blends);
    // A lone colour that can be blended is, else bits are copied.
    const bool copies = may_copy && (device.blends == 0 || key.colors.size() > 1);
    for (uint32_t k = 0; k < key.colors.size(); ++k) {
        ColorKey& color = key.colors[k];
        if (!color.blends && (device.blends >> k & 1U) != 0) {
            const bool is_off = key.logic.has_value() || copies;
            const auto destination =
                static_cast<uint8_t>(is_off ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ZERO);
            color.blends = true;
            color.equation = {VK_BLEND_FACTOR_ONE, destination, VK_BLEND_OP_ADD,
                              VK_BLEND_FACTOR_ONE, destination, VK_BLEND_OP_ADD};
        }
    }
    if (copies && !key.colors.empty()) {
        key.logic = cases::LogicOp::copy;
    }
    key.unused_bounds = device.bounds && tests_nothing(key) && !key.tests_bounds;
}

}  // namespace

shaders::Output output_of(VkFormat format) {
    const auto* row =
        std::ranges::find(cases::kColorFormats, uint32_t{format}, &cases::ColorFormatRow::vulkan);
    return row == cases::kColorFormats.end() || !cases::is_integer(row->kind)
               ? shaders::Output::number
           : cases::is_signed(row->kind) ? shaders::Output::signed_whole
                                         : shaders::Output::whole;
}

PipelineKey pipeline_key(const cases::Case& c, const cases::Draw& draw,
                         const TargetLayout& layout) {
    PipelineKey key;
    key.attribute_count = input_count(c);
    key.samples = c.target.samples;
    for (uint32_t k = 0; k < key.attribute_count; ++k) {
        if (const cases::Attribute* attribute = input_attribute(c, draw, k)) {
            key.attributes[k] = attribute_key(*attribute);
        } else {
            key.attributes[k].interpolation = cases::Interpolation::flat;
        }
    }
    key.viewports = viewport_count(c);
    key.viewport_index = key.viewports > 1;
    key.layer = names_layers(c);
    key.clip_count = draw.distances.clip_count;
    key.cull_count = draw.distances.cull_count;
    key.matrix = draw.matrix;
    key.way = vertex_way(c, draw, layout.vertex_formats);
    key.negative_one_to_one = draw.depth.negative_one_to_one;
    key.provoking = draw.provoking;
    key.writes_mask = draw.multisample.shader_mask.has_value();
    key.discards = draw.discard != cases::Discard::none;
    key.discard_by = draw.discard_by;
    key.early_tests = draw.early_tests;
    key.writes_depth = draw.frag_depth.has_value();
    key.depth_layout = draw.frag_depth ? draw.frag_depth->layout : cases::DepthLayout::any;
    key.sample_mask = draw.multisample.sample_mask;
    if (draw.multisample.min_sample_shading) {
        key.min_shading_bits = std::bit_cast<uint32_t>(*draw.multisample.min_sample_shading);
    }
    key.sample_locations = c.target.sample_locations;
    key.masked = c.variation.masked;
    if (c.variation.door == cases::Door::state_static) {
        key.fixed = draw_state(c, draw);
    } else if (layout.holds_state) {
        key.fixed = without_numbers(draw_state(c, draw));
        key.sets_numbers = true;
    }
    key.made = pipeline_way(c.variation.door);
    key.stages = stage_way(c.variation.door);
    if (layout.has_geometry && key.stages == StageWay::vertex) {
        key.stages = StageWay::geometry;
    }
    if (has_pass(c, layout)) {
        key.pass = pass_key(c, layout);
        key.subpass = subpass_of(c, static_cast<size_t>(&draw - c.draws.data()));
    }
    key.view_mask = view_mask(c);
    key.depth_format = c.target.depth_format;
    key.depth_clamp = draw.depth.clamp;
    key.depth_clip = draw.depth.clip;
    key.conservative = draw.conservative;
    key.extra_bits = std::bit_cast<uint32_t>(draw.conservative_extra);
    key.fragment_size = draw.fragment_size;
    key.tests_bounds = cases::tests_bounds(c);
    key.has_depth = c.target.has_depth;
    key.has_stencil = c.target.has_stencil;
    key.instruments = c.target.has_instruments;
    key.layout = layout;
    if (c.target.color) {
        key.color = cases::is_integer(c.target.color->format) ? shaders::ColorKind::integer
                                                              : shaders::ColorKind::number;
        if (draw.color.blend && cases::takes_second(*draw.color.blend)) {
            key.color = shaders::ColorKind::two_numbers;
        }
        if (!c.target.other_colors.empty()) {
            key.color = shaders::ColorKind::several;
        }
        for (uint32_t k = 0; k < c.target.color_count(); ++k) {
            key.colors.push_back(
                color_key(c.target.color_at(k), cases::output_at(c.target, draw, k)));
            key.colors.back().attribute = input_of_color(c, draw, k);
        }
        key.color_from = draw.color.from;
        for (int k = 0; key.color_from == cases::ColorFrom::constant && k < 4; ++k) {
            key.constant_bits.at(static_cast<size_t>(k)) =
                std::bit_cast<uint32_t>(draw.color.value[k]);
        }
        key.logic = draw.color.logic;
        key.alpha_to_one = draw.color.alpha_to_one;
        key.alpha_to_coverage = draw.color.alpha_to_coverage;
    }
    if (c.variation.door == cases::Door::state_unused) {
        switch_on_unused(key);
    }
    if (c.variation.door == cases::Door::stage_unused) {
        key.unused_interface = true;
        // A shader with two sources for a colour has no others (maxFragmentDualSrcAttachments).
        const uint32_t location = first_color(key) + static_cast<uint32_t>(key.colors.size());
        if (location < layout.most_colors && key.color != shaders::ColorKind::two_numbers) {
            key.unused_color = location;
        }
    }
    return key;
}

shaders::VertexVariant vertex_variant(const PipelineKey& key) {
    // The last stage before rasterization chooses layer and viewport.
    const bool is_last = key.stages == StageWay::vertex;
    return {key.attribute_count,           key.clip_count, key.cull_count,   is_last && key.layer,
            is_last && key.viewport_index, key.way.pulled, key.way.instances};
}

shaders::VertexVariant geometry_variant(const PipelineKey& key) {
    return {key.attribute_count, key.clip_count, key.cull_count, key.layer, key.viewport_index};
}

shaders::OutputChange output_change(const PipelineKey& key) {
    shaders::OutputChange out;
    if (key.color != shaders::ColorKind::several && key.color != shaders::ColorKind::integer) {
        return out;
    }
    out.first_location = first_color(key);
    for (const ColorKey& color : key.colors) {
        out.kept.push_back(color.output);
    }
    return out;
}

std::vector<uint32_t> execution_modes(const PipelineKey& key) {
    std::vector<uint32_t> modes;
    if (key.early_tests) {
        modes.push_back(shaders::kEarlyFragmentTests);
    }
    switch (key.depth_layout) {
        case cases::DepthLayout::any:
            break;
        case cases::DepthLayout::greater:
            modes.push_back(shaders::kDepthGreater);
            break;
        case cases::DepthLayout::less:
            modes.push_back(shaders::kDepthLess);
            break;
        case cases::DepthLayout::unchanged:
            modes.push_back(shaders::kDepthUnchanged);
            break;
    }
    return modes;
}

bool needs_fragments(const PipelineKey& key) {
    return key.instruments || !key.colors.empty() || key.discards || key.writes_depth ||
           key.writes_mask;
}

std::span<const uint32_t> vertex_code(const PipelineKey& key) {
    return key.matrix ? shaders::matrix_vertex(key.attribute_count)
                      : shaders::capture_vertex(vertex_variant(key));
}

std::span<const uint32_t> fragment_code(const PipelineKey& key) {
    return key.color_from == cases::ColorFrom::push_constant
               ? shaders::capture_fragment(fragment_variant(key))
               : shaders::bare_fragment(static_cast<uint32_t>(key.color_from));
}

shaders::FragmentVariant fragment_variant(const PipelineKey& key) {
    shaders::FragmentVariant v;
    v.attributes = key.attribute_count;
    v.mask_out = key.writes_mask;
    v.discards = key.discards;
    v.depth_out = key.writes_depth;
    v.color = key.color;
    v.instruments = key.instruments;
    v.split = key.layout.split;
    v.pairs = key.layout.pairs;
    for (const AttributeKey& attribute : key.attributes) {
        switch (attribute.source) {
            case cases::Source::vertex:
                break;
            case cases::Source::barycentric:
                v.barycentrics = true;
                break;
            case cases::Source::sample_mask_in:
                v.mask_in = true;
                break;
            case cases::Source::sample_id:
            case cases::Source::sample_position:
                v.sample = true;
                break;
            case cases::Source::shading_rate:
                v.rate = true;
                break;
        }
        v.lod = v.lod || attribute.probe == cases::Probe::lod;
        v.probes = v.probes ||
                   (attribute.probe != cases::Probe::value && attribute.probe != cases::Probe::lod);
    }
    // The build compiles lod with the probes, and the sample built-ins with the mask (which changes
    // nothing once there is sample shading).
    v.probes = v.probes || v.lod;
    v.mask_in = v.mask_in || v.sample;
    return v;
}

}  // namespace vk_harness
