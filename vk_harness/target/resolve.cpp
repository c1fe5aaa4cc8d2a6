// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/target/resolve.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "capture/capture.hpp"
#include "cases/format/color_format.hpp"
#include "vk_harness/device/format.hpp"
#include "vk_harness/memory/memory.hpp"
#include "vk_harness/target/attachments.hpp"

namespace vk_harness {

namespace {

struct ResolveMode {
    VkResolveModeFlagBits bit;
    std::string_view name;
};

// By cases::Resolve.
constexpr std::array<ResolveMode, 5> kModes = {{{VK_RESOLVE_MODE_NONE, "NONE"},
                                                {VK_RESOLVE_MODE_SAMPLE_ZERO_BIT, "SAMPLE_ZERO"},
                                                {VK_RESOLVE_MODE_AVERAGE_BIT, "AVERAGE"},
                                                {VK_RESOLVE_MODE_MIN_BIT, "MIN"},
                                                {VK_RESOLVE_MODE_MAX_BIT, "MAX"}}};

static_assert(kModes.size() == static_cast<size_t>(cases::Resolve::max) + 1);

const ResolveMode& mode_of(cases::Resolve mode) {
    return kModes.at(static_cast<size_t>(mode));
}

}  // namespace

void check_resolve_and_stencil(const Capabilities& c, const cases::Target& t) {
    VkResult failed = VK_SUCCESS;
    const auto has_image = [&](VkFormat format, VkImageUsageFlags usage, uint32_t samples) {
        const ImageLimits limits = image_limits(c.physical, format, usage, 0);
        failed = limits.failed != VK_SUCCESS ? limits.failed : failed;
        return (limits.samples & samples) != 0;
    };
    const auto unsupported = [&failed](std::string reason) {
        return failed == VK_SUCCESS ? Rejection{Rendered::Status::unsupported, std::move(reason)}
                                    : Rejection{Rendered::Status::error, failed_query(failed)};
    };
    if (t.has_stencil) {
        const VkImageUsageFlags read =
            t.samples > 1 ? VK_IMAGE_USAGE_SAMPLED_BIT : VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        const cases::DepthFormat beside = depth_beside_stencil(c, t);
        if (!has_image(depth_stencil_format(beside),
                       VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | read, t.samples) ||
            (c.limits.framebufferStencilSampleCounts & t.samples) == 0 ||
            (t.samples > 1 && (c.limits.sampledImageStencilSampleCounts & t.samples) == 0)) {
            throw unsupported(
                fmt::format("the device cannot draw to and read back format {} at sample count {}",
                            cases::row_of(beside).with_stencil_name, t.samples));
        }
    }
    if (capture::resolves_color(t) && !has_image(to_vulkan(t.color->format), color_usage(1), 1)) {
        throw unsupported(fmt::format("the device cannot resolve into the colour format {}",
                                      cases::name_of(t.color->format)));
    }
    if (!capture::resolves_depth(t) && !capture::resolves_stencil(t)) {
        return;
    }
    if (!c.core.depth_resolve) {
        throw unsupported("the device lacks Vulkan 1.2 or VK_KHR_depth_stencil_resolve");
    }
    VkPhysicalDeviceDepthStencilResolveProperties resolve =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_STENCIL_RESOLVE_PROPERTIES};
    get_properties(c.physical, resolve);
    const auto check_mode = [&](cases::Resolve used, VkResolveModeFlags modes,
                                std::string_view aspect) {
        const ResolveMode& mode = mode_of(used);
        const auto bit = static_cast<VkResolveModeFlags>(mode.bit);
        if ((modes & bit) != bit) {
            throw unsupported(
                fmt::format("the device does not resolve {} by {}", aspect, mode.name));
        }
    };
    check_mode(t.depth_resolve, resolve.supportedDepthResolveModes, "depth");
    check_mode(t.stencil_resolve, resolve.supportedStencilResolveModes, "stencil");
    // Of one image.
    if (!t.has_stencil || t.depth_resolve == t.stencil_resolve ||
        resolve.independentResolve == VK_TRUE) {
        return;
    }
    const bool one_is_none = !capture::resolves_depth(t) || !capture::resolves_stencil(t);
    if (!one_is_none || resolve.independentResolveNone != VK_TRUE) {
        throw unsupported(
            one_is_none ? "the device does not resolve depth without stencil or stencil without "
                          "depth (independentResolveNone)"
                        : "the device does not resolve depth and stencil by different modes "
                          "(independentResolve)");
    }
}

VkResolveModeFlagBits resolve_mode(cases::Resolve mode) {
    return mode_of(mode).bit;
}

void resolve_into(VkImageView view, VkImageLayout layout, cases::Resolve mode,
                  VkRenderingAttachmentInfo& from) {
    from.resolveMode = mode_of(mode).bit;
    from.resolveImageView = view;
    from.resolveImageLayout = layout;
}

}  // namespace vk_harness
