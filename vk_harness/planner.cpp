// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/planner.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "cases/model/instances.hpp"
#include "cases/model/sample.hpp"
#include "vk_harness/case_check.hpp"
#include "vk_harness/commands/render_pass.hpp"
#include "vk_harness/pipeline/object_state.hpp"
#include "vk_harness/row_reader.hpp"
#include "vk_harness/target/shader_interface.hpp"
#include "vk_harness/target/target_way.hpp"

namespace vk_harness {

namespace {

bool is_feeding(cases::Door door) {
    return door == cases::Door::transform_feedback || door == cases::Door::mesh_shader ||
           (door != cases::Door::none && cases::row_of(door).group == cases::DoorGroup::vertices);
}

// Whether a draw has state that is on for nothing. The test of a stencil that is not there always
// is.
bool has_unused_state(const cases::Case& c, const cases::Draw& draw, const TargetLayout& layout) {
    cases::Case plain = c;
    plain.variation.door = cases::Door::none;
    const PipelineKey with = pipeline_key(c, draw, layout);
    const PipelineKey without = pipeline_key(plain, draw, layout);
    return !c.target.has_stencil || with.colors != without.colors || with.logic != without.logic ||
           with.unused_bounds || draw_state(c, draw) != draw_state(plain, draw);
}

// Why nothing of what the door is for has come about; nothing if some has.
std::optional<std::string> closed_door(const CasePlan& plan, const TargetLayout& layout) {
    const cases::Case& c = *plan.test;
    switch (c.variation.door) {
        case cases::Door::state_unused:
            if (std::ranges::none_of(c.draws, [&](const cases::Draw& draw) {
                    return has_unused_state(c, draw, layout);
                })) {
                return "the case leaves no state that is on for nothing";
            }
            break;
        case cases::Door::exact_formats:
            if (std::ranges::none_of(c.draws, [&](const cases::Draw& draw) {
                    return vertex_way(c, draw, layout.vertex_formats) != VertexWay{};
                })) {
                return "the device reads vertices in no other format that holds the case's numbers";
            }
            break;
        case cases::Door::input_attachment:
            if (is_large(plan)) {
                return "the attachments are so large that they are read back piece by piece";
            }
            if (std::ranges::none_of(plan.attachments, [](const auto& a) { return a.is_input; })) {
                return "the case has no attachment whose bits follow from what a shader reads";
            }
            break;
        case cases::Door::image_linear:
            if (std::ranges::none_of(plan.images, [](const auto* i) { return i->is_linear(); })) {
                return "the device has no image of linear tiling for any attachment";
            }
            break;
        case cases::Door::memory_aliased:
            if (std::ranges::none_of(plan.images,
                                     [](const auto* i) { return i->alias() != VK_NULL_HANDLE; })) {
                return "the device has no memory in which another image lies beside an attachment";
            }
            break;
        default:
            break;
    }
    return std::nullopt;
}

}  // namespace

DrawPlan Planner::plan_draw(const cases::Case& test, const cases::Draw& draw,
                            const TargetLayout& layout) const {
    const cases::Door door = test.variation.door;
    DrawPlan item;
    item.draw = &draw;
    item.is_split = layout.split;
    if (draw.clear) {
        return item;
    }
    PipelineKey own = pipeline_key(test, draw, layout);
    if (door == cases::Door::state_output) {
        item.outputs = output_state(own);
        own = without_outputs(own);
    } else if (door == cases::Door::state_rasterization) {
        item.rasterization = std::make_shared<PipelineKey>(own);
        own = without_rasterization(own);
    }
    plan_shaders(item, own, door);
    if (door == cases::Door::state_after_static) {
        PipelineKey key = pipeline_key(test, draw, layout);
        key.fixed = other_state(draw_state(test, draw), Leaves::scissors_empty);
        key.sets_numbers = false;
        item.other_pipeline = pipelines_->get(key);
    }
    if (is_feeding(door) || cases::is_instanced(draw)) {
        item.feed = std::make_shared<Feed>(test, draw, own.way);
    }
    for (const cases::Attribute& attribute : draw.attributes) {
        if (attribute.probe == cases::Probe::lod) {
            item.texture = textures_->get(*pipelines_, attribute.texture_size);
        }
    }
    return item;
}

std::optional<Rejection> Planner::plan(CasePlan& plan) const {
    const cases::Case& test = *plan.test;
    if (auto rejection = check_case(device_->capabilities(), test, plan.reads_hits)) {
        return rejection;
    }
    plan.input_count = input_count(test);
    const TargetLayout layout = target_layout(device_->capabilities(), test);
    for (const cases::Draw& draw : test.draws) {
        plan.draws.push_back(plan_draw(test, draw, layout));
    }
    plan.attachments = attachments_of(test, layout);
    if (test.blit) {
        plan.blit = std::make_shared<BlitImages>(*device_, test);
        return std::nullopt;
    }
    if (cases::asks_queries(test)) {
        plan.queries = std::make_shared<Queries>(*device_, test);
    }
    if (has_color_sources(test)) {
        plan.colors = std::make_shared<ColorSources>(*device_, pipelines_->layouts(), test);
    }
    plan.images = targets_->get(test.target, plan.attachments, image_way(test), resolved_way(test));
    if (auto closed = closed_door(plan, layout)) {
        return unsupported("{}", *closed);
    }
    if (test.variation.door == cases::Door::clear_draw) {
        plan_clears(plan);
    }
    if (has_pass(test, layout)) {
        plan_pass(plan, layout);
    }
    return std::nullopt;
}

void Planner::plan_shaders(DrawPlan& item, const PipelineKey& key, cases::Door door) const {
    if (door == cases::Door::shader_objects) {
        item.object_key = std::make_shared<PipelineKey>(key);
        item.objects = pipelines_->get_objects(key);
        return;
    }
    if (door == cases::Door::transform_feedback) {
        item.feedback = pipelines_->get_feedback(key.attribute_count);
    }
    item.pipeline = pipelines_->get(key);
}

void Planner::plan_clears(CasePlan& plan) const {
    const std::vector<ClearKey> keys = clear_keys(plan.test->target, plan.attachments);
    for (const ClearKey& key : keys) {
        ClearDraw draw;
        draw.pipeline = pipelines_->get_clear(key);
        draw.has_stencil = !key.location && key.has_stencil;
        uint32_t location = 0;
        for (const Attachment& a : plan.attachments) {
            if (a.is_resolved()) {
                continue;
            }
            if (a.is_depth_stencil()) {
                if (!key.location && a.is_depth()) {
                    draw.bits[0] = std::bit_cast<uint32_t>(a.clear.depthStencil.depth);
                }
                draw.stencil = a.clear.depthStencil.stencil;
            } else if (key.location == location++) {
                draw.bits = std::to_array(a.clear.color.uint32);
            }
        }
        plan.clears.push_back(draw);
    }
}

void Planner::plan_pass(CasePlan& plan, const TargetLayout& layout) const {
    const PassKey key = pass_key(*plan.test, layout);
    plan.pass_clears_resolved = key.clears_resolved;
    plan.pass = pipelines_->get_pass(key);
    for (size_t k = 0; k < plan.attachments.size(); ++k) {
        if (plan.attachments[k].is_input) {
            const auto index = static_cast<uint32_t>(plan.inputs.size());
            const InputKey input = input_key(key, plan.test->target, plan.attachments[k], index);
            plan.inputs.push_back({k, pipelines_->get_input(input), VK_NULL_HANDLE});
        }
    }
    plan.framebuffer =
        std::make_shared<Handle<VkFramebuffer>>(make_framebuffer(*device_, plan, plan.pass));
}

}  // namespace vk_harness
