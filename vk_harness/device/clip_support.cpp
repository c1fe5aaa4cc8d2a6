// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/clip_support.hpp"

#include <fmt/format.h>

#include <cstring>
#include <glm/vec4.hpp>

namespace vk_harness {

void query_clip_limits(VkPhysicalDevice physical, const VkPhysicalDeviceLimits& limits,
                       ClipSupport& clip) {
    clip.max_clip = clip.clips ? limits.maxClipDistances : 0;
    clip.max_cull = clip.culls ? limits.maxCullDistances : 0;
    clip.max_combined = limits.maxCombinedClipAndCullDistances;
    if (clip.last_provoking_vertex) {
        VkPhysicalDeviceProvokingVertexPropertiesEXT modes =
            Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_PROPERTIES_EXT};
        get_properties(physical, modes);
        clip.provoking_per_pipeline = modes.provokingVertexModePerPipeline == VK_TRUE;
    }
}

std::optional<std::string> missing_clip_support(const ClipSupport& support, const cases::Case& c) {
    // The pipelines of these doors' own have the first vertex as the provoking one.
    bool has_first = c.variation.door == cases::Door::clear_draw ||
                     c.variation.door == cases::Door::transform_feedback;
    bool has_last = false;
    for (const cases::Draw& draw : c.draws) {
        if (draw.clear) {
            continue;
        }
        const cases::ClipDistances& d = draw.distances;
        if (d.clip_count > 0 && support.max_clip == 0) {
            return "the device lacks the feature shaderClipDistance";
        }
        if (d.cull_count > 0 && support.max_cull == 0) {
            return "the device lacks the feature shaderCullDistance";
        }
        if (d.clip_count > support.max_clip || d.cull_count > support.max_cull ||
            d.clip_count + d.cull_count > support.max_combined) {
            return fmt::format(
                "a draw has {} clip and {} cull distances, the device allows {} and "
                "{}, together {}",
                d.clip_count, d.cull_count, support.max_clip, support.max_cull,
                support.max_combined);
        }
        if (draw.depth.negative_one_to_one && !support.depth_clip_control) {
            return "the device lacks the feature depthClipControl";
        }
        has_first = has_first || draw.provoking == cases::ProvokingVertex::first;
        has_last = has_last || draw.provoking == cases::ProvokingVertex::last;
    }
    if (has_last && !support.last_provoking_vertex) {
        return "the device lacks the feature provokingVertexLast";
    }
    if (has_first && has_last && !support.provoking_per_pipeline) {
        return "the device has one provoking vertex mode for all draws (not "
               "provokingVertexModePerPipeline)";
    }
    return std::nullopt;
}

VkDeviceSize place_distances(const cases::Draw& draw, VkDeviceSize begin, DistancePlaces& places) {
    places[0] = begin;
    begin += draw.distances.clip.size() * sizeof(glm::vec4);
    places[1] = begin;
    return begin + draw.distances.cull.size() * sizeof(glm::vec4);
}

void write_distances(const cases::Draw& draw, const DistancePlaces& places,
                     std::span<std::byte> memory) {
    const auto write = [&](VkDeviceSize offset, const std::vector<glm::vec4>& values) {
        if (!values.empty()) {
            std::memcpy(memory.data() + offset, values.data(), values.size() * sizeof(glm::vec4));
        }
    };
    write(places[0], draw.distances.clip);
    write(places[1], draw.distances.cull);
}

}  // namespace vk_harness
