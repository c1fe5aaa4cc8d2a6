// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/blit.hpp"

#include <algorithm>
#include <span>

#include "cases/format/color_format.hpp"
#include "cases/model/blit_source.hpp"
#include "vk_harness/device/format.hpp"
#include "vk_harness/memory/barrier.hpp"
#include "vk_harness/target/attachments.hpp"

namespace vk_harness {

namespace {

VkImageMemoryBarrier2 change(VkImage image, VkImageLayout from, VkImageLayout to) {
    constexpr VkPipelineStageFlags2 kStages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    return image_barrier(
        image, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
        {kStages, VK_ACCESS_2_TRANSFER_WRITE_BIT, from},
        {kStages, VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT, to});
}

constexpr VkImageSubresourceLayers kLayers = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
// Of offsets in the buffer that is copied from: a multiple of four and of every texel.
constexpr size_t kCopyAlignment = 16;
constexpr std::byte kPoisonByte{0x5a};

}  // namespace

void check_blit(const Capabilities& capabilities, const cases::Case& c) {
    const cases::Blit& blit = *c.blit;
    if (!c.target.color || c.target.has_instruments || c.target.has_depth || !c.draws.empty() ||
        c.target.samples != 1 || c.target.layers != 1) {
        throw invalid("a blit writes to a colour target of one sample alone");
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
        throw invalid("a region of the blit leaves its image, or is empty");
    }
    const bool linear = blit.filter == cases::BlitFilter::linear;
    constexpr VkFormatFeatureFlags filtered = VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if (!has_features(capabilities, to_vulkan(blit.source_format),
                      VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT |
                          (linear ? filtered : VkFormatFeatureFlags{0}))) {
        throw unsupported("the device does not blit{} from the format {}",
                          linear ? " with a linear filter" : "",
                          cases::name_of(blit.source_format));
    }
    if (!has_features(capabilities, to_vulkan(c.target.color->format),
                      VK_FORMAT_FEATURE_BLIT_DST_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT |
                          VK_FORMAT_FEATURE_TRANSFER_SRC_BIT)) {
        throw unsupported("the device does not blit to the format {}",
                          cases::name_of(c.target.color->format));
    }
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

BlitImages::PlainImage BlitImages::make_image(const Device& device, cases::ColorFormat format,
                                              uint32_t width, uint32_t height) {
    const auto info = image_info(to_vulkan(format), {width, height},
                                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    PlainImage made;
    made.image = vk_harness::make_image(device, info);
    made.memory = bind_guarded(device, made.image.get());
    return made;
}

BlitImages::BlitImages(const Device& device, const cases::Case& c) {
    const cases::Blit& blit = *c.blit;
    const std::vector<std::byte> texels =
        encode_texels(blit.source_format, cases::blit_source(blit));
    // Behind the texels what the destination holds before it is cleared: fresh memory may hold the
    // clear colour, and a clear that is lost would go unseen.
    poison_offset_ = (texels.size() + kCopyAlignment - 1) / kCopyAlignment * kCopyAlignment;
    const VkDeviceSize poison =
        VkDeviceSize{c.target.width} * c.target.height * bytes_of(c.target.color->format);
    upload_ = Buffer::create(device, poison_offset_ + poison, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                             HostAccess::write);
    const std::span<std::byte> upload = upload_.bytes();
    std::ranges::copy(texels, upload.begin());
    std::fill(upload.begin() + static_cast<std::ptrdiff_t>(poison_offset_), upload.end(),
              kPoisonByte);
    upload_.flush();
    source_ = make_image(device, blit.source_format, blit.source_width, blit.source_height);
    destination_ = make_image(device, c.target.color->format, c.target.width, c.target.height);
}

void BlitImages::record(const Device& device, VkCommandBuffer commands, const cases::Case& c,
                        VkClearColorValue clear, VkBuffer readback, VkDeviceSize offset) const {
    const VolkDeviceTable& vk = device.vk();
    const cases::Blit& blit = *c.blit;
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    constexpr VkImageLayout kWritten = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    record_barriers(
        device, commands,
        std::array{change(source_.image.get(), VK_IMAGE_LAYOUT_UNDEFINED, kWritten),
                   change(destination_.image.get(), VK_IMAGE_LAYOUT_UNDEFINED, kWritten)});
    VkBufferImageCopy copy{};
    copy.imageSubresource = kLayers;
    copy.imageExtent = {blit.source_width, blit.source_height, 1};
    vk.vkCmdCopyBufferToImage(commands, upload_.get(), source_.image.get(), kWritten, 1, &copy);
    VkBufferImageCopy poison{};
    poison.bufferOffset = poison_offset_;
    poison.imageSubresource = kLayers;
    poison.imageExtent = {c.target.width, c.target.height, 1};
    vk.vkCmdCopyBufferToImage(commands, upload_.get(), destination_.image.get(), kWritten, 1,
                              &poison);
    record_barriers(device, commands,
                    std::array{change(destination_.image.get(), kWritten, kWritten)});
    const VkImageSubresourceRange all = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vk.vkCmdClearColorImage(commands, destination_.image.get(), kWritten, &clear, 1, &all);
    record_barriers(device, commands,
                    std::array{change(source_.image.get(), kWritten, kRead),
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
    record_barriers(device, commands,
                    std::array{change(destination_.image.get(), kWritten, kRead)});
    VkBufferImageCopy back{};
    back.bufferOffset = offset;
    back.imageSubresource = kLayers;
    back.imageExtent = {c.target.width, c.target.height, 1};
    vk.vkCmdCopyImageToBuffer(commands, destination_.image.get(), kRead, readback, 1, &back);
}

}  // namespace vk_harness
