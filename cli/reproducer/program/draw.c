// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The third part of every reproducer: pipelines, the draws, and copies of what they left.
static VkPipeline make_pipeline(const struct Draw* d, VkPipelineLayout layout) {
    VkFormat formats[COLORS];
    const VkDynamicState dynamics[2] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineShaderStageCreateInfo stages[2];
    VkVertexInputBindingDescription bindings[INPUTS];
    VkVertexInputAttributeDescription inputs[INPUTS];
    VkPipelineVertexInputStateCreateInfo vertex = {0};
    VkPipelineInputAssemblyStateCreateInfo assembly = {0};
    VkPipelineViewportStateCreateInfo viewport = {0};
    VkPipelineRasterizationStateCreateInfo raster = {0};
    VkPipelineMultisampleStateCreateInfo multisample = {0};
    VkPipelineDepthStencilStateCreateInfo depth = {0};
    VkPipelineColorBlendAttachmentState blends[COLORS];
    VkPipelineColorBlendStateCreateInfo blend = {0};
    VkPipelineDynamicStateCreateInfo dynamic = {0};
    VkPipelineRenderingCreateInfo rendering = {0};
    VkGraphicsPipelineCreateInfo info = {0};
    VkPipeline pipeline;
    uint32_t k, n = 0;
    stages[0] = stage(VK_SHADER_STAGE_VERTEX_BIT, make_module(&d->vertex_code));
    stages[1] = stage(VK_SHADER_STAGE_FRAGMENT_BIT, make_module(&d->fragment_code));
    for (k = 0; k < INPUTS; ++k) {
        if (d->inputs[k] != NULL) {
            VkVertexInputBindingDescription binding = {0, 16, VK_VERTEX_INPUT_RATE_VERTEX};
            VkVertexInputAttributeDescription input = {0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0};
            binding.binding = input.binding = input.location = k;
            bindings[n] = binding;
            inputs[n++] = input;
        }
    }
    vertex.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    vertex.vertexBindingDescriptionCount = n;
    vertex.pVertexBindingDescriptions = bindings;
    vertex.vertexAttributeDescriptionCount = n;
    vertex.pVertexAttributeDescriptions = inputs;
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = d->topology;
    assembly.primitiveRestartEnable = d->restart;
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = viewport.scissorCount = 1;
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.depthClampEnable = d->depth_clamp;
    raster.rasterizerDiscardEnable = d->discard;
    raster.cullMode = d->cull;
    raster.frontFace = d->front;
    raster.depthBiasEnable = d->has_bias;
    raster.depthBiasConstantFactor = d->bias[0];
    raster.depthBiasClamp = d->bias[1];
    raster.depthBiasSlopeFactor = d->bias[2];
    raster.lineWidth = 1;
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = (VkSampleCountFlagBits)SAMPLES;
    multisample.pSampleMask = &d->sample_mask;
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = HAS_DEPTH;
    depth.depthWriteEnable = HAS_DEPTH && d->depth_write;
    depth.depthCompareOp = d->compare;
    memset(blends, 0, sizeof blends);
    for (k = 0; k < COLORS; ++k) {
        formats[k] = color_format(k);
        blends[k].colorWriteMask = k < FIRST_ATTRIBUTE + d->attributes ? 0xf : 0;
    }
    blends[HITS].blendEnable = VK_TRUE;
    blends[HITS].srcColorBlendFactor = blends[HITS].dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
    blends[HITS].srcAlphaBlendFactor = blends[HITS].dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = COLORS;
    blend.pAttachments = blends;
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamics;
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = COLORS;
    rendering.pColorAttachmentFormats = formats;
    rendering.depthAttachmentFormat = HAS_DEPTH ? DEPTH_FORMAT : VK_FORMAT_UNDEFINED;
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &rendering;
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &vertex;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout;
    CHECK(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline));
    return pipeline;
}

static VkBuffer make_filled(const void* data, size_t size, VkBufferUsageFlags usage) {
    void* mapped;
    VkBuffer buffer = make_buffer(size, usage, &mapped);
    memcpy(mapped, data, size);
    return buffer;
}

static void record_draw(VkCommandBuffer commands, uint32_t number, VkPipelineLayout layout) {
    const struct Draw* d = &kDraws[number];
    const size_t array = 16 * (size_t)d->vertices;
    const VkDeviceSize zero = 0;
    uint32_t constants[21] = {0};
    uint32_t k;
    if (d->count == 0) {
        return;
    }
    constants[0] = number | (uint32_t)DRAWS << 16;
    constants[20] = d->shader_mask;  // DrawConstants of the shaders: 84 bytes
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, make_pipeline(d, layout));
    vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
                       0, sizeof constants, constants);
    vkCmdSetViewport(commands, 0, 1, &d->viewport);
    vkCmdSetScissor(commands, 0, 1, &d->scissor);
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
        vkCmdDrawIndexed(commands, d->count, 1, 0, 0, 0);
    } else {
        vkCmdDraw(commands, d->count, 1, 0, 0);
    }
}

static VkImageAspectFlags aspect_of(uint32_t plane) {
    return plane < COLORS ? VK_IMAGE_ASPECT_COLOR_BIT : VK_IMAGE_ASPECT_DEPTH_BIT;
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
    b.subresourceRange.levelCount = 1;
    b.subresourceRange.layerCount = 1;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1, &b);
}

/* Each sample by a shader: a resolve would combine them. */
static void copy_samples(VkCommandBuffer commands, uint32_t plane, VkImage image, VkBuffer buffer) {
    const struct Code* code = &kCopyCodes[words_of(plane) / 2];
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
                                     plane == COLORS        ? DEPTH_FORMAT
                                     : words_of(plane) == 2 ? VK_FORMAT_R32G32_UINT
                                                            : VK_FORMAT_R32G32B32A32_UINT,
                                     aspect_of(plane), VK_IMAGE_USAGE_SAMPLED_BIT);
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
    vkCmdDispatch(commands, (WIDTH + 7) / 8, (HEIGHT + 7) / 8, 1);
}

// Copies a plane to a buffer, sample after sample of a pixel; where the CPU will see it.
static const void* copy_plane(VkCommandBuffer commands, uint32_t plane, VkImage image) {
    const size_t bytes = (size_t)WIDTH * HEIGHT * SAMPLES * words_of(plane) * sizeof(float);
    VkBufferImageCopy region = {0};
    void* mapped;
    const VkBuffer buffer = make_buffer(
        bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, &mapped);
    memset(mapped, 0xa5, bytes);
    barrier(commands, image, aspect_of(plane),
            plane < COLORS ? VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL
                           : VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
            SAMPLES > 1 ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
                        : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    if (SAMPLES > 1) {
        copy_samples(commands, plane, image, buffer);
        return mapped;
    }
    region.imageSubresource.aspectMask = aspect_of(plane);
    region.imageSubresource.layerCount = 1;
    region.imageExtent.width = WIDTH;
    region.imageExtent.height = HEIGHT;
    region.imageExtent.depth = 1;
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1,
                           &region);
    return mapped;
}

static VkImage make_attachment(VkCommandBuffer commands, uint32_t plane,
                               VkRenderingAttachmentInfo* info) {
    const int is_color = plane < COLORS;
    const VkFormat format = is_color ? color_format(plane) : DEPTH_FORMAT;
    const VkImageLayout layout = is_color ? VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL
                                          : VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    const VkImage image =
        make_image(format, is_color ? COLOR_USAGE : DEPTH_USAGE, is_color ? COLOR_FLAGS : 0);
    uint32_t k;
    barrier(commands, image, aspect_of(plane), VK_IMAGE_LAYOUT_UNDEFINED, layout);
    info->sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    info->imageView = make_view(image, format, aspect_of(plane),
                                is_color ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT
                                         : VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    info->imageLayout = layout;
    info->loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    info->storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    if (is_color) {
        for (k = 0; k < 4; ++k) {
            info->clearValue.color.float32[k] = plane == HITS ? NO_HITS : -1.0F;
        }
    } else {
        info->clearValue.depthStencil.depth = DEPTH_CLEAR;
    }
    return image;
}

// Draws everything; planes[k] is then what attachment k holds, the depth last.
static void draw(const void** planes) {
    VkCommandPoolCreateInfo pool_info = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, NULL, 0, 0};
    VkCommandBufferAllocateInfo allocation = {0};
    VkCommandBufferBeginInfo begin = {0};
    VkRenderingAttachmentInfo attachments[PLANES];
    VkRenderingInfo rendering = {0};
    VkPipelineLayout layout =
        make_layout(VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 84, NULL);
    VkMemoryBarrier to_host = {VK_STRUCTURE_TYPE_MEMORY_BARRIER, NULL, VK_ACCESS_MEMORY_WRITE_BIT,
                               VK_ACCESS_HOST_READ_BIT};
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkImage images[PLANES];
    VkSubmitInfo submit = {0};
    uint32_t k;
    pool_info.queueFamilyIndex = queue_family;
    CHECK(vkCreateCommandPool(device, &pool_info, NULL, &pool));
    allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocation.commandPool = pool;
    allocation.commandBufferCount = 1;
    CHECK(vkAllocateCommandBuffers(device, &allocation, &commands));
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    CHECK(vkBeginCommandBuffer(commands, &begin));
    memset(attachments, 0, sizeof attachments);
    for (k = 0; k < PLANES; ++k) {
        images[k] = make_attachment(commands, k, &attachments[k]);
    }
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent.width = WIDTH;
    rendering.renderArea.extent.height = HEIGHT;
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = COLORS;
    rendering.pColorAttachments = attachments;
    rendering.pDepthAttachment = HAS_DEPTH ? &attachments[PLANES - 1] : NULL;
    vkCmdBeginRendering(commands, &rendering);
    for (k = 0; k < DRAWS; ++k) {
        record_draw(commands, k, layout);
    }
    vkCmdEndRendering(commands);
    for (k = 0; k < PLANES; ++k) {
        planes[k] = copy_plane(commands, k, images[k]);
    }
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                         0, 1, &to_host, 0, NULL, 0, NULL);
    CHECK(vkEndCommandBuffer(commands));
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    CHECK(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE));
    CHECK(vkQueueWaitIdle(queue));
}
