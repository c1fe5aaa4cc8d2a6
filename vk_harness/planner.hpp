// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pipelines, attachments, queries and render pass object of a case, made or found again.
#pragma once

#include <optional>

#include "vk_harness/commands/case_plan.hpp"
#include "vk_harness/commands/lod_texture.hpp"
#include "vk_harness/device/rejection.hpp"

namespace vk_harness {

class Planner {
  public:
    Planner(const Device& device, PipelineCache& pipelines, TargetCache& targets,
            LodTextures& textures)
        : device_(&device), pipelines_(&pipelines), targets_(&targets), textures_(&textures) {}

    // What drawing plan.test takes, or why it cannot be drawn.
    std::optional<Rejection> plan(CasePlan& plan) const;

  private:
    DrawPlan plan_draw(const cases::Case& test, const cases::Draw& draw,
                       const TargetLayout& layout) const;
    // The pipeline of a draw, or its shaders where there is none.
    void plan_shaders(DrawPlan& item, const PipelineKey& key, cases::Door door) const;
    // What clears the attachments of a case that is cleared by draws.
    void plan_clears(CasePlan& plan) const;
    // The render pass and framebuffer of a case that has_pass().
    void plan_pass(CasePlan& plan, const TargetLayout& layout) const;

    const Device* device_;
    PipelineCache* pipelines_;
    TargetCache* targets_;
    LodTextures* textures_;
};

}  // namespace vk_harness
