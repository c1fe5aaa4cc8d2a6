// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/commands/color_source.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "cases/format/color_format.hpp"
#include "cases/model/texels.hpp"
#include "vk_harness/memory/barrier.hpp"

namespace vk_harness {

namespace {

using cases::ColorFrom;

// Every device takes multiples of it as offsets (minUniformBufferOffsetAlignment and the like are
// at most 256).
constexpr VkDeviceSize kSlot = 256;
constexpr uint32_t kSide = cases::kMaskColumns;  // texels of a texture of one colour
// Behind the slots: texels that tell where they lie.
constexpr VkDeviceSize kTexelBytes = VkDeviceSize{4} * cases::kTexels * cases::kTexels;
constexpr VkImageSubresourceRange kOneLevel = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

// A draw has two slots: another colour, then its own.
VkDeviceSize slot_of(size_t draw) {
    return (2 * draw + 1) * kSlot;
}

// The codes of 8 bits that stand for these numbers, c / 255, if there are any and the target has no
// more bits: a device may read a number beside c / 255, which is stored as it were that.
std::optional<std::array<uint8_t, 4>> codes_of(const glm::vec4& color, cases::ColorFormat target) {
    const cases::ComponentKind kind = cases::row_of(target).kind;
    if ((kind != cases::ComponentKind::unorm && kind != cases::ComponentKind::srgb) ||
        cases::component_of(target, 0).bits > 8) {
        return std::nullopt;
    }
    std::array<uint8_t, 4> codes{};
    for (int k = 0; k < 4; ++k) {
        const float code = std::round(color[k] * 255.0F);
        if (!(code >= 0 && code <= 255) ||
            std::bit_cast<uint32_t>(code / 255.0F) != std::bit_cast<uint32_t>(color[k])) {
            return std::nullopt;
        }
        codes.at(static_cast<size_t>(k)) = static_cast<uint8_t>(code);
    }
    return codes;
}

VkDescriptorType type_of(ColorFrom from) {
    switch (from) {
        case ColorFrom::uniform:
            return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        case ColorFrom::uniform_offset:
            return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
        case ColorFrom::storage:
            return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        default:
            return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    }
}

// Of texels that are read without filtering, wherever they are read.
Handle<VkSampler> make_nearest_sampler(const Device& device) {
    VkSamplerCreateInfo info = Typed{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    return make(device, Stage::pipeline, "vkCreateSampler", device.vk().vkCreateSampler,
                device.vk().vkDestroySampler, info);
}

}  // namespace

bool has_color_sources(const cases::Case& c) {
    return std::ranges::any_of(
        c.draws, [](const cases::Draw& draw) { return draw.color.from > ColorFrom::constant; });
}

SampledImage ColorSources::make_texture(VkFormat format, uint32_t side, bool is_rendered) const {
    const VkImageUsageFlags filled =
        is_rendered ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT : VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    return make_sampled(*device_,
                        image_info(format, {side, side}, VK_IMAGE_USAGE_SAMPLED_BIT | filled),
                        VK_IMAGE_VIEW_TYPE_2D, kOneLevel);
}

ColorSources::ColorSources(const Device& device, const PipelineLayouts& layouts,
                           const cases::Case& c)
    : device_(&device),
      layouts_(&layouts),
      buffer_(Buffer::create(device, slot_of(c.draws.size()) + kTexelBytes,
                             VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                 VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                             HostAccess::write)),
      sampler_(make_nearest_sampler(device)),
      sources_(c.draws.size()) {
    const std::span<std::byte> memory = buffer_.bytes();
    DescriptorWrites writes;
    for (size_t k = 0; k < c.draws.size(); ++k) {
        Source& source = sources_[k];
        const cases::ColorOutput& output = c.draws[k].color;
        source.from = output.from;
        if (source.from <= ColorFrom::constant) {
            continue;
        }
        const VkDescriptorType type = type_of(source.from);
        source.set = make_sets(device, {type}, layouts.colored(source.from).set.get());
        const VkDescriptorSet set = source.set.sets.front();
        const glm::vec4 other = glm::vec4(1) - output.value;
        std::memcpy(&memory[slot_of(k) - kSlot], &other, sizeof other);
        std::memcpy(&memory[slot_of(k)], &output.value, sizeof output.value);
        if (!is_texture(source.from)) {
            const bool is_dynamic = source.from == ColorFrom::uniform_offset;
            writes.add(set, 0, {buffer_.get(), is_dynamic ? 0 : slot_of(k), sizeof(glm::vec4)},
                       type);
            continue;
        }
        const bool tells = source.from == ColorFrom::texels;
        const auto codes = codes_of(output.value, c.target.color->format);
        const size_t texel = codes ? codes->size() : sizeof output.value;
        for (size_t t = 0; t < size_t{kSide} * kSide && !tells; ++t) {
            const void* from = codes ? static_cast<const void*>(codes->data()) : &output.value;
            if (source.from == ColorFrom::mask && t % kSide < kSide / 2) {
                std::memset(&memory[slot_of(k) + t * texel], 0, texel);
            } else {
                std::memcpy(&memory[slot_of(k) + t * texel], from, texel);
            }
        }
        for (int i = 0; i < 4; ++i) {
            source.color.float32[i] = output.value[i];
        }
        source.texels = tells ? slot_of(c.draws.size()) : slot_of(k);
        source.side = tells ? cases::kTexels : kSide;
        source.image =
            make_texture(codes || tells ? VK_FORMAT_R8G8B8A8_UNORM : VK_FORMAT_R32G32B32A32_SFLOAT,
                         source.side, source.from == ColorFrom::rendered);
        writes.add(
            set, 0, type,
            {sampler_.get(), source.image.view.get(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    }
    for (uint32_t t = 0; t < cases::kTexels * cases::kTexels; ++t) {
        const std::array<uint8_t, 4> codes = {
            static_cast<uint8_t>(cases::texel_code(t % cases::kTexels)),
            static_cast<uint8_t>(cases::texel_code(t / cases::kTexels)), 255, 255};
        std::memcpy(&memory[slot_of(c.draws.size()) + t * codes.size()], codes.data(),
                    codes.size());
    }
    buffer_.flush();
    writes.write(device);
}

void ColorSources::record(VkCommandBuffer commands) const {
    const VolkDeviceTable& vk = device_->vk();
    for (const Source& source : sources_) {
        if (!is_texture(source.from)) {
            continue;
        }
        const bool is_rendered = source.from == ColorFrom::rendered;
        const ImageUse filled =
            is_rendered ? ImageUse{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                   VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                                   VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}
                        : ImageUse{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
        const ImageUse read = {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                               VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        const VkImage image = source.image.image.get();
        record_barriers(*device_, commands,
                        std::array{image_barrier(
                            image, kOneLevel, {read.stage, 0, VK_IMAGE_LAYOUT_UNDEFINED}, filled)});
        if (is_rendered) {
            VkRenderingAttachmentInfo cleared = Typed{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
            cleared.imageView = source.image.view.get();
            cleared.imageLayout = filled.layout;
            cleared.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
            cleared.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
            cleared.clearValue.color = source.color;
            VkRenderingInfo info = Typed{VK_STRUCTURE_TYPE_RENDERING_INFO};
            info.renderArea.extent = {kSide, kSide};
            info.layerCount = 1;
            info.colorAttachmentCount = 1;
            info.pColorAttachments = &cleared;
            vk.vkCmdBeginRendering(commands, &info);
            vk.vkCmdEndRendering(commands);
        } else {
            VkBufferImageCopy copy{};
            copy.bufferOffset = source.texels;
            copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
            copy.imageExtent = {source.side, source.side, 1};
            vk.vkCmdCopyBufferToImage(commands, buffer_.get(), image, filled.layout, 1, &copy);
        }
        record_barriers(*device_, commands,
                        std::array{image_barrier(image, kOneLevel, filled, read)});
    }
}

void ColorSources::bind(VkCommandBuffer commands, uint32_t draw) const {
    const Source& source = sources_[draw];
    if (source.from <= ColorFrom::constant) {
        return;
    }
    const auto offset = static_cast<uint32_t>(slot_of(draw));
    const bool is_dynamic = source.from == ColorFrom::uniform_offset;
    device_->vk().vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                          layouts_->colored(source.from).layout.get(), 0, 1,
                                          source.set.sets.data(), is_dynamic ? 1 : 0, &offset);
}

}  // namespace vk_harness
