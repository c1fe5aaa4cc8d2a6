// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/depth_codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "capture/capture.hpp"
#include "cases/format/depth_format.hpp"
#include "vk_harness/memory/barrier.hpp"
#include "vk_harness/memory/memory.hpp"
#include "vk_harness/target/readback.hpp"

namespace vk_harness {

struct DepthCodes::Asking {
    SampledImage image;
    Buffer codes, read;
    DescriptorSets sets;
    Asking(const Device& device, const PipelineCache& pipelines, VkFormat format, VkExtent2D extent,
           VkDeviceSize bytes);
    void record(const Device& device, const PipelineCache& pipelines, VkPipeline pipeline,
                VkCommandBuffer commands, VkFormat format, VkExtent2D extent) const;
};

namespace {

constexpr uint32_t kLargestCode = (1U << 24) - 1;
// A conversion that is further off than so many codes is found to be none.
constexpr uint32_t kReach = 4;
constexpr uint32_t kWidth = 1024;  // texels; every device has images of 4096 x 4096

constexpr VkImageUsageFlags kUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;

VkImageAspectFlags all_aspects(VkFormat format) {
    return VkImageAspectFlags{VK_IMAGE_ASPECT_DEPTH_BIT} |
           (format == VK_FORMAT_D24_UNORM_S8_UINT ? VkImageAspectFlags{VK_IMAGE_ASPECT_STENCIL_BIT}
                                                  : 0U);
}

// Whether a word is a number that is read of some code.
bool is_depth(uint32_t word) {
    const auto read = std::bit_cast<float>(word);
    return read >= 0 && read <= 1;
}

}  // namespace

DepthCodes::Asking::Asking(const Device& device, const PipelineCache& pipelines, VkFormat format,
                           VkExtent2D extent, VkDeviceSize bytes)
    : image(make_sampled(device, image_info(format, extent, kUsage), VK_IMAGE_VIEW_TYPE_2D_ARRAY,
                         {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1})),
      codes(Buffer::create(device, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write)),
      read(Buffer::create(device, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, HostAccess::read)),
      sets(make_sets(device, {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                     pipelines.layouts().copy_set.get())) {
    DescriptorWrites writes;
    writes.add(sets.sets.front(), 0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
               {VK_NULL_HANDLE, image.view.get(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    writes.add(sets.sets.front(), 1, {read.get(), 0, read.size()});
    writes.write(device);
}

void DepthCodes::Asking::record(const Device& device, const PipelineCache& pipelines,
                                VkPipeline pipeline, VkCommandBuffer commands, VkFormat format,
                                VkExtent2D extent) const {
    const VolkDeviceTable& vk = device.vk();
    const VkImageSubresourceRange range = {all_aspects(format), 0, 1, 0, 1};
    const auto turn = [&](const ImageUse& from, const ImageUse& to) {
        const VkImageMemoryBarrier2 barrier = image_barrier(image.image.get(), range, from, to);
        record_barriers(device, commands, {&barrier, 1});
    };
    const ImageUse written = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
    turn({0, 0, VK_IMAGE_LAYOUT_UNDEFINED}, written);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
    region.imageExtent = {extent.width, extent.height, 1};
    vk.vkCmdCopyBufferToImage(commands, codes.get(), image.image.get(),
                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    turn(written, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    const std::array<uint32_t, kCopyConstants> constants = {extent.width, extent.height, 1, 0, 0};
    vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vk.vkCmdPushConstants(commands, pipelines.layouts().copy.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                          sizeof(constants), constants.data());
    vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                               pipelines.layouts().copy.get(), 0, 1, sets.sets.data(), 0, nullptr);
    vk.vkCmdDispatch(commands, (extent.width + kCopyGroupSize - 1) / kCopyGroupSize,
                     (extent.height + kCopyGroupSize - 1) / kCopyGroupSize, 1);
}

bool can_ask_codes(const Capabilities& capabilities, VkFormat format) {
    return has_features(capabilities, format,
                        VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT) &&
           image_limits(capabilities.physical, format, kUsage, 0).width >= kWidth;
}

void DepthCodes::ask(Submission& submission, PipelineCache& pipelines, VkFormat format,
                     const std::vector<uint32_t>& codes) {
    const VkExtent2D extent = {kWidth, static_cast<uint32_t>((codes.size() + kWidth - 1) / kWidth)};
    const size_t words = size_t{extent.width} * extent.height;
    const VkPipeline pipeline = pipelines.get_code_copy();
    last_ = std::make_shared<Asking>(*device_, pipelines, format, extent, words * sizeof(uint32_t));
    Asking& asking = *last_;
    // The codes of the last row that are not asked for are 0.
    std::vector<uint32_t> texels = codes;
    texels.resize(words);
    std::memcpy(asking.codes.bytes().data(), texels.data(), words * sizeof(uint32_t));
    asking.codes.flush();
    poison(asking.read.bytes().first(words * sizeof(uint32_t)));
    asking.read.flush();
    auto commands = submission.begin();
    asking.record(*device_, pipelines, pipeline, commands, format, extent);
    submission.run();
    asking.read.invalidate();
    const auto* read = reinterpret_cast<const uint32_t*>(asking.read.bytes().data());
    Format& known = formats_[format];
    for (size_t k = 0; k < codes.size(); ++k) {
        const auto [it, is_new] = known.code_of.emplace(read[k], codes[k]);
        if (!is_new && it->second != codes[k]) {
            known.ambiguous.insert(read[k]);
        }
    }
    known.asked.insert(codes.begin(), codes.end());
    last_.reset();
}

void DepthCodes::learn(Submission& submission, PipelineCache& pipelines, VkFormat format,
                       std::span<const uint32_t> words) {
    const Format& known = formats_[format];
    const std::set<uint32_t> distinct(words.begin(), words.end());
    std::set<uint32_t> codes;
    for (const uint32_t word : distinct) {
        if (!is_depth(word)) {
            continue;
        }
        const double nearest = std::floor(static_cast<double>(std::bit_cast<float>(word)) *
                                              static_cast<double>(kLargestCode) +
                                          0.5);
        const auto middle = static_cast<uint32_t>(nearest);
        for (uint32_t code = middle - std::min(middle, kReach);
             code <= std::min(middle + kReach, kLargestCode); ++code) {
            if (!known.asked.contains(code)) {
                codes.insert(code);
            }
        }
    }
    // At most as many rows as every device has.
    constexpr size_t kMost = size_t{kWidth} * 1024;
    const std::vector<uint32_t> all(codes.begin(), codes.end());
    for (size_t first = 0; first < all.size(); first += kMost) {
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = begin + static_cast<std::ptrdiff_t>(std::min(kMost, all.size() - first));
        ask(submission, pipelines, format, {begin, end});
    }
}

std::optional<std::string> DepthCodes::decode(VkFormat format, std::span<const uint32_t> words,
                                              std::span<float> to) const {
    const Format& known = formats_.at(format);
    for (size_t k = 0; k < words.size(); ++k) {
        to[k] = std::bit_cast<float>(words[k]);
        if (!is_depth(words[k])) {
            continue;
        }
        if (known.ambiguous.contains(words[k])) {
            return fmt::format(
                "a shader of the device reads {} of several codes of D24, so that single "
                "samples that hold one of them cannot be told apart",
                to[k]);
        }
        const auto found = known.code_of.find(words[k]);
        if (found == known.code_of.end()) {
            return "a shader of the device reads a sample of D24 as a number that it reads of no "
                   "code in an image of one sample";
        }
        to[k] = cases::depth_of_code(found->second, cases::DepthFormat::d24_unorm);
    }
    return std::nullopt;
}

}  // namespace vk_harness
