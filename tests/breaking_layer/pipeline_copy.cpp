// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline_copy.hpp"

#include <cstdio>
#include <cstdlib>

namespace breaking {

namespace {

// Takes the structure of that type out of a chain whose other members are all known, too.
template <typename T>
void take(const VkBaseInStructure* chained, VkStructureType type, std::optional<T>& copy) {
    if (chained->sType == type) {
        copy = *reinterpret_cast<const T*>(chained);
    }
}

// A chained structure that faults do not know could not be told from a copied one when the chain is
// tied again: better to stop than to drop it.
void expect_one_of(const VkBaseInStructure* chained, std::initializer_list<VkStructureType> known) {
    for (const VkStructureType type : known) {
        if (chained->sType == type) {
            return;
        }
    }
    std::fprintf(stderr,
                 "breaking layer: error: structure type %d in a pipeline is not known to "
                 "pipeline_copy.cpp\n",
                 static_cast<int>(chained->sType));
    std::abort();
}

const VkBaseInStructure* first_of(const void* next) {
    return static_cast<const VkBaseInStructure*>(next);
}

template <typename T>
void chain(const void*& to, std::optional<T>& structure) {
    if (structure) {
        structure->pNext = to;
        to = &*structure;
    }
}

}  // namespace

PipelineCopy::PipelineCopy(const VkGraphicsPipelineCreateInfo& from)
    : facts(facts_of(from)), info_(from), stages_(from.pStages, from.pStages + from.stageCount) {
    for (const VkPipelineShaderStageCreateInfo& stage : stages_) {
        if (stage.stage == VK_SHADER_STAGE_FRAGMENT_BIT && stage.pSpecializationInfo != nullptr) {
            specialized_ = *stage.pSpecializationInfo;
            const auto* words = static_cast<const uint32_t*>(specialized_.pData);
            constants.assign(words, words + specialized_.dataSize / sizeof(uint32_t));
        }
    }
    // A library has the state of its part.
    if (from.pVertexInputState != nullptr) {
        vertex_input = *from.pVertexInputState;
        inputs.assign(vertex_input.pVertexAttributeDescriptions,
                      vertex_input.pVertexAttributeDescriptions +
                          vertex_input.vertexAttributeDescriptionCount);
        bindings.assign(
            vertex_input.pVertexBindingDescriptions,
            vertex_input.pVertexBindingDescriptions + vertex_input.vertexBindingDescriptionCount);
    }

    for (const auto* s = first_of(vertex_input.pNext); s != nullptr; s = s->pNext) {
        expect_one_of(s, {VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_DIVISOR_STATE_CREATE_INFO_EXT});
        take(s, VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_DIVISOR_STATE_CREATE_INFO_EXT, divided);
    }
    if (divided) {
        divisors.assign(divided->pVertexBindingDivisors,
                        divided->pVertexBindingDivisors + divided->vertexBindingDivisorCount);
    }

    for (const auto* s = first_of(from.pNext); s != nullptr; s = s->pNext) {
        lacks_stencil =
            lacks_stencil ||
            (s->sType == VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO &&
             reinterpret_cast<const VkPipelineRenderingCreateInfo*>(s)->stencilAttachmentFormat ==
                 VK_FORMAT_UNDEFINED);
    }
    if (from.pRasterizationState != nullptr) {
        rasterization = *from.pRasterizationState;
    }
    for (const auto* s = first_of(rasterization.pNext); s != nullptr; s = s->pNext) {
        expect_one_of(
            s, {VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_DEPTH_CLIP_STATE_CREATE_INFO_EXT,
                VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_PROVOKING_VERTEX_STATE_CREATE_INFO_EXT});
        take(s, VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_DEPTH_CLIP_STATE_CREATE_INFO_EXT,
             depth_clip);
        take(s, VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_PROVOKING_VERTEX_STATE_CREATE_INFO_EXT,
             provoking);
    }

    if (from.pViewportState != nullptr) {
        viewport_ = *from.pViewportState;
    }
    for (const auto* s = first_of(viewport_.pNext); s != nullptr; s = s->pNext) {
        expect_one_of(s, {VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_DEPTH_CLIP_CONTROL_CREATE_INFO_EXT});
        take(s, VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_DEPTH_CLIP_CONTROL_CREATE_INFO_EXT,
             clip_control);
    }

    if (from.pMultisampleState != nullptr) {
        multisample = *from.pMultisampleState;
    }
    if (multisample.pSampleMask != nullptr) {
        mask = multisample.pSampleMask[0];
    }
    for (const auto* s = first_of(multisample.pNext); s != nullptr; s = s->pNext) {
        expect_one_of(s, {VK_STRUCTURE_TYPE_PIPELINE_SAMPLE_LOCATIONS_STATE_CREATE_INFO_EXT});
        take(s, VK_STRUCTURE_TYPE_PIPELINE_SAMPLE_LOCATIONS_STATE_CREATE_INFO_EXT, locations);
    }
    if (locations) {
        const VkSampleLocationsInfoEXT& l = locations->sampleLocationsInfo;
        places.assign(l.pSampleLocations, l.pSampleLocations + l.sampleLocationsCount);
    }

    if (from.pDepthStencilState != nullptr) {
        depth = *from.pDepthStencilState;
    }
    if (from.pColorBlendState != nullptr) {
        blend = *from.pColorBlendState;
        blends.assign(blend.pAttachments, blend.pAttachments + blend.attachmentCount);
    }
}

const VkGraphicsPipelineCreateInfo& PipelineCopy::info() {
    specialized_.pData = constants.data();
    for (VkPipelineShaderStageCreateInfo& stage : stages_) {
        if (stage.stage == VK_SHADER_STAGE_FRAGMENT_BIT && stage.pSpecializationInfo != nullptr) {
            stage.pSpecializationInfo = &specialized_;
        }
    }
    info_.pStages = stages_.data();

    vertex_input.pVertexAttributeDescriptions = inputs.data();
    vertex_input.vertexAttributeDescriptionCount = static_cast<uint32_t>(inputs.size());
    vertex_input.pVertexBindingDescriptions = bindings.data();
    vertex_input.vertexBindingDescriptionCount = static_cast<uint32_t>(bindings.size());
    vertex_input.pNext = nullptr;
    if (divided) {
        divided->pVertexBindingDivisors = divisors.data();
    }
    chain(vertex_input.pNext, divided);
    info_.pVertexInputState = info_.pVertexInputState != nullptr ? &vertex_input : nullptr;

    rasterization.pNext = nullptr;
    chain(rasterization.pNext, depth_clip);
    chain(rasterization.pNext, provoking);
    info_.pRasterizationState = info_.pRasterizationState != nullptr ? &rasterization : nullptr;

    viewport_.pNext = nullptr;
    chain(viewport_.pNext, clip_control);
    info_.pViewportState = info_.pViewportState != nullptr ? &viewport_ : nullptr;

    multisample.pNext = nullptr;
    if (multisample.pSampleMask != nullptr) {
        multisample.pSampleMask = &mask;
    }
    if (locations) {
        locations->sampleLocationsInfo.pSampleLocations = places.data();
    }
    chain(multisample.pNext, locations);
    info_.pMultisampleState = info_.pMultisampleState != nullptr ? &multisample : nullptr;

    info_.pDepthStencilState = info_.pDepthStencilState != nullptr ? &depth : nullptr;
    blend.pAttachments = blends.data();
    info_.pColorBlendState = info_.pColorBlendState != nullptr ? &blend : nullptr;
    return info_;
}

}  // namespace breaking
