// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/blit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "cases/format/color_format.hpp"
#include "cases/model/blit_source.hpp"
#include "vk_harness/device/format.hpp"
#include "vk_harness/target/attachments.hpp"

namespace vk_harness {

namespace {

bool has_features(const Capabilities& c, cases::ColorFormat format, VkFormatFeatureFlags needed) {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(c.physical, to_vulkan(format), &properties);
    return (properties.optimalTilingFeatures & needed) == needed;
}

VkImageMemoryBarrier2 change(VkImage image, VkImageLayout from, VkImageLayout to) {
    constexpr VkPipelineStageFlags2 kStages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    VkImageMemoryBarrier2 b = Typed{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    b.srcStageMask = kStages;
    b.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    b.dstStageMask = kStages;
    b.dstAccessMask = VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
    b.oldLayout = from;
    b.newLayout = to;
    b.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    b.image = image;
    b.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    return b;
}

void wait_for(const Device& device, VkCommandBuffer commands,
              const std::vector<VkImageMemoryBarrier2>& barriers) {
    VkDependencyInfo info = Typed{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = static_cast<uint32_t>(barriers.size());
    info.pImageMemoryBarriers = barriers.data();
    device.vk().vkCmdPipelineBarrier2(commands, &info);
}

constexpr VkImageSubresourceLayers kLayers = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};

}  // namespace

std::optional<Rejection> check_blit(const Capabilities& capabilities, const cases::Case& c) {
    const cases::Blit& blit = *c.blit;
    const auto invalid = [](const char* why) { return Rejection{Rendered::Status::error, why}; };
    if (!c.target.color || c.target.has_instruments || c.target.has_depth || !c.draws.empty() ||
        c.target.samples != 1 || c.target.layers != 1) {
        return invalid("a blit writes to a colour target of one sample alone");
    }
    const auto inside = [](const cases::Corners& r, uint32_t width, uint32_t height) {
        const auto within = [](int32_t a, int32_t b, uint32_t size) {
            return a >= 0 && b >= 0 && a != b && static_cast<uint32_t>(std::max(a, b)) <= size;
        };
        return within(r.x0, r.x1, width) && within(r.y0, r.y1, height);
    };
    if (blit.source_width == 0 || blit.source_height == 0 ||
        !inside(blit.source, blit.source_width, blit.source_height) ||
        !inside(blit.destination, c.target.width, c.target.height)) {
        return invalid("a region of the blit leaves its image, or is empty");
    }
    const auto unsupported = [](std::string why) {
        return Rejection{Rendered::Status::unsupported, std::move(why)};
    };
    const bool linear = blit.filter == cases::BlitFilter::linear;
    constexpr VkFormatFeatureFlags filtered = VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if (!has_features(capabilities, blit.source_format,
                      VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT |
                          (linear ? filtered : VkFormatFeatureFlags{0}))) {
        return unsupported(fmt::format("the device does not blit{} from the format {}",
                                       linear ? " with a linear filter" : "",
                                       cases::name_of(blit.source_format)));
    }
    if (!has_features(capabilities, c.target.color->format,
                      VK_FORMAT_FEATURE_BLIT_DST_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT |
                          VK_FORMAT_FEATURE_TRANSFER_SRC_BIT)) {
        return unsupported(fmt::format("the device does not blit to the format {}",
                                       cases::name_of(c.target.color->format)));
    }
    return std::nullopt;
}

std::vector<std::byte> encode_texels(cases::ColorFormat format,
                                     const std::vector<cases::TexelCodes>& texels) {
    const size_t size = bytes_of(format);
    std::vector<std::byte> bytes(texels.size() * size);
    for (size_t n = 0; n < texels.size(); ++n) {
        encode_texel(format, texels[n], bytes.data() + n * size);
    }
    return bytes;
}

Result<BlitImages::PlainImage> BlitImages::make_image(const Device& device,
                                                      cases::ColorFormat format, uint32_t width,
                                                      uint32_t height) {
    VkImageCreateInfo info = Typed{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = to_vulkan(format);
    info.extent = {width, height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImage handle = VK_NULL_HANDLE;
    const VkResult result = device.vk().vkCreateImage(device.get(), &info, nullptr, &handle);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::memory, result, "vkCreateImage"));
    }
    PlainImage made;
    made.image = Handle<VkImage>(device.get(), handle, device.vk().vkDestroyImage);
    auto memory = bind_guarded(device, handle);
    if (!memory) {
        return fail(memory.error());
    }
    made.memory = std::move(*memory);
    return made;
}

Result<BlitImages> BlitImages::create(const Device& device, const cases::Case& c) {
    const cases::Blit& blit = *c.blit;
    BlitImages images;
    const std::vector<std::byte> texels =
        encode_texels(blit.source_format, cases::blit_source(blit));
    auto upload =
        Buffer::create(device, texels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write);
    if (!upload) {
        return fail(upload.error());
    }
    images.upload_ = std::move(*upload);
    std::copy(texels.begin(), texels.end(), images.upload_.bytes().begin());
    if (auto flushed = images.upload_.flush(); !flushed) {
        return fail(flushed.error());
    }
    auto source = make_image(device, blit.source_format, blit.source_width, blit.source_height);
    if (!source) {
        return fail(source.error());
    }
    images.source_ = std::move(*source);
    auto destination = make_image(device, c.target.color->format, c.target.width, c.target.height);
    if (!destination) {
        return fail(destination.error());
    }
    images.destination_ = std::move(*destination);
    return images;
}

void BlitImages::record(const Device& device, VkCommandBuffer commands, const cases::Case& c,
                        VkClearColorValue clear, VkBuffer readback, VkDeviceSize offset) const {
    const VolkDeviceTable& vk = device.vk();
    const cases::Blit& blit = *c.blit;
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    constexpr VkImageLayout kWritten = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    wait_for(device, commands,
             {change(source_.image.get(), VK_IMAGE_LAYOUT_UNDEFINED, kWritten),
              change(destination_.image.get(), VK_IMAGE_LAYOUT_UNDEFINED, kWritten)});
    VkBufferImageCopy copy{};
    copy.imageSubresource = kLayers;
    copy.imageExtent = {blit.source_width, blit.source_height, 1};
    vk.vkCmdCopyBufferToImage(commands, upload_.get(), source_.image.get(), kWritten, 1, &copy);
    const VkImageSubresourceRange all = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vk.vkCmdClearColorImage(commands, destination_.image.get(), kWritten, &clear, 1, &all);
    wait_for(device, commands,
             {change(source_.image.get(), kWritten, kRead),
              change(destination_.image.get(), kWritten, kWritten)});
    VkImageBlit region{};
    region.srcSubresource = kLayers;
    region.dstSubresource = kLayers;
    region.srcOffsets[0] = {blit.source.x0, blit.source.y0, 0};
    region.srcOffsets[1] = {blit.source.x1, blit.source.y1, 1};
    region.dstOffsets[0] = {blit.destination.x0, blit.destination.y0, 0};
    region.dstOffsets[1] = {blit.destination.x1, blit.destination.y1, 1};
    vk.vkCmdBlitImage(
        commands, source_.image.get(), kRead, destination_.image.get(), kWritten, 1, &region,
        blit.filter == cases::BlitFilter::linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST);
    if (readback == VK_NULL_HANDLE) {
        return;
    }
    wait_for(device, commands, {change(destination_.image.get(), kWritten, kRead)});
    VkBufferImageCopy back{};
    back.bufferOffset = offset;
    back.imageSubresource = kLayers;
    back.imageExtent = {c.target.width, c.target.height, 1};
    vk.vkCmdCopyImageToBuffer(commands, destination_.image.get(), kRead, readback, 1, &back);
}

}  // namespace vk_harness
