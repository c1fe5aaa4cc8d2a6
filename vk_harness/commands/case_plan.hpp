// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What drawing one case takes: pipelines, attachments, queries, places in buffers.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "vk_harness/commands/blit.hpp"
#include "vk_harness/commands/color_source.hpp"
#include "vk_harness/commands/query.hpp"
#include "vk_harness/door/feed.hpp"
#include "vk_harness/memory/surroundings.hpp"
#include "vk_harness/pipeline/output_state.hpp"
#include "vk_harness/pipeline/pipeline_cache.hpp"
#include "vk_harness/target/readback.hpp"
#include "vk_harness/target/target.hpp"

namespace vk_harness {

// A draw with the place of its data in the vertex buffer, in bytes.
struct DrawPlan {
    const cases::Draw* draw = nullptr;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkPipeline other_pipeline = VK_NULL_HANDLE;  // of the door state_after_static: all is static
    VkPipeline feedback = VK_NULL_HANDLE;        // of the door transform_feedback: writes vertices
    VkDescriptorSet texture = VK_NULL_HANDLE;    // if an attribute asks for a level of detail
    std::array<VkDeviceSize, 1 + cases::kMaxAttributes> vertices{};  // positions, attributes
    DistancePlaces distances{};
    VkDeviceSize indices = 0;
    bool is_split = false;                    // TargetLayout::split
    std::shared_ptr<Feed> feed;               // of instances, or of a door that feeds vertices
    std::optional<OutputState> outputs = {};  // of the door state_output: set before the draw
    std::shared_ptr<const PipelineKey> rasterization;  // of the door state_rasterization
    // Of the door shader_objects, instead of a pipeline; the state is that of the key.
    std::shared_ptr<const PipelineKey> object_key;
    ShaderPair objects{};
};

// A draw that clears one colour, or depth and stencil.
struct ClearDraw {
    VkPipeline pipeline = VK_NULL_HANDLE;
    std::array<uint32_t, 4> bits{};  // that it writes; of depth: the first
    bool has_stencil = false;
    uint32_t stencil = 0;
};

// A draw that reads one attachment as an input attachment and writes it to the read-back buffer.
struct InputRead {
    size_t attachment = 0;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;  // null: nothing is read back
};

struct PlacedSurroundings {
    size_t attachment = 0;
    Surroundings of;
};

struct CasePlan {
    const cases::Case* test = nullptr;
    size_t slot = 0;           // among the renderings of the batch
    bool reads_hits = true;    // check_case()
    uint32_t input_count = 0;  // case_check.hpp
    std::vector<Attachment> attachments;
    std::vector<const Image*> images;  // one an attachment
    std::vector<DrawPlan> draws;
    std::shared_ptr<BlitImages> blit;          // instead of images and draws
    std::shared_ptr<Queries> queries;          // if draws ask for them
    std::shared_ptr<ColorSources> colors;      // has_color_sources()
    std::vector<VkCommandBuffer> secondaries;  // secondaries_of() many; empty: none
    std::vector<ClearDraw> clears;             // of the door clear_draw
    std::vector<InputRead> inputs;             // of the door input_attachment
    // Where the case is rendered by a render pass object (has_pass).
    VkRenderPass pass = VK_NULL_HANDLE;
    bool pass_clears_resolved = false;  // PassKey::clears_resolved
    std::shared_ptr<Handle<VkFramebuffer>> framebuffer;
    ReadbackLayout readback;
    std::vector<PlacedSurroundings> surroundings;  // that are looked at
    // The image of attachment k has been filled with what surrounds it.
    bool is_filled(size_t k) const {
        return std::ranges::any_of(surroundings, [&](const PlacedSurroundings& s) {
            return images[s.attachment] == images[k];
        });
    }
};

// Where a case's planes are guarded, and what the attachments are called.
std::vector<std::pair<Guard*, std::string>> guards_of(const CasePlan& plan);

// Has the surroundings of the case's own planes and of its hits read back from byte `begin` on;
// returns the end. Those of other instruments are like them.
VkDeviceSize place_surroundings(CasePlan& plan, VkDeviceSize begin);

// Before the case is drawn: all images with surroundings are filled from `pattern`.
void fill_surroundings(const Device& device, VkCommandBuffer commands, const CasePlan& plan,
                       VkBuffer pattern);
// Behind it, where the attachments are ready to be copied.
void copy_surroundings(const Device& device, VkCommandBuffer commands, const CasePlan& plan,
                       VkBuffer readback);
// What was recorded has run.
std::vector<capture::StrayWrite> changed_surroundings(const CasePlan& plan,
                                                      std::span<const std::byte> memory);

// Of the damage, what lies beside the case's attachments; `renderings`: drawn together with it.
std::vector<capture::StrayWrite> stray_writes(const CasePlan& plan,
                                              std::span<const GuardDamage> damage,
                                              size_t renderings);

}  // namespace vk_harness
