// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The fifth part of every reproducer: the draws, and copies of what they left.
static const void* drawn[DRAWINGS][MOST_PLANES];

// What attachments are cleared to.
static float clear_number(const struct Drawing* d, uint32_t plane) {
    return plane == HITS && HAS_INSTRUMENTS ? (d->other_clears ? OTHER_NO_HITS : NO_HITS)
           : d->other_clears                ? -2.0F
                                            : -1.0F;
}
static float clear_depth(const struct Drawing* d) {
    return d->other_depth_clear ? 0.625F : DEPTH_CLEAR;
}

static VkBuffer make_filled(const void* data, size_t size, VkBufferUsageFlags usage) {
    void* mapped;
    VkBuffer buffer = make_buffer(size, usage, &mapped);
    memcpy(mapped, data, size);
    return buffer;
}

/* The part of a scissor in a tile: 64 bits, for a scissor may end at 2^31 - 1. */
static VkRect2D cut_scissor(const VkRect2D* own, uint32_t x, uint32_t y, const uint32_t* tile) {
    const int64_t begins[2] = {own->offset.x, own->offset.y}, tiles[2] = {x, y};
    const int64_t sizes[2] = {own->extent.width, own->extent.height};
    int64_t low[2], high[2];
    VkRect2D out = {{0, 0}, {0, 0}};
    uint32_t k;
    for (k = 0; k < 2; ++k) {
        low[k] = begins[k] > tiles[k] ? begins[k] : tiles[k];
        high[k] = begins[k] + sizes[k];
        high[k] = high[k] < tiles[k] + tile[k] ? high[k] : tiles[k] + tile[k];
    }
    if (low[0] < high[0] && low[1] < high[1]) {
        out.offset.x = (int32_t)low[0];
        out.offset.y = (int32_t)low[1];
        out.extent.width = (uint32_t)(high[0] - low[0]);
        out.extent.height = (uint32_t)(high[1] - low[1]);
    }
    return out;
}

static void draw_in(VkCommandBuffer commands, const struct Draw* d, const VkRect2D* scissor) {
    vkCmdSetScissor(commands, 0, 1, scissor);
    if (d->indices != NULL) {
        vkCmdDrawIndexed(commands, d->count, 1, 0, 0, 0);
    } else {
        vkCmdDraw(commands, d->count, 1, 0, 0);
    }
}

static void record_draw(VkCommandBuffer commands, const struct Drawing* drawing, uint32_t number,
                        VkPipelineLayout layout, VkDescriptorSet texture) {
    const struct Draw* d = &drawing->draws[number];
    const size_t array = 16 * (size_t)d->vertices;
    const VkDeviceSize zero = 0;
    uint32_t constants[26] = {0};  // DrawConstants of the shaders: 104 bytes
    uint32_t k, x, y;
    if (d->count == 0) {
        return;
    }
    constants[0] = number | (uint32_t)DRAWS << 16;
    constants[1] = d->layer;
    memcpy(&constants[4], d->colors, sizeof d->colors);
    memcpy(&constants[8], d->offsets, sizeof d->offsets);
    memcpy(&constants[16], d->sample_numbers, sizeof d->sample_numbers);
    constants[20] = d->shader_mask;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, make_pipeline(drawing, d, layout));
    if (texture != VK_NULL_HANDLE) {
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &texture,
                                0, NULL);
    }
    vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
                       0, sizeof constants, constants);
    vkCmdSetViewport(commands, 0, 1, &d->viewport);
    for (k = 0; k < INPUTS; ++k) {
        if (d->inputs[k] != NULL) {
            const VkBuffer buffer =
                make_filled(d->inputs[k], array, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
            vkCmdBindVertexBuffers(commands, k, 1, &buffer, &zero);
        }
    }
    if (d->indices != NULL) {
        vkCmdBindIndexBuffer(
            commands,
            make_filled(d->indices, 4 * (size_t)d->count, VK_BUFFER_USAGE_INDEX_BUFFER_BIT), 0,
            VK_INDEX_TYPE_UINT32);
    }
    if (drawing->tile[0] == 0) {
        draw_in(commands, d, &d->scissor);
        return;
    }
    for (y = 0; y < HEIGHT; y += drawing->tile[1]) {
        for (x = 0; x < WIDTH; x += drawing->tile[0]) {
            const VkRect2D scissor = cut_scissor(&d->scissor, x, y, drawing->tile);
            if (scissor.extent.width > 0) {
                draw_in(commands, d, &scissor);
            }
        }
    }
}

/* Each sample by a shader: a resolve would combine them. */
static void copy_samples(VkCommandBuffer commands, enum Role role, VkImage image, VkBuffer buffer) {
    const uint32_t words = bytes_of(role) / 4;
    const struct Code* code = &kCopyCodes[role == DEPTH ? 3 : words / 2];
    const uint32_t constants[3] = {WIDTH, HEIGHT, SAMPLES};
    const VkDescriptorPoolSize sizes[2] = {{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1},
                                           {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1}};
    VkDescriptorSetLayoutBinding bindings[2] = {
        {0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL},
        {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL}};
    VkDescriptorSetLayoutCreateInfo set_info = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                NULL, 0, 2, bindings};
    VkDescriptorPoolCreateInfo pool_info = {
        VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, NULL, 0, 1, 2, sizes};
    VkDescriptorSetAllocateInfo allocation = {0};
    VkDescriptorImageInfo image_info = {0};
    VkDescriptorBufferInfo buffer_info = {0};
    VkWriteDescriptorSet writes[2];
    VkComputePipelineCreateInfo info = {0};
    VkDescriptorSetLayout set_layout;
    VkDescriptorPool pool;
    VkDescriptorSet set;
    VkPipeline pipeline;
    CHECK(vkCreateDescriptorSetLayout(device, &set_info, NULL, &set_layout));
    CHECK(vkCreateDescriptorPool(device, &pool_info, NULL, &pool));
    allocation.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocation.descriptorPool = pool;
    allocation.descriptorSetCount = 1;
    allocation.pSetLayouts = &set_layout;
    CHECK(vkAllocateDescriptorSets(device, &allocation, &set));
    image_info.imageView = make_view(image,
                                     role == DEPTH                        ? DEPTH_FORMAT
                                     : role == TARGET && COLOR_BYTES == 2 ? VK_FORMAT_R16_UINT
                                     : words == 1                         ? VK_FORMAT_R32_UINT
                                     : words == 2                         ? VK_FORMAT_R32G32_UINT
                                                  : VK_FORMAT_R32G32B32A32_UINT,
                                     aspect_of(role), VK_IMAGE_USAGE_SAMPLED_BIT,
                                     VK_IMAGE_VIEW_TYPE_2D_ARRAY);
    image_info.imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    buffer_info.buffer = buffer;
    buffer_info.range = VK_WHOLE_SIZE;
    memset(writes, 0, sizeof writes);
    writes[0].sType = writes[1].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[0].dstSet = writes[1].dstSet = set;
    writes[0].descriptorCount = writes[1].descriptorCount = 1;
    writes[0].descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    writes[0].pImageInfo = &image_info;
    writes[1].dstBinding = 1;
    writes[1].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[1].pBufferInfo = &buffer_info;
    vkUpdateDescriptorSets(device, 2, writes, 0, NULL);
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, make_module(code));
    info.layout = make_layout(VK_SHADER_STAGE_COMPUTE_BIT, sizeof constants, &set_layout);
    CHECK(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline));
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdPushConstants(commands, info.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants,
                       constants);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, info.layout, 0, 1, &set, 0,
                            NULL);
    vkCmdDispatch(commands, (WIDTH + 7) / 8, (HEIGHT + 7) / 8, LAYERS);
}

// Copies a plane to a buffer, sample after sample of a pixel; where the CPU will see it.
static const void* copy_plane(VkCommandBuffer commands, enum Role role, VkImage image) {
    const size_t bytes = (size_t)WIDTH * HEIGHT * LAYERS * SAMPLES * bytes_of(role);
    VkBufferImageCopy region = {0};
    void* mapped;
    const VkBuffer buffer = make_buffer(
        bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, &mapped);
    memset(mapped, 0xa5, bytes);
    barrier(commands, image, aspect_of(role), layout_of(role),
            SAMPLES > 1 ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
                        : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    if (SAMPLES > 1) {
        copy_samples(commands, role, image, buffer);
        return mapped;
    }
    region.imageSubresource.aspectMask = aspect_of(role);
    region.imageSubresource.layerCount = LAYERS;
    region.imageExtent.width = WIDTH;
    region.imageExtent.height = HEIGHT;
    region.imageExtent.depth = 1;
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1,
                           &region);
    return mapped;
}

static VkImage make_attachment(VkCommandBuffer commands, const struct Drawing* drawing,
                               uint32_t plane, VkRenderingAttachmentInfo* info) {
    const enum Role role = role_of(drawing, plane);
    const VkFormat format = format_of(role);
    const VkImageUsageFlags usage = role == DEPTH ? DEPTH_USAGE : COLOR_USAGE;
    const VkImage image =
        make_image(format, WIDTH, HEIGHT, 1, LAYERS, SAMPLES, usage, role == DEPTH ? 0 : COLOR_FLAGS);
    uint32_t k;
    barrier(commands, image, aspect_of(role), VK_IMAGE_LAYOUT_UNDEFINED, layout_of(role));
    info->sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    info->imageView = make_view(image, format, aspect_of(role),
                                role == DEPTH ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                              : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                LAYERS > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D);
    info->imageLayout = layout_of(role);
    info->loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    info->storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    if (role == DEPTH) {
        info->clearValue.depthStencil.depth = clear_depth(drawing);
    } else if (role == TARGET) {
        memcpy(info->clearValue.color.uint32, kColorClear, sizeof kColorClear);
    } else {
        for (k = 0; k < 4; ++k) {
            info->clearValue.color.float32[k] = clear_number(drawing, plane);
        }
    }
    return image;
}

// Records a drawing; planes[k] is where the CPU will see what attachment k holds.
static void record(VkCommandBuffer commands, const struct Drawing* drawing, const void** planes) {
    const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                                  VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
    VkDescriptorSetLayoutCreateInfo set_info = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                NULL, 0, 1, &binding};
    VkRenderingAttachmentInfo attachments[MOST_PLANES];
    VkRenderingInfo rendering = {0};
    VkDescriptorSetLayout set_layout;
    VkDescriptorSet textures[DRAWS];
    VkPipelineLayout layout;
    VkImage images[MOST_PLANES];
    uint32_t k;
    CHECK(vkCreateDescriptorSetLayout(device, &set_info, NULL, &set_layout));
    layout =
        make_layout(VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 104, &set_layout);
    memset(attachments, 0, sizeof attachments);
    for (k = 0; k < planes_of(drawing); ++k) {
        images[k] = make_attachment(commands, drawing, k, &attachments[k]);
    }
    for (k = 0; k < DRAWS; ++k) {
        textures[k] = drawing->draws[k].texture[0] == 0
                          ? VK_NULL_HANDLE
                          : make_texture(commands, drawing->draws[k].texture, set_layout);
    }
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent.width = WIDTH;
    rendering.renderArea.extent.height = HEIGHT;
    rendering.layerCount = LAYERS;
    rendering.colorAttachmentCount = depth_plane(drawing);
    rendering.pColorAttachments = attachments;
    rendering.pDepthAttachment = HAS_DEPTH ? &attachments[depth_plane(drawing)] : NULL;
    vkCmdBeginRendering(commands, &rendering);
    for (k = 0; k < DRAWS; ++k) {
        record_draw(commands, drawing, k, layout, textures[k]);
    }
    vkCmdEndRendering(commands);
    for (k = 0; k < planes_of(drawing); ++k) {
        planes[k] = copy_plane(commands, role_of(drawing, k), images[k]);
    }
}

/* Draws those of the drawings that belong to one submission. */
static void submit(VkBool32 later) {
    VkCommandPoolCreateInfo pool_info = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, NULL, 0, 0};
    VkCommandBufferAllocateInfo allocation = {0};
    VkCommandBufferBeginInfo begin = {0};
    VkMemoryBarrier to_host = {VK_STRUCTURE_TYPE_MEMORY_BARRIER, NULL, VK_ACCESS_MEMORY_WRITE_BIT,
                               VK_ACCESS_HOST_READ_BIT};
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkSubmitInfo info = {0};
    uint32_t k;
    pool_info.queueFamilyIndex = queue_family;
    CHECK(vkCreateCommandPool(device, &pool_info, NULL, &pool));
    allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocation.commandPool = pool;
    allocation.commandBufferCount = 1;
    CHECK(vkAllocateCommandBuffers(device, &allocation, &commands));
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    CHECK(vkBeginCommandBuffer(commands, &begin));
    for (k = 0; k < DRAWINGS; ++k) {
        if (kDrawings[k].later == later) {
            record(commands, &kDrawings[k], drawn[k]);
        }
    }
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                         0, 1, &to_host, 0, NULL, 0, NULL);
    CHECK(vkEndCommandBuffer(commands));
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands;
    CHECK(vkQueueSubmit(queue, 1, &info, VK_NULL_HANDLE));
    CHECK(vkQueueWaitIdle(queue));
}
