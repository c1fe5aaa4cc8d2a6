// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a device needs for clip and cull distances, depth clip control and the provoking vertex, and
// the vertex inputs of distances.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "cases/model/case.hpp"
#include "vk_harness/device/api.hpp"

namespace vk_harness {

// Bindings and locations of distances in capture.vert; attributes end before them.
inline constexpr uint32_t kClipBinding = 5, kCullBinding = 6;

struct ClipSupport {
    bool clips = false, culls = false;  // shaderClipDistance, shaderCullDistance
    uint32_t max_clip = 0, max_cull = 0, max_combined = 0;  // distances; 0 without the feature
    bool depth_clip_control = false;                        // VK_EXT_depth_clip_control
    bool last_provoking_vertex = false;   // VK_EXT_provoking_vertex, provokingVertexLast
    bool provoking_per_pipeline = false;  // provokingVertexModePerPipeline
    // transformFeedbackPreservesProvokingVertex, without which any vertex of a primitive may be
    // written first; only with last_provoking_vertex and transformFeedback.
    bool feedback_keeps_order = false;
};

// Limits and modes of what was found to be supported.
void query_clip_limits(VkPhysicalDevice physical, const VkPhysicalDeviceLimits& limits,
                       ClipSupport& clip);

// Why a case cannot be drawn: one sentence that names the feature; nothing if it can.
std::optional<std::string> missing_clip_support(const ClipSupport& support, const cases::Case& c);

// Where the arrays of a draw's distances lie in the vertex buffer, bytes: clip, cull.
using DistancePlaces = std::array<VkDeviceSize, 2>;
// Places them from `begin` on; returns the end.
VkDeviceSize place_distances(const cases::Draw& draw, VkDeviceSize begin, DistancePlaces& places);
void write_distances(const cases::Draw& draw, const DistancePlaces& places,
                     std::span<std::byte> memory);

}  // namespace vk_harness
