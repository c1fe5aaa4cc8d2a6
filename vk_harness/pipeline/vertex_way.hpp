// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How the vertices of a draw lie in memory and are read, as far as its pipeline knows of it.
#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "cases/format/vertex_format.hpp"
#include "cases/model/case.hpp"
#include "shaders/shaders.hpp"

namespace vk_harness {

// Positions, attributes, clip distances, cull distances, offsets of instances.
inline constexpr uint32_t kOffsetBinding = 7, kBindings = 8;

// As constructed: every input is an array of vec4 of its own.
struct VertexWay {
    bool padded = false;                                   // stride_of() has room between vertices
    bool dynamic_stride = false;                           // the strides are given with the buffers
    bool interleaved = false;                              // all inputs lie in binding 0
    std::array<cases::VertexFormat, kBindings> formats{};  // by binding
    bool pulled = false;         // the shader reads them from a storage buffer
    uint32_t instance_rate = 0;  // bit b: binding b is read once for divisors[b] instances
    std::array<uint32_t, kBindings> divisors{1, 1, 1, 1, 1, 1, 1, 1};  // 0: for all of them
    shaders::Instances instances = shaders::Instances::one;
    bool is_of_instance(uint32_t binding) const { return (instance_rate >> binding & 1U) != 0; }
    friend auto operator<=>(const VertexWay&, const VertexWay&) = default;
};

// The descriptor set of a vertex shader that reads its inputs, whose binding 0 is a storage buffer:
// eight words, by binding the number of the first vec4 that would be bound there; then the vec4
// (capture.vert). A mesh shader finds the number of its first triangle in the last of them.
inline constexpr uint32_t kPulledSet = 1, kPulledWords = 8;

// `formats`: those that the device reads vertices in, a bit each.
VertexWay vertex_way(const cases::Case& c, const cases::Draw& draw, uint32_t formats);

// Whether the door puts restarts before the first and behind the last index of a draw.
bool adds_restarts(cases::Door door, const cases::Draw& draw);

// Bytes of one vertex of a binding, and from one vertex to the next.
uint32_t size_of(const VertexWay& way, uint32_t binding);
uint32_t stride_of(const VertexWay& way, uint32_t binding);
// What a pipeline says of a stride that is dynamic: another one.
inline constexpr uint32_t kIgnoredStride = 112;

// The bindings that a draw reads: positions, attributes, clip and cull distances, offsets. With the
// interleaved way they are places in binding 0, one vec4 after the other in this order.
struct Bindings {
    uint32_t numbers[kBindings] = {};
    uint32_t count = 0;
    const uint32_t* begin() const { return numbers; }
    const uint32_t* end() const { return numbers + count; }
};
Bindings bindings_of(uint32_t attribute_count, uint32_t clip_count, uint32_t cull_count,
                     bool has_offsets);

}  // namespace vk_harness
