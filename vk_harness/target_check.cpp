// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/target_check.hpp"

#include <algorithm>

#include "cases/format/color_format.hpp"
#include "cases/model/derive.hpp"
#include "vk_harness/depth_codes.hpp"
#include "vk_harness/device/format.hpp"
#include "vk_harness/target/shader_interface.hpp"
#include "vk_harness/target/target.hpp"

namespace vk_harness {

namespace {

// Where the device puts the samples has to be known.
void check_locations(const Capabilities& c, const cases::Target& t) {
    if (t.sample_locations.empty()) {
        const bool is_told = std::ranges::any_of(
            c.told_locations,
            [&](const cases::SampleLocations& own) { return own.size() == t.samples; });
        if (t.samples > 1 && !is_told && !c.info.sample_locations_error.empty()) {
            throw invalid("{}", c.info.sample_locations_error);
        }
        if (t.samples > 1 && !c.has_standard_locations && !is_told) {
            throw unsupported(
                "the device does not promise the standard sample locations, and does not tell its "
                "own at sample count {} by gl_SamplePosition, in sixteenths of a pixel, alike in "
                "every pixel",
                t.samples);
        }
        return;
    }
    if (t.sample_locations.size() != t.samples) {
        throw invalid("the target has {} sample locations for {} samples",
                      t.sample_locations.size(), t.samples);
    }
    if ((c.location_counts & t.samples) == 0) {
        throw unsupported(
            "the device does not take sample locations at sample count {} "
            "(VK_EXT_sample_locations)",
            t.samples);
    }
    for (const std::array<uint8_t, 2>& location : t.sample_locations) {
        for (const uint8_t sixteenths : location) {
            const float at = static_cast<float>(sixteenths) / 16.0F;
            if (at < c.location_range[0] || at > c.location_range[1]) {
                throw unsupported(
                    "the sample location {}/16 is outside the device's range of {} to {} pixels",
                    sixteenths, c.location_range[0], c.location_range[1]);
            }
        }
    }
}

void check_depth_format(const Capabilities& c, const cases::Target& t) {
    if (t.depth_format == cases::DepthFormat::d32_float) {
        return;
    }
    const std::string_view name = t.has_stencil ? row_of(t.depth_format).with_stencil_name
                                                : row_of(t.depth_format).vulkan_name;
    // Depth with stencil is asked for by check_resolve_and_stencil().
    const VkSampleCountFlags counts =
        t.has_stencil ? t.samples : c.depth_sample_counts.at(static_cast<size_t>(t.depth_format));
    if (counts == 0) {
        throw unsupported("the device cannot draw to and read back format {}", name);
    }
    if (t.samples > 1 && t.depth_format == cases::DepthFormat::d24_unorm &&
        !can_ask_codes(c, t.has_stencil ? depth_stencil_format(t.depth_format)
                                        : depth_format(t.depth_format))) {
        throw unsupported("single samples of {} cannot be read exactly", name);
    }
    if ((counts & t.samples) == 0) {
        throw unsupported("the device does not draw {} samples a pixel with format {}", t.samples,
                          name);
    }
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
    return std::ranges::any_of(bits, [](uint32_t b) { return b != 0 && b != 32; });
}

// A colour target's format, as an attachment, blended where a draw blends, read back.
void check_color_format(const Capabilities& c, const cases::Case& test, uint32_t location) {
    const cases::ColorTarget& color = test.target.color_at(location);
    const auto any_output = [&](const auto& is) {
        return std::ranges::any_of(test.draws, [&](const cases::Draw& draw) {
            return is(cases::output_at(test.target, draw, location));
        });
    };
    const bool blends = any_output([](const auto& output) { return output.blend.has_value(); });
    if (blends && is_integer(color.format)) {
        throw invalid("a target of integers is blended");
    }
    const bool multisampled = test.target.samples > 1;
    refuse_without(
        blends && !c.portability.constant_alpha_factors && any_output(names_constant_alpha),
        "constantAlphaColorBlendFactors (VK_KHR_portability_subset)");
    if (multisampled && !c.portability.view_reinterpretation && is_reinterpreted(color.format)) {
        throw unsupported(
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
        throw unsupported("the device does not draw{} to the colour format {}",
                          blends ? " and blend" : "", cases::name_of(color.format));
    }
    const ImageLimits image =
        image_limits(c.physical, to_vulkan(color.format), color_usage(test.target.samples),
                     color_flags(test.target.samples));
    if (image.failed != VK_SUCCESS) {
        throw invalid("{}", failed_query(image.failed));
    }
    if ((image.samples & test.target.samples) == 0 || image.width < test.target.width ||
        image.height < test.target.height || image.layers < test.target.layers) {
        throw unsupported("the device has no {} x {} target of format {} with {} samples",
                          test.target.width, test.target.height, cases::name_of(color.format),
                          test.target.samples);
    }
}

}  // namespace

bool can_have_geometry(const Capabilities& c, const cases::Case& test) {
    return c.doors.geometry && cases::can_take(cases::Door::geometry, test);
}

void check_target(const Capabilities& c, const cases::Case& test) {
    const cases::Target& t = test.target;
    if (t.width == 0 || t.height == 0) {
        throw invalid("the target has no pixels");
    }
    if (t.width > c.max_width || t.height > c.max_height) {
        throw unsupported("the target has {} x {} pixels, the device allows {} x {}", t.width,
                          t.height, c.max_width, c.max_height);
    }
    if (t.layers == 0) {
        throw invalid("a target has at least one layer");
    }
    if (t.layers > c.max_layers) {
        throw unsupported("the target has {} layers, the device allows {} (maxFramebufferLayers)",
                          t.layers, c.max_layers);
    }
    if (t.layers > 1 && t.samples > 1 && !c.portability.multisampled_arrays) {
        throw unsupported(
            "the device lacks the feature multisampleArrayImage (VK_KHR_portability_subset)");
    }
    if (names_layers(test) && !c.layer_output && !can_have_geometry(c, test)) {
        throw unsupported(
            "the device lacks the feature shaderOutputLayer, by which a vertex shader chooses the "
            "layer");
    }
    if (t.samples == 0 || t.samples > 64 || (t.samples & (t.samples - 1)) != 0) {
        throw invalid("{} samples a pixel is not a power of two up to 64", t.samples);
    }
    if ((c.sample_counts & t.samples) == 0) {
        throw unsupported("the device does not draw {} samples a pixel", t.samples);
    }
    check_depth_format(c, t);
    check_locations(c, t);
    const std::vector<Attachment> attachments = attachments_of(test, target_layout(c, test));
    if (attachments.empty()) {
        throw invalid("the target has no attachments");
    }
    const uint32_t colors = color_count(attachments);
    if (colors > c.info.max_color_attachments) {
        throw unsupported("the case needs {} colour attachments, the device has {}", colors,
                          c.info.max_color_attachments);
    }
    const VkDeviceSize words = VkDeviceSize{t.width} * t.rows() * t.samples;
    if (t.is_read_by_shader() && words * 16 > c.limits.maxStorageBufferRange) {
        throw unsupported(
            "reading {} samples singly exceeds the device's storage buffer range of {} bytes",
            words, c.limits.maxStorageBufferRange);
    }
    if (words * 16 > c.max_allocation) {
        throw unsupported("an attachment of {} bytes exceeds the device's largest allocation of {}",
                          words * 16, c.max_allocation);
    }
    const VkDeviceSize needed = attachment_bytes(t, attachments);
    if (needed > c.total_memory) {
        throw unsupported("the attachments take {} bytes, the device has {}", needed,
                          c.total_memory);
    }
}

// Colour targets, and what draws do to them.
void check_color(const Capabilities& c, const cases::Case& test) {
    if (!test.target.color) {
        return;
    }
    const bool operates = std::ranges::any_of(
        test.draws, [](const auto& draw) { return draw.color.logic.has_value(); });
    refuse_without(operates && !c.logic_op, "logicOp");
    if (operates && test.target.has_instruments) {
        throw invalid("a logical operation switches off the blending that counts hits");
    }
    const bool takes_second = std::ranges::any_of(test.draws, [](const auto& d) {
        return d.color.blend && cases::takes_second(*d.color.blend);
    });
    refuse_without(takes_second && !c.dual_source, "dualSrcBlend");
    if (takes_second && test.target.has_instruments) {
        throw invalid("a second source is blended beside the attachments that count hits");
    }
    const bool is_one =
        std::ranges::any_of(test.draws, [](const auto& draw) { return draw.color.alpha_to_one; });
    refuse_without(is_one && !c.alpha_to_one, "alphaToOne");
    if (is_one && test.target.has_instruments) {
        throw invalid("alpha to one changes the attachments that tell of fragments");
    }
    const bool renders_first = std::ranges::any_of(
        test.draws, [](const auto& draw) { return draw.color.from == cases::ColorFrom::rendered; });
    refuse_without(renders_first && !c.core.dynamic_rendering, "dynamicRendering");
    const bool takes_samples = std::ranges::any_of(
        test.draws, [](const auto& draw) { return draw.color.alpha_to_coverage; });
    if (takes_samples && test.target.has_instruments) {
        throw invalid("alpha to coverage takes the alpha of what tells of fragments");
    }
    for (uint32_t location = 0; location < test.target.color_count(); ++location) {
        check_color_format(c, test, location);
    }
}

}  // namespace vk_harness
