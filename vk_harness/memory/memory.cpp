// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/memory/memory.hpp"

#include <fmt/format.h>

#include <bit>
#include <optional>

#include "vk_harness/device/format.hpp"

namespace vk_harness {

namespace {

// The first memory type with all of `required` and, if there is one, all of `preferred`.
std::optional<uint32_t> find_memory_type(const VkPhysicalDeviceMemoryProperties& memory,
                                         uint32_t allowed, VkMemoryPropertyFlags required,
                                         VkMemoryPropertyFlags preferred) {
    std::optional<uint32_t> fallback;
    for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
        const VkMemoryPropertyFlags flags = memory.memoryTypes[type].propertyFlags;
        if ((allowed >> type & 1U) == 0 || (flags & required) != required) {
            continue;
        }
        if ((flags & preferred) == preferred) {
            return type;
        }
        if (!fallback) {
            fallback = type;
        }
    }
    return fallback;
}

Result<Handle<VkDeviceMemory>> allocate(const Device& device, VkDeviceSize size, uint32_t type,
                                        const void* next = nullptr) {
    VkMemoryAllocateInfo info = Typed{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.pNext = next;
    info.allocationSize = size;
    info.memoryTypeIndex = type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    const VkResult result = device.vk().vkAllocateMemory(device.get(), &info, nullptr, &memory);
    if (result != VK_SUCCESS) {
        Failure failure = call_failure(Stage::memory, result, "vkAllocateMemory");
        failure.message += fmt::format(" for {} bytes", size);
        return fail(std::move(failure));
    }
    return Handle<VkDeviceMemory>(device.get(), memory, device.vk().vkFreeMemory);
}

Failure no_memory_type(std::string_view what) {
    Failure failure;
    failure.stage = Stage::memory;
    failure.message = fmt::format("the device has no memory type for {}", what);
    return failure;
}

// Several layers, or samples that copy_samples.comp reads, are seen as an array.
Result<Handle<VkImageView>> create_view(const Device& device, const VkImageCreateInfo& of,
                                        VkImage image, VkFormat format, VkImageAspectFlags aspect,
                                        VkImageUsageFlags usage) {
    VkImageViewUsageCreateInfo usage_info = Typed{VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO};
    usage_info.usage = usage;
    VkImageViewCreateInfo info = Typed{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.pNext = &usage_info;
    info.image = image;
    info.viewType = of.arrayLayers > 1 || of.samples != VK_SAMPLE_COUNT_1_BIT
                        ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                        : VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspect, 0, 1, 0, of.arrayLayers};
    VkImageView view = VK_NULL_HANDLE;
    const VkResult result = device.vk().vkCreateImageView(device.get(), &info, nullptr, &view);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::memory, result, "vkCreateImageView"));
    }
    return Handle<VkImageView>(device.get(), view, device.vk().vkDestroyImageView);
}

}  // namespace

Result<Buffer> Buffer::create(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage,
                              HostAccess access) {
    const VolkDeviceTable& vk = device.vk();
    auto handle = make_buffer(device, size, usage);
    if (!handle) {
        return fail(handle.error());
    }
    Buffer buffer;
    buffer.device_ = &device;
    buffer.buffer_ = std::move(*handle);
    buffer.size_ = size;

    VkMemoryRequirements needs{};
    vk.vkGetBufferMemoryRequirements(device.get(), buffer.get(), &needs);
    const VkPhysicalDeviceMemoryProperties& memory = device.capabilities().memory;
    const auto type =
        find_memory_type(memory, needs.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT,
                         access == HostAccess::read ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT
                                                    : VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    if (!type) {
        return fail(no_memory_type("a buffer that the host can map"));
    }
    buffer.coherent_ =
        (memory.memoryTypes[*type].propertyFlags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) != 0;
    auto allocation = allocate(device, needs.size, *type);
    if (!allocation) {
        return fail(allocation.error());
    }
    buffer.memory_ = std::move(*allocation);
    VkResult result = vk.vkBindBufferMemory(device.get(), buffer.get(), buffer.memory_.get(), 0);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::memory, result, "vkBindBufferMemory"));
    }
    void* data = nullptr;
    result = vk.vkMapMemory(device.get(), buffer.memory_.get(), 0, VK_WHOLE_SIZE, 0, &data);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::memory, result, "vkMapMemory"));
    }
    buffer.data_ = static_cast<std::byte*>(data);
    return buffer;
}

Result<void> Buffer::synchronize(PFN_vkFlushMappedMemoryRanges VolkDeviceTable::*call, Stage stage,
                                 std::string_view name) const {
    if (coherent_) {
        return {};
    }
    VkMappedMemoryRange range = Typed{VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE};
    range.memory = memory_.get();
    range.size = VK_WHOLE_SIZE;
    const VkResult result = (device_->vk().*call)(device_->get(), 1, &range);
    return result == VK_SUCCESS ? Result<void>() : fail(call_failure(stage, result, name));
}

Result<void> Buffer::flush() const {
    return synchronize(&VolkDeviceTable::vkFlushMappedMemoryRanges, Stage::memory,
                       "vkFlushMappedMemoryRanges");
}

Result<void> Buffer::invalidate() const {
    return synchronize(&VolkDeviceTable::vkInvalidateMappedMemoryRanges, Stage::readback,
                       "vkInvalidateMappedMemoryRanges");
}

Result<ImageMemory> bind_guarded(const Device& device, VkImage image) {
    VkImageMemoryRequirementsInfo2 asked =
        Typed{VK_STRUCTURE_TYPE_IMAGE_MEMORY_REQUIREMENTS_INFO_2};
    asked.image = image;
    VkMemoryDedicatedRequirements dedicated =
        Typed{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS};
    VkMemoryRequirements2 answer = Typed{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
    answer.pNext = &dedicated;
    device.vk().vkGetImageMemoryRequirements2(device.get(), &asked, &answer);
    const VkMemoryRequirements& needs = answer.memoryRequirements;
    const auto find_type = [&device](uint32_t allowed) {
        return find_memory_type(device.capabilities().memory, allowed, 0,
                                VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    };

    ImageMemory made;
    GuardPlaces places{0, 0, 0, needs.size};
    std::optional<uint32_t> type;
    if (dedicated.requiresDedicatedAllocation == VK_FALSE) {
        auto guard = Guard::create(device);
        if (!guard) {
            return fail(guard.error());
        }
        const VkMemoryRequirements side = (*guard)->needs();
        type = find_type(needs.memoryTypeBits & side.memoryTypeBits);
        if (type) {
            made.guard = std::move(*guard);
            places = place_guards(needs, side, device.capabilities().limits.bufferImageGranularity);
        }
    }
    if (!type) {
        type = find_type(needs.memoryTypeBits);
    }
    if (!type) {
        return fail(no_memory_type("an image"));
    }
    VkMemoryDedicatedAllocateInfo alone = Typed{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO};
    alone.image = image;
    auto allocation =
        allocate(device, places.size, *type,
                 dedicated.requiresDedicatedAllocation != VK_FALSE ? &alone : nullptr);
    if (!allocation) {
        return fail(allocation.error());
    }
    made.memory = std::move(*allocation);
    made.size = places.size;
    const VkResult result =
        device.vk().vkBindImageMemory(device.get(), image, made.memory.get(), places.image);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::memory, result, "vkBindImageMemory"));
    }
    if (made.guard) {
        if (auto bound = made.guard->bind(device, made.memory.get(), places, needs.size); !bound) {
            return fail(bound.error());
        }
    }
    return made;
}

VkImageUsageFlags color_usage(uint32_t samples) {
    return VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
           (samples > 1 ? VK_IMAGE_USAGE_SAMPLED_BIT : VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
}

VkImageCreateFlags color_flags(uint32_t samples) {
    return samples > 1 ? VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT : 0;
}

Result<Image> Image::create(const Device& device, VkFormat format, VkExtent2D extent,
                            uint32_t samples, uint32_t layers, VkImageCreateFlags flags) {
    const VolkDeviceTable& vk = device.vk();
    const bool stencil = format == kDepthStencilFormat;
    const bool depth = stencil || format == VK_FORMAT_D32_SFLOAT ||
                       format == VK_FORMAT_X8_D24_UNORM_PACK32 || format == VK_FORMAT_D16_UNORM;
    const bool multisampled = samples > 1;
    const VkImageUsageFlags attachment =
        depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    VkImageCreateInfo info = Typed{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = layers;
    info.samples = static_cast<VkSampleCountFlagBits>(samples);  // the bits' values are the counts
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage =
        attachment | (multisampled ? VK_IMAGE_USAGE_SAMPLED_BIT : VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    info.flags = flags;
    if (multisampled && !depth) {
        info.flags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
    }
    VkImage handle = VK_NULL_HANDLE;
    const VkResult result = vk.vkCreateImage(device.get(), &info, nullptr, &handle);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::memory, result, "vkCreateImage"));
    }
    Image image;
    image.image_ = Handle<VkImage>(device.get(), handle, vk.vkDestroyImage);
    image.aspect_ = depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    if (stencil) {
        image.aspect_ |= VK_IMAGE_ASPECT_STENCIL_BIT;
    }

    auto memory = bind_guarded(device, handle);
    if (!memory) {
        return fail(memory.error());
    }
    image.memory_ = std::move(*memory);
    image.layers_ = layers;

    VkImageUsageFlags view_usage = attachment;
    if (multisampled && depth) {
        view_usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    }
    auto view = create_view(device, info, handle, format, image.aspect_, view_usage);
    if (!view) {
        return fail(view.error());
    }
    image.view_ = std::move(*view);
    if (multisampled && !depth) {
        auto bits = create_view(device, info, handle, bits_format(format), image.aspect_,
                                VK_IMAGE_USAGE_SAMPLED_BIT);
        if (!bits) {
            return fail(bits.error());
        }
        image.bits_view_ = std::move(*bits);
    }
    if (multisampled && stencil) {  // a descriptor names one aspect
        for (const auto& [aspect, to] :
             {std::pair(VK_IMAGE_ASPECT_DEPTH_BIT, &image.bits_view_),
              std::pair(VK_IMAGE_ASPECT_STENCIL_BIT, &image.stencil_view_)}) {
            auto one =
                create_view(device, info, handle, format, aspect, VK_IMAGE_USAGE_SAMPLED_BIT);
            if (!one) {
                return fail(one.error());
            }
            *to = std::move(*one);
        }
    }
    return image;
}

Result<Handle<VkDeviceMemory>> bind_memory(const Device& device, VkImage image) {
    VkMemoryRequirements needs{};
    device.vk().vkGetImageMemoryRequirements(device.get(), image, &needs);
    const auto type = find_memory_type(device.capabilities().memory, needs.memoryTypeBits, 0,
                                       VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (!type) {
        return fail(no_memory_type("an image"));
    }
    auto allocation = allocate(device, needs.size, *type);
    if (!allocation) {
        return fail(allocation.error());
    }
    const VkResult result =
        device.vk().vkBindImageMemory(device.get(), image, allocation->get(), 0);
    if (result != VK_SUCCESS) {
        return fail(call_failure(Stage::memory, result, "vkBindImageMemory"));
    }
    return std::move(*allocation);
}

}  // namespace vk_harness
