// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The vertices of a draw on another way to the pipeline: other indices, other places, other
// commands. One object a draw of instances, or of a case that goes through a door of the group
// `vertices`.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "vk_harness/memory/descriptor.hpp"
#include "vk_harness/memory/memory.hpp"
#include "vk_harness/pipeline/vertex_way.hpp"

namespace vk_harness {

class Feed {
  public:
    // `way` is that of the draw's pipeline.
    Feed(const cases::Case& c, const cases::Draw& draw, const VertexWay& way);

    // Assigns places from byte `begin` of the vertex buffer on; returns the end.
    VkDeviceSize place(VkDeviceSize begin);
    // Writes vertices, indices and parameters there; what lies between them must not be read.
    // `is_mirrored`: with the opposite of each x.
    void write(std::span<std::byte> memory, bool is_mirrored) const;
    // Buffers and memory of their own, if the door gives them; after place() and write().
    // `pulled`: the layout of the descriptor set from which a shader reads vertices.
    void make_buffers(const Device& device, std::span<const std::byte> memory,
                      VkDescriptorSetLayout pulled);

    // Binds vertices and indices; `vertices` is the buffer that was written.
    void bind(const Device& device, VkCommandBuffer commands, VkBuffer vertices) const;
    // Binds what a shader reads vertices from, if it does; `layout` is the pipeline's.
    void bind_pulled(const Device& device, VkCommandBuffer commands, VkPipelineLayout layout) const;
    // Writes the vertices to the buffer that they are drawn from, by transform feedback; `pipeline`
    // is PipelineCache::get_feedback()'s, `vertices` the buffer that was written.
    void record_feedback(const Device& device, VkCommandBuffer commands, VkPipeline pipeline,
                         VkBuffer vertices) const;
    // Draws once. Called after bind(), once for every scissor.
    void draw(const Device& device, VkCommandBuffer commands, VkBuffer vertices) const;

  private:
    static constexpr uint32_t kCommands = 3;  // in one buffer, or in one command
    struct Part {                             // vertices or indices of a draw
        uint32_t first = 0, count = 0;
    };
    std::array<Part, kCommands> parts_of() const;
    struct Array {  // what is bound at one number
        uint32_t binding = 0;
        VkDeviceSize begin = 0;   // of the room that it takes
        VkDeviceSize offset = 0;  // at which it is bound
        VkDeviceSize end = 0;
    };
    std::span<const glm::vec4> values_of(uint32_t binding) const;
    void make_indices();
    void make_triangles(const cases::Case& c);
    void make_pulled(const Device& device, std::span<const std::byte> memory,
                     VkDescriptorSetLayout layout);
    VkDeviceSize index_size() const;
    VkDeviceSize place_commands(VkDeviceSize begin);
    void write_vertices(std::span<std::byte> memory, bool is_mirrored) const;
    void write_indices(std::span<std::byte> memory) const;
    void write_commands(std::span<std::byte> memory) const;

    const cases::Draw* draw_;
    cases::Door door_;
    VertexWay way_;
    Bindings bindings_;
    std::array<std::vector<glm::vec4>, kBindings> values_;  // by binding
    std::vector<uint32_t> indices_;                         // as they are written
    bool is_indexed_ = false;
    VkIndexType index_type_ = VK_INDEX_TYPE_UINT32;
    // Of the drawing command.
    uint32_t count_ = 0, first_ = 0, first_instance_ = 0, instances_ = 1;
    int32_t vertex_offset_ = 0;

    std::vector<Array> arrays_;
    VkDeviceSize index_begin_ = 0, index_offset_ = 0, index_end_ = 0;
    VkDeviceSize commands_ = 0, draw_count_ = 0;      // places
    std::vector<Buffer> buffers_;                     // of the arrays, then of the indices; or none
    std::vector<std::array<uint32_t, 4>> triangles_;  // of a mesh shader; the last word is 0
    Buffer pulled_;                                   // of a shader that reads vertices
    DescriptorSets pulled_set_;                       // with that buffer
};

}  // namespace vk_harness
