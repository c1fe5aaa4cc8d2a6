// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/memory/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

Handle<VkDeviceMemory> allocate(const Device& device, VkDeviceSize size, uint32_t type,
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
        fail(std::move(failure));
    }
    return Handle<VkDeviceMemory>(device.get(), memory, device.vk().vkFreeMemory);
}

[[noreturn]] void no_memory_type(std::string_view what) {
    fail(Stage::memory, fmt::format("the device has no memory type for {}", what));
}

// Several layers, or what copy_samples.comp reads, are seen as an array.
Handle<VkImageView> create_view(const Device& device, const VkImageCreateInfo& of, VkImage image,
                                VkFormat format, const VkImageSubresourceRange& range,
                                VkImageUsageFlags usage) {
    VkImageViewUsageCreateInfo usage_info = Typed{VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO};
    usage_info.usage = usage;
    VkImageViewCreateInfo info = Typed{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.pNext = &usage_info;
    info.image = image;
    info.viewType = range.layerCount > 1 || of.samples != VK_SAMPLE_COUNT_1_BIT ||
                            usage == VK_IMAGE_USAGE_SAMPLED_BIT
                        ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                        : VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = range;
    return make(device, Stage::memory, "vkCreateImageView", device.vk().vkCreateImageView,
                device.vk().vkDestroyImageView, info);
}

// Whether a column of the table of depth formats has the format.
bool is_depth_format(VkFormat format, uint32_t cases::DepthFormatRow::*column) {
    return std::ranges::any_of(cases::kDepthFormats,
                               [&](const auto& row) { return row.*column == uint32_t{format}; });
}

// Adds every use of the image that the device offers for its format, and views of other formats.
void add_usages(const Device& device, VkImageCreateInfo& info, bool is_depth) {
    const VkPhysicalDevice physical = device.capabilities().physical;
    VkFormatProperties offered{};
    vkGetPhysicalDeviceFormatProperties(physical, info.format, &offered);
    struct Use {
        VkFormatFeatureFlags feature;
        VkImageUsageFlags usage;
        VkImageCreateFlags flags;
    };
    const std::array<Use, 6> uses = {{
        {VK_FORMAT_FEATURE_TRANSFER_SRC_BIT, VK_IMAGE_USAGE_TRANSFER_SRC_BIT, 0},
        {VK_FORMAT_FEATURE_TRANSFER_DST_BIT, VK_IMAGE_USAGE_TRANSFER_DST_BIT, 0},
        {VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, VK_IMAGE_USAGE_SAMPLED_BIT, 0},
        {VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, VK_IMAGE_USAGE_STORAGE_BIT, 0},
        {0, VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT, 0},
        {0, 0, is_depth ? 0U : uint32_t{VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT}},
    }};
    for (const Use& use : uses) {
        // Storage of several samples needs a feature of its own.
        const bool is_stored = use.usage == VK_IMAGE_USAGE_STORAGE_BIT;
        if ((offered.optimalTilingFeatures & use.feature) != use.feature ||
            (is_stored && info.samples != VK_SAMPLE_COUNT_1_BIT)) {
            continue;
        }
        VkImageFormatProperties limits{};
        const VkResult result = vkGetPhysicalDeviceImageFormatProperties(
            physical, info.format, info.imageType, info.tiling, info.usage | use.usage,
            info.flags | use.flags, &limits);
        if (result == VK_SUCCESS &&
            (limits.sampleCounts & static_cast<VkSampleCountFlags>(info.samples)) != 0 &&
            limits.maxArrayLayers >= info.arrayLayers &&
            limits.maxExtent.width >= info.extent.width &&
            limits.maxExtent.height >= info.extent.height) {
            info.usage |= use.usage;
            info.flags |= use.flags;
        }
    }
}

// Whether the device has images like this that buffers are copied to and from.
bool can_be_copied_to(const Device& device, const VkImageCreateInfo& info) {
    VkImageFormatProperties limits{};
    return has_features(device.capabilities(), info.format,
                        VK_FORMAT_FEATURE_TRANSFER_DST_BIT | VK_FORMAT_FEATURE_TRANSFER_SRC_BIT) &&
           vkGetPhysicalDeviceImageFormatProperties(
               device.capabilities().physical, info.format, info.imageType, info.tiling,
               info.usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT, info.flags, &limits) == VK_SUCCESS;
}

// An image of colour, of as many texels as the other has samples in all, which is cleared by a
// command; every device clears these formats ("Required Format Support").
Handle<VkImage> make_alias(const Device& device, const VkImageCreateInfo& other) {
    const VkFormat format = other.format == kColorFormat  ? kColorFormat
                            : other.format == kTwoNumbers ? VK_FORMAT_R16G16B16A16_SFLOAT
                                                          : VK_FORMAT_R8G8B8A8_UNORM;
    VkImageCreateInfo info = image_info(format, {other.extent.width, other.extent.height},
                                        VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    info.arrayLayers = std::min(other.arrayLayers * static_cast<uint32_t>(other.samples),
                                device.capabilities().limits.maxImageArrayLayers);
    return make_image(device, info);
}

}  // namespace

bool has_linear(VkPhysicalDevice physical, const VkImageCreateInfo& info) {
    VkFormatProperties offered{};
    vkGetPhysicalDeviceFormatProperties(physical, info.format, &offered);
    const VkFormatFeatureFlags needed =
        offered.optimalTilingFeatures &
        (VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT |
         VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_TRANSFER_SRC_BIT);
    if ((offered.linearTilingFeatures & needed) != needed) {
        return false;
    }
    VkImageFormatProperties limits{};
    return vkGetPhysicalDeviceImageFormatProperties(physical, info.format, info.imageType,
                                                    VK_IMAGE_TILING_LINEAR, info.usage, info.flags,
                                                    &limits) == VK_SUCCESS &&
           limits.maxExtent.width >= info.extent.width &&
           limits.maxExtent.height >= info.extent.height;
}

Buffer::Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, const void* next)
    : device_(&device), buffer_(make_buffer(device, size, usage, next)), size_(size) {}

VkMemoryRequirements Buffer::needs() const {
    VkMemoryRequirements needs{};
    device_->vk().vkGetBufferMemoryRequirements(device_->get(), get(), &needs);
    return needs;
}

void Buffer::bind(Handle<VkDeviceMemory> memory) {
    memory_ = std::move(memory);
    check(Stage::memory, device_->vk().vkBindBufferMemory(device_->get(), get(), memory_.get(), 0),
          "vkBindBufferMemory");
}

Buffer Buffer::create(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage,
                      HostAccess access) {
    Buffer buffer(device, size, usage);
    const VkMemoryRequirements needs = buffer.needs();
    const VkPhysicalDeviceMemoryProperties& memory = device.capabilities().memory;
    const auto type =
        find_memory_type(memory, needs.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT,
                         access == HostAccess::read ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT
                                                    : VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    if (!type) {
        no_memory_type("a buffer that the host can map");
    }
    buffer.coherent_ =
        (memory.memoryTypes[*type].propertyFlags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) != 0;
    buffer.bind(allocate(device, needs.size, *type));
    void* data = nullptr;
    check(Stage::memory,
          device.vk().vkMapMemory(device.get(), buffer.memory_.get(), 0, VK_WHOLE_SIZE, 0, &data),
          "vkMapMemory");
    buffer.data_ = static_cast<std::byte*>(data);
    return buffer;
}

Buffer Buffer::import(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage) {
    constexpr VkExternalMemoryHandleTypeFlagBits kHost =
        VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
    VkExternalMemoryBufferCreateInfo external =
        Typed{VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO};
    external.handleTypes = kHost;
    Buffer buffer(device, size, usage, &external);
    const VkMemoryRequirements needs = buffer.needs();
    // A power of two, of which address and size are multiples.
    const VkDeviceSize alignment =
        std::max({device.capabilities().doors.host_alignment, needs.alignment,
                  VkDeviceSize{alignof(std::max_align_t)}});
    const VkDeviceSize bytes = (needs.size + alignment - 1) / alignment * alignment;
    buffer.host_.reset(static_cast<std::byte*>(
        std::aligned_alloc(static_cast<size_t>(alignment), static_cast<size_t>(bytes))));
    if (!buffer.host_) {
        fail(Stage::memory, fmt::format("the host has no {} bytes to import", bytes));
    }
    VkMemoryHostPointerPropertiesEXT offered =
        Typed{VK_STRUCTURE_TYPE_MEMORY_HOST_POINTER_PROPERTIES_EXT};
    check(Stage::memory,
          device.vk().vkGetMemoryHostPointerPropertiesEXT(device.get(), kHost, buffer.host_.get(),
                                                          &offered),
          "vkGetMemoryHostPointerPropertiesEXT");
    const auto type = find_memory_type(
        device.capabilities().memory, needs.memoryTypeBits & offered.memoryTypeBits,
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, 0);
    if (!type) {
        no_memory_type("a buffer in memory of the host");
    }
    VkImportMemoryHostPointerInfoEXT imported =
        Typed{VK_STRUCTURE_TYPE_IMPORT_MEMORY_HOST_POINTER_INFO_EXT};
    imported.handleType = kHost;
    imported.pHostPointer = buffer.host_.get();
    buffer.bind(allocate(device, bytes, *type, &imported));
    buffer.data_ = buffer.host_.get();
    return buffer;
}

void Buffer::synchronize(PFN_vkFlushMappedMemoryRanges VolkDeviceTable::*call, Stage stage,
                         std::string_view name) const {
    if (coherent_) {
        return;
    }
    VkMappedMemoryRange range = Typed{VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE};
    range.memory = memory_.get();
    range.size = VK_WHOLE_SIZE;
    return check(stage, (device_->vk().*call)(device_->get(), 1, &range), name);
}

void Buffer::flush() const {
    return synchronize(&VolkDeviceTable::vkFlushMappedMemoryRanges, Stage::memory,
                       "vkFlushMappedMemoryRanges");
}

void Buffer::invalidate() const {
    return synchronize(&VolkDeviceTable::vkInvalidateMappedMemoryRanges, Stage::readback,
                       "vkInvalidateMappedMemoryRanges");
}

ImageMemory bind_guarded(const Device& device, VkImage image, bool is_dedicated,
                         Handle<VkImage>* alias) {
    VkImageMemoryRequirementsInfo2 asked =
        Typed{VK_STRUCTURE_TYPE_IMAGE_MEMORY_REQUIREMENTS_INFO_2};
    asked.image = image;
    VkMemoryDedicatedRequirements dedicated =
        Typed{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS};
    VkMemoryRequirements2 answer = Typed{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
    answer.pNext = &dedicated;
    device.vk().vkGetImageMemoryRequirements2(device.get(), &asked, &answer);
    VkMemoryRequirements needs = answer.memoryRequirements;
    if (alias != nullptr) {
        VkMemoryRequirements other{};
        device.vk().vkGetImageMemoryRequirements(device.get(), alias->get(), &other);
        if ((needs.memoryTypeBits & other.memoryTypeBits) == 0 ||
            dedicated.requiresDedicatedAllocation != VK_FALSE) {
            *alias = {};
            alias = nullptr;
        } else {
            needs.size = std::max(needs.size, other.size);
            needs.alignment = std::max(needs.alignment, other.alignment);  // powers of two
            needs.memoryTypeBits &= other.memoryTypeBits;
        }
    }
    const auto find_type = [&device](uint32_t allowed) {
        return find_memory_type(device.capabilities().memory, allowed, 0,
                                VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    };

    ImageMemory made;
    GuardPlaces places{0, 0, 0, needs.size};
    std::optional<uint32_t> type;
    is_dedicated = is_dedicated || dedicated.requiresDedicatedAllocation != VK_FALSE;
    if (!is_dedicated) {
        auto guard = std::make_unique<Guard>(device);
        const VkMemoryRequirements side = guard->needs();
        type = find_type(needs.memoryTypeBits & side.memoryTypeBits);
        if (type) {
            made.guard = std::move(guard);
            places = place_guards(needs, side, device.capabilities().limits.bufferImageGranularity);
        }
    }
    if (!type) {
        type = find_type(needs.memoryTypeBits);
    }
    if (!type) {
        no_memory_type("an image");
    }
    VkMemoryDedicatedAllocateInfo alone = Typed{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO};
    alone.image = image;
    made.memory = allocate(device, places.size, *type, is_dedicated ? &alone : nullptr);
    made.size = places.size;
    for (const VkImage bound : {image, alias != nullptr ? alias->get() : VK_NULL_HANDLE}) {
        if (bound == VK_NULL_HANDLE) {
            continue;
        }
        check(Stage::memory,
              device.vk().vkBindImageMemory(device.get(), bound, made.memory.get(), places.image),
              "vkBindImageMemory");
    }
    if (made.guard) {
        made.guard->bind(device, made.memory.get(), places, needs.size);
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

Image Image::create(const Device& device, VkFormat format, VkExtent2D extent, uint32_t samples,
                    uint32_t layers, VkImageCreateFlags flags, const ImageWay& way) {
    const bool stencil = is_depth_format(format, &cases::DepthFormatRow::with_stencil);
    const bool depth = stencil || is_depth_format(format, &cases::DepthFormatRow::vulkan);
    const bool multisampled = samples > 1;
    const bool is_read = multisampled || way.is_sampled;
    const VkImageUsageFlags attachment =
        depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    VkImageCreateInfo info = image_info(
        format, way.extent(extent),
        attachment | (is_read ? VK_IMAGE_USAGE_SAMPLED_BIT : VK_IMAGE_USAGE_TRANSFER_SRC_BIT));
    info.mipLevels = std::min(
        way.levels(),
        static_cast<uint32_t>(std::bit_width(std::max(info.extent.width, info.extent.height))));
    info.arrayLayers = way.first_layer + layers + way.more_layers;
    info.samples = static_cast<VkSampleCountFlagBits>(samples);  // the bits' values are the counts
    info.flags = flags;
    if (multisampled && !depth) {
        info.flags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
    }
    if (way.is_input) {
        info.usage |= VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT;
    }
    if (way.all_usages) {
        add_usages(device, info, depth);
    }
    if (way.is_linear && has_linear(device.capabilities().physical, info)) {
        info.tiling = VK_IMAGE_TILING_LINEAR;
    }
    Image image;
    image.whole_ = {{info.extent.width, info.extent.height},
                    info.mipLevels,
                    info.arrayLayers,
                    way.has_spare_aspect,
                    way.origin()};
    if (way.has_neighbours() && !multisampled && can_be_copied_to(device, info)) {
        info.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        image.whole_.is_copied = true;
    }
    image.is_linear_ = info.tiling == VK_IMAGE_TILING_LINEAR;
    image.image_ = make_image(device, info);
    const VkImage handle = image.get();
    image.range_ = {depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT, way.level, 1,
                    way.first_layer, layers};
    if (stencil) {
        image.range_.aspectMask |= VK_IMAGE_ASPECT_STENCIL_BIT;
    }

    if (way.is_aliased) {
        image.alias_ = make_alias(device, info);
    }
    image.memory_ =
        bind_guarded(device, handle, way.is_dedicated, image.alias_ ? &image.alias_ : nullptr);

    const VkImageUsageFlags input =
        way.is_input ? VkImageUsageFlags{VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT} : 0U;
    VkImageUsageFlags view_usage = attachment | input;
    if (multisampled && depth) {
        view_usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    }
    const auto add_view = [&](Handle<VkImageView>& to, VkFormat seen, VkImageAspectFlags aspect,
                              VkImageUsageFlags usage) {
        VkImageSubresourceRange range = image.range_;
        range.aspectMask = aspect;
        to = create_view(device, info, handle, seen, range, usage);
    };
    image.drawn_ = image.range_;
    image.views_ = way.views;
    if (way.views != 0) {
        image.drawn_.baseArrayLayer = 0;
        image.drawn_.layerCount = info.arrayLayers;
    }
    image.view_ = create_view(device, info, handle, format, image.drawn_, view_usage);
    if (multisampled && !depth) {
        add_view(image.bits_view_, bits_format(format), image.aspect(), VK_IMAGE_USAGE_SAMPLED_BIT);
    }
    if (way.is_sampled && !multisampled) {
        add_view(image.bits_view_, format, image.aspect(), VK_IMAGE_USAGE_SAMPLED_BIT);
    }
    if (multisampled && way.views != 0 && depth && !stencil) {
        add_view(image.bits_view_, format, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_USAGE_SAMPLED_BIT);
    }
    if ((multisampled || way.is_input) && stencil) {  // a descriptor names one aspect
        const VkImageUsageFlags usage =
            input | (multisampled ? VkImageUsageFlags{VK_IMAGE_USAGE_SAMPLED_BIT} : 0U);
        add_view(image.bits_view_, format, VK_IMAGE_ASPECT_DEPTH_BIT, usage);
        add_view(image.stencil_view_, format, VK_IMAGE_ASPECT_STENCIL_BIT, usage);
    }
    return image;
}

VkImageCreateInfo image_info(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage) {
    VkImageCreateInfo info = Typed{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    return info;
}

Handle<VkImage> make_image(const Device& device, const VkImageCreateInfo& info) {
    return make(device, Stage::memory, "vkCreateImage", device.vk().vkCreateImage,
                device.vk().vkDestroyImage, info);
}

SampledImage make_sampled(const Device& device, const VkImageCreateInfo& info, VkImageViewType type,
                          const VkImageSubresourceRange& range) {
    SampledImage out;
    out.image = make_image(device, info);
    VkMemoryRequirements needs{};
    device.vk().vkGetImageMemoryRequirements(device.get(), out.image.get(), &needs);
    const auto memory_type = find_memory_type(device.capabilities().memory, needs.memoryTypeBits, 0,
                                              VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (!memory_type) {
        no_memory_type("an image");
    }
    out.memory = allocate(device, needs.size, *memory_type);
    check(Stage::memory,
          device.vk().vkBindImageMemory(device.get(), out.image.get(), out.memory.get(), 0),
          "vkBindImageMemory");
    VkImageViewCreateInfo view = Typed{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = out.image.get();
    view.viewType = type;
    view.format = info.format;
    view.subresourceRange = range;
    out.view = make(device, Stage::memory, "vkCreateImageView", device.vk().vkCreateImageView,
                    device.vk().vkDestroyImageView, view);
    return out;
}

}  // namespace vk_harness
