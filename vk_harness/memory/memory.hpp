// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Buffers that the host maps, and attachments.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <span>

#include "vk_harness/memory/guard.hpp"
#include "vk_harness/memory/image_way.hpp"

namespace vk_harness {

enum class HostAccess { write, read };

// A buffer in host-visible memory, mapped as long as it lives. Memory for reading is host-cached
// where the device has such memory: reading uncached memory is slower by an order of magnitude.
class Buffer {
  public:
    Buffer() = default;
    static Buffer create(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage,
                         HostAccess access);

    // In memory of the application, which the device imports: DoorSupport::host_import. Not mapped.
    static Buffer import(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage);

    VkBuffer get() const { return buffer_.get(); }
    VkDeviceSize size() const { return size_; }
    std::span<std::byte> bytes() const { return {data_, static_cast<size_t>(size_)}; }
    // Makes host writes visible to the device, or device writes to the host.
    void flush() const;
    void invalidate() const;

  private:
    // Not bound to memory yet. `next` extends the structure that it is made from.
    Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage,
           const void* next = nullptr);
    VkMemoryRequirements needs() const;
    void bind(Handle<VkDeviceMemory> memory);
    // Flushes or invalidates all of the memory by `call`, unless it is coherent.
    void synchronize(PFN_vkFlushMappedMemoryRanges VolkDeviceTable::*call, Stage stage,
                     std::string_view name) const;

    struct Free {
        void operator()(std::byte* memory) const { std::free(memory); }
    };
    const Device* device_ = nullptr;
    std::unique_ptr<std::byte[], Free> host_;  // that is imported; freed after what imports it
    Handle<VkDeviceMemory> memory_;            // freed after the buffer
    Handle<VkBuffer> buffer_;
    VkDeviceSize size_ = 0;
    std::byte* data_ = nullptr;
    bool coherent_ = true;
};

// Usage and flags of a colour attachment that is copied (one sample) or read sample by sample.
VkImageUsageFlags color_usage(uint32_t samples);
VkImageCreateFlags color_flags(uint32_t samples);

// Memory that an image is bound to, with guards on both sides where the device lets an image share
// its memory; the guard is freed first.
struct ImageMemory {
    Handle<VkDeviceMemory> memory;
    std::unique_ptr<Guard> guard;  // may be null
    VkDeviceSize size = 0;         // of it all
};
// Memory of its own for an image that is written to, bound to it.
// is_dedicated: without guards, in an allocation for it alone. `alias`: an image that is bound to
// the same place, where the device has memory for both; else it is destroyed.
ImageMemory bind_guarded(const Device& device, VkImage image, bool is_dedicated = false,
                         Handle<VkImage>* alias = nullptr);

// Whether the device draws to, and blends where it does so otherwise, images like this of one
// sample, level and layer with linear tiling.
bool has_linear(VkPhysicalDevice physical, const VkImageCreateInfo& info);

// The image that an attachment is a part of.
struct ImageWhole {
    VkExtent2D extent{};  // of level 0
    uint32_t levels = 1, layers = 1;
    bool has_spare_aspect = false;  // ImageWay
    VkOffset2D origin{};            // of the attachment, in its level
    bool is_copied =
        false;  // it has more than the attachment, which buffers are copied to and from
};

// A colour or depth attachment.
class Image {
  public:
    Image() = default;
    // samples == 1: can be copied to a buffer. samples > 1: can be read sample by sample in a
    // shader. `flags`: besides those that this needs.
    // The views show all layers; those of several layers or samples are of an array.
    // `way`: of what it is a part; `extent` and `layers` are its own.
    static Image create(const Device& device, VkFormat format, VkExtent2D extent, uint32_t samples,
                        uint32_t layers, VkImageCreateFlags flags = 0, const ImageWay& way = {});

    VkImage get() const { return image_.get(); }
    VkImageView view() const { return view_.get(); }
    // To read single samples: unsigned view of colour, a view of depth alone.
    VkImageView sample_view() const { return bits_view_ ? bits_view_.get() : view_.get(); }
    // To read single samples of the stencil, if there is one.
    VkImageView stencil_view() const { return stencil_view_.get(); }
    // As an input attachment: of its own format, of one aspect.
    VkImageView input_view(VkImageAspectFlags aspect) const {
        return aspect == VK_IMAGE_ASPECT_STENCIL_BIT ? stencil_view()
               : aspect == VK_IMAGE_ASPECT_DEPTH_BIT ? sample_view()
                                                     : view();
    }
    VkImageAspectFlags aspect() const { return range_.aspectMask; }
    // What of the image the attachment is; of all that it has.
    const VkImageSubresourceRange& range() const { return range_; }
    // What of the image the view shows that is drawn to: with multiview more than that.
    const VkImageSubresourceRange& drawn() const { return drawn_; }
    uint32_t views() const { return views_; }  // ImageWay
    const ImageWhole& whole() const { return whole_; }
    VkDeviceSize memory_size() const { return memory_.size; }
    Guard* guard() const { return memory_.guard.get(); }  // may be null
    // Another image in the same memory, which vkCmdClearColorImage clears; null if there is none.
    VkImage alias() const { return alias_.get(); }
    bool is_linear() const { return is_linear_; }

  private:
    ImageMemory memory_;
    Handle<VkImage> image_, alias_;
    bool is_linear_ = false;
    uint32_t views_ = 0;
    Handle<VkImageView> view_;
    Handle<VkImageView> bits_view_;
    Handle<VkImageView> stencil_view_;
    VkImageSubresourceRange range_ = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageSubresourceRange drawn_ = range_;
    ImageWhole whole_;
};

// What all images have in common: two dimensions, one level, layer and sample, no contents.
VkImageCreateInfo image_info(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage);
Handle<VkImage> make_image(const Device& device, const VkImageCreateInfo& info);

// An image that shaders read, in memory of its own, with a view of what they see.
struct SampledImage {
    Handle<VkDeviceMemory> memory;  // freed after the image
    Handle<VkImage> image;
    Handle<VkImageView> view;
};
SampledImage make_sampled(const Device& device, const VkImageCreateInfo& info, VkImageViewType type,
                          const VkImageSubresourceRange& range);

}  // namespace vk_harness
