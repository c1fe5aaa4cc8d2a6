// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Of generate.
#include "load_errors.hpp"

namespace cases {

namespace {

// clang-format off
const Row kGeneratorsRows[] = {
    {generator(R"~()~"),
     R"~(f:7:12: error: generate has no kind; write "grid", "fan", "strip", "mesh", "triangles" or "surface")~"},
    {generator(R"~(kind = "gird")~"),
     R"~(f:7:21: error: kind is "gird"; did you mean "grid"?)~"},
    {generator(R"~(kind = "grid")~"),
     R"~(f:7:12: error: generate has no columns; write an integer
f:7:12: error: generate has no rows; write an integer)~"},
    {generator(R"~(kind = "grid", columns = 0, rows = 1)~"),
     R"~(f:7:39: error: columns is not an integer from 1 to 4096)~"},
    {generator(R"~(kind = "grid", columns = 4, rows = 4, jiter = 1)~"),
     R"~(f:7:52: error: the generator "grid" has no key "jiter"; did you mean "jitter"?)~"},
    {generator(R"~(kind = "grid", columns = 4, rows = 4, jitter = 1)~"),
     R"~(f:7:61: error: jitter and rounding reach half a cell; make jitter smaller, grid finer or cells larger)~"},
    {generator(R"~(kind = "grid", columns = 4, rows = 4, jitter = -1)~"),
     R"~(f:7:61: error: jitter is negative)~"},
    {generator(R"~(kind = "grid", columns = 4096, rows = 4096)~"),
     R"~(f:7:39: error: 16785409 vertices are too many; a draw has at most 1048576)~"},
    {generator(R"~(kind = "grid", columns = 4, rows = 4, from = [8,8], to = [0,0])~"),
     R"~(f:7:71: error: to is not right of and below from)~"},
    {generator(R"~(kind = "grid", columns = 4, rows = 4, from = [8])~"),
     R"~(f:7:59: error: from has 1 number instead of 2)~"},
    {generator(R"~(kind = "grid", columns = 4, rows = 4, to = ["2^30",1])~"),
     R"~(f:7:57: error: to is more than 2^24 pixels away)~"},
    {generator(R"~(kind = "grid", columns = 4, rows = 4, diagonal = "left")~"),
     R"~(f:7:63: error: diagonal is "left"; write "down", "up" or "random")~"},
    {generator(R"~(kind = "grid", columns = 4, rows = 4, shuffle = 1)~"),
     R"~(f:7:62: error: shuffle is the number 1; write true or false)~"},
    {generator(R"~(kind = "grid", columns = 4, rows = 4, w = [0,1])~"),
     R"~(f:7:56: error: w is not [low, high] in multiples of 1/256 with 1/256 <= low <= high <= 65536)~"},
    {generator(R"~(kind = "grid", columns = 4, rows = 4, seed = 0.5)~"),
     R"~(f:7:59: error: seed is not an integer from 0 to 9223372036854775807)~"},
    {generator(R"~(kind = "grid", columns = 8, rows = 8, grid = 1)~"),
     R"~(f:7:12: error: jitter and rounding reach half a cell; make jitter smaller, grid finer or cells larger)~"},
    {generator(R"~(kind = "grid", columns = 4, rows = 4, w = 1)~"),
     R"~(f:7:56: error: w is the number 1; write an array of 2 numbers)~"},
    {generator(R"~(kind = "fan")~"),
     R"~(f:7:12: error: generate has no center; write [x, y]
f:7:12: error: generate has no radius; write a number of pixels
f:7:12: error: generate has no count; write an integer)~"},
    {generator(R"~(kind = "fan", center = [4,4])~"),
     R"~(f:7:12: error: generate has no radius; write a number of pixels
f:7:12: error: generate has no count; write an integer)~"},
    {generator(R"~(kind = "fan", center = [4,4], radius = 3, count = 2)~"),
     R"~(f:7:64: error: count is not an integer from 3 to 1048574)~"},
    {generator(R"~(kind = "fan", center = [4,4], radius = 3, count = 200, grid = 1)~"),
     R"~(f:7:64: error: triangle 0 of the fan has no area; make count smaller, radius larger or grid finer)~"},
    {generator(R"~(kind = "strip")~"),
     R"~(f:7:12: error: generate has no count; write an integer)~"},
    {generator(R"~(kind = "strip", count = 20, jitter = 3)~"),
     R"~(f:7:51: error: triangle 2 of the strip folds over; make jitter or count smaller)~"},
    {generator(R"~(kind = "mesh")~"),
     R"~(f:7:12: error: generate has no points; write an integer)~"},
    {generator(R"~(kind = "mesh", points = 10, from = ["1/3",0])~"),
     R"~(f:7:49: error: from and to are not multiples of 1/256, so the mesh could not fill the rectangle)~"},
    {generator(R"~(kind = "mesh", points = 100, grid = 1)~"),
     R"~(f:7:38: error: there are more points than half of the grid's; ask for fewer)~"},
    {generator(R"~(kind = "mesh", points = 1, grid = 65536, to = [65536,1])~"),
     R"~(f:7:48: error: the rectangle has more than 67108864 grid steps a side; make it smaller or grid coarser)~"},
    {generator(R"~(kind = "triangles")~"),
     R"~(f:7:12: error: generate has no count; write an integer)~"},
    {generator(R"~(kind = "triangles", count = 4097, class = "huge")~"),
     R"~(f:7:42: error: count is not an integer from 1 to 4096)~"},
    {generator(R"~(kind = "triangles", count = 65537, class = "tiny")~"),
     R"~(f:7:42: error: count is not an integer from 1 to 65536)~"},
    {generator(R"~(kind = "surface", shape = "disc", columns = 600000 }
[[draw]]
generate = { kind = "surface", shape = "disc", columns = 600000)~"),
     R"~(f:8:1: error: the draws up to this one have 1200002 vertices and 3600000 indices; the most are 1048576 and 4194304 in a case)~"},
    {generator(R"~(kind = "triangles", count = 1, class = "offgrid")~"),
     R"~(f:7:53: error: class is "offgrid"; did you mean "off-grid"?)~"},
    {generator(R"~(kind = "triangles", count = 1, to = ["1/256", 1])~"),
     R"~(f:7:50: error: the rectangle is smaller than two grid steps; make it larger)~"},
    {generator(R"~(kind = "triangles", count = 1, grid = 65536, to = [65536, 65536])~"),
     R"~(f:7:52: error: the rectangle has too many grid steps; make it smaller or grid coarser)~"},
};
// clang-format on

}  // namespace

TEST(LoadErrors, OfGenerators) {
    expect_words(kGeneratorsRows);
}

}  // namespace cases
