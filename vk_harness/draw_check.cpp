// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/draw_check.hpp"

#include <algorithm>
#include <cmath>

#include "cases/model/device.hpp"
#include "cases/model/sample.hpp"
#include "vk_harness/target/shader_interface.hpp"

namespace vk_harness {

namespace {

// A number is on the reference's finest grid, and so on every finer one.
bool is_on_finest_grid(float v) {
    const double steps = std::ldexp(double{v}, static_cast<int>(cases::kMostSubpixelBits));
    return !(std::floor(steps) < steps);
}

// A device may snap finer than the reference can follow; Vulkan sets no upper bound.
void check_grids(const DeviceInfo& device, const cases::Viewport& v) {
    constexpr const char* kText =
        "the device {} to 2^-{} pixels ({}), and the reference judges grids down to 2^-{}";
    if (device.subpixel_bits > cases::kMostSubpixelBits) {
        throw unsupported(kText, "snaps vertices", device.subpixel_bits, "subPixelPrecisionBits",
                          cases::kMostSubpixelBits);
    }
    // Bounds that are on the grid stay what they are.
    const float bounds[] = {v.x, v.y, v.width, v.height};
    if (device.viewport_subpixel_bits > cases::kMostSubpixelBits &&
        !std::all_of(std::begin(bounds), std::end(bounds), is_on_finest_grid)) {
        throw unsupported(kText, "keeps viewports", device.viewport_subpixel_bits,
                          "viewportSubPixelBits", cases::kMostSubpixelBits);
    }
}

void check_viewport(const Capabilities& c, const cases::Viewport& v) {
    const float height = std::abs(v.height);
    for (const float value : {v.x, v.y, v.width, v.height, v.min_depth, v.max_depth}) {
        if (!std::isfinite(value)) {
            throw invalid("the viewport has a number that is not finite");
        }
    }
    if (!(v.width > 0.0F) || v.min_depth < 0.0F || v.min_depth > 1.0F || v.max_depth < 0.0F ||
        v.max_depth > 1.0F) {
        throw invalid("the viewport's width must be positive and its depths lie in [0, 1]");
    }
    const auto max_width = static_cast<float>(c.limits.maxViewportDimensions[0]);
    const auto max_height = static_cast<float>(c.limits.maxViewportDimensions[1]);
    if (v.width > max_width || height > max_height) {
        throw unsupported("the viewport has {} x {} pixels, the device allows {} x {}", v.width,
                          height, max_width, max_height);
    }
    const float low = c.limits.viewportBoundsRange[0];
    const float high = c.limits.viewportBoundsRange[1];
    const float ends[] = {v.x, v.y, v.x + v.width, v.y + v.height};
    if (std::any_of(std::begin(ends), std::end(ends),
                    [low, high](float end) { return !(end >= low && end <= high); })) {
        throw unsupported("the viewport leaves the device's range of {} to {} pixels", low, high);
    }
    check_grids(c.info, v);
}

void check_depth(const Capabilities& c, const cases::DepthState& depth) {
    const bool clamps_bias = depth.bias && std::abs(depth.bias->clamp) > 0.0F;
    for (const auto& [lacks, feature] :
         {std::pair(depth.clamp && !c.depth_clamp, "depthClamp"),
          {depth.clip && !c.depth_clip_enable, "depthClipEnable of VK_EXT_depth_clip_enable"},
          {clamps_bias && !c.depth_bias_clamp, "depthBiasClamp"},
          {depth.bounds && !c.depth_bounds, "depthBounds"}}) {
        refuse_without(lacks, feature);
    }
    if (depth.bias) {
        refuse(missing_depth_bias_support(c.depth_bias, *depth.bias));
    }
}

// What an attribute asks of the fragment stage.
void check_attribute(const Capabilities& c, const cases::Draw& draw, const cases::Attribute& a) {
    const size_t vertices = draw.positions.size();
    if (a.source == cases::Source::vertex && a.values.size() != vertices) {
        throw invalid("attribute '{}' has {} values for {} vertices", a.name, a.values.size(),
                      vertices);
    }
    refuse_without(a.source == cases::Source::barycentric && !c.barycentrics,
                   "fragmentShaderBarycentric (VK_KHR_fragment_shader_barycentric)");
    const bool is_derivative = a.probe >= cases::Probe::dx && a.probe <= cases::Probe::width_coarse;
    const bool is_at = a.probe >= cases::Probe::at_centroid && a.probe <= cases::Probe::at_offset;
    // The shader that takes derivatives has interpolateAt* too.
    const bool needs_sample_rate = a.auxiliary == cases::Auxiliary::sample ||
                                   a.source == cases::Source::sample_id ||
                                   a.source == cases::Source::sample_position || is_derivative ||
                                   is_at || a.probe == cases::Probe::lod;
    refuse_without(needs_sample_rate && !c.has_sample_shading, "sampleRateShading");
    refuse_without((is_derivative || is_at || a.probe == cases::Probe::lod) &&
                       !c.portability.interpolation_functions,
                   "shaderSampleRateInterpolationFunctions (VK_KHR_portability_subset)");
    for (const float offset : a.probe_offset) {
        // Beyond the range the position is undefined; a device's range may end at 0.
        if (a.probe == cases::Probe::at_offset && !(offset >= c.limits.minInterpolationOffset &&
                                                    offset <= c.limits.maxInterpolationOffset)) {
            throw unsupported(
                "interpolateAtOffset by {} pixels leaves the device's range of {} to {}", offset,
                c.limits.minInterpolationOffset, c.limits.maxInterpolationOffset);
        }
    }
    for (const uint32_t side : a.texture_size) {
        if (a.probe == cases::Probe::lod && side > c.limits.maxImageDimension2D) {
            throw unsupported("a texture of {} texels a side exceeds the device's {}", side,
                              c.limits.maxImageDimension2D);
        }
    }
}

void check_conservative(const Capabilities& device, const cases::Draw& draw) {
    using enum cases::Conservative;
    if (draw.conservative == none) {
        return;
    }
    if (!device.has_conservative) {
        throw unsupported("the device lacks VK_EXT_conservative_rasterization");
    }
    if (draw.conservative == underestimate && !device.has_underestimation) {
        throw unsupported("the device does not underestimate (primitiveUnderestimation)");
    }
    if (!(draw.conservative_extra <= device.most_overestimation)) {
        throw unsupported(
            "the draw enlarges its triangles by {} pixels, the device allows {} "
            "(maxExtraPrimitiveOverestimationSize)",
            draw.conservative_extra, device.most_overestimation);
    }
}

}  // namespace

void check_draw(const Capabilities& c, const cases::Draw& draw) {
    check_viewport(c, draw.viewport);
    const cases::Rect& s = draw.scissor;
    constexpr int64_t kMax = 0x7fffffff;
    if (s.x < 0 || s.y < 0 || int64_t{s.x} + s.width > kMax || int64_t{s.y} + s.height > kMax) {
        throw invalid("the scissor must begin at 0 or later and end below 2^31");
    }
    refuse_without(draw.topology == cases::Topology::triangle_fan && !c.portability.triangle_fans,
                   "triangleFans");
    const std::optional<float> shading = draw.multisample.min_sample_shading;
    if (shading && (!(*shading >= 0.0F) || *shading > 1.0F)) {
        throw invalid("the fraction of samples that is shaded at least must lie in [0, 1]");
    }
    refuse_without(shading && !c.has_sample_shading, "sampleRateShading");
    if (draw.attributes.size() > cases::kMaxAttributes) {
        throw invalid("a draw has {} attributes, at most {} are allowed", draw.attributes.size(),
                      cases::kMaxAttributes);
    }
    refuse_without(draw.query == cases::Query::occlusion_precise && !c.precise_queries,
                   "occlusionQueryPrecise");
    refuse_without(cases::is_statistic(draw.query) && !c.pipeline_statistics,
                   "pipelineStatisticsQuery");
    check_conservative(c, draw);
    check_depth(c, draw.depth);
    const size_t vertices = draw.positions.size();
    for (const cases::Attribute& attribute : draw.attributes) {
        check_attribute(c, draw, attribute);
    }
    for (const auto& [count, distances] :
         {std::pair(draw.distances.clip_count, &draw.distances.clip),
          std::pair(draw.distances.cull_count, &draw.distances.cull)}) {
        if (count > 4 || distances->size() != (count > 0 ? vertices : 0)) {
            throw invalid("{} distances a vertex have values at {} of {} vertices", count,
                          distances->size(), vertices);
        }
    }
    const size_t elements = draw.indices ? draw.indices->size() : vertices;
    if (vertices >= kMaxId || elements >= kMaxId) {
        throw unsupported("a draw has {} vertices, the harness tells {} apart",
                          std::max(vertices, elements), kMaxId - 1);
    }
    if (draw.primitive_restart && !draw.indices) {
        throw invalid("primitive restart needs indices");
    }
    refuse_without(draw.primitive_restart && draw.topology == cases::Topology::triangle_list &&
                       !c.list_restart,
                   "primitiveTopologyListRestart (VK_EXT_primitive_topology_list_restart)");
    if (draw.indices) {
        for (const uint32_t index : *draw.indices) {
            const bool restart = draw.primitive_restart && index == cases::kRestartIndex;
            if (!restart && index >= draw.vertex_count()) {
                throw invalid("index {} is beyond the {} vertices of its draw", index,
                              draw.vertex_count());
            }
        }
    }
}

// "If any of the following conditions are met", fragments have one pixel (Vulkan specification,
// "Combining the Fragment Shading Rates"); those that a case may meet, with what a device may have
// against it.
void check_fragment_size(const FragmentSizeSupport& device, const cases::Draw& draw,
                         const cases::Target& target) {
    if (!cases::asks_shading_rate(draw)) {
        return;
    }
    refuse_without(!device.is_supported,
                   "pipelineFragmentShadingRate (VK_KHR_fragment_shading_rate)");
    if (!device.has(draw.fragment_size, target.samples)) {
        throw unsupported("the device has no fragments of {} x {} pixels at sample count {}",
                          draw.fragment_size[0], draw.fragment_size[1], target.samples);
    }
    if (!cases::has_large_fragments(draw)) {
        return;
    }
    const uint32_t all = (1U << target.samples) - 1;
    if ((draw.multisample.sample_mask & all) != all && !device.with_sample_mask) {
        throw unsupported(
            "the device has fragments of one pixel where a sample mask is used "
            "(fragmentShadingRateWithSampleMask)");
    }
    const bool has_mask = std::ranges::any_of(draw.attributes, [](const cases::Attribute& a) {
        return a.source == cases::Source::sample_mask_in;
    });
    if (has_mask && !device.with_shader_mask) {
        throw unsupported(
            "the device has fragments of one pixel where the shader reads gl_SampleMaskIn "
            "(fragmentShadingRateWithShaderSampleMask)");
    }
}

}  // namespace vk_harness
