// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "vk_harness/pipeline/pipeline_key.hpp"
#include "vk_harness/pipeline/pipeline_state.hpp"

namespace vk_harness {
namespace {

const VkPipelineRasterizationConservativeStateCreateInfoEXT* conservative_of(
    const RasterizationState& state) {
    const auto* s = static_cast<const VkBaseInStructure*>(state.info.pNext);
    for (; s != nullptr; s = s->pNext) {
        if (s->sType ==
            VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_CONSERVATIVE_STATE_CREATE_INFO_EXT) {
            return reinterpret_cast<const VkPipelineRasterizationConservativeStateCreateInfoEXT*>(
                s);
        }
    }
    return nullptr;
}

TEST(ConservativeState, IsThatOfTheDraw) {
    PipelineKey key;
    const RasterizationState plain(key);
    EXPECT_EQ(conservative_of(plain), nullptr);
    key.conservative = cases::Conservative::overestimate;
    key.extra_bits = 0x3e800000U;  // 0.25
    key.provoking = cases::ProvokingVertex::last;
    key.depth_clip = true;
    const RasterizationState over(key);
    const auto* state = conservative_of(over);
    ASSERT_NE(state, nullptr);
    EXPECT_EQ(state->conservativeRasterizationMode,
              VK_CONSERVATIVE_RASTERIZATION_MODE_OVERESTIMATE_EXT);
    EXPECT_EQ(state->extraPrimitiveOverestimationSize, 0.25F);
    key.conservative = cases::Conservative::underestimate;
    key.extra_bits = 0;
    const RasterizationState under(key);
    ASSERT_NE(conservative_of(under), nullptr);
    EXPECT_EQ(conservative_of(under)->conservativeRasterizationMode,
              VK_CONSERVATIVE_RASTERIZATION_MODE_UNDERESTIMATE_EXT);
    EXPECT_NE(under.info.pNext, nullptr);
}

TEST(FragmentSizeState, IsThatOfTheDrawAndCombinesNothing) {
    PipelineKey key;
    key.fragment_size = {4, 2};
    const auto state = fragment_size_state(key);
    EXPECT_EQ(state.sType, VK_STRUCTURE_TYPE_PIPELINE_FRAGMENT_SHADING_RATE_STATE_CREATE_INFO_KHR);
    EXPECT_EQ(state.fragmentSize.width, 4U);
    EXPECT_EQ(state.fragmentSize.height, 2U);
    EXPECT_EQ(state.combinerOps[0], VK_FRAGMENT_SHADING_RATE_COMBINER_OP_KEEP_KHR);
    EXPECT_EQ(state.combinerOps[1], VK_FRAGMENT_SHADING_RATE_COMBINER_OP_KEEP_KHR);
}

}  // namespace
}  // namespace vk_harness
