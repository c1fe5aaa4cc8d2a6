// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "cases/load/loader.hpp"
#include "fuzz/document/document.hpp"

namespace fuzz {

inline Document read(const std::string& text) {
    const cases::Expected<cases::TomlValue> document = cases::read_toml(text, "test.toml");
    EXPECT_TRUE(document) << cases::to_string(document.error()) << "\n" << text;
    return document ? *document : Document{};
}

inline cases::Case load(const std::string& text) {
    const auto loaded = cases::load_text(text, "test.toml", "test");
    EXPECT_TRUE(loaded) << cases::to_string(loaded.error().front()) << "\n" << text;
    return loaded ? loaded->front() : cases::Case{};
}

// Draws of all topologies, with everything that has a default said otherwise.
inline constexpr const char* kCrowded = R"(
format = 1
description = "Everything at once."
catches = "nothing yet"
links = ["https://example.org/1"]
rules = ["cover.inside"]
relations = ["same-twice", { scissor-tiles = [3, 5] }]
[target]
size = [24, 20]
samples = 4
sample_locations = [[0, 3], [15, 1], [7, 7], [4, 12]]
depth = "d16-unorm"
depth_clear = 0.75
depth_resolve = "min"
resolve = "average"
[target.color]
format = "rgba16-float"
clear = [0.1, 0.2, 0.3, 1]
[[draw]]
vertices = [[0,0,0.25],[8.125,0.5,0.5],[1,15,0.75], [3,3,0.1,1.5],[9.3,3.7,0.1,2.5],[4.4,9.9,0.2,0.7]]
scissor = [1, 2, 20, 17]
depth = { compare = "less", write = false, bias = { constant = 3.7, slope = 1 } }
color = { attribute = "attribute1", blend = { source = "src-alpha", alpha = { source = "one" } }, constants = [0.1, 0, 0, 0] }
[[draw.attribute]]
interpolation = "flat"
values = [1, 2, 3, 4, 5, 6]
[[draw.attribute]]
auxiliary = "sample"
values = [[0.3, 0.7], [1, 0], [0, 1], [0.1, 0.1], [0.2, 0.2], [3, 4]]
[[draw.attribute]]
probe = "at-sample"
sample = 3
constant = [0.5, 0.25]
[[draw.clip_distance]]
plane = "x+2*y-1/3"
[[draw.cull_distance]]
values = [1, -1, 1, 1, "1/3", 1]
negate = true
[[draw]]
space = "clip"
topology = "triangle-strip"
vertices = [[-0.75,-0.75,0,1],[0.5,-0.5,0.25,1],[-0.25,0.5,0.5,1],[0.75,0.75,0,1],[1.5,0.75,3,2]]
indices = [0, 1, 2, 3, "restart", 1, 2, 3, 4, "restart", 2, 3, 4]
cull = "back"
front_face = "clockwise"
color = { value = [0.7, 0, 0, 1], write_mask = "rg" }
viewport = { rect = [1.5, 2, 20.25, 16], depth = [0.1, 0.9] }
[[draw]]
space = "ndc"
topology = "triangle-fan"
vertices = [[0,0],[-0.5,-0.75],[0.5,-0.75],[0.75,0.5],[-0.75,0.5]]
color = { value = [1, 0, 0, 1] }
sample_mask = 7
shader_mask = 3
provoking = "last"
[[draw]]
vertices = [[2,2],[20,3],[4,18],[19,19]]
indices = [0, 1, 2, 1, 2, 3, 0, 2, 3]
color = { value = [1, 0, 0, 1] }
rasterizer_discard = true
[[draw.attribute]]
source = "sample-id"
)";

}  // namespace fuzz
