// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "dynamic_state.hpp"
#include "pipeline_facts.hpp"

namespace breaking {

// What the layer knows about a command buffer. If the fault reorders draws, state and draws between
// vkCmdBeginRendering and vkCmdEndRendering are held back: each draw keeps the state it was
// recorded under.
class Recording {
  public:
    using Command = std::function<void()>;
    // Which state a command sets: the command, and the first slot, binding or byte.
    using StateKey = std::pair<std::string_view, uint32_t>;

    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    bool has_restart = false;
    VkIndexType index_type = VK_INDEX_TYPE_UINT32;
    VkBuffer index_buffer = VK_NULL_HANDLE;
    VkDeviceSize index_offset = 0;
    VkBuffer first_buffer = VK_NULL_HANDLE;  // bound for vertices at 0
    VkDeviceSize first_stride = 0;           // if strides are dynamic
    uint32_t draws = 0;                      // in this rendering
    uint64_t rendering = 0;                  // in this process, from 1
    std::vector<VkImageView> attachments;    // of this rendering
    bool is_secondary = false;
    bool has_pipeline = false;    // some pipeline, or shader objects, were bound
    bool lacks_feedback = false;  // transform feedback should have been begun
    uint32_t executions = 0;      // of a secondary one, since it was begun
    uint32_t submissions = 0;     // of a primary one, since it was begun
    bool may_repeat = false;      // a primary one that was not begun for one submission alone
    uint32_t subpass = 0;         // of a render pass object
    PipelineFacts pipeline;       // that was bound last
    bool has_offsets = false;     // of the descriptors that were bound last
    DynamicState dynamic;
    bool follows_static = false;        // StateCall
    std::set<StateKey> set_since_bind;  // since the last pipeline was bound

    void begin(bool secondary);
    void begin_rendering(bool holds_back);
    // Does the command now, or keeps it. A later command of the same key takes its place.
    void set_state(StateKey key, Command command);
    void draw(Command command);
    // Draws what was held back in the order that `arrange` makes of 0, 1, 2, ...
    void end_rendering(const std::function<void(std::vector<uint32_t>&)>& arrange);

  private:
    using State = std::map<StateKey, std::shared_ptr<const Command>>;
    bool holds_back_ = false;
    State state_;
    std::vector<std::pair<State, Command>> held_;
};

// Whether a pipeline has no dynamic state, and what it is made of: written down when it is made,
// asked when it is bound.
void note_pipeline(VkPipeline pipeline, bool is_static, const PipelineFacts& facts);
bool is_static(VkPipeline pipeline);
PipelineFacts facts_of(VkPipeline pipeline);

// The recording of a command buffer; made when first asked for.
Recording& recording_of(VkCommandBuffer commands);

}  // namespace breaking
