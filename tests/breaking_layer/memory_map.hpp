// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include "fault.hpp"

namespace breaking {

// What lies where in the application's memory, as far as it is bound.
void note_buffer(VkBuffer buffer, const VkBufferCreateInfo& info);
bool is_imported(VkBuffer buffer);  // its memory comes from outside of the device
void note_view(VkImageView view, VkImage image);
void note_binding(VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize offset);
void note_binding(VkImage image, VkDeviceMemory memory, VkDeviceSize offset);
void forget_memory(VkDeviceMemory memory);

// What an image was made as; that its memory is its alone.
void note_image(VkImage image, const VkImageCreateInfo& info);
void note_dedicated(VkImage image);
ImageFacts facts_of(VkImage image);
ImageFacts facts_of(VkImageView view);

void note_map(VkDeviceMemory memory, VkDeviceSize offset, void* data);

// A word of a buffer whose memory the application has mapped; nothing if it has not.
std::optional<uint32_t> word_at(VkBuffer buffer, VkDeviceSize offset);

// The buffers next to the image of a view.
Neighbours neighbours_of(VkImageView view);

}  // namespace breaking
