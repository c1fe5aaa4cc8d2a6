// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "recording.hpp"

#include <atomic>
#include <mutex>
#include <numeric>
#include <set>

namespace breaking {

void Recording::begin_rendering(bool holds_back) {
    static std::atomic<uint64_t> count = 0;
    rendering = ++count;
    draws = 0;
    follows_static = false;
    has_pipeline = false;
    holds_back_ = holds_back;
}

void Recording::begin(bool secondary) {
    is_secondary = secondary;
    executions = 0;
    subpass = 0;
    draws = 0;
    follows_static = false;
    has_pipeline = false;
    set_since_bind.clear();
}

void Recording::set_state(StateKey key, Command command) {
    if (!holds_back_) {
        command();
        return;
    }
    state_[key] = std::make_shared<const Command>(std::move(command));
}

void Recording::draw(Command command) {
    if (!holds_back_) {
        command();
        return;
    }
    held_.emplace_back(state_, std::move(command));
}

void Recording::end_rendering(const std::function<void(std::vector<uint32_t>&)>& arrange) {
    if (!holds_back_) {
        return;
    }
    std::vector<uint32_t> order(held_.size());
    std::iota(order.begin(), order.end(), 0U);
    arrange(order);
    for (const uint32_t number : order) {
        const auto& [state, draw] = held_[number];
        for (const auto& [key, set] : state) {
            (*set)();
        }
        draw();
    }
    held_.clear();
    state_.clear();
    holds_back_ = false;
}

namespace {

std::mutex pipelines_mutex;
std::set<VkPipeline> static_pipelines;
std::map<VkPipeline, PipelineFacts> facts_of_pipelines;

}  // namespace

void note_pipeline(VkPipeline pipeline, bool is_static, const PipelineFacts& facts) {
    const std::lock_guard lock(pipelines_mutex);
    facts_of_pipelines[pipeline] = facts;
    if (is_static) {
        static_pipelines.insert(pipeline);
    } else {
        static_pipelines.erase(pipeline);
    }
}

bool is_static(VkPipeline pipeline) {
    const std::lock_guard lock(pipelines_mutex);
    return static_pipelines.contains(pipeline);
}

PipelineFacts facts_of(VkPipeline pipeline) {
    const std::lock_guard lock(pipelines_mutex);
    const auto found = facts_of_pipelines.find(pipeline);
    return found == facts_of_pipelines.end() ? PipelineFacts() : found->second;
}

Recording& recording_of(VkCommandBuffer commands) {
    static std::mutex mutex;
    static std::map<VkCommandBuffer, Recording> recordings;
    const std::lock_guard lock(mutex);
    return recordings[commands];
}

}  // namespace breaking
