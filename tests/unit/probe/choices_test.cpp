// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Every choice of the software rasterizer is set to every value, and the datasheet has to tell it;
// those that no datasheet can show are listed with the reason.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "rasterizers/software/choice/choice.hpp"
#include "software.hpp"

namespace probe {
namespace {

struct Told {
    std::string property, answer;
};
// What shows a choice: experiments, and for each value the answers. `beside` are choices without
// which it does not matter.
struct Shown {
    std::vector<std::string_view> experiments;
    std::vector<std::vector<Told>> by_value;
    std::string beside = {};
};

std::vector<Told> of_bits(const std::string& bits) {
    return {{"grid.bits.x", bits}, {"grid.bits.y", bits}};
}
std::vector<Told> of_rule(const std::string& rule) {
    return {{"grid.rule.x", rule}, {"grid.rule.y", rule}};
}
std::vector<Told> of_setup(const std::string& what) {
    return {{"setup.smooth", what},
            {"setup.noperspective", what},
            {"setup.depth", what},
            {"setup.frag_coord_z", what},
            {"setup.frag_coord_w", what}};
}

const std::map<std::string_view, Shown>& shown() {
    const std::string first =
        "the first covered sample where it is covered in part, else the centre";
    const std::string mean = "the mean of the covered samples";
    const std::string centre = "the pixel's centre";
    static const std::map<std::string_view, Shown> kShown = {
        {"subpixel-bits",
         {{"grid"},
          {of_bits("4"), of_bits("5"), of_bits("6"), of_bits("7"), of_bits("8"), of_bits("9"),
           of_bits("10"), of_bits("11"), of_bits("12")}}},
        {"rounding",
         {{"grid"},
          {of_rule("nearest, ties to even"), of_rule("nearest, ties up"), of_rule("floor"),
           of_rule("ceil"), of_rule("toward zero")}}},
        {"ties",
         {{"ties"},
          {{{"ties.rule", "top-left"}},
           {{"ties.rule", "top-right"}},
           {{"ties.rule", "bottom-left"}},
           {{"ties.rule", "bottom-right"}},
           {{"ties.rule", "edges above, of vertical ones the left"}}}}},
        {"basis",
         {{"grid", "setup"}, {of_setup("unsnapped positions"), of_setup("snapped positions")}}},
        {"depth-has-other-basis",
         {{"grid", "setup"},
          {{{"setup.smooth", "unsnapped positions"}, {"setup.depth", "unsnapped positions"}},
           {{"setup.smooth", "unsnapped positions"}, {"setup.depth", "snapped positions"}}}}},
        {"viewport-bits",
         {{"grid", "viewport"},
          {{{"grid.viewport", "on a grid of 0 bits"}},
           {{"grid.viewport", "on a grid of 1 bits"}},
           {{"grid.viewport", "on a grid of 2 bits"}},
           {{"grid.viewport", "on a grid of 3 bits"}},
           {{"grid.viewport", "on a grid of 4 bits"}},
           {{"grid.viewport", "on a grid of 5 bits"}},
           {{"grid.viewport", "on a grid of 6 bits"}},
           {{"grid.viewport", "on a grid of 7 bits"}},
           {{"grid.viewport", "on a grid of 8 bits"}}},
          "keeps-viewport-grid=yes"}},
        {"keeps-viewport-grid",
         {{"grid", "viewport"},
          {{{"grid.viewport", "where they are put"}}, {{"grid.viewport", "on a grid of 0 bits"}}}}},
        {"piece-planes",
         {{"grid", "setup"},
          {{{"setup.clipped", "snapped positions"}},
           {{"setup.clipped", "snapped positions of the pieces"}}},
          "basis=snapped"}},
        {"fused",
         {{"grid", "transform"},
          {{{"setup.viewport", "the product is rounded, then the sum"}},
           {{"setup.viewport", "fused multiply-add"}}}}},
        {"reciprocal-w",
         {{"grid", "transform"}, {{{"setup.divide", "x / w"}}, {{"setup.divide", "x times 1/w"}}}}},
        {"near-reciprocal",
         {{"grid", "transform"},
          {{{"setup.divide", "x / w"}},
           {{"setup.divide", "x times 1/w, which is off by a unit in the last place at most"}}}}},
        {"scales-first",
         {{"grid", "transform"},
          {{{"setup.viewport", "the product is rounded, then the sum"}},
           {{"setup.viewport", "the product before the division, then the sum, each rounded"}}}}},
        {"counts-borders",
         {{"conservative"},
          {{{"conservative.reach", "not at all, and not where borders alone meet"},
            {"conservative.inner", "1 unit of the grid from it"}},
           {{"conservative.reach", "not at all, but where borders meet"},
            {"conservative.inner", "up to the edge"}}}}},
        {"mitres-corners",
         {{"conservative"},
          {{{"conservative.corners", "with the box around the triangle"}},
           {{"conservative.corners", "where the moved edges meet"}}}}},
        {"covers-by-piece",
         {{"conservative"},
          {{{"conservative.pieces", "as one polygon"}},
           {{"conservative.pieces", "triangle by triangle"}}}}},
        {"overestimation",
         {{"conservative"},
          {{{"conservative.reach", "not at all, but where borders meet"}},
           {{"conservative.reach", "by 1 unit of the grid"}},
           {{"conservative.reach", "by 0.5 pixel"}}},
          "counts-borders=yes"}},
        {"centroid", {{"places"}, {{{"samples.centroid", first}}, {{"samples.centroid", mean}}}}},
        {"inputs-follow-samples",
         {{"places"},
          {{{"samples.shaded_inputs", centre}}, {{"samples.shaded_inputs", "the sample itself"}}}}},
        {"corner-inputs",
         {{"places"},
          {{{"samples.inputs", centre}},
           {{"samples.inputs", "always (0.0625, 0.9375) in the pixel"}}}}},
        {"facing-unsnapped",
         {{"grid", "setup"},
          {{{"setup.facing", "snapped positions"}}, {{"setup.facing", "unsnapped positions"}}}}},
        {"planes",
         {{"inputs"},
          {{{"setup.anchor", "the framebuffer's origin"},
            {"inputs.constant.noperspective", "stay what they are, bit for bit"}},
           {{"setup.anchor", "the triangle"},
            {"inputs.constant.noperspective", "stay what they are, bit for bit"}},
           {{"setup.anchor", "the triangle"}, {"inputs.constant.noperspective", "are rounded"}}}}},
        {"clip",
         {{"grid", "clipping"},
          {{{"clipping.guard_band", "they are cut at its border"}},
           {{"clipping.guard_band", "2^13 to 2^14 pixels"}}}}},
        {"tests-distances",
         {{"grid", "clipping"},
          {{{"clipping.distances", "the polygon is cut, and its corners snap"}},
           {{"clipping.distances", "exactly: each sample is tested, or corners do not snap"}}}}},
        {"tests-depth",
         {{"grid", "clipping"},
          {{{"clipping.depth", "the polygon is cut, and its corners snap"}},
           {{"clipping.depth", "exactly: each sample is tested, or corners do not snap"}}}}},
        {"odd-quads",
         {{"derivatives"},
          {{{"derivatives.fine",
             "of the pixel's own row or column (fine); quads begin at even pixels"},
            {"derivatives.coarse",
             "of the quad's first row or column; quads begin at even pixels"}},
           {{"derivatives.fine",
             "of the pixel's own row or column (fine); quads begin at odd pixels"},
            {"derivatives.coarse",
             "of the quad's first row or column; quads begin at odd pixels"}}}}},
        {"unorm",
         {{"colors"},
          {{{"color.rounding.rgba8-unorm", "nearest, ties up"}},
           {{"color.rounding.rgba8-unorm", "nearest, ties to even"}},
           {{"color.rounding.rgba8-unorm", "nearest, ties down"}},
           {{"color.rounding.rgba8-unorm", "down"}, {"color.rounding.rgba16-unorm", "down"}}}}},
        {"narrow-through-eight",
         {{"colors"},
          {{{"color.rounding.r5g6b5-unorm", "nearest, ties up"}},
           {{"color.rounding.r5g6b5-unorm", "to 8 bits, of which the low ones are cut off"},
            {"color.rounding.rgba8-unorm", "nearest, ties up"}}}}},
        {"blend",
         {{"blending"},
          {{{"blending.rgba8-unorm", "the format's codes, the product to nearest"},
            {"blending.rgba16-unorm", "floating point, rounded once"}},
           {{"blending.rgba8-unorm", "floating point, rounded once"}},
           {{"blending.rgba8-unorm",
             "the format's codes of a source cut to 4 bits more, the product to nearest"}}}}},
        {"half-toward-zero",
         {{"colors"},
          {{{"color.rounding.rgba16-float", "nearest, ties to even"}},
           {{"color.rounding.rgba16-float", "toward zero"}}}}},
        {"resolve-truncates",
         {{"resolves"},
          {{{"resolve.rounding", "nearest, ties up"}}, {{"resolve.rounding", "down"}}}}},
        {"srgb-resolved-encoded",
         {{"resolves"},
          {{{"resolve.srgb", "the numbers that the codes stand for"}},
           {{"resolve.srgb", "the codes"}}}}},
        {"blit-edge",
         {{"blits"},
          {{{"blit.border", "at the image's border"}},
           {{"blit.border", "at the region's border"}}}}},
        {"blit-steps",
         {{"blits"},
          {{{"blit.coordinates", "each by itself"}},
           {{"blit.coordinates", "by adding the step to the last one"}}}}},
    };
    return kShown;
}

// Choices that a datasheet does not show, and why.
const std::map<std::string_view, const char*>& hidden() {
    static const std::map<std::string_view, const char*> kHidden = {
        {"multiply",
         "both ways give the nearest code of every product of two codes (BothMultiplications)"},
        {"first-strip-order",
         "it shows in gl_BaryCoordEXT alone, and devices tell it: "
         "triStripVertexOrderIndependentOfProvokingVertex; a run judges by it"},
        {"rasterizes-degenerates",
         "devices tell it: degenerateTrianglesRasterized; a run judges by it"},
        {"counts-most", "it shows in pipeline statistics alone, which no experiment asks for"},
        {"short-levels", "it shows in levels of detail beyond every texture, which none asks for"},
        {"coarse-inputs-at-sample",
         "it shows in fragments of several pixels alone, of which no experiment draws any"},
        {"alpha-mask", "it shows through alpha to coverage alone, which no experiment draws with"},
    };
    return kHidden;
}

class EachChoice : public testing::TestWithParam<size_t> {};

TEST_P(EachChoice, IsFoundAsItWasSet) {
    const software::Choice& choice = software::all_choices().at(GetParam());
    if (hidden().contains(choice.key)) {
        GTEST_SKIP() << hidden().at(choice.key);
    }
    ASSERT_TRUE(shown().contains(choice.key)) << choice.key << " is neither shown nor hidden";
    const Shown& how = shown().at(choice.key);
    ASSERT_EQ(how.by_value.size(), choice.values.size());
    for (size_t value = 0; value < choice.values.size(); ++value) {
        software::Device device;
        ASSERT_EQ(software::set_choices(device, how.beside), "");
        choice.set(device, value);
        const Datasheet sheet = sheet_of(device, how.experiments);
        for (const Told& told : how.by_value[value]) {
            const Property* property = sheet.find(told.property);
            ASSERT_NE(property, nullptr) << told.property;
            EXPECT_EQ(property->answer, told.answer)
                << choice.key << "=" << choice.values[value] << ": " << told.property << ": "
                << property->why << " (" << property->agree << " of "
                << property->agree + property->contradict << ")";
            EXPECT_EQ(property->contradict, 0U) << told.property;
            EXPECT_GT(property->agree, 0U) << told.property;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, EachChoice, testing::Range(size_t{0}, software::all_choices().size()),
                         [](const auto& choice) {
                             std::string name(software::all_choices().at(choice.param).key);
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(Choices, AreShownOrHidden) {
    EXPECT_EQ(shown().size() + hidden().size(), software::all_choices().size());
}

TEST(Choices, BothMultiplicationsGiveTheNearestCode) {
    for (uint32_t a = 0; a < 256; ++a) {
        for (uint32_t b = 0; b < 256; ++b) {
            const uint32_t t = a * b + 128;
            EXPECT_EQ((a * b + 127) / 255, (t + (t >> 8)) >> 8) << a << " " << b;
        }
    }
}

TEST(Choices, WrongWordsAreToldInOneSentence) {
    software::Device device;
    EXPECT_NE(software::set_choices(device, "tie=top-left").find("no choice 'tie'; it has"),
              std::string::npos);
    EXPECT_NE(software::set_choices(device, "ties=left").find("'left' is no value of 'ties'"),
              std::string::npos);
    EXPECT_NE(software::set_choices(device, "ties").find("'' is no value of 'ties'"),
              std::string::npos);
    EXPECT_EQ(software::set_choices(device, "ties=top-right,fused=yes"), "");
    EXPECT_EQ(device.ties, software::TieRule::top_right);
    EXPECT_TRUE(device.fused);
}

}  // namespace
}  // namespace probe
