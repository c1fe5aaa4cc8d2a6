// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "cases/fault/fault.hpp"
#include "dynamic_state.hpp"
#include "pipeline_copy.hpp"
#include "pipeline_facts.hpp"
#include "shader_words.hpp"

namespace breaking {

// Writes a value; whether that altered anything.
template <typename T>
bool change(T& variable, const std::type_identity_t<T>& value) {
    const bool differs =
        !std::equal_to<T>()(variable, value);  // floats, too: any other value counts
    variable = value;
    return differs;
}

// One call of vkCmdDraw or vkCmdDrawIndexed.
struct DrawCall {
    bool indexed = false;
    uint32_t count = 0;         // vertices or indices
    uint32_t first = 0;         // vertex or index
    int32_t vertex_offset = 0;  // indexed only
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    uint32_t number = 0;        // in its rendering, from 0
    uint64_t rendering = 0;     // in this process, from 1
    bool in_secondary = false;  // in a secondary command buffer
    bool may_repeat = false;    // Recording
    uint32_t times = 1;         // how often the driver is asked
    uint32_t instances = 1, first_instance = 0;
    bool is_reversed = false;  // set by a fault: later instances are drawn first, one by one
    VkIndexType index_type = VK_INDEX_TYPE_UINT32;  // indexed only
    bool has_restart = false;                       // primitive restart is on
    uint32_t subpass = 0;                           // of a render pass object
    VkShaderStageFlags stages = 0;                  // of the pipeline
    PipelineFacts pipeline;
    bool has_offsets = false;  // dynamic ones, of the descriptors that were bound last
    // What a fault writes here holds for this draw; what is not dynamic in the pipeline is not
    // altered.
    DynamicState state;
    bool is_imported = false;  // the first vertex buffer's memory is the host's
    // Set by a fault: restart is on or off for this draw whatever was asked.
    std::optional<bool> restart;
    // The first index of an indexed draw, if the buffer is mapped.
    std::optional<uint32_t> first_value;
};

// One command with draws in a buffer. The buffer is read as the fault says, and what is found there
// is drawn directly.
struct IndirectCall {
    bool indexed = false;
    VkDeviceSize offset = 0;
    uint32_t count = 0;  // of draws; with a count in a buffer: the most
    uint32_t stride = 0;
    std::optional<VkDeviceSize> count_offset;  // of the count in its buffer
};
struct IndirectDraw {
    bool indexed = false;
    uint32_t count = 0, instances = 0, first = 0, first_instance = 0;
    int32_t vertex_offset = 0;
};

// Several draws of one command, from memory of the application.
struct MultiDraw {
    bool indexed = false;
    std::vector<IndirectDraw> draws;
};

// Buffers bound by vkCmdBindVertexBuffers or vkCmdBindVertexBuffers2.
struct VertexBuffers {
    uint32_t first = 0;
    std::vector<VkBuffer> buffers;
    std::vector<VkDeviceSize> offsets;
    std::vector<VkDeviceSize> strides;       // empty: those of the pipeline
    VkBuffer first_buffer = VK_NULL_HANDLE;  // what is bound at 0
    VkDeviceSize first_stride = 0;           // with strides: what was given for 0
};
struct IndexBuffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkIndexType type = VK_INDEX_TYPE_UINT32;
    VkBuffer first_buffer = VK_NULL_HANDLE;  // the vertex buffer that is bound at 0
};

// Buffers that lie directly before and after an attachment's image in its memory.
struct Neighbours {
    struct Place {
        VkBuffer buffer = VK_NULL_HANDLE;
        VkDeviceSize size = 0;
    };
    Place before, after;
    uint64_t rendering = 0;                                    // in this process, from 1
    std::optional<std::pair<VkBuffer, VkDeviceSize>> written;  // one word, from that byte on
};

// What an image was made as, and whether its memory is its alone.
struct ImageFacts {
    VkExtent3D extent{};
    uint32_t levels = 1;
    VkImageUsageFlags usage = 0;
    bool is_dedicated = false;
    VkImageTiling tiling = VK_IMAGE_TILING_OPTIMAL;
    bool is_aliased = false;  // another image is bound to the same place
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};
struct ImageCopy {
    VkBufferImageCopy region;
    ImageFacts image;
};

// One call of vkCmdBeginRendering.
struct Rendering {
    VkRenderingInfo info;
    std::vector<VkRenderingAttachmentInfo> colors;
    std::vector<ImageFacts> images, resolved;  // of the colours, and what they are resolved into
    std::optional<VkRenderingAttachmentInfo> depth, stencil;
};

// Resolves no colour into an image for which this holds; whether any was to be.
inline bool resolve_nothing(Rendering& r, bool (*holds)(const ImageFacts&)) {
    bool altered = false;
    for (size_t k = 0; k < r.colors.size(); ++k) {
        altered = (holds(r.resolved[k]) && change(r.colors[k].resolveMode, VK_RESOLVE_MODE_NONE)) ||
                  altered;
    }
    return altered;
}

struct DepthBias {
    float constant, clamp, slope;
};

struct DepthBounds {
    float min, max;
};

// One call of vkCmdSetStencilOp, or of one of the commands that set a mask or the reference.
struct StencilOps {
    VkStencilFaceFlags faces;
    VkStencilOp fail, pass, depth_fail;
    VkCompareOp compare;
    bool is_dropped = false;
};
struct StencilValue {
    VkStencilFaceFlags faces;
    uint32_t value;
    bool in_secondary = false;  // in a secondary command buffer
    bool is_dropped = false;
};

// One call that sets a dynamic state.
struct StateCall {
    std::string_view state;     // "viewport", "cull mode", ... (state_commands.cpp)
    bool is_set_again = false;  // since the last pipeline was bound
    // A pipeline without dynamic state was bound before, in the same rendering.
    bool follows_static = false;
};

// What binding a pipeline with dynamic state sets, though nobody asked for it.
struct Reset {
    std::optional<VkPrimitiveTopology> topology;
    std::optional<VkCullModeFlags> cull_mode;
    std::optional<VkRect2D> scissor;  // the first
};

// One call of vkCmdClearAttachments.
struct Clears {
    std::vector<VkClearAttachment> attachments;
    std::vector<VkClearRect> rects;
};

// What is read of a query.
struct QueryResult {
    uint64_t count = 0;
    VkQueryPipelineStatisticFlags statistics = 0;  // that its pool counts; 0: of occlusion
    bool is_precise = false;
    bool in_secondary = false;     // it was begun in a secondary command buffer
    bool before_pipeline = false;  // and before any pipeline was bound there
    uint64_t before = 0;  // what the queries counted that were read before it, since a reset
};

// What becomes of a call that answers with a VkResult.
enum class Answer { as_asked, device_lost, unknown_error, no_memory, hang, crash };

// What a fault does to the calls of an application. Each is handed what was asked, may write to it,
// and says whether it altered anything; what is not set lets the calls through.
struct Hooks {
    bool (*viewports)(std::span<VkViewport>) = nullptr;
    bool (*scissors)(std::span<VkRect2D>) = nullptr;
    bool (*draw)(DrawCall&) = nullptr;
    // The draws of a rendering are held back until its end; the numbers of those to draw, in order.
    bool (*order)(std::vector<uint32_t>&) = nullptr;
    bool (*cull_mode)(VkCullModeFlags&) = nullptr;
    bool (*front_face)(VkFrontFace&) = nullptr;
    bool (*topology)(VkPrimitiveTopology&) = nullptr;
    bool (*primitive_restart)(VkBool32&) = nullptr;
    bool (*rasterizer_discard)(VkBool32&) = nullptr;
    bool (*index_type)(VkIndexType&) = nullptr;
    bool (*vertex_buffers)(VertexBuffers&) = nullptr;
    bool (*index_buffer)(IndexBuffer&) = nullptr;
    bool (*indirect)(IndirectCall&) = nullptr;
    bool (*indirect_draw)(IndirectDraw&) = nullptr;
    bool (*multi_draw)(MultiDraw&) = nullptr;
    bool (*mesh_groups)(uint32_t&) = nullptr;  // of vkCmdDrawMeshTasksEXT, along x
    // The views of the input attachments of one call of vkUpdateDescriptorSets, in its order.
    bool (*input_views)(std::span<VkImageView>) = nullptr;
    // A buffer for a shader, by one call of vkUpdateDescriptorSets.
    bool (*buffer_read)(VkDescriptorBufferInfo&, VkDescriptorType) = nullptr;
    bool (*dynamic_offsets)(std::span<uint32_t>) = nullptr;
    bool (*depth_compare)(VkCompareOp&) = nullptr;
    bool (*depth_write)(VkBool32&) = nullptr;
    bool (*depth_bounds_enable)(VkBool32&) = nullptr;
    bool (*depth_bounds)(DepthBounds&) = nullptr;
    bool (*depth_bias_enable)(VkBool32&) = nullptr;
    bool (*depth_bias)(DepthBias&) = nullptr;
    bool (*blend_constants)(std::span<float, 4>) = nullptr;
    // Of attachments, where they are dynamic.
    bool (*blend_enables)(std::span<VkBool32>) = nullptr;
    bool (*write_masks)(std::span<VkColorComponentFlags>) = nullptr;
    bool (*sample_mask)(VkSampleMask&) = nullptr;
    bool (*alpha_to_coverage)(VkBool32&) = nullptr;
    bool (*depth_clamp)(VkBool32&) = nullptr;
    bool (*provoking_mode)(VkProvokingVertexModeEXT&) = nullptr;
    bool (*stencil_ops)(StencilOps&) = nullptr;
    bool (*stencil_compare_mask)(StencilValue&) = nullptr;
    bool (*stencil_write_mask)(StencilValue&) = nullptr;
    bool (*stencil_reference)(StencilValue&) = nullptr;
    bool (*drop_state)(StateCall&) = nullptr;  // whether the call is not done
    bool (*bind)(Reset&) = nullptr;            // of a pipeline with dynamic state
    bool (*secondaries)(std::vector<VkCommandBuffer>&) = nullptr;  // of vkCmdExecuteCommands
    // Whether a secondary command buffer is not executed that has been executed before.
    bool (*drop_again)() = nullptr;
    bool (*drop_feedback)() = nullptr;  // whether transform feedback is not begun
    bool (*clear_attachments)(Clears&) = nullptr;
    bool (*pipeline)(PipelineCopy&) = nullptr;
    bool (*shader)(ShaderWords&) = nullptr;
    bool (*sample_locations)(std::span<VkSampleLocationEXT>) = nullptr;  // of barriers
    bool (*rendering)(Rendering&) = nullptr;
    bool (*clear_color)(VkClearColorValue&) = nullptr;  // of vkCmdClearColorImage
    bool (*drop_clear_color)() = nullptr;               // the same, not done
    bool (*image_to_buffer)(VkBufferImageCopy&) = nullptr;
    bool (*image_copy)(ImageCopy&) = nullptr;  // the same, of which the image is known
    bool (*view)(VkImageViewCreateInfo&) = nullptr;
    bool (*pass_clears)(std::vector<VkClearValue>&) = nullptr;  // of vkCmdBeginRenderPass
    // Whether commands are not executed that were submitted without a fence, or with one.
    bool (*drop_submission)(bool has_fence) = nullptr;
    bool (*drop_repeated)() = nullptr;  // whether a command buffer is not executed once more
    bool (*buffer_to_image)(VkBufferImageCopy&) = nullptr;
    bool (*upload)(ImageCopy&) = nullptr;  // the same, of which the image is known
    bool (*blit)(VkImageBlit&, VkFilter&) = nullptr;
    bool (*dispatch)(uint32_t& groups_x) = nullptr;
    // At the end of a rendering, for each of its attachments: which of the buffers that share its
    // memory gets a word of the driver's own, at which byte; sizes are known.
    bool (*stray_write)(Neighbours&) = nullptr;
    bool (*query_result)(QueryResult&) = nullptr;
    Answer (*submit)(uint64_t number) = nullptr;  // in this process, from 1
    Answer (*wait)(uint64_t number) = nullptr;
    Answer (*make_pipeline)(uint64_t number) = nullptr;
    Answer (*allocate)(uint64_t number) = nullptr;    // vkAllocateMemory
    Answer (*make_image)(uint64_t number) = nullptr;  // vkCreateImage
    Answer (*map)(uint64_t number) = nullptr;         // vkMapMemory
};

// What the driver does wrong: a row of the catalogue, of which the layer has the calls, or, of what
// no picture without these calls could show, a sentence of its own.
struct Saying {
    constexpr Saying(const char* own) : sentence(own) {}
    constexpr Saying(cases::Fault of) : row(of), sentence(cases::row_of(of).sentence) {}
    cases::Fault row = cases::kNoFault;
    std::string_view sentence;
};
using cases::operator""_fault;

struct Fault {
    std::string_view name;
    Saying says;
    Hooks hooks;
    bool needs_lines = false;  // enables VkPhysicalDeviceFeatures::fillModeNonSolid
};

// The tables, by what the faults touch.
std::span<const Fault> draw_faults();
std::span<const Fault> viewport_faults();
std::span<const Fault> assembly_faults();
std::span<const Fault> depth_faults();
std::span<const Fault> color_faults();
std::span<const Fault> target_faults();
std::span<const Fault> clear_faults();
std::span<const Fault> multisample_faults();
std::span<const Fault> shader_faults();
std::span<const Fault> transfer_faults();
std::span<const Fault> device_faults();
std::span<const Fault> query_faults();
std::span<const Fault> door_faults();
std::span<const Fault> recording_door_faults();
std::span<const Fault> target_door_faults();
std::span<const Fault> bare_faults();
std::vector<const Fault*> all_faults();

// The N of EDGECASE_BREAK=NAME:N; 1 if none is given.
uint64_t parameter();

}  // namespace breaking
