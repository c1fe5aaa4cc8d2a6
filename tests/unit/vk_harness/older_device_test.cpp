// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What is drawn on devices without dynamic rendering or extendedDynamicState; no device.
#include <gmock/gmock.h>

#include "hand_case.hpp"
#include "vk_harness/pipeline/pipeline_key.hpp"
#include "vk_harness/pipeline/pipeline_state.hpp"
#include "vk_harness/target/target_layout.hpp"

namespace vk_harness::testing {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

TargetLayout layout_of(bool has_rendering, bool has_state, const cases::Case& c) {
    Capabilities capabilities;
    capabilities.core.dynamic_rendering = has_rendering;
    capabilities.core.dynamic_state = has_state;
    return target_layout(capabilities, c);
}

PipelineKey key_of(const cases::Case& c, bool has_rendering, bool has_state) {
    return pipeline_key(c, c.draws[0], layout_of(has_rendering, has_state, c));
}

TEST(OlderDevice, IsRenderedByAPassObject) {
    const cases::Case c = make_case({64, 64, 1}, half_square());
    EXPECT_FALSE(key_of(c, true, true).pass.has_value());
    EXPECT_TRUE(key_of(c, false, true).pass.has_value());
    EXPECT_FALSE(key_of(c, true, true).fixed.has_value());
}

// A pipeline that discards for good has no samples, which a dynamic rendering would ask for.
TEST(OlderDevice, SeveralSamplesThatAreDiscardedForGoodAreRenderedByAPassObject) {
    cases::Case c = make_case({64, 64, 4}, half_square());
    EXPECT_FALSE(key_of(c, true, false).pass.has_value());
    c.draws[0].rasterizer_discard = true;
    EXPECT_TRUE(key_of(c, true, false).pass.has_value());
    EXPECT_FALSE(key_of(c, true, true).pass.has_value());
    c.target.samples = 1;
    EXPECT_FALSE(key_of(c, true, false).pass.has_value());
}

TEST(OlderDevice, PipelinesHoldTheStateThatIsNotDynamic) {
    cases::Case c = make_case({64, 64, 1}, half_square());
    c.target.has_stencil = true;
    c.draws[0].cull = cases::CullMode::back;
    const PipelineKey held = key_of(c, true, false);
    ASSERT_TRUE(held.fixed.has_value());
    EXPECT_EQ(held.fixed->cull, VK_CULL_MODE_BACK_BIT);
    const std::vector<VkDynamicState> states = dynamic_states(held);
    for (const VkDynamicState first :
         {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_DEPTH_BIAS,
          VK_DYNAMIC_STATE_BLEND_CONSTANTS, VK_DYNAMIC_STATE_STENCIL_REFERENCE}) {
        EXPECT_THAT(states, Contains(first));
    }
    for (const VkDynamicState extended :
         {VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_PRIMITIVE_TOPOLOGY,
          VK_DYNAMIC_STATE_DEPTH_COMPARE_OP, VK_DYNAMIC_STATE_STENCIL_OP,
          VK_DYNAMIC_STATE_RASTERIZER_DISCARD_ENABLE}) {
        EXPECT_THAT(states, Not(Contains(extended)));
        EXPECT_THAT(dynamic_states(key_of(c, true, true)), Contains(extended));
    }
}

// Cases that differ in what Vulkan 1.0 sets between draws share a pipeline.
TEST(OlderDevice, NumbersMakeNoOtherPipelines) {
    const cases::Case c = make_case({64, 64, 1}, half_square());
    cases::Case other = c;
    other.draws[0].viewport.width = 32;
    other.draws[0].scissor = {1, 2, 30, 40};
    other.draws[0].stencil.front.reference = 7;
    EXPECT_EQ(key_of(c, true, false), key_of(other, true, false));
    other.draws[0].cull = cases::CullMode::front;
    EXPECT_NE(key_of(c, true, false), key_of(other, true, false));
    EXPECT_EQ(key_of(c, true, true), key_of(other, true, true));
    // The door at which everything is static tells them apart.
    cases::Case fixed = c;
    fixed.variation.door = cases::Door::state_static;
    EXPECT_THAT(dynamic_states(key_of(fixed, true, false)), IsEmpty());
}

TEST(OlderDevice, AGeometryShaderNamesLayersAndViewports) {
    Capabilities capabilities;
    cases::Case c = make_case({64, 64, 1}, half_square());
    const auto stages = [&] {
        return pipeline_key(c, c.draws[0], target_layout(capabilities, c)).stages;
    };
    EXPECT_EQ(stages(), StageWay::vertex);
    c.target.layers = 2;
    c.draws[0].layer = 1;
    EXPECT_EQ(stages(), StageWay::geometry);
    capabilities.layer_output = true;
    EXPECT_EQ(stages(), StageWay::vertex);
    c.draws[0].viewport_index = 1;
    EXPECT_EQ(stages(), StageWay::geometry);
    capabilities.viewport_output = true;
    EXPECT_EQ(stages(), StageWay::vertex);
}

// Doors that need what a way to draw does without, or that are that way.
TEST(OlderDevice, EachWayClosesItsDoorsAlone) {
    using cases::Door;
    TargetLayout pass, state, geometry;
    pass.has_pass = state.holds_state = geometry.has_geometry = true;
    const auto closed = [&](Door door) {
        std::string out;
        out += closed_by(pass, door) ? "pass " : "";
        out += closed_by(state, door) ? "state " : "";
        out += closed_by(geometry, door) ? "geometry " : "";
        return out;
    };
    EXPECT_EQ(closed(Door::pass_split), "pass ");
    EXPECT_EQ(closed(Door::transform_feedback), "pass ");
    EXPECT_EQ(closed(Door::render_pass), "pass ");
    EXPECT_EQ(closed(Door::multiview), "pass geometry ");
    EXPECT_EQ(closed(Door::shader_objects), "pass state geometry ");
    EXPECT_EQ(closed(Door::geometry), "geometry ");
    EXPECT_EQ(closed(Door::stride_dynamic), "state ");
    EXPECT_EQ(closed(Door::index_16), "");
    EXPECT_EQ(closed_by(TargetLayout{}, Door::shader_objects), std::nullopt);
}

}  // namespace
}  // namespace vk_harness::testing
