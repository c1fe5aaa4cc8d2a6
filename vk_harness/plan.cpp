// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What drawing one case takes: pipelines, attachments, queries, a render pass object if it has one.
#include <array>
#include <bit>

#include "cases/format/color_format.hpp"
#include "cases/model/sample.hpp"
#include "vk_harness/case_check.hpp"
#include "vk_harness/commands/render_pass.hpp"
#include "vk_harness/renderer.hpp"
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

// A call that fails is never 'unsupported': what a device does not advertise, check_case has
// rejected before anything is asked of the driver.
void reject(Rendered& result, const Failure& failure) {
    result.status = failure.is_lost ? Rendered::Status::device_lost : Rendered::Status::error;
    result.reason = std::string(to_string(failure.stage)) + ": " + failure.message;
}

bool BatchRenderer::plan(CasePlan& plan, Rendered& result) {
    const cases::Case& test = *plan.test;
    if (auto rejection = check_case(device_->capabilities(), test, plan.reads_hits)) {
        result.status = rejection->status;
        result.reason = std::move(rejection->reason);
        return false;
    }
    const bool is_fed = is_feeding(test.variation.door);
    plan.input_count = input_count(test);
    const TargetLayout layout = target_layout(device_->capabilities(), test);
    for (const cases::Draw& draw : test.draws) {
        DrawPlan item;
        PipelineKey own = pipeline_key(test, draw, layout);
        if (test.variation.door == cases::Door::state_output) {
            item.outputs = output_state(own);
            own = without_outputs(own);
        }
        item.draw = &draw;
        if (auto made = plan_shaders(item, own, test.variation.door); !made) {
            reject(result, made.error());
            return false;
        }
        if (test.variation.door == cases::Door::state_after_static) {
            PipelineKey key = pipeline_key(test, draw, layout);
            key.fixed = other_state(draw_state(test, draw), Leaves::scissors_empty);
            key.sets_numbers = false;
            auto other = pipelines_.get(key);
            if (!other) {
                reject(result, other.error());
                return false;
            }
            item.other_pipeline = *other;
        }
        item.is_split = layout.split;
        if (is_fed) {
            item.feed = std::make_shared<Feed>(test, draw, own.way);
        }
        for (const cases::Attribute& attribute : draw.attributes) {
            if (attribute.probe == cases::Probe::lod) {
                auto texture = textures_.get(pipelines_, attribute.texture_size);
                if (!texture) {
                    reject(result, texture.error());
                    return false;
                }
                item.texture = *texture;
            }
        }
        plan.draws.push_back(item);
    }
    plan.attachments = attachments_of(test, layout);
    if (test.blit) {
        auto blit = BlitImages::create(*device_, test);
        if (!blit) {
            reject(result, blit.error());
            return false;
        }
        plan.blit = std::make_shared<BlitImages>(std::move(*blit));
        return true;
    }
    if (cases::asks_queries(test)) {
        auto queries = Queries::create(*device_, test);
        if (!queries) {
            reject(result, queries.error());
            return false;
        }
        plan.queries = std::make_shared<Queries>(std::move(*queries));
    }
    auto images = targets_.get(test.target, plan.attachments, image_way(test));
    if (!images) {
        reject(result, images.error());
        return false;
    }
    plan.images = std::move(*images);
    if (test.variation.door == cases::Door::input_attachment && is_large({&plan, 1})) {
        result.status = Rendered::Status::unsupported;
        result.reason = "the attachments are so large that they are read back piece by piece";
        return false;
    }
    if (auto closed = closed_door(plan, layout)) {
        result.status = Rendered::Status::unsupported;
        result.reason = *std::move(closed);
        return false;
    }
    if (test.variation.door == cases::Door::clear_draw) {
        if (auto made = plan_clears(plan); !made) {
            reject(result, made.error());
            return false;
        }
    }
    if (has_pass(test, layout)) {
        if (auto made = plan_pass(plan, layout); !made) {
            reject(result, made.error());
            return false;
        }
    }
    return true;
}

Result<void> BatchRenderer::plan_shaders(DrawPlan& item, const PipelineKey& key, cases::Door door) {
    if (door == cases::Door::shader_objects) {
        item.object_key = std::make_shared<PipelineKey>(key);
        return put(item.objects, pipelines_.get_objects(key));
    }
    if (door == cases::Door::transform_feedback) {
        if (auto made = put(item.feedback, pipelines_.get_feedback(key.attribute_count)); !made) {
            return made;
        }
    }
    return put(item.pipeline, pipelines_.get(key));
}

Result<void> BatchRenderer::plan_clears(CasePlan& plan) {
    const std::vector<ClearKey> keys = clear_keys(plan.test->target, plan.attachments);
    for (const ClearKey& key : keys) {
        auto pipeline = pipelines_.get_clear(key);
        if (!pipeline) {
            return fail(pipeline.error());
        }
        ClearDraw draw;
        draw.pipeline = *pipeline;
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
    return {};
}

Result<void> BatchRenderer::plan_pass(CasePlan& plan, const TargetLayout& layout) {
    const PassKey key = pass_key(*plan.test, layout);
    plan.pass_clears_resolved = key.clears_resolved;
    if (auto got = put(plan.pass, pipelines_.get_pass(key)); !got) {
        return got;
    }
    if (auto made = plan_inputs(plan, key); !made) {
        return made;
    }
    auto framebuffer = make_framebuffer(*device_, plan, plan.pass);
    if (!framebuffer) {
        return fail(framebuffer.error());
    }
    plan.framebuffer = std::make_shared<Handle<VkFramebuffer>>(std::move(*framebuffer));
    return {};
}

Result<void> BatchRenderer::plan_inputs(CasePlan& plan, const PassKey& pass) {
    for (size_t k = 0; k < plan.attachments.size(); ++k) {
        const Attachment& attachment = plan.attachments[k];
        if (!attachment.is_input) {
            continue;
        }
        const auto index = static_cast<uint32_t>(plan.inputs.size());
        auto pipeline = pipelines_.get_input(input_key(pass, plan.test->target, attachment, index));
        if (!pipeline) {
            return fail(pipeline.error());
        }
        plan.inputs.push_back({k, *pipeline, VK_NULL_HANDLE});
    }
    return {};
}

}  // namespace vk_harness
