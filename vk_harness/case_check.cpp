// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/case_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/format/color_format.hpp"
#include "cases/model/derive.hpp"
#include "cases/model/sample.hpp"
#include "vk_harness/commands/blit.hpp"
#include "vk_harness/device/format.hpp"
#include "vk_harness/pipeline/pipeline_key.hpp"
#include "vk_harness/target/resolve.hpp"
#include "vk_harness/target/shader_interface.hpp"
#include "vk_harness/target/target.hpp"
#include "vk_harness/target/target_way.hpp"

namespace vk_harness {

namespace {

template <class... T>
Rejection unsupported(fmt::format_string<T...> text, T&&... values) {
    return {Rendered::Status::unsupported, fmt::format(text, std::forward<T>(values)...)};
}

template <class... T>
Rejection invalid(fmt::format_string<T...> text, T&&... values) {
    return {Rendered::Status::error, fmt::format(text, std::forward<T>(values)...)};
}

// Where the device puts the samples has to be known.
std::optional<Rejection> check_locations(const Capabilities& c, const cases::Target& t) {
    if (t.sample_locations.empty()) {
        const bool is_told = std::ranges::any_of(
            c.info.sample_locations,
            [&](const cases::SampleLocations& own) { return own.size() == t.samples; });
        if (t.samples > 1 && !is_told && !c.info.sample_locations_error.empty()) {
            return invalid("{}", c.info.sample_locations_error);
        }
        if (t.samples > 1 && !c.has_standard_locations && !is_told) {
            return unsupported(
                "the device does not promise the standard sample locations, and does not tell its "
                "own at sample count {} by gl_SamplePosition, in sixteenths of a pixel, alike in "
                "every pixel",
                t.samples);
        }
        return std::nullopt;
    }
    if (t.sample_locations.size() != t.samples) {
        return invalid("the target has {} sample locations for {} samples",
                       t.sample_locations.size(), t.samples);
    }
    if ((c.location_counts & t.samples) == 0) {
        return unsupported(
            "the device does not take sample locations at sample count {} "
            "(VK_EXT_sample_locations)",
            t.samples);
    }
    for (const std::array<uint8_t, 2>& location : t.sample_locations) {
        for (const uint8_t sixteenths : location) {
            const float at = static_cast<float>(sixteenths) / 16.0F;
            if (at < c.location_range[0] || at > c.location_range[1]) {
                return unsupported(
                    "the sample location {}/16 is outside the device's range of {} to {} pixels",
                    sixteenths, c.location_range[0], c.location_range[1]);
            }
        }
    }
    return std::nullopt;
}

std::optional<Rejection> check_depth_format(const Capabilities& c, const cases::Target& t) {
    if (t.depth_format == cases::DepthFormat::d32_float) {
        return std::nullopt;
    }
    const std::string_view name = t.has_stencil ? row_of(t.depth_format).with_stencil_name
                                                : row_of(t.depth_format).vulkan_name;
    // Depth with stencil is asked for by check_resolve_and_stencil().
    const VkSampleCountFlags counts =
        t.has_stencil ? t.samples : c.depth_sample_counts.at(static_cast<size_t>(t.depth_format));
    if (counts == 0) {
        return unsupported("the device cannot draw to and read back format {}", name);
    }
    if (t.samples > 1 && t.depth_format == cases::DepthFormat::d24_unorm) {
        // A shader reads binary32; the conversion may be off by a step of 2^-24.
        return unsupported("single samples of {} cannot be read exactly", name);
    }
    if ((counts & t.samples) == 0) {
        return unsupported("the device does not draw {} samples a pixel with format {}", t.samples,
                           name);
    }
    return std::nullopt;
}

// Whether a geometry shader can hand on the case's triangles, and name their layers and viewports.
bool can_have_geometry(const Capabilities& c, const cases::Case& test) {
    return c.doors.geometry && cases::can_take(cases::Door::geometry, test);
}

std::optional<Rejection> check_target(const Capabilities& c, const cases::Case& test) {
    const cases::Target& t = test.target;
    if (t.width == 0 || t.height == 0) {
        return invalid("the target has no pixels");
    }
    if (t.width > c.max_width || t.height > c.max_height) {
        return unsupported("the target has {} x {} pixels, the device allows {} x {}", t.width,
                           t.height, c.max_width, c.max_height);
    }
    if (t.layers == 0 ||
        (t.layers > 1 && (capture::resolves_color(t) || capture::resolves_depth(t)))) {
        return invalid("a target has at least one layer, and one that is resolved only one");
    }
    if (t.layers > c.max_layers) {
        return unsupported("the target has {} layers, the device allows {} (maxFramebufferLayers)",
                           t.layers, c.max_layers);
    }
    if (t.layers > 1 && t.samples > 1 && !c.portability.multisampled_arrays) {
        return unsupported(
            "the device lacks the feature multisampleArrayImage (VK_KHR_portability_subset)");
    }
    if (names_layers(test) && !c.layer_output && !can_have_geometry(c, test)) {
        return unsupported(
            "the device lacks the feature shaderOutputLayer, by which a vertex shader chooses the "
            "layer");
    }
    if (t.samples == 0 || t.samples > 64 || (t.samples & (t.samples - 1)) != 0) {
        return invalid("{} samples a pixel is not a power of two up to 64", t.samples);
    }
    if ((c.sample_counts & t.samples) == 0) {
        return unsupported("the device does not draw {} samples a pixel", t.samples);
    }
    if (auto rejection = check_depth_format(c, t)) {
        return rejection;
    }
    if (auto rejection = check_locations(c, t)) {
        return rejection;
    }
    const std::vector<Attachment> attachments = attachments_of(test, target_layout(c, test));
    if (attachments.empty()) {
        return invalid("the target has no attachments");
    }
    const uint32_t colors = color_count(attachments);
    if (colors > c.info.max_color_attachments) {
        return unsupported("the case needs {} colour attachments, the device has {}", colors,
                           c.info.max_color_attachments);
    }
    const VkDeviceSize words = VkDeviceSize{t.width} * t.rows() * t.samples;
    if (t.samples > 1 && words * 16 > c.limits.maxStorageBufferRange) {
        return unsupported(
            "reading {} samples singly exceeds the device's storage buffer range of {} bytes",
            words, c.limits.maxStorageBufferRange);
    }
    if (words * 16 > c.max_allocation) {
        return unsupported(
            "an attachment of {} bytes exceeds the device's largest allocation of {}", words * 16,
            c.max_allocation);
    }
    const VkDeviceSize needed = attachment_bytes(t, attachments);
    if (needed > c.total_memory) {
        return unsupported("the attachments take {} bytes, the device has {}", needed,
                           c.total_memory);
    }
    return std::nullopt;
}

// Whether a colour is blended by the constant's alpha.
bool names_constant_alpha(const cases::ColorOutput& output) {
    const auto is_alpha = [](cases::BlendFactor f) {
        return static_cast<VkBlendFactor>(f) == VK_BLEND_FACTOR_CONSTANT_ALPHA ||
               static_cast<VkBlendFactor>(f) == VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_ALPHA;
    };
    return output.blend &&
           (is_alpha(output.blend->color.source) || is_alpha(output.blend->color.destination));
}

// Whether the unsigned format of the same size (bits_format) has other components.
bool is_reinterpreted(cases::ColorFormat format) {
    const auto& bits = row_of(format).bits;
    return std::any_of(bits.begin(), bits.end(), [](uint32_t b) { return b != 0 && b != 32; });
}

// A colour target's format, as an attachment, blended where a draw blends, read back.
std::optional<Rejection> check_color_format(const Capabilities& c, const cases::Case& test,
                                            uint32_t location) {
    const cases::ColorTarget& color = test.target.color_at(location);
    const auto any_output = [&](const auto& is) {
        return std::any_of(test.draws.begin(), test.draws.end(), [&](const cases::Draw& draw) {
            return is(cases::output_at(test.target, draw, location));
        });
    };
    const bool blends = any_output([](const auto& output) { return output.blend.has_value(); });
    if (blends && is_integer(color.format)) {
        return invalid("a target of integers is blended");
    }
    const bool multisampled = test.target.samples > 1;
    if (blends && !c.portability.constant_alpha_factors && any_output(names_constant_alpha)) {
        return unsupported(
            "the device lacks the feature constantAlphaColorBlendFactors "
            "(VK_KHR_portability_subset)");
    }
    if (multisampled && !c.portability.view_reinterpretation && is_reinterpreted(color.format)) {
        return unsupported(
            "single samples of {} cannot be read without the feature "
            "imageViewFormatReinterpretation (VK_KHR_portability_subset)",
            cases::name_of(color.format));
    }
    const VkFormatFeatureFlags needed =
        VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT |
        (blends ? VkFormatFeatureFlags{VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT} : 0U) |
        (multisampled ? VkFormatFeatureFlags{VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT}
                      : VkFormatFeatureFlags{VK_FORMAT_FEATURE_TRANSFER_SRC_BIT});
    if (!has_features(c, to_vulkan(color.format), needed)) {
        return unsupported("the device does not draw{} to the colour format {}",
                           blends ? " and blend" : "", cases::name_of(color.format));
    }
    const ImageLimits image =
        image_limits(c.physical, to_vulkan(color.format), color_usage(test.target.samples),
                     color_flags(test.target.samples));
    if (image.failed != VK_SUCCESS) {
        return invalid("{}", failed_query(image.failed));
    }
    if ((image.samples & test.target.samples) == 0 || image.width < test.target.width ||
        image.height < test.target.height || image.layers < test.target.layers) {
        return unsupported("the device has no {} x {} target of format {} with {} samples",
                           test.target.width, test.target.height, cases::name_of(color.format),
                           test.target.samples);
    }
    return std::nullopt;
}

// Colour targets, and what draws do to them.
std::optional<Rejection> check_color(const Capabilities& c, const cases::Case& test) {
    if (!test.target.color) {
        return std::nullopt;
    }
    const bool operates = std::any_of(test.draws.begin(), test.draws.end(), [](const auto& draw) {
        return draw.color.logic.has_value();
    });
    if (operates && !c.logic_op) {
        return unsupported("the device lacks the feature logicOp");
    }
    if (operates && test.target.has_instruments) {
        return invalid("a logical operation switches off the blending that counts hits");
    }
    const bool takes_second = std::any_of(test.draws.begin(), test.draws.end(), [](const auto& d) {
        return d.color.blend && cases::takes_second(*d.color.blend);
    });
    if (takes_second && !c.dual_source) {
        return unsupported("the device lacks the feature dualSrcBlend");
    }
    if (takes_second && test.target.has_instruments) {
        return invalid("a second source is blended beside the attachments that count hits");
    }
    const bool is_one = std::any_of(test.draws.begin(), test.draws.end(),
                                    [](const auto& draw) { return draw.color.alpha_to_one; });
    if (is_one && !c.alpha_to_one) {
        return unsupported("the device lacks the feature alphaToOne");
    }
    if (is_one && test.target.has_instruments) {
        return invalid("alpha to one changes the attachments that tell of fragments");
    }
    for (uint32_t location = 0; location < test.target.color_count(); ++location) {
        if (auto rejection = check_color_format(c, test, location)) {
            return rejection;
        }
    }
    return std::nullopt;
}

std::optional<Rejection> check_viewport(const Capabilities& c, const cases::Viewport& v) {
    const float height = std::abs(v.height);
    for (const float value : {v.x, v.y, v.width, v.height, v.min_depth, v.max_depth}) {
        if (!std::isfinite(value)) {
            return invalid("the viewport has a number that is not finite");
        }
    }
    if (!(v.width > 0.0F) || v.min_depth < 0.0F || v.min_depth > 1.0F || v.max_depth < 0.0F ||
        v.max_depth > 1.0F) {
        return invalid("the viewport's width must be positive and its depths lie in [0, 1]");
    }
    const auto max_width = static_cast<float>(c.limits.maxViewportDimensions[0]);
    const auto max_height = static_cast<float>(c.limits.maxViewportDimensions[1]);
    if (v.width > max_width || height > max_height) {
        return unsupported("the viewport has {} x {} pixels, the device allows {} x {}", v.width,
                           height, max_width, max_height);
    }
    const float low = c.limits.viewportBoundsRange[0];
    const float high = c.limits.viewportBoundsRange[1];
    const float ends[] = {v.x, v.y, v.x + v.width, v.y + v.height};
    if (std::any_of(std::begin(ends), std::end(ends),
                    [low, high](float end) { return end < low || end > high; })) {
        return unsupported("the viewport leaves the device's range of {} to {} pixels", low, high);
    }
    return std::nullopt;
}

std::optional<Rejection> check_depth(const Capabilities& c, const cases::DepthState& depth) {
    const bool clamps_bias = depth.bias && std::abs(depth.bias->clamp) > 0.0F;
    for (const auto& [lacks, feature] :
         {std::pair(depth.clamp && !c.depth_clamp, "depthClamp"),
          {depth.clip && !c.depth_clip_enable, "depthClipEnable of VK_EXT_depth_clip_enable"},
          {clamps_bias && !c.depth_bias_clamp, "depthBiasClamp"},
          {depth.bounds && !c.depth_bounds, "depthBounds"}}) {
        if (lacks) {
            return unsupported("the device lacks the feature {}", feature);
        }
    }
    if (depth.bias) {
        if (auto missing = missing_depth_bias_support(c.depth_bias, *depth.bias)) {
            return unsupported("{}", *missing);
        }
    }
    return std::nullopt;
}

// What an attribute asks of the fragment stage.
std::optional<Rejection> check_attribute(const Capabilities& c, const cases::Draw& draw,
                                         const cases::Attribute& a) {
    const size_t vertices = draw.positions.size();
    if (a.source == cases::Source::vertex && a.values.size() != vertices) {
        return invalid("attribute '{}' has {} values for {} vertices", a.name, a.values.size(),
                       vertices);
    }
    if (a.source == cases::Source::barycentric && !c.barycentrics) {
        return unsupported(
            "the device lacks the feature fragmentShaderBarycentric "
            "(VK_KHR_fragment_shader_barycentric)");
    }
    const bool is_derivative = a.probe >= cases::Probe::dx && a.probe <= cases::Probe::width_coarse;
    const bool is_at = a.probe >= cases::Probe::at_centroid && a.probe <= cases::Probe::at_offset;
    // The shader that takes derivatives has interpolateAt* too.
    const bool needs_sample_rate = a.auxiliary == cases::Auxiliary::sample ||
                                   a.source == cases::Source::sample_id ||
                                   a.source == cases::Source::sample_position || is_derivative ||
                                   is_at || a.probe == cases::Probe::lod;
    if (needs_sample_rate && !c.has_sample_shading) {
        return unsupported("the device lacks the feature sampleRateShading");
    }
    if ((is_derivative || is_at || a.probe == cases::Probe::lod) &&
        !c.portability.interpolation_functions) {
        return unsupported(
            "the device lacks the feature shaderSampleRateInterpolationFunctions "
            "(VK_KHR_portability_subset)");
    }
    for (const float offset : a.probe_offset) {
        // Beyond the range the position is undefined; a device's range may end at 0.
        if (a.probe == cases::Probe::at_offset && (offset < c.limits.minInterpolationOffset ||
                                                   offset > c.limits.maxInterpolationOffset)) {
            return unsupported(
                "interpolateAtOffset by {} pixels leaves the device's range of {} to {}", offset,
                c.limits.minInterpolationOffset, c.limits.maxInterpolationOffset);
        }
    }
    for (const uint32_t side : a.texture_size) {
        if (a.probe == cases::Probe::lod && side > c.limits.maxImageDimension2D) {
            return unsupported("a texture of {} texels a side exceeds the device's {}", side,
                               c.limits.maxImageDimension2D);
        }
    }
    return std::nullopt;
}

std::optional<Rejection> check_conservative(const DeviceInfo& device, const cases::Draw& draw) {
    using enum cases::Conservative;
    if (draw.conservative == none) {
        return std::nullopt;
    }
    if (!device.has_conservative) {
        return unsupported("the device lacks VK_EXT_conservative_rasterization");
    }
    if (draw.conservative == underestimate && !device.has_underestimation) {
        return unsupported("the device does not underestimate (primitiveUnderestimation)");
    }
    if (draw.conservative_extra > device.most_overestimation) {
        return unsupported(
            "the draw enlarges its triangles by {} pixels, the device allows {} "
            "(maxExtraPrimitiveOverestimationSize)",
            draw.conservative_extra, device.most_overestimation);
    }
    return std::nullopt;
}

// "If any of the following conditions are met", fragments have one pixel (Vulkan specification,
// "Combining the Fragment Shading Rates"); those that a case may meet, with what a device may have
// against it.
std::optional<Rejection> check_fragment_size(const FragmentSizeSupport& device,
                                             const cases::Draw& draw, const cases::Target& target) {
    if (!cases::asks_shading_rate(draw)) {
        return std::nullopt;
    }
    if (!device.is_supported) {
        return unsupported(
            "the device lacks the feature pipelineFragmentShadingRate "
            "(VK_KHR_fragment_shading_rate)");
    }
    if (!device.has(draw.fragment_size, target.samples)) {
        return unsupported("the device has no fragments of {} x {} pixels at sample count {}",
                           draw.fragment_size[0], draw.fragment_size[1], target.samples);
    }
    if (!cases::has_large_fragments(draw)) {
        return std::nullopt;
    }
    const uint32_t all = (1U << target.samples) - 1;
    if ((draw.multisample.sample_mask & all) != all && !device.with_sample_mask) {
        return unsupported(
            "the device has fragments of one pixel where a sample mask is used "
            "(fragmentShadingRateWithSampleMask)");
    }
    const bool has_mask = std::ranges::any_of(draw.attributes, [](const cases::Attribute& a) {
        return a.source == cases::Source::sample_mask_in;
    });
    if (has_mask && !device.with_shader_mask) {
        return unsupported(
            "the device has fragments of one pixel where the shader reads gl_SampleMaskIn "
            "(fragmentShadingRateWithShaderSampleMask)");
    }
    return std::nullopt;
}

std::optional<Rejection> check_draw(const Capabilities& c, const cases::Draw& draw) {
    if (auto rejection = check_viewport(c, draw.viewport)) {
        return rejection;
    }
    const cases::Rect& s = draw.scissor;
    constexpr int64_t kMax = 0x7fffffff;
    if (s.x < 0 || s.y < 0 || int64_t{s.x} + s.width > kMax || int64_t{s.y} + s.height > kMax) {
        return invalid("the scissor must begin at 0 or later and end below 2^31");
    }
    if (draw.topology == cases::Topology::triangle_fan && !c.portability.triangle_fans) {
        return unsupported("the device lacks the feature triangleFans");
    }
    const std::optional<float> shading = draw.multisample.min_sample_shading;
    if (shading && (!(*shading >= 0.0F) || *shading > 1.0F)) {
        return invalid("the fraction of samples that is shaded at least must lie in [0, 1]");
    }
    if (shading && !c.has_sample_shading) {
        return unsupported("the device lacks the feature sampleRateShading");
    }
    if (draw.attributes.size() > cases::kMaxAttributes) {
        return invalid("a draw has {} attributes, at most {} are allowed", draw.attributes.size(),
                       cases::kMaxAttributes);
    }
    if (draw.query == cases::Query::occlusion_precise && !c.precise_queries) {
        return unsupported("the device lacks the feature occlusionQueryPrecise");
    }
    if (cases::is_statistic(draw.query) && !c.pipeline_statistics) {
        return unsupported("the device lacks the feature pipelineStatisticsQuery");
    }
    if (auto rejection = check_conservative(c.info, draw)) {
        return rejection;
    }
    if (auto rejection = check_depth(c, draw.depth)) {
        return rejection;
    }
    const size_t vertices = draw.positions.size();
    for (const cases::Attribute& attribute : draw.attributes) {
        if (auto rejection = check_attribute(c, draw, attribute)) {
            return rejection;
        }
    }
    for (const auto& [count, distances] :
         {std::pair(draw.distances.clip_count, &draw.distances.clip),
          std::pair(draw.distances.cull_count, &draw.distances.cull)}) {
        if (count > 4 || distances->size() != (count > 0 ? vertices : 0)) {
            return invalid("{} distances a vertex have values at {} of {} vertices", count,
                           distances->size(), vertices);
        }
    }
    const size_t elements = draw.indices ? draw.indices->size() : vertices;
    if (vertices >= kMaxId || elements >= kMaxId) {
        return unsupported("a draw has {} vertices, the harness tells {} apart",
                           std::max(vertices, elements), kMaxId - 1);
    }
    if (draw.primitive_restart &&
        (!draw.indices || draw.topology == cases::Topology::triangle_list)) {
        return invalid("primitive restart needs indices and a strip or a fan");
    }
    if (draw.indices) {
        for (const uint32_t index : *draw.indices) {
            const bool restart = draw.primitive_restart && index == cases::kRestartIndex;
            if (!restart && index >= vertices) {
                return invalid("index {} is beyond the {} vertices of its draw", index, vertices);
            }
        }
    }
    return std::nullopt;
}

// No sample can be hit more often: the triangles of all draws, counted generously.
size_t most_hits(const cases::Case& c) {
    size_t triangles = 0;
    for (const cases::Draw& draw : c.draws) {
        const size_t corners = draw.indices ? draw.indices->size() : draw.positions.size();
        triangles += draw.topology == cases::Topology::triangle_list ? corners / 3 : corners;
    }
    return triangles;
}

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
    if (most_hits(c) > most) {
        return unsupported(
            "the case may hit a sample {} times and {} that hits are counted up to {}; leave out "
            "an "
            "attribute or the colour target",
            most_hits(c),
            layout.halves ? "the device blends 16-bit floats only, so" : "has so many attributes",
            most);
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

}  // namespace

std::optional<Rejection> check_case(const Capabilities& capabilities, const cases::Case& c) {
    for (const cases::Draw& draw : c.draws) {
        if (auto rejection = check_draw(capabilities, draw)) {
            return rejection;
        }
        if (auto rejection = check_fragment_size(capabilities.fragment_sizes, draw, c.target)) {
            return rejection;
        }
        if (draw.other_colors.size() != c.target.other_colors.size()) {
            return invalid("a draw writes to {} colour targets of {}", draw.other_colors.size() + 1,
                           c.target.color_count());
        }
        const std::vector<uint32_t> drawn = cases::drawn_attributes(c.target, draw);
        if (std::any_of(drawn.begin(), drawn.end(),
                        [&](uint32_t k) { return k >= draw.attributes.size(); })) {
            return invalid("a draw's colour comes from an attribute that it does not have");
        }
    }
    if (auto rejection = c.blit ? check_blit(capabilities, c) : check_color(capabilities, c)) {
        return rejection;
    }
    if (auto rejection = check_resolve_and_stencil(capabilities, c.target)) {
        return rejection;
    }
    if (c.draws.size() >= kMaxId) {
        return unsupported("the case has {} draws, the harness tells {} apart", c.draws.size(),
                           kMaxId - 1);
    }
    const uint32_t most = capabilities.viewport_output || can_have_geometry(capabilities, c)
                              ? capabilities.max_viewports
                              : 1;
    if (const uint32_t viewports = viewport_count(c); viewports > most) {
        return unsupported(
            "the case chooses from {} viewports by gl_ViewportIndex, the device from {} (features "
            "multiViewport and shaderOutputViewportIndex)",
            viewports, most);
    }
    const TargetLayout layout = target_layout(capabilities, c);
    if (auto rejection = check_counting(capabilities, c, layout)) {
        return rejection;
    }
    for (const cases::Draw& draw : c.draws) {
        if (draw.layer >= c.target.layers) {
            return invalid("a draw goes to layer {} of {}", draw.layer, c.target.layers);
        }
        const PipelineKey key = pipeline_key(c, draw, layout);
        if (key.discard_by == cases::DiscardBy::demote && !capabilities.discard.demote) {
            return unsupported("the device lacks the feature shaderDemoteToHelperInvocation");
        }
        if (key.discard_by == cases::DiscardBy::terminate && !capabilities.discard.terminate) {
            return unsupported("the device lacks the feature shaderTerminateInvocation");
        }
        if (shaders::capture_vertex(vertex_variant(key)).empty() ||
            shaders::capture_fragment(fragment_variant(key)).empty()) {
            return invalid(
                "a draw asks for a combination of shader features that no shader was built for; "
                "put them into different draws");
        }
    }
    if (auto missing = missing_clip_support(capabilities.clip, c)) {
        return unsupported("{}", *missing);
    }
    if (c.variation.door != cases::Door::none) {
        if (auto missing = missing_door_support(capabilities.doors, c.variation.door)) {
            return unsupported("{}", *missing);
        }
        if (auto closed = closed_by(layout, c.variation.door)) {
            return unsupported("{}", *closed);
        }
        if (auto missing = missing_mesh_layers(capabilities.doors, c)) {
            return unsupported("{}", *missing);
        }
        if (auto missing = missing_images(capabilities, c)) {
            return unsupported("{}", *missing);
        }
    }
    return check_target(capabilities, c);
}

}  // namespace vk_harness
