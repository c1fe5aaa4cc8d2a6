// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/target/target_way.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "capture/capture.hpp"
#include "vk_harness/memory/memory.hpp"
#include "vk_harness/target/attachments.hpp"

namespace vk_harness {

ImageWay image_way(const cases::Case& c) {
    ImageWay way;
    way.is_sampled = c.target.frame == cases::Frame::sampled;
    if (c.target.frame == cases::Frame::part) {
        way.more_columns = 5;
        way.more_rows = 3;
        way.first_layer = way.more_layers = 1;
        way.level = c.target.samples == 1 ? 1 : 0;  // images of several samples have one level
    }
    switch (c.variation.door) {
        case cases::Door::target_larger:
            way.more_columns = 29;
            way.more_rows = 19;
            break;
        case cases::Door::target_last_tile:
            way.more_columns = cases::kMovedColumns;
            way.more_rows = cases::kMovedRows;
            way.ends_with_it = true;
            break;
        case cases::Door::input_attachment:
            way.is_input = true;
            break;
        case cases::Door::image_layer:
            way.first_layer = 2;
            break;
        case cases::Door::image_level:
            // Images of several samples have one level.
            way.level = c.target.samples == 1 ? 1 : 0;
            break;
        case cases::Door::image_linear:
            way.is_linear = true;
            break;
        case cases::Door::memory_aliased:
            way.is_aliased = true;
            break;
        case cases::Door::image_usages:
            way.all_usages = true;
            break;
        case cases::Door::memory_dedicated:
            way.is_dedicated = true;
            break;
        case cases::Door::multiview:
            way.first_layer = 1;
            way.views = 0b10;
            break;
        case cases::Door::multiview_all:
            way.first_layer = 2;
            way.views = 0b101;
            break;
        default:
            break;
    }
    return way;
}

ImageWay resolved_way(const cases::Case& c) {
    ImageWay way = image_way(c);
    way.has_spare_aspect = c.target.has_stencil &&
                           capture::resolves_depth(c.target) != capture::resolves_stencil(c.target);
    if (c.variation.door == cases::Door::image_layer) {
        // The images have as many layers, so that a device that takes the layer of one for the
        // other stays within them.
        way.first_layer = 1;
        way.more_layers = 1;
    } else if (c.variation.door == cases::Door::image_level) {
        way.level = 1;
    }
    return way;
}

namespace {

bool has_linear_attachment(const Capabilities& capabilities, const cases::Case& c) {
    const std::vector<Attachment> attachments = attachments_of(c, target_layout(capabilities, c));
    return std::ranges::any_of(attachments, [&](const Attachment& a) {
        VkImageCreateInfo info = image_info(
            a.format, {c.target.width, c.target.height},
            VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                static_cast<VkImageUsageFlags>(a.is_depth_stencil()
                                                   ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                   : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT));
        return has_linear(capabilities.physical, info);
    });
}

bool has_inputs(const Capabilities& capabilities, const cases::Case& c) {
    const std::vector<Attachment> attachments = attachments_of(c, target_layout(capabilities, c));
    const uint32_t samples = c.target.samples;
    return std::ranges::all_of(attachments, [&](const Attachment& a) {
        const VkImageUsageFlags usage =
            VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT |
            VkImageUsageFlags{samples > 1 ? VK_IMAGE_USAGE_SAMPLED_BIT
                                          : VK_IMAGE_USAGE_TRANSFER_SRC_BIT} |
            VkImageUsageFlags{a.is_depth_stencil() ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                   : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT};
        VkImageFormatProperties offered{};
        const VkResult result = vkGetPhysicalDeviceImageFormatProperties(
            capabilities.physical, a.format, VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL, usage,
            a.is_depth_stencil() ? 0U : color_flags(samples), &offered);
        return !a.is_input || (result == VK_SUCCESS && (offered.sampleCounts & samples) != 0);
    });
}

// Why the device has no room for the case so far to the right and down.
std::optional<std::string> missing_place(const Capabilities& capabilities, const cases::Case& c,
                                         const VkOffset2D& origin) {
    const VkPhysicalDeviceLimits& limits = capabilities.limits;
    const auto x = static_cast<float>(origin.x), y = static_cast<float>(origin.y);
    const float high = limits.viewportBoundsRange[1];
    const bool is_beyond =
        (origin.x > 0 || origin.y > 0) &&
        std::ranges::any_of(c.draws, [&](const cases::Draw& draw) {
            const cases::Viewport& v = draw.viewport;
            return v.x + x + v.width > high || std::max(v.y, v.y + v.height) + y > high;
        });
    return is_beyond
               ? std::optional(fmt::format("a viewport {} columns and {} rows further leaves the "
                                           "device's range, which ends at {} pixels",
                                           origin.x, origin.y, high))
               : std::nullopt;
}

}  // namespace

std::optional<std::string> missing_images(const Capabilities& capabilities, const cases::Case& c) {
    const ImageWay way = image_way(c);
    // Of what is resolved into, the larger one.
    const VkExtent2D extent = resolved_way(c).extent({c.target.width, c.target.height});
    const uint32_t layers = c.target.layers + way.first_layer;
    const VkPhysicalDeviceLimits& limits = capabilities.limits;
    if (std::max(extent.width, extent.height) > limits.maxImageDimension2D) {
        return fmt::format(
            "an image of {} x {} texels is more than the device has (maxImageDimension2D {})",
            extent.width, extent.height, limits.maxImageDimension2D);
    }
    if (layers > limits.maxImageArrayLayers) {
        return fmt::format(
            "an image of {} layers is more than the device has (maxImageArrayLayers {})", layers,
            limits.maxImageArrayLayers);
    }
    if (layers > 1 && c.target.samples > 1 && !capabilities.portability.multisampled_arrays) {
        return "the device lacks the feature multisampleArrayImage (VK_KHR_portability_subset)";
    }
    if (auto missing = missing_place(capabilities, c, way.origin())) {
        return missing;
    }
    if (way.is_input && !has_inputs(capabilities, c)) {
        return "the device has no images for attachments like these that may be input attachments";
    }
    if (way.is_linear && !has_linear_attachment(capabilities, c)) {
        return fmt::format("the device lacks {}", needs_of(c.variation.door));
    }
    return std::nullopt;
}

VkRect2D render_area(const cases::Case& c) {
    return {image_way(c).origin(), {c.target.width, c.target.height}};
}

uint32_t view_mask(const cases::Case& c) {
    return image_way(c).views;
}

}  // namespace vk_harness
