// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The third part of every reproducer: buffers, images, shaders.
static VkDeviceMemory allocate(VkMemoryRequirements need, VkMemoryPropertyFlags flags) {
    VkMemoryAllocateInfo info = {0};
    VkDeviceMemory memory;
    uint32_t k = 0;
    while (k < memory_properties.memoryTypeCount &&
           (!(need.memoryTypeBits >> k & 1) ||
            (memory_properties.memoryTypes[k].propertyFlags & flags) != flags)) {
        ++k;
    }
    NEED(k < memory_properties.memoryTypeCount, "memory of the needed type");
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = need.size;
    info.memoryTypeIndex = k;
    CHECK(vkAllocateMemory(device, &info, NULL, &memory));
    return memory;
}

/* A buffer that the CPU sees, and where. */
static VkBuffer make_buffer(VkDeviceSize size, VkBufferUsageFlags usage, void** mapped) {
    VkBufferCreateInfo info = {0};
    VkMemoryRequirements need;
    VkDeviceMemory memory;
    VkBuffer buffer;
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage;
    CHECK(vkCreateBuffer(device, &info, NULL, &buffer));
    vkGetBufferMemoryRequirements(device, buffer, &need);
    memory =
        allocate(need, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    CHECK(vkBindBufferMemory(device, buffer, memory, 0));
    CHECK(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, mapped));
    return buffer;
}

static VkImageView make_view(VkImage image, VkFormat format, VkImageAspectFlags aspect,
                             VkImageUsageFlags usage, VkImageViewType type) {
    VkImageViewUsageCreateInfo used = {VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO, NULL, usage};
    VkImageViewCreateInfo info = {0};
    VkImageView view;
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.pNext = &used;
    info.image = image;
    info.viewType = type;
    info.format = format;
    info.subresourceRange.aspectMask = aspect;
    info.subresourceRange.levelCount = VK_REMAINING_MIP_LEVELS;
    info.subresourceRange.layerCount = VK_REMAINING_ARRAY_LAYERS;
    CHECK(vkCreateImageView(device, &info, NULL, &view));
    return view;
}

static VkImage make_image(VkFormat format, uint32_t width, uint32_t height, uint32_t levels,
                          uint32_t layers, uint32_t samples, VkImageUsageFlags usage, VkImageCreateFlags flags) {
    VkImageCreateInfo info = {0};
    VkMemoryRequirements need;
    VkImage image;
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.flags = flags;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent.width = width;
    info.extent.height = height;
    info.extent.depth = 1;
    info.mipLevels = levels;
    info.arrayLayers = layers;
    info.samples = (VkSampleCountFlagBits)samples;
    info.usage = usage;
    CHECK(vkCreateImage(device, &info, NULL, &image));
    vkGetImageMemoryRequirements(device, image, &need);
    CHECK(vkBindImageMemory(device, image, allocate(need, 0), 0));
    return image;
}

static VkShaderModule make_module(const struct Code* code) {
    VkShaderModuleCreateInfo info = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, NULL, 0,
                                     code->size, code->words};
    VkShaderModule module;
    CHECK(vkCreateShaderModule(device, &info, NULL, &module));
    return module;
}

static VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, VkShaderModule module) {
    VkPipelineShaderStageCreateInfo info = {0};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = bit;
    info.module = module;
    info.pName = "main";
    return info;
}

static VkPipelineLayout make_layout(VkShaderStageFlags stages, uint32_t bytes,
                                    const VkDescriptorSetLayout* set) {
    VkPushConstantRange range = {stages, 0, bytes};
    VkPipelineLayoutCreateInfo info = {0};
    VkPipelineLayout layout;
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = set != NULL;
    info.pSetLayouts = set;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    CHECK(vkCreatePipelineLayout(device, &info, NULL, &layout));
    return layout;
}

static VkImageAspectFlags aspect_of(enum Role role) {
    return role == DEPTH ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

static VkImageLayout layout_of(enum Role role) {
    return role == DEPTH ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                         : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
}

static void barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                    VkImageLayout before, VkImageLayout after) {
    VkImageMemoryBarrier b = {0};
    b.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    b.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    b.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    b.oldLayout = before;
    b.newLayout = after;
    b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    b.image = image;
    b.subresourceRange.aspectMask = aspect;
    b.subresourceRange.levelCount = VK_REMAINING_MIP_LEVELS;
    b.subresourceRange.layerCount = VK_REMAINING_ARRAY_LAYERS;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1, &b);
}
