// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The keys of colour: what they mean, and every sentence about a mistake, word for word.
#include "cases/load/color.hpp"

#include <gtest/gtest.h>

#include <string>

#include "cases/format/color_format.hpp"
#include "cases/load/loader.hpp"

namespace cases {
namespace {

const std::string kColorHead =
    "format = 1\ndescription = \"d\"\nrules = [\"store.unorm\"]\n[target]\n";

// A case whose [target.color] is line 6 and whose draw's color is line 10.
std::string file(const std::string& target_color, const std::string& color,
                 const std::string& target = "size = [8, 8]") {
    return kColorHead + target + "\n[target.color]\n" + target_color +
           "\n[[draw]]\nvertices = [[0,0],[8,0],[0,8]]\n" + color +
           "\n[[draw.attribute]]\nname = \"c\"\nvalues = [[1,2,3,4],[5,6,7,8],[1,0.5,2,3]]\n";
}

std::string error_of(const std::string& toml) {
    const auto loaded = load_text(toml, "f", "id");
    return loaded ? "no error" : to_string(loaded.error().front());
}

const std::string kUnorm = "format = \"rgba8-unorm\"";
const std::string kValue = "color = { value = [0, 0, 0, 1] }";

TEST(Color, IsRead) {
    const auto loaded = load_text(
        file("format = \"bgra8-unorm\"\nclear = [0, \"1/2\", 1, 2]",
             "color = { attribute = \"c\", blend = { source = \"dst-alpha\", op = "
             "\"max\", alpha = { "
             "destination = \"one\" } }, constants = [1, 2, 3, 4], logic = \"or-reverse\", "
             "write_mask = \"gb\" }",
             "size = [8, 8]\nattachments = \"color+depth\""),
        "f", "id");
    ASSERT_TRUE(loaded) << to_string(loaded.error().front());
    const Case& c = loaded->front();
    EXPECT_EQ(c.target.color->format, ColorFormat::bgra8_unorm);
    EXPECT_EQ(c.target.color->clear, glm::vec4(0, 0.5F, 1, 2));
    EXPECT_FALSE(c.target.has_instruments);
    EXPECT_TRUE(c.target.has_depth);
    const ColorOutput& out = c.draws[0].color;
    EXPECT_EQ(out.attribute, 0);
    EXPECT_EQ(out.write_mask, 0b0110);
    EXPECT_EQ(out.logic, LogicOp::or_reverse);
    ASSERT_TRUE(out.blend);
    EXPECT_EQ(out.blend->constants, glm::vec4(1, 2, 3, 4));
    EXPECT_EQ(out.blend->color,
              (BlendEquation{BlendFactor::dst_alpha, BlendFactor::zero, BlendOp::max}));
    EXPECT_EQ(out.blend->alpha, (BlendEquation{BlendFactor::one, BlendFactor::one, BlendOp::add}));
}

TEST(Color, ASecondSourceIsRead) {
    const std::string text = file(kUnorm,
                                  "color = { attribute = \"c\", blend = { source = \"src1-color\", "
                                  "alpha = { destination = \"one-minus-src1-alpha\" } }, second = "
                                  "[0, \"1/2\", -1, 2] }",
                                  "size = [8, 8]\nattachments = \"color\"");
    const auto loaded = load_text(text, "f", "id");
    ASSERT_TRUE(loaded) << to_string(loaded.error().front());
    const Blend& blend = *loaded->front().draws[0].color.blend;
    EXPECT_EQ(blend.second, glm::vec4(0, 0.5F, -1, 2));
    EXPECT_EQ(blend.color.source, BlendFactor::src1_color);
    EXPECT_EQ(blend.alpha.destination, BlendFactor::one_minus_src1_alpha);
    EXPECT_TRUE(takes_second(blend));
    EXPECT_FALSE(takes_second(blend_of_word(1)));
}

TEST(Color, AlphaToOneIsRead) {
    const std::string on = "color = { value = [0, 0, 0, 0], alpha_to_one = ";
    const std::string target = "size = [8, 8]\nattachments = \"color\"";
    const auto loaded = load_text(file(kUnorm, on + "true }", target), "f", "id");
    ASSERT_TRUE(loaded) << to_string(loaded.error().front());
    EXPECT_TRUE(loaded->front().draws[0].color.alpha_to_one);
    EXPECT_EQ(error_of(file(kUnorm, on + "false }")), "no error");
    EXPECT_NE(error_of(file(kUnorm, on + "true }"))
                  .find("alpha to one changes the attachments that tell of fragments; write "
                        "attachments = \"color\" or \"color+depth\" in [target]"),
              std::string::npos);
}

TEST(Color, AlphaToCoverageIsRead) {
    const std::string on = "color = { value = [0, 0, 0, 0], alpha_to_coverage = ";
    const std::string target = "size = [8, 8]\nattachments = \"color\"";
    const auto loaded = load_text(file(kUnorm, on + "true }", target), "f", "id");
    ASSERT_TRUE(loaded) << to_string(loaded.error().front());
    EXPECT_TRUE(loaded->front().draws[0].color.alpha_to_coverage);
    EXPECT_EQ(error_of(file(kUnorm, on + "false }")), "no error");
    EXPECT_NE(error_of(file(kUnorm, on + "true }"))
                  .find("alpha to coverage takes the alpha of what tells of fragments; write "
                        "attachments = \"color\" or \"color+depth\" in [target]"),
              std::string::npos);
    EXPECT_NE(error_of(file(kUnorm, on + "true }\nearly_tests = true", target))
                  .find("early tests come before alpha takes samples away, which is not judged "
                        "here; leave out early_tests or alpha_to_coverage"),
              std::string::npos);
    EXPECT_NE(error_of(file(kUnorm, on + "true }\nfragment_size = [2, 2]", target))
                  .find("fragment_size does not go with alpha_to_coverage"),
              std::string::npos);
}

TEST(Color, MistakesAreNamed) {
    EXPECT_EQ(error_of(file("clear = [0,0,0,0]", kValue)),
              "f:6:1: error: [target.color] has no format; write one, as format = "
              "\"rgba8-unorm\"");
    const auto says = [](const std::string& toml, const std::string& text) {
        const std::string error = error_of(toml);
        EXPECT_NE(error.find(": error: " + text), std::string::npos) << error;
        EXPECT_EQ(error.find("f:"), 0U) << error;
    };
    says(file("format = \"rgba8-unrom\"", kValue),
         "the colour format is \"rgba8-unrom\"; did you mean \"rgba8-unorm\"?");
    says(file(kUnorm + "\nclear = [0,0,0]", kValue), "clear has 3 numbers instead of 4");
    says(file(kUnorm, "color = 1"), "color is the number 1; write a table");
    says(file(kUnorm, "color = { }"),
         "color has no value; write value = [r, g, b, a] or attribute = \"its name\"");
    says(file(kUnorm, "color = { value = [0,0,0,0], attribute = \"c\" }"),
         "color has both value and attribute; keep one");
    says(file(kUnorm, "color = { attribute = \"d\" }"),
         "the draw has no attribute \"d\" for its colour");
    says(file(kUnorm, "color = { value = [0,0,0,0], constants = [0,0,0,0] }"),
         "constants without blend mean nothing; leave them out");
    says(file(kUnorm, "color = { value = [0,0,0,0], write_mask = \"rr\" }"),
         "write_mask is \"rr\"; write each of the letters r, g, b and a at most once");
    says(file(kUnorm, "color = { value = [0,0,0,0], blend = \"alhpa\" }"),
         "blend is \"alhpa\"; did you mean \"alpha\"?");
    says(file(kUnorm, "color = { value = [0,0,0,0], blend = { source = \"alpha\" } }"),
         "the blend factor source is \"alpha\"; ");
    const std::string two = "color = { value = [0,0,0,0], blend = { destination = \"src1-alpha\" }";
    says(file(kUnorm, two + " }", "size = [8, 8]\nattachments = \"color\""),
         "blend has a factor of the second source; write second = [r, g, b, a]");
    says(file(kUnorm, two + ", second = [0,0,0,1] }"),
         "a device may blend a second source into one attachment alone; write attachments = "
         "\"color\" or \"color+depth\" in [target]");
    says(file(kUnorm, "color = { value = [0,0,0,0], blend = \"alpha\", second = [0,0,0,1] }"),
         "second without a factor of the second source means nothing; leave it out");
    says(file(kUnorm, two + ", second = [0,0,1] }", "size = [8, 8]\nattachments = \"color\""),
         "second has 3 numbers instead of 4");
    says(file(kUnorm, "color = { value = [0,0,0,0], logic = \"xor\" }"),
         "a logical operation switches off the blending that counts hits; write attachments = "
         "\"color\" or \"color+depth\" in [target]");
    says(file(kUnorm, "color = { value = [0,0,0,0], logic = \"andd\" }"),
         "the logical operation is \"andd\"; did you mean \"and\"?");
    says(file(kUnorm, ""),
         "[[draw]] has no color, but the target has; write color = { value = [r, "
         "g, b, a] }");
    says(file("format = \"r32-uint\"", "color = { attribute = \"c\" }"),
         "the colour of a target of integers (r32-uint) needs a flat attribute of whole numbers");
    says(file("format = \"rgba8-uint\"", "color = { value = [0, 256, 0, 0] }"),
         "value is not a whole number from 0 to 255, as the format rgba8-uint needs it");
    says(file("format = \"r8-sint\"", "color = { value = [0, -129, 0, 0] }"),
         "value is not a whole number from -128 to 127, as the format r8-sint needs it");
    says(file("format = \"rgb10a2-uint\"", "color = { value = [1023, 0, 0, 4] }"),
         "value is not a whole number from 0 to 3, as the format rgb10a2-uint needs it");
    says(file("format = \"r32-uint\"", "color = { value = [0,0,0,0], blend = \"alpha\" }"),
         "a target of integers (r32-uint) is not blended; leave blend out");
    const std::string plain =
        kColorHead + "size = [8, 8]\n[[draw]]\nvertices = [[0,0],[8,0],[0,8]]\n";
    says(plain + kValue + "\n", "the target has no colour; write [target.color]");
    says(kColorHead +
             "size = [8, 8]\nattachments = \"color\"\n[[draw]]\nvertices = "
             "[[0,0],[8,0],[0,8]]\n",
         "attachments leaves nothing to draw to; write [target.color]");
}

}  // namespace
}  // namespace cases
