// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Of [[draw.attribute]].
#include "load_errors.hpp"

namespace cases {

namespace {

// clang-format off
const Row kAttributesRows[] = {
    {draw(R"~(space = "clip"
vertices = [[0,0,0,1],[1,0,0,1],["nan",1,0,1]]
[[draw.attribute]]
plane = "x")~"),
     R"~(f:10:9: error: plane has no x and y at vertex 2, whose position is not finite)~"},
    {attribute(R"~()~"),
     R"~(f:8:1: error: [[draw.attribute]] has 0 of the keys values, constant, plane and from; write exactly one)~"},
    {attribute(R"~(values = [1,2,3]
constant = 1)~"),
     R"~(f:8:1: error: [[draw.attribute]] has 2 of the keys values, constant, plane and from; write exactly one)~"},
    {attribute(R"~(value = [1,2,3])~"),
     R"~(f:9:1: error: [[draw.attribute]] has no key "value"; did you mean "values"?
f:8:1: error: [[draw.attribute]] has 0 of the keys values, constant, plane and from; write exactly one)~"},
    {attribute(R"~(values = [1,2])~"),
     R"~(f:9:10: error: values has 2 entries for 3 vertices)~"},
    {attribute(R"~(values = 1)~"),
     R"~(f:9:10: error: values is the number 1; write an array)~"},
    {attribute(R"~(values = [[1,2],[1],[1]])~"),
     R"~(f:9:17: error: entry 1 of values has 1 components, the first has 2; write the same number everywhere)~"},
    {attribute(R"~(values = [[],[],[]])~"),
     R"~(f:9:11: error: 0 components are given; write 1 to 4)~"},
    {attribute(R"~(values = [[1,2,3,4,5],1,1])~"),
     R"~(f:9:11: error: 5 components are given; write 1 to 4)~"},
    {attribute(R"~(values = [1,2,"x"])~"),
     R"~(f:9:15: error: an attribute: "x" is not a number: the name x is unknown; names are the keys of [matrix])~"},
    {attribute(R"~(constant = "2^127")~"),
     R"~(f:9:12: error: an attribute is larger than 2^126; write a smaller number)~"},
    {attribute(R"~(constant = "bits(0x7f7fffff)")~"),
     R"~(f:9:12: error: an attribute is larger than 2^126; write a smaller number)~"},
    {attribute(R"~(constant = [])~"),
     R"~(f:9:12: error: 0 components are given; write 1 to 4)~"},
    {attribute(R"~(interpolation = "perspective"
constant = 1)~"),
     R"~(f:9:17: error: interpolation is "perspective"; write "smooth", "noperspective" or "flat")~"},
    {attribute(R"~(name = ""
constant = 1)~"),
     R"~(f:9:8: error: name is empty; leave it out or write a word)~"},
    {attribute(R"~(name = 1
constant = 1)~"),
     R"~(f:9:8: error: name is the number 1; write a string)~"},
    {attribute(R"~(plane = ["x","y","1","1","1"])~"),
     R"~(f:9:9: error: 5 components are given; write 1 to 4)~"},
    {attribute(R"~(plane = "1/x")~"),
     R"~(f:9:9: error: plane: "1/x" is not a number: it divides by zero)~"},
    {attribute(R"~(from = "baricentric")~"),
     R"~(f:9:8: error: from is "baricentric"; did you mean "barycentric"?)~"},
    {attribute(R"~(constant = 1
seed = 1)~"),
     R"~(f:10:8: error: seed goes with from = "random" only)~"},
    {attribute(R"~(from = "random"
seed = -1)~"),
     R"~(f:10:8: error: seed is not an integer from 0 to 9223372036854775807)~"},
    {attribute(R"~(from = "random"
components = 5)~"),
     R"~(f:10:14: error: components is not an integer from 1 to 4)~"},
    {attribute(R"~(from = "barycentric"
components = 4)~"),
     R"~(f:10:14: error: components is not an integer from 1 to 3)~"},
    {attribute(R"~(plane = "x"
components = 2)~"),
     R"~(f:10:14: error: components goes with from = "random" or "barycentric" only)~"},
    {attribute(R"~(name = "a"
constant = 1
[[draw.attribute]]
name = "a"
constant = 2)~"),
     R"~(f:11:1: error: two attributes are called a; rename one)~"},
    {attribute(R"~(constant = 1
auxiliary = "centre")~"),
     R"~(f:10:13: error: auxiliary is "centre"; did you mean "centroid"?)~"},
    {attribute(R"~(constant = 1
interpolation = "flat"
auxiliary = "sample")~"),
     R"~(f:11:13: error: a flat attribute is the same everywhere; leave auxiliary out)~"},
    {attribute(R"~(constant = 1
interpolation = "flat"
probe = "dfdx")~"),
     R"~(f:11:9: error: a flat attribute is the same everywhere; leave probe out)~"},
    {attribute(R"~(source = "vertices")~"),
     R"~(f:9:10: error: source is "vertices"; did you mean "vertex"?)~"},
    {attribute(R"~(source = "barycentric"
constant = 1)~"),
     R"~(f:10:12: error: constant goes with source = "vertex" only)~"},
    {attribute(R"~(source = "sample-id"
probe = "dfdx")~"),
     R"~(f:10:9: error: probe goes with source = "vertex" only)~"},
    {attribute(R"~(source = "sample-position"
interpolation = "flat")~"),
     R"~(f:10:17: error: interpolation goes with source = "vertex" or "barycentric" only)~"},
    {attribute(R"~(source = "sample-mask-in"
auxiliary = "centroid")~"),
     R"~(f:10:13: error: auxiliary goes with source = "vertex" or "barycentric" only)~"},
    {attribute(R"~(source = "barycentric"
interpolation = "flat")~"),
     R"~(f:9:10: error: source = "barycentric" is smooth or noperspective, never flat)~"},
    {attribute(R"~(constant = 1
probe = "ddx")~"),
     R"~(f:10:9: error: probe is "ddx"; did you mean "dfdx"?)~"},
    {attribute(R"~(constant = 1
probe = "at-offset")~"),
     R"~(f:8:1: error: probe = "at-offset" needs the key offset)~"},
    {attribute(R"~(constant = 1
offset = [0, 0])~"),
     R"~(f:10:10: error: offset goes with probe = "at-offset" only)~"},
    {attribute(R"~(constant = 1
probe = "at-offset"
offset = [0, 0.5])~"),
     R"~(f:11:14: error: the offset 0.5 lies outside of -0.5 to 0.4375, which is what every device has; write a smaller one)~"},
    {attribute(R"~(constant = 1
probe = "at-offset"
offset = [0])~"),
     R"~(f:11:10: error: offset has 1 number instead of 2)~"},
    {attribute(R"~(constant = 1
probe = "at-sample")~"),
     R"~(f:8:1: error: probe = "at-sample" needs the key sample)~"},
    {attribute(R"~(constant = 1
sample = 0)~"),
     R"~(f:10:10: error: sample goes with probe = "at-sample" only)~"},
    {attribute(R"~(constant = 1
probe = "at-sample"
sample = 1)~"),
     R"~(f:11:10: error: sample is not an integer from 0 to 0)~"},
    {attribute(R"~(constant = [1, 2]
probe = "query-lod")~"),
     R"~(f:8:1: error: probe = "query-lod" needs the key texture)~"},
    {attribute(R"~(constant = [1, 2]
texture = [4, 4])~"),
     R"~(f:10:11: error: texture goes with probe = "query-lod" only)~"},
    {attribute(R"~(constant = [1, 2]
probe = "query-lod"
texture = 4)~"),
     R"~(f:11:11: error: texture is the number 4; write an array)~"},
    {attribute(R"~(constant = [1, 2]
probe = "query-lod"
texture = [4])~"),
     R"~(f:11:11: error: texture has 1 number; write [width, height])~"},
    {attribute(R"~(constant = [1, 2]
probe = "query-lod"
texture = [4, 5000])~"),
     R"~(f:11:15: error: texture is not an integer from 1 to 4096)~"},
    {attribute(R"~(constant = 1
probe = "query-lod"
texture = [4, 4])~"),
     R"~(f:8:1: error: probe = "query-lod" looks up coordinates of 2 components; the attribute has 1)~"},
    {attribute(R"~(constant = [1, 2]
probe = "query-lod"
texture = [4, 4]
[[draw.attribute]]
constant = [1, 2]
probe = "query-lod"
texture = [4, 8])~"),
     R"~(f:12:1: error: two attributes of one draw look up different textures; write the same size or put them into two draws)~"},
    {attribute(R"~(source = "barycentric"
[[draw.attribute]]
source = "barycentric"
auxiliary = "sample")~"),
     R"~(f:10:1: error: two attributes of one draw place the same barycentric input differently; write the same auxiliary or put them into two draws)~"},
    {triangle(R"~(topology = "triangle-fan"
[[draw.attribute]]
from = "barycentric")~"),
     R"~(f:10:8: error: from = "barycentric" needs a triangle list without indices)~"},
    {draw(R"~(space = "clip"
vertices = [[0,0,0,1],[1,0,0,1],[0,1,0,0]]
[[draw.attribute]]
plane = "x")~"),
     R"~(f:10:9: error: plane has no x and y at vertex 2, whose w is 0)~"},
    {triangle(R"~(instances = 3
[[draw.attribute]]
divisor = 2
values = [1, 2, 3])~"),
     R"~(f:11:10: error: values has 3 entries for 2 elements, which the instances read)~"},
    {attribute("divisor = 17\nvalues = [1]"),
     R"~(f:9:11: error: divisor is not an integer from 0 to 16)~"},
    {attribute("divisor = 1\nplane = \"x\""),
     R"~(f:10:9: error: plane is of vertices, and the attribute has a divisor; write values or constant)~"},
    {attribute("divisor = 1\nfrom = \"random\""),
     R"~(f:10:8: error: from is of vertices, and the attribute has a divisor; write values or constant)~"},
    {attribute("divisor = 1\nsource = \"barycentric\""),
     R"~(f:9:11: error: a divisor is of values that are read; leave it or source out)~"},
};
// clang-format on

}  // namespace

TEST(LoadErrors, OfAttributes) {
    expect_words(kAttributesRows);
}

}  // namespace cases
