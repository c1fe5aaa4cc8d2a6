// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Vertices that go astray on one way to the pipeline and arrive on all others: only a picture
// through that door shows it.
#include <algorithm>
#include <array>
#include <limits>

#include "fault.hpp"

namespace breaking {

namespace {

template <VkIndexType from, VkIndexType to>
bool take_for(VkIndexType& type) {
    return type == from && change(type, to);
}

template <VkIndexType type, bool restart>
bool force_restart(DrawCall& d) {
    if (!d.indexed || d.index_type != type || d.topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST ||
        d.has_restart == restart) {
        return false;
    }
    d.restart = restart;
    return true;
}

// An offset that loses what is less than `size`.
template <VkDeviceSize size>
bool round_offsets(VertexBuffers& b) {
    bool altered = false;
    for (VkDeviceSize& offset : b.offsets) {
        altered = change(offset, offset / size * size) || altered;
    }
    return altered;
}

bool is_together(const PipelineCopy& p) {
    return std::any_of(p.inputs.begin(), p.inputs.end(),
                       [](const auto& input) { return input.offset != 0; });
}

template <uint32_t most>
bool limit_strides(PipelineCopy& p) {
    bool altered = false;
    for (VkVertexInputBindingDescription& binding : p.bindings) {
        altered = change(binding.stride, std::min(binding.stride, most)) || altered;
    }
    return altered;
}

bool forget_padding(PipelineCopy& p) {
    return !is_together(p) && limit_strides<16>(p);
}

bool forget_input_offsets(PipelineCopy& p) {
    bool altered = false;
    for (VkVertexInputAttributeDescription& input : p.inputs) {
        altered = change(input.offset, 0) || altered;
    }
    return altered;
}

bool read_four_of_three(PipelineCopy& p) {
    bool altered = false;
    for (VkVertexInputAttributeDescription& input : p.inputs) {
        if (input.format == VK_FORMAT_R32G32B32_SFLOAT) {
            input.format = VK_FORMAT_R32G32B32A32_SFLOAT;
            altered = true;
        }
    }
    return altered;
}

bool read_at_vertices(PipelineCopy& p) {
    bool altered = false;
    for (VkVertexInputBindingDescription& binding : p.bindings) {
        altered = change(binding.inputRate, VK_VERTEX_INPUT_RATE_VERTEX) || altered;
    }
    return altered;
}

template <uint32_t from_least, uint32_t from_most>
bool count_divisors_as_one(PipelineCopy& p) {
    bool altered = false;
    for (VkVertexInputBindingDivisorDescriptionEXT& divisor : p.divisors) {
        altered = (divisor.divisor >= from_least && divisor.divisor <= from_most &&
                   change(divisor.divisor, 1)) ||
                  altered;
    }
    return altered;
}

bool take_formats(PipelineCopy& p, std::span<const std::pair<VkFormat, VkFormat>> pairs) {
    bool altered = false;
    for (VkVertexInputAttributeDescription& input : p.inputs) {
        const auto found =
            std::ranges::find(pairs, input.format, &std::pair<VkFormat, VkFormat>::first);
        altered = (found != pairs.end() && change(input.format, found->second)) || altered;
    }
    return altered;
}

constexpr std::array<std::pair<VkFormat, VkFormat>, 5> kOtherSigns = {{
    {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_SNORM},
    {VK_FORMAT_R16G16B16A16_UNORM, VK_FORMAT_R16G16B16A16_SNORM},
    {VK_FORMAT_R16G16_UNORM, VK_FORMAT_R16G16_SNORM},
    {VK_FORMAT_R8G8B8A8_SNORM, VK_FORMAT_R8G8B8A8_UNORM},
    {VK_FORMAT_R16G16B16A16_SNORM, VK_FORMAT_R16G16B16A16_UNORM},
}};

bool take_strides_as_tight(VertexBuffers& b) {
    bool altered = false;
    for (VkDeviceSize& stride : b.strides) {
        altered = change(stride, 16) || altered;
    }
    return altered;
}

bool take_first_stride(VertexBuffers& b) {
    bool altered = false;
    for (VkDeviceSize& stride : b.strides) {
        altered = change(stride, b.first_stride) || altered;
    }
    return altered;
}

bool take_first_buffer(VertexBuffers& b) {
    bool altered = false;
    for (size_t k = 0; k < b.buffers.size(); ++k) {
        if (b.buffers[k] != b.first_buffer) {
            b.buffers[k] = b.first_buffer;
            b.offsets[k] = 0;
            altered = true;
        }
    }
    return altered;
}

bool keep_only(MultiDraw& multi, size_t number) {
    const bool altered = multi.draws.size() > 1;
    if (altered) {
        multi.draws = {multi.draws.at(number)};
    }
    return altered;
}

constexpr std::array kDoorFaults = {
    Fault{"door-index-8-as-16",
          "Indices of 8 bits are read as indices of 16 bits.",
          {.index_type = take_for<VK_INDEX_TYPE_UINT8_EXT, VK_INDEX_TYPE_UINT16>}},
    Fault{"door-index-16-as-32",
          "Indices of 16 bits are read as indices of 32 bits.",
          {.index_type = take_for<VK_INDEX_TYPE_UINT16, VK_INDEX_TYPE_UINT32>}},
    Fault{"door-index-16-as-8",
          "Indices of 16 bits are read as indices of 8 bits.",
          {.index_type = take_for<VK_INDEX_TYPE_UINT16, VK_INDEX_TYPE_UINT8_EXT>}},
    Fault{"door-restart-always-8",
          "Index 255 of 8 bits restarts strips and fans whether restart is on or not.",
          {.draw = force_restart<VK_INDEX_TYPE_UINT8_EXT, true>}},
    Fault{"door-restart-always-16",
          "Index 65535 of 16 bits restarts strips and fans whether restart is on or not.",
          {.draw = force_restart<VK_INDEX_TYPE_UINT16, true>}},
    Fault{"door-restart-never-8",
          "Restart is off where indices have 8 bits.",
          {.draw = force_restart<VK_INDEX_TYPE_UINT8_EXT, false>}},
    Fault{"door-restart-never-16",
          "Restart is off where indices have 16 bits.",
          {.draw = force_restart<VK_INDEX_TYPE_UINT16, false>}},
    Fault{"door-restart-at-front-ends",
          "A draw whose first index restarts is over.",
          {.draw =
               [](DrawCall& d) {
                   return d.has_restart && d.first_value == 0xffffffffU && change(d.times, 0);
               }}},
    Fault{"door-first-vertex-ignored",
          "firstVertex is ignored.",
          {.draw = [](DrawCall& d) { return !d.indexed && change(d.first, 0); }}},
    Fault{"door-first-index-ignored",
          "firstIndex is ignored.",
          {.draw = [](DrawCall& d) { return d.indexed && change(d.first, 0); }}},
    Fault{"door-first-index-in-bytes",
          "firstIndex counts bytes.",
          {.draw = [](DrawCall& d) { return d.indexed && change(d.first, d.first / 4); }}},
    Fault{"door-vertex-offset-ignored",
          "A vertexOffset above 0 is ignored.",
          {.draw =
               [](DrawCall& d) {
                   return d.indexed && d.vertex_offset > 0 && change(d.vertex_offset, 0);
               }}},
    Fault{"door-vertex-offset-negative-as-zero",
          "A negative vertexOffset counts as 0.",
          {.draw =
               [](DrawCall& d) {
                   return d.indexed && d.vertex_offset < 0 && change(d.vertex_offset, 0);
               }}},
    Fault{"door-vertex-offset-8-bits",
          "Of a negative vertexOffset only the lowest 8 bits count.",
          {.draw =
               [](DrawCall& d) {
                   return d.indexed && d.vertex_offset < 0 &&
                          change(d.vertex_offset, static_cast<int8_t>(d.vertex_offset & 0xff));
               }}},
    Fault{"door-bind-offset-16",
          "Offsets of vertex buffers lose what is no multiple of 16 bytes.",
          {.vertex_buffers = round_offsets<16>}},
    Fault{"door-bind-offset-8",
          "Offsets of vertex buffers lose what is no multiple of 8 bytes.",
          {.vertex_buffers = round_offsets<8>}},
    Fault{"door-index-offset-16",
          "The offset of an index buffer loses what is no multiple of 16 bytes.",
          {.index_buffer = [](IndexBuffer& b) { return change(b.offset, b.offset / 16 * 16); }}},
    Fault{"door-first-buffer-for-all",
          "All vertices are read from the buffer that is bound at 0.",
          {.vertex_buffers = take_first_buffer}},
    Fault{"door-index-buffer-of-vertices",
          "Indices are read from the buffer of the vertices.",
          {.index_buffer =
               [](IndexBuffer& b) {
                   return b.buffer != b.first_buffer && b.first_buffer != VK_NULL_HANDLE &&
                          change(b.buffer, b.first_buffer);
               }}},
    Fault{"door-stride-tight",
          "What lies between vertices is read as vertices.",
          {.pipeline = forget_padding}},
    Fault{"door-stride-at-most-32",
          "Strides of more than 32 bytes count as 32.",
          {.pipeline = limit_strides<32>}},
    Fault{"door-dynamic-stride-tight",
          "Strides that are given with the buffers count as 16.",
          {.vertex_buffers = take_strides_as_tight}},
    Fault{"door-dynamic-stride-first-for-all",
          "All bindings have the dynamic stride of the first one.",
          {.vertex_buffers = take_first_stride}},
    Fault{"door-input-offset-ignored",
          "Inputs are read at the beginning of the vertex, wherever they lie in it.",
          {.pipeline = forget_input_offsets}},
    Fault{"door-three-components-as-four",
          "The fourth component of an input of three is read from memory.",
          {.pipeline = read_four_of_three}},
    Fault{"door-instance-rate-ignored",
          "Inputs of an instance are read at every vertex.",
          {.pipeline = read_at_vertices}},
    Fault{"door-first-instance-ignored",
          "firstInstance is ignored.",
          {.draw = [](DrawCall& d) { return change(d.first_instance, 0); }}},
    Fault{"door-divisor-as-one",
          "Divisors above 1 count as 1.",
          {.pipeline = count_divisors_as_one<2, std::numeric_limits<uint32_t>::max()>}},
    Fault{"door-divisor-zero-as-one",
          "A divisor of 0 counts as 1.",
          {.pipeline = count_divisors_as_one<0, 0>}},
    Fault{"door-normalized-input-other-sign",
          "Normalized inputs with a sign are read without, and others with one.",
          {.pipeline = [](PipelineCopy& p) { return take_formats(p, kOtherSigns); }}},
    Fault{"door-pulled-writes-no-green",
          "A pipeline without inputs, whose depth test is dynamic, does not write the second "
          "component.",
          {.pipeline =
               [](PipelineCopy& p) {
                   bool altered = false;
                   for (VkPipelineColorBlendAttachmentState& blend : p.blends) {
                       altered =
                           (!p.has_inputs() && p.depth.depthCompareOp != VK_COMPARE_OP_ALWAYS &&
                            change(blend.colorWriteMask,
                                   blend.colorWriteMask &
                                       ~VkColorComponentFlags{VK_COLOR_COMPONENT_G_BIT})) ||
                           altered;
                   }
                   return altered;
               }}},
    Fault{"door-imported-last-triangle-lost",
          "A draw from memory of the host loses its last three vertices.",
          {.draw =
               [](DrawCall& d) {
                   return d.is_imported && change(d.count, d.count - std::min(d.count, 3U));
               }}},
    Fault{"door-indirect-offset-short",
          "A single indirect draw is read 32 bytes too early.",
          {.indirect =
               [](IndirectCall& c) {
                   return c.count == 1 && !c.count_offset && change(c.offset, c.offset - 32);
               }}},
    Fault{
        "door-indirect-vertex-offset-ignored",
        "vertexOffset of indirect draws is ignored.",
        {.indirect_draw = [](IndirectDraw& d) { return d.indexed && change(d.vertex_offset, 0); }}},
    Fault{"door-indirect-first-vertex-ignored",
          "firstVertex of indirect draws is ignored.",
          {.indirect_draw = [](IndirectDraw& d) { return !d.indexed && change(d.first, 0); }}},
    Fault{"door-indirect-count-ignored",
          "The number of indirect draws is not read: the most are drawn.",
          {.indirect =
               [](IndirectCall& c) {
                   const bool altered = c.count_offset.has_value();
                   c.count_offset.reset();
                   return altered;
               }}},
    Fault{"door-indirect-count-before",
          "The number of indirect draws is read 4 bytes too early.",
          {.indirect =
               [](IndirectCall& c) {
                   return c.count_offset && change(*c.count_offset, *c.count_offset - 4);
               }}},
    Fault{
        "door-indirect-first-only",
        "Of several indirect draws only the first is drawn.",
        {.indirect =
             [](IndirectCall& c) { return !c.count_offset && c.count > 1 && change(c.count, 1); }}},
    Fault{"door-indirect-stride-tight",
          "Several indirect draws are read one directly behind the other.",
          {.indirect =
               [](IndirectCall& c) {
                   return !c.count_offset && c.count > 1 && change(c.stride, c.indexed ? 20U : 16U);
               }}},
    Fault{"door-multi-draw-first-only",
          "Of several draws in a command only the first is drawn.",
          {.multi_draw = [](MultiDraw& m) { return keep_only(m, 0); }}},
    Fault{"door-multi-draw-last-only",
          "Of several draws in a command only the last is drawn.",
          {.multi_draw = [](MultiDraw& m) { return keep_only(m, m.draws.size() - 1); }}},
    Fault{"door-multi-draw-first-for-all",
          "Several draws in a command begin all where the first one does.",
          {.multi_draw =
               [](MultiDraw& m) {
                   bool altered = false;
                   for (IndirectDraw& draw : m.draws) {
                       altered = change(draw.first, m.draws.front().first) || altered;
                       altered =
                           change(draw.vertex_offset, m.draws.front().vertex_offset) || altered;
                   }
                   return altered;
               }}},
};

}  // namespace

std::span<const Fault> door_faults() {
    return kDoorFaults;
}

}  // namespace breaking
