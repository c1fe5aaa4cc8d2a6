// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Several colour targets: their attachments, and the states, outputs and inputs that go with each;
// no device.
#include <gmock/gmock.h>

#include "cases/load/loader.hpp"
#include "vk_harness/pipeline/output_state.hpp"
#include "vk_harness/pipeline/pipeline_state.hpp"
#include "vk_harness/pipeline/shader_stage.hpp"
#include "vk_harness/target/attachments.hpp"
#include "vk_harness/target/shader_interface.hpp"

namespace vk_harness {
namespace {

using ::testing::ElementsAre;

cases::Case three_colors(const std::string& target) {
    const auto loaded = cases::load_text(
        "format = 1\ndescription = \"d\"\nrules = [\"color.location\"]\n[target]\nsize = [8, 8]\n" +
            target +
            "\ncolor = [{ format = \"rgba8-unorm\", clear = [1, 0, 0, 0] }, { format = "
            "\"r32-uint\", clear = [7, 0, 0, 0] }, { format = \"rgba16-float\" }]\njudged = 1\n"
            "[[draw]]\nvertices = [[0,0],[8,0],[0,8]]\n"
            "color = [{ attribute = \"c\", blend = { source = \"constant-color\" }, constants = "
            "[1, 2, 3, 4] }, { value = [9, 0, 0, 0], write_mask = \"r\" }, { attribute = \"b\", "
            "write_mask = \"\" }]\n"
            "[[draw.attribute]]\nname = \"a\"\nconstant = [1, 1, 1, 1]\n"
            "[[draw.attribute]]\nname = \"b\"\nconstant = [2, 2, 2, 2]\n"
            "[[draw.attribute]]\nname = \"c\"\nconstant = [3, 3, 3, 3]\n",
        "f", "id");
    EXPECT_TRUE(loaded) << cases::to_string(loaded.error().front());
    return loaded->front();
}

TEST(ColorTargets, LieInTheOrderOfTheirLocations) {
    const cases::Case c = three_colors("");
    const std::vector<Attachment> all = attachments_of(c);
    std::vector<Role> roles;
    for (const Attachment& a : all) {
        roles.push_back(a.role);
    }
    EXPECT_THAT(roles, ElementsAre(Role::writer_and_hits, Role::frag_coord, Role::attribute,
                                   Role::attribute, Role::attribute, Role::other_color, Role::color,
                                   Role::other_color, Role::depth));
    EXPECT_EQ(color_count(all), 8U);
    EXPECT_EQ(all[5].clear.color.float32[0], 1);
    EXPECT_EQ(all[6].clear.color.uint32[0], 7U);
    EXPECT_EQ(all[7].format, VK_FORMAT_R16G16B16A16_SFLOAT);
    EXPECT_EQ(attachment_name(all, 5), "other color 0");
    EXPECT_EQ(attachment_name(all, 6), "color");
    EXPECT_EQ(attachment_name(all, 7), "other color 1");
}

TEST(ColorTargets, HaveStatesOfTheirOwn) {
    const cases::Case c = three_colors("attachments = \"color\"");
    const PipelineKey key = pipeline_key(c, c.draws[0], {});
    EXPECT_EQ(key.color, shaders::ColorKind::several);
    const ColorState state(key);
    ASSERT_EQ(state.info.attachmentCount, 3U);
    EXPECT_EQ(state.blends[0].blendEnable, VK_TRUE);
    EXPECT_EQ(state.blends[0].srcColorBlendFactor, VK_BLEND_FACTOR_CONSTANT_COLOR);
    EXPECT_EQ(state.blends[1].blendEnable, VK_FALSE);
    EXPECT_EQ(state.blends[1].colorWriteMask, 1U);
    EXPECT_EQ(state.blends[2].colorWriteMask, 0U);
    EXPECT_THAT(state.formats, ElementsAre(VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R32_UINT,
                                           VK_FORMAT_R16G16B16A16_SFLOAT));
    // The constants are those of a target that is not judged.
    EXPECT_EQ(draw_state(c, c.draws[0]).blend_constants[3], std::bit_cast<uint32_t>(4.0F));
    // Behind the door, all of them are set.
    const OutputState dynamic = output_state(key);
    EXPECT_THAT(dynamic.blends, ElementsAre(VK_TRUE, VK_FALSE, VK_FALSE));
    EXPECT_THAT(dynamic.write_masks, ElementsAre(0xfU, 1U, 0U));
    EXPECT_EQ(dynamic.equations[0].srcColorBlendFactor, VK_BLEND_FACTOR_CONSTANT_COLOR);
    const PipelineKey bare = without_outputs(key);
    EXPECT_EQ(output_change(bare).kept, output_change(key).kept);
    EXPECT_FALSE(bare.colors[0].blends);
    EXPECT_EQ(bare.colors[2].write_mask, 0xf);
}

TEST(ColorTargets, GetWhatIsOfTheirFormatsClass) {
    using shaders::Output;
    EXPECT_EQ(output_of(VK_FORMAT_R8_SNORM), Output::number);
    EXPECT_EQ(output_of(VK_FORMAT_A2B10G10R10_UINT_PACK32), Output::whole);
    EXPECT_EQ(output_of(VK_FORMAT_R16G16_SINT), Output::signed_whole);
    EXPECT_EQ(output_of(kTwoNumbers), Output::number);
}

TEST(ColorTargets, TakeTheInputsThatTheyName) {
    // Without instruments only colours reach the shader, in the order of the locations.
    const cases::Case lone = three_colors("attachments = \"color\"");
    EXPECT_EQ(input_count(lone), 2U);
    EXPECT_EQ(input_attribute(lone, lone.draws[0], 0)->name, "c");
    EXPECT_EQ(input_attribute(lone, lone.draws[0], 1)->name, "b");
    EXPECT_EQ(input_attribute(lone, lone.draws[0], 2), nullptr);
    const auto inputs = [](const cases::Case& c) {
        std::vector<int32_t> out;
        for (uint32_t k = 0; k < 3; ++k) {
            out.push_back(input_of_color(c, c.draws[0], k));
        }
        return out;
    };
    EXPECT_THAT(inputs(lone), ElementsAre(0, -1, 1));
    const cases::Case all = three_colors("");
    EXPECT_EQ(input_count(all), 3U);
    EXPECT_THAT(inputs(all), ElementsAre(2, -1, 1));
    // As constants of the shader: of each input, of the first colour, of those behind it.
    Specialization constants;
    specialize(pipeline_key(lone, lone.draws[0], {}), constants);
    std::vector<std::pair<uint32_t, int32_t>> set;
    for (size_t k = 2; k < constants.entries.size(); ++k) {
        set.emplace_back(constants.entries[k].constantID,
                         std::bit_cast<int32_t>(constants.words[k]));
    }
    EXPECT_THAT(set, ElementsAre(std::pair(shaders::kColorAttributeConstant, 0),
                                 std::pair(shaders::kOtherAttributeConstant, -1),
                                 std::pair(shaders::kOtherAttributeConstant + 1, 1)));
}

}  // namespace
}  // namespace vk_harness
