// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The fourth part of every reproducer: the pipeline of a draw, and the texture of its levels.

/* Whether a drawing leaves an attachment as it was cleared. */
static VkBool32 is_masked(const struct Drawing* d, uint32_t plane) {
    const uint32_t bit = plane == HITS     ? 0
                         : plane == WRITER ? 1
                         : plane < 4       ? 2
                                           : plane - FIRST_ATTRIBUTE + 3;
    switch (role_of(d, plane)) {
        case TARGET:
            return VK_FALSE;
        case DEPTH:
            return d->masks_depth;
        default:
            return d->masked >> bit & 1;
    }
}

static VkPipeline make_pipeline(const struct Drawing* drawing, const struct Draw* d,
                                VkPipelineLayout layout) {
    const uint32_t colors = depth_plane(drawing);
    VkFormat formats[MOST_PLANES];
    const VkDynamicState dynamics[2] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineShaderStageCreateInfo stages[2];
    VkVertexInputBindingDescription bindings[INPUTS];
    VkVertexInputAttributeDescription inputs[INPUTS];
    VkPipelineVertexInputStateCreateInfo vertex = {0};
    VkPipelineInputAssemblyStateCreateInfo assembly = {0};
    VkPipelineViewportStateCreateInfo viewport = {0};
    VkPipelineViewportDepthClipControlCreateInfoEXT control = {0};
    VkPipelineRasterizationStateCreateInfo raster = {0};
    VkPipelineRasterizationDepthClipStateCreateInfoEXT clip = {0};
    VkPipelineRasterizationProvokingVertexStateCreateInfoEXT provoking = {0};
    VkPipelineMultisampleStateCreateInfo multisample = {0};
    VkPipelineDepthStencilStateCreateInfo depth = {0};
    VkPipelineColorBlendAttachmentState blends[MOST_PLANES];
    VkPipelineColorBlendStateCreateInfo blend = {0};
    VkPipelineDynamicStateCreateInfo dynamic = {0};
    VkPipelineRenderingCreateInfo rendering = {0};
    VkSpecializationMapEntry entries[5];
    VkSpecializationInfo specialization = {0};
    VkGraphicsPipelineCreateInfo info = {0};
    VkPipeline pipeline;
    uint32_t k, n = 0;
    stages[0] = stage(VK_SHADER_STAGE_VERTEX_BIT, make_module(&d->vertex_code));
    stages[1] = stage(VK_SHADER_STAGE_FRAGMENT_BIT, make_module(&d->fragment_code));
    for (k = 0; k < 5; ++k) {
        entries[k].constantID = k;
        entries[k].offset = 4 * k;
        entries[k].size = 4;
    }
    specialization.mapEntryCount = 5;
    specialization.pMapEntries = entries;
    specialization.dataSize = sizeof d->choices;
    specialization.pData = d->choices;
    stages[1].pSpecializationInfo = &specialization;
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
    if (d->is_symmetric) {
        control.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_DEPTH_CLIP_CONTROL_CREATE_INFO_EXT;
        control.negativeOneToOne = VK_TRUE;
        viewport.pNext = &control;
    }
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
    if (d->depth_clip != 0) {
        clip.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_DEPTH_CLIP_STATE_CREATE_INFO_EXT;
        clip.depthClipEnable = d->depth_clip == 2;
        raster.pNext = &clip;
    }
    if (d->last_provokes) {
        provoking.sType =
            VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_PROVOKING_VERTEX_STATE_CREATE_INFO_EXT;
        provoking.provokingVertexMode = VK_PROVOKING_VERTEX_MODE_LAST_VERTEX_EXT;
        provoking.pNext = raster.pNext;
        raster.pNext = &provoking;
    }
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = (VkSampleCountFlagBits)SAMPLES;
    multisample.pSampleMask = &d->sample_mask;
    multisample.sampleShadingEnable = d->shades_samples;
    multisample.minSampleShading = d->least_shading;
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = HAS_DEPTH;
    depth.depthWriteEnable = HAS_DEPTH && d->depth_write && !drawing->masks_depth;
    depth.depthCompareOp = d->compare;
    memset(blends, 0, sizeof blends);
    for (k = 0; k < colors; ++k) {
        const enum Role role = role_of(drawing, k);
        formats[k] = format_of(role);
        blends[k].colorWriteMask = is_masked(drawing, k) ? 0 : 0xf;
        if (role == TARGET) {
            blends[k] = d->mix;
        } else if (role == INSTRUMENT && k == HITS) {
            blends[k].blendEnable = VK_TRUE;
            blends[k].srcColorBlendFactor = blends[k].dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
            blends[k].srcAlphaBlendFactor = blends[k].dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
        }
    }
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = colors;
    blend.pAttachments = blends;
    memcpy(blend.blendConstants, d->mix_constants, sizeof d->mix_constants);
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamics;
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = colors;
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

/* The set of a texture of this size, whose texels are never read, only its levels counted. */
static VkDescriptorSet make_texture(VkCommandBuffer commands, const uint32_t size[2],
                                    VkDescriptorSetLayout layout) {
    const VkDescriptorPoolSize sizes = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
    VkDescriptorPoolCreateInfo pool_info = {
        VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, NULL, 0, 1, 1, &sizes};
    VkDescriptorSetAllocateInfo allocation = {0};
    VkSamplerCreateInfo sampler = {0};
    VkDescriptorImageInfo image = {0};
    VkWriteDescriptorSet write = {0};
    VkDescriptorPool pool;
    VkDescriptorSet set;
    VkImage texture;
    uint32_t levels = 1;
    while ((size[0] | size[1]) >> levels != 0) {
        ++levels;
    }
    texture = make_image(VK_FORMAT_R8_UNORM, size[0], size[1], levels, 1, 1,
                         VK_IMAGE_USAGE_SAMPLED_BIT, 0);
    barrier(commands, texture, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    sampler.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;
    sampler.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    sampler.maxLod = VK_LOD_CLAMP_NONE;
    CHECK(vkCreateSampler(device, &sampler, NULL, &image.sampler));
    CHECK(vkCreateDescriptorPool(device, &pool_info, NULL, &pool));
    allocation.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocation.descriptorPool = pool;
    allocation.descriptorSetCount = 1;
    allocation.pSetLayouts = &layout;
    CHECK(vkAllocateDescriptorSets(device, &allocation, &set));
    image.imageView = make_view(texture, VK_FORMAT_R8_UNORM, VK_IMAGE_ASPECT_COLOR_BIT,
                                VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_VIEW_TYPE_2D);
    image.imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &image;
    vkUpdateDescriptorSets(device, 1, &write, 0, NULL);
    return set;
}
