// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Clip and cull distances, depth volume and provoking vertex in case files, and every sentence said
// of their mistakes.
#include <gtest/gtest.h>

#include <string>

#include "cases/load/loader.hpp"

namespace cases {

namespace {

const std::string kClipHead =
    "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n"
    "[target]\nsize = [8, 8]\n[[draw]]\n";
const std::string kClipTriangle = "vertices = [[0,0],[8,0],[0,8]]\n";

Draw draw_of(const std::string& text) {
    const ExpectedAll<std::vector<Case>> loaded = load_text(kClipHead + text, "f", "id");
    if (!loaded) {
        for (const Error& error : loaded.error()) {
            ADD_FAILURE() << to_string(error);
        }
        return {};
    }
    return loaded->at(0).draws.at(0);
}

std::string clip_errors(const std::string& text) {
    const ExpectedAll<std::vector<Case>> loaded = load_text(kClipHead + text, "f", "id");
    if (loaded) {
        return "no error";
    }
    std::string out;
    for (const Error& error : loaded.error()) {
        out += (out.empty() ? "" : "\n") + to_string(error);
    }
    return out;
}

std::string clip(const std::string& text) {
    return clip_errors(kClipTriangle + "[[draw.clip_distance]]\n" + text);
}

using Vectors = std::vector<glm::vec4>;

}  // namespace

TEST(LoadClip, Defaults) {
    const Draw d = draw_of(kClipTriangle);
    EXPECT_EQ(d.distances, ClipDistances{});
    EXPECT_EQ(d.provoking, ProvokingVertex::first);
    EXPECT_FALSE(d.depth.negative_one_to_one);
}

TEST(LoadClip, EveryForm) {
    const Draw d = draw_of(kClipTriangle +
                           "provoking = \"last\"\n"
                           "depth_volume = \"negative-one-to-one\"\n"
                           "[[draw.clip_distance]]\nvalues = [1, -2, \"1/4\"]\n"
                           "[[draw.clip_distance]]\nplane = \"x-2*y+1\"\n"
                           "[[draw.clip_distance]]\nconstant = 3\nnegate = true\n"
                           // clip space: x_c = x/4 - 1, y_c = y/4 - 1, z_c = 1/2, w_c = 1
                           "[[draw.clip_distance]]\nhalf_space = [1, 2, 4, 8]\n"
                           "[[draw.cull_distance]]\nvalues = [0, -1, 5]\n");
    EXPECT_EQ(d.provoking, ProvokingVertex::last);
    EXPECT_TRUE(d.depth.negative_one_to_one);
    EXPECT_EQ(d.distances.clip_count, 4U);
    EXPECT_EQ(d.distances.cull_count, 1U);
    EXPECT_EQ(d.distances.clip, (Vectors{{1, 1, -3, 7}, {-2, 9, -3, 9}, {0.25F, -15, -3, 11}}));
    EXPECT_EQ(d.distances.cull, (Vectors{{0, 0, 0, 0}, {-1, 0, 0, 0}, {5, 0, 0, 0}}));
}

TEST(LoadClip, DistancesMoveWithTheirVertices) {
    const Draw d = draw_of(kClipTriangle +
                           "first = 1\n"
                           "[[draw.clip_distance]]\nvalues = [1, 2, 3]\n"
                           "[[draw.cull_distance]]\nvalues = [4, 5, 6]\n");
    const Draw plain = draw_of(kClipTriangle + "first = 1\n");
    EXPECT_EQ(d.positions, plain.positions);
    EXPECT_EQ(d.distances.clip, (Vectors{{2, 0, 0, 0}, {3, 0, 0, 0}, {1, 0, 0, 0}}));
    EXPECT_EQ(d.distances.cull, (Vectors{{5, 0, 0, 0}, {6, 0, 0, 0}, {4, 0, 0, 0}}));
}

TEST(LoadClip, Mistakes) {
    EXPECT_EQ(clip_errors(kClipTriangle + "provoking = \"lst\"\n"),
              "f:8:13: error: provoking is \"lst\"; did you mean \"last\"?");
    EXPECT_EQ(clip_errors(kClipTriangle + "depth_volume = \"zero\"\n"),
              "f:8:16: error: depth_volume is \"zero\"; write \"zero-to-one\" or "
              "\"negative-one-to-one\"");
    EXPECT_EQ(clip(""),
              "f:8:1: error: clip_distance has no values; write values, constant, plane or "
              "half_space");
    EXPECT_EQ(clip("values = [1,2,3]\nconstant = 1\n"),
              "f:10:12: error: clip_distance says twice where its values come from; keep one of "
              "values, constant, plane and half_space");
    EXPECT_EQ(clip("values = [1,2]\n"), "f:9:10: error: values has 2 entries for 3 vertices");
    EXPECT_EQ(clip("values = [1,2,\"k\"]\n"),
              "f:9:15: error: a clip_distance: \"k\" is not a number: the name k is unknown; names "
              "are the keys of [matrix]");
    EXPECT_EQ(clip("constant = \"2^61\"\n"),
              "f:9:12: error: a clip_distance is 2.30584e+18; write 0 or a number of magnitude "
              "2^-60 to 2^60");
    EXPECT_EQ(clip("constant = \"-2^-61\"\n"),
              "f:9:12: error: a clip_distance is -4.33681e-19; write 0 or a number of magnitude "
              "2^-60 to 2^60");
    EXPECT_EQ(clip("half_space = [1,2,3]\n"),
              "f:9:14: error: half_space has 3 numbers instead of 4");
    EXPECT_EQ(clip("normal = [1,2,3]\n"),
              "f:9:1: error: [[draw.clip_distance]] has no key \"normal\"; its keys are values, "
              "constant, plane, half_space, negate\n"
              "f:8:1: error: clip_distance has no values; write values, constant, plane or "
              "half_space");
    EXPECT_EQ(clip("constant = 1\nnegate = 1\n"),
              "f:10:10: error: negate is the number 1; write true or false");
    const std::string one = "[[draw.clip_distance]]\nconstant = 1\n";
    EXPECT_EQ(clip_errors(kClipTriangle + one + one + one + one + one),
              "f:8:1: error: a draw has 1 to 4 of clip_distance, not 5");
    EXPECT_EQ(clip_errors("space = \"clip\"\nvertices = [[0,0,0,1],[1,0,0,0],[0,1,0,1]]\n"
                          "[[draw.cull_distance]]\nplane = \"x\"\n"),
              "f:10:9: error: plane has no x and y at vertex 1, whose w is 0; write half_space");
}

}  // namespace cases
