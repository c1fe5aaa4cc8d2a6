// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Of [target].
#include "load_errors.hpp"

namespace cases {

namespace {

// clang-format off
const Row kTargetsRows[] = {
    {target(R"~(size = [8, 8]
stencil_load = "load")~"),
     R"~(f:6:16: error: the target has no such attachment; leave out stencil_load)~"},
    {target(R"~(size = [8, 8]
depth_load = "lode")~"),
     R"~(f:6:14: error: depth_load is "lode"; write "clear", "load", "dont-care" or "none")~"},
    {target(R"~(size = [8, 8]
depth_store = "none")~"),
     R"~(f:6:15: error: depth_store = "none" keeps what an earlier pass has left, if nothing is written; write depth_load = "load", and draws that write none of it)~"},
    {target(R"~(size = [8, 8]
stencil = true
stencil_load = "load"
stencil_store = "none")~"),
     R"~(f:8:17: error: stencil_store = "none" keeps what an earlier pass has left, if nothing is written; write stencil_load = "load", and draws that write none of it)~"},
    {target(R"~(size = [8, 8]
depth_load = "none")~"),
     R"~(f:6:14: error: depth_load = "none" leaves contents that nothing may test nor store; write depth_store = "none", and no test of it)~"},
    {target(R"~(size = [8, 8]
color = { format = "rgba8-unorm", load = "load", store = "none" })~"),
     R"~(f:7:1: error: [[draw]] has no color, but the target has; write color = { value = [r, g, b, a] }
f:6:58: error: store = "none" keeps what an earlier pass has left, if nothing is written; write load = "load", and draws that write none of it)~"},
    {target(R"~(size = [8, 8]
samples = 4
resolve = "average"
color = { format = "rgba8-unorm", store = "dont-care" })~"),
     R"~(f:7:11: error: resolve is judged by the samples, which are not stored; leave out one of the two)~"},
    {target(R"~(size = [8, 8]
attachments = "color"
color = { format = "rgba8-unorm" }
depth_store = "dont-care")~"),
     R"~(f:8:15: error: the target has no such attachment; leave out depth_store)~"},
    {target(R"~(samples = 1)~"),
     R"~(f:4:1: error: [target] has no size; write size = [width, height])~"},
    {target(R"~(size = 8)~"),
     R"~(f:5:8: error: size is the number 8; write an array)~"},
    {target(R"~(size = [8])~"),
     R"~(f:5:8: error: size has 1 number; write [width, height])~"},
    {target(R"~(size = [0, 8])~"),
     R"~(f:5:9: error: the target's width is not an integer from 1 to 16384)~"},
    {target(R"~(size = [8, 16385])~"),
     R"~(f:5:12: error: the target's height is not an integer from 1 to 16384)~"},
    {target(R"~(size = [8, 2.5])~"),
     R"~(f:5:12: error: the target's height is not an integer from 1 to 16384)~"},
    {target(R"~(size = [16384, 16384])~"),
     R"~(f:5:8: error: the target has more than 2^24 samples; make it smaller)~"},
    {target(R"~(size = [8, 8]
samples = 6)~"),
     R"~(f:6:11: error: 6 samples have no standard locations; write 1, 2, 4, 8 or 16)~"},
    {target(R"~(size = [8, 8]
samples = 32)~"),
     R"~(f:6:11: error: samples is not an integer from 1 to 16)~"},
    {target(R"~(size = [8, 8]
layers = 0)~"),
     R"~(f:6:10: error: layers is not an integer from 1 to 256)~"},
    {target(R"~(size = [8, 8]
layers = 257)~"),
     R"~(f:6:10: error: layers is not an integer from 1 to 256)~"},
    {target(R"~(size = [8, 8]
layers = "two")~"),
     R"~(f:6:10: error: layers: "two" is not a number: the name two is unknown; names are the keys of [matrix])~"},
    {target(R"~(size = [8, 8]
layer = 2)~"),
     R"~(f:6:1: error: [target] has no key "layer"; did you mean "layers"?)~"},
    {target(R"~(size = [4096, 4096]
layers = 5)~"),
     R"~(f:5:8: error: the target has more than 2^24 samples; make it smaller)~"},
    {target(R"~(size = [8, 8]
samples = 4
stencil_resolve = "min")~"),
     R"~(f:7:19: error: stencil_resolve needs a stencil; write stencil = true)~"},
    {target(R"~(size = [8, 8]
samples = 4
stencil = true
stencil_resolve = "average")~"),
     R"~(f:8:19: error: Vulkan has no average of stencils; write sample-zero, min or max)~"},
    {target(R"~(size = [8, 8]
samples = 4
depth_resolve = "min"
depth_store = "dont-care")~"),
     R"~(f:7:17: error: depth_resolve is judged by the samples, which are not stored; leave out one of the two)~"},
    {"relations = [\"same-twice\"]\n" + target(R"~(size = [8, 8]
depth_load = "dont-care")~"),
     R"~(f:1:14: error: the relation same-twice does not go with contents that are not loaded, since each rendering may have other ones; leave it out)~"},
    {target(R"~(size = [8, 8]
stencil = true
stencil_resolve = "max")~"),
     R"~(f:7:19: error: stencil_resolve needs several samples; write samples = 4)~"},
    {target(R"~(size = [8192, 8192]
samples = 2)~"),
     R"~(f:5:8: error: the target has more than 2^24 samples; make it smaller)~"},
    {target(R"~(size = [8, 8]
samples = 2
sample_locations = [[1, 2]])~"),
     R"~(f:7:20: error: sample_locations has 1 pair for 2 samples; write one [x, y] a sample)~"},
    {target(R"~(size = [8, 8]
samples = 2
sample_locations = [[1, 2], [3]])~"),
     R"~(f:7:29: error: a sample location has 1 number; write [x, y] in sixteenths of a pixel)~"},
    {target(R"~(size = [8, 8]
samples = 2
sample_locations = [[1, 2], [16, 0]])~"),
     R"~(f:7:30: error: a sample location is not an integer from 0 to 15)~"},
    {target(R"~(size = [8, 8]
samples = 2
sample_locations = [[1, 2], [3, 4]]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
[[draw.attribute]]
source = "sample-position")~"),
     R"~(f:11:10: error: gl_SamplePosition has no value in a target with sample_locations; write source = "sample-id", or leave sample_locations out)~"},
    {target(R"~(size = [8, 8]
sample_locations = 3)~"),
     R"~(f:6:20: error: sample_locations is the number 3; write an array)~"},
    {target(R"~(size = [8, 8]
sample = 1)~"),
     R"~(f:6:1: error: [target] has no key "sample"; did you mean "samples"?)~"},
    {target(R"~(size = [8, "x"])~"),
     R"~(f:5:12: error: the target's height: "x" is not a number: the name x is unknown; names are the keys of [matrix])~"},
    {target(R"~(size = [8, true])~"),
     R"~(f:5:12: error: the target's height is true; write a number or an expression in quotes)~"},
    {target("size = [8, 8]\ndepth = \"d32\""),
     R"~(f:6:9: error: depth is "d32"; write "d32-float", "d24-unorm" or "d16-unorm")~"},
    {target("size = [8, 8]\ndepth = 32"),
     R"~(f:6:9: error: depth is the number 32; write a string)~"},
    {target("size = [8, 8]\ndepth_clear = 1.5"),
     R"~(f:6:15: error: depth_clear is outside 0..1, which Vulkan does not allow)~"},
    {target("size = [8, 8]\nresolve = \"mean\""),
     R"~(f:6:11: error: resolve is "mean"; write "none", "sample-zero", "average", "min" or "max")~"},
    {target("size = [8, 8]\ndepth_resolve = \"min\""),
     R"~(f:6:17: error: depth_resolve needs several samples; write samples = 4)~"},
    {target("size = [8, 8]\nsamples = 4\nresolve = \"average\""),
     R"~(f:7:11: error: resolve needs a colour target; write [target.color])~"},
    {target("size = [8, 8]\nsamples = 4\nresolve = \"min\"\ncolor = { format = \"r32-uint\" }"),
     R"~(f:7:11: error: Vulkan resolves colours of integers by sample-zero and all others by average; write that one)~"},
    {target("size = [8, 8]\nsamples = 4\nresolve = \"sample-zero\"\ncolor = { format = \"rgba8-unorm\" }"),
     R"~(f:7:11: error: Vulkan resolves colours of integers by sample-zero and all others by average; write that one)~"},
    {target("size = [8, 8]\nsamples = 4\ndepth_resolve = \"min\"\nattachments = \"color\"\ncolor = { format = \"r32-uint\" }"),
     R"~(f:7:17: error: depth_resolve needs a depth attachment; leave out attachments)~"},
    {target("size = [8, 8]\nstencil = 1"),
     R"~(f:6:11: error: stencil is the number 1; write true or false)~"},
    {target("size = [8, 8]\nstencil_clear = 1"),
     R"~(f:6:17: error: the target has no stencil; write stencil = true)~"},
    {target("size = [8, 8]\nstencil = true\nstencil_clear = 256"),
     R"~(f:7:17: error: stencil_clear is not an integer from 0 to 255)~"},
};
// clang-format on

}  // namespace

TEST(LoadErrors, OfTargets) {
    expect_words(kTargetsRows);
}

}  // namespace cases
