// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The table [blit], what a source holds, and clipping at the destination.
#include <gtest/gtest.h>

#include <set>

#include "cases/format/color_format.hpp"
#include "cases/load/loader.hpp"
#include "cases/model/blit_source.hpp"

namespace cases {
namespace {

std::string blit_file(const std::string& blit, const std::string& format = "rgba8-unorm",
                      const std::string& more = "") {
    return "format = 1\ndescription = \"d\"\nrules = [\"blit.nearest\"]\n[target]\nsize = [8, 6]\n"
           "color = { format = \"" +
           format + "\"" + more + " }\n[blit]\n" + blit + "\n";
}

std::string blit_error(const std::string& text) {
    const ExpectedAll<std::vector<Case>> loaded = load_text(text, "f", "id");
    return loaded ? "no error" : to_string(loaded.error().front());
}

}  // namespace

TEST(LoadBlit, ReadsRegionsAndDefaults) {
    const ExpectedAll<std::vector<Case>> loaded =
        load_text(blit_file("size = [5, 4]\nfrom = [4, 1, 0, 3]\nfilter = \"linear\""), "f", "id");
    ASSERT_TRUE(loaded);
    const Case& c = loaded->front();
    ASSERT_TRUE(c.blit);
    EXPECT_EQ(c.blit->source_format, ColorFormat::rgba8_unorm);
    EXPECT_EQ(c.blit->filter, BlitFilter::linear);
    EXPECT_EQ(c.blit->source, (Corners{4, 1, 0, 3}));
    EXPECT_EQ(c.blit->destination, (Corners{0, 0, 8, 6}));
    EXPECT_FALSE(c.target.has_instruments);
    EXPECT_FALSE(c.target.has_depth);
    EXPECT_TRUE(c.draws.empty());
}

TEST(LoadBlit, EverySentence) {
    const std::vector<std::pair<std::string, std::string>> table = {
        {blit_file(""), "f:7:1: error: [blit] has no size; write size = [width, height]"},
        {blit_file("size = [1]"), "f:8:8: error: size has 1 number; write [width, height]"},
        {blit_file("size = [5, 4]\nfrom = [1, 1, 1, 2]"),
         "f:9:8: error: from is an empty region; move a corner"},
        {blit_file("size = [5, 4]\nto = [1, 1, 2]"),
         "f:9:6: error: to has 3 numbers; write two corners, [x0, y0, x1, y1]"},
        {blit_file("size = [5, 4]\nfilter = \"linear\"", "r32-uint"),
         "f:9:10: error: integers are not filtered; write \"nearest\""},
        {blit_file("size = [5, 4]\nformat = \"r32-uint\""),
         "f:7:1: error: a blit does not convert between r32-uint and rgba8-unorm; integers go to "
         "integers only"},
        {blit_file("size = [5, 4]", "rgba8-unorm", ", clear = [0.5, 0, 0, 0]"),
         "f:7:1: error: a blit's target is cleared to 0 or 1, which have exact codes"},
        {blit_file("size = [5, 4]\nto = [0, 0, 3, 6]\nfrom = [0, 0, 5, 4]\nclip = true"),
         "no error"},
        {blit_file("size = [5, 4]\nto = [-1, 0, 2, 6]\nclip = true"),
         "f:9:6: error: the clipped region would begin or end inside a texel of the source; scale "
         "by a whole number or move the destination"},
        {blit_file("size = [5, 4]\nto = [-5, 0, 0, 6]\nclip = true"),
         "f:9:6: error: nothing of the destination region lies in the target; move it"},
        {blit_file("size = [5, 4]\nformat = \"rgba8-snorm\""),
         "f:7:1: error: a blit is not judged from or to rgba8-snorm, which has signed codes, "
         "floats "
         "without a sign or one byte; write another format"},
        {blit_file("size = [5, 4]\n[[draw]]\nvertices = [[0,0],[8,0],[0,4]]"),
         "f:9:1: error: a case with [blit] has no draw; leave it out"},
    };
    for (const auto& [text, expected] : table) {
        EXPECT_EQ(blit_error(text), expected) << text;
    }
}

TEST(BlitSource, UniqueTexelsDiffer) {
    for (uint32_t f = 0; f <= static_cast<uint32_t>(kLastColorFormat); ++f) {
        Blit blit;
        blit.source_format = static_cast<ColorFormat>(f);
        if (!can_be_blitted(blit.source_format) || bytes_of(blit.source_format) == 1) {
            continue;
        }
        blit.source_width = 32;
        blit.source_height = 32;
        const std::vector<TexelCodes> texels = blit_source(blit);
        EXPECT_EQ(std::set<TexelCodes>(texels.begin(), texels.end()).size(), 1024U)
            << name_of(blit.source_format);
    }
}

TEST(ClipToDestination, MovesTheSourceByTheSameShare) {
    const ClippedBlit twice = clip_to_destination({0, 0, 6, 8}, {-6, 2, 6, 10}, 16, 8);
    EXPECT_EQ(twice.error, "");
    EXPECT_EQ(twice.source, (Corners{3, 0, 6, 6}));
    EXPECT_EQ(twice.destination, (Corners{0, 2, 6, 8}));
    const ClippedBlit mirrored = clip_to_destination({6, 0, 0, 8}, {-6, 0, 6, 8}, 16, 8);
    EXPECT_EQ(mirrored.source, (Corners{3, 0, 0, 8}));
    const ClippedBlit reversed = clip_to_destination({0, 0, 6, 8}, {6, 0, -6, 8}, 16, 8);
    EXPECT_EQ(reversed.source, (Corners{0, 0, 3, 8}));
    EXPECT_EQ(reversed.destination, (Corners{6, 0, 0, 8}));
    EXPECT_NE(clip_to_destination({0, 0, 5, 5}, {-1, 0, 9, 5}, 16, 8).error, "");
    EXPECT_EQ(clip_to_destination({0, 0, 5, 5}, {-2, 0, 8, 5}, 16, 8).source,
              (Corners{1, 0, 5, 5}));
}

// The clipped blit asks for the same source coordinate at every texel that is left.
TEST(ClipToDestination, KeepsEveryCoordinate) {
    for (int32_t begin = -12; begin <= 12; ++begin) {
        for (const int32_t scale : {1, 2, 3}) {
            const Corners from{1, 0, 7, 4};
            const Corners to{begin, 0, begin + 6 * scale, 4};
            const ClippedBlit clipped = clip_to_destination(from, to, 16, 4);
            if (!clipped.error.empty()) {
                continue;
            }
            const Corners& s = clipped.source;
            const Corners& d = clipped.destination;
            for (int32_t i = d.x0; i < d.x1; ++i) {
                // (2 i + 1 - 2 d0) (s1 - s0) / (2 (d1 - d0)) + s0, cross-multiplied
                const int64_t own = int64_t{2 * i + 1 - 2 * d.x0} * (s.x1 - s.x0) +
                                    int64_t{2} * s.x0 * (d.x1 - d.x0);
                const int64_t all = int64_t{2 * i + 1 - 2 * to.x0} * (from.x1 - from.x0) +
                                    int64_t{2} * from.x0 * (to.x1 - to.x0);
                EXPECT_EQ(own * (to.x1 - to.x0), all * (d.x1 - d.x0));
            }
        }
    }
}

}  // namespace cases
