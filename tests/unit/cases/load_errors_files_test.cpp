// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Of the file as a whole and its top.
#include "load_errors.hpp"

namespace cases {

namespace {

// clang-format off
const Row kFilesRows[] = {
    {whole(R"~(format = 
)~"),
     R"~(f:1:10: error: this is not TOML: Error while parsing key-value pair: expected value, saw '\n')~"},
    {whole(R"~(format = 1
format = 1
)~"),
     R"~(f:2:10: error: this is not TOML: Error while parsing key-value pair: cannot redefine existing integer 'format')~"},
    {whole(R"~(x = "a
)~"),
     R"~(f:1:7: error: this is not TOML: Error while parsing string: unescaped control characters other than TAB (U+0009) are explicitly prohibited)~"},
    {whole(R"~(x = 99999999999999999999
)~"),
     R"~(f:1:25: error: this is not TOML: Error while parsing decimal integer: '99999999999999999999' is not representable in 64 bits)~"},
    // An expression, or a word, without quotes.
    {whole("v = [[1,1], [16, 8.5+up/256], [1,7]]\n"),
     "f:1:21: error: this is not TOML: Error while parsing floating-point: expected decimal digit "
     "or '.', saw '+'; write it in quotes: \"8.5+up/256\""},
    {whole("x = 1\nv = 2 * k # twice\n"),
     R"~(f:2:7: error: this is not TOML: Error while parsing key-value pair: expected a comment or whitespace, saw '*'; write it in quotes: "2 * k")~"},
    {whole("v = [\n  16-k/2,\n]\n"),
     R"~(f:2:5: error: this is not TOML: Error while parsing date: expected 4-digit year, saw '-'; write it in quotes: "16-k/2")~"},
    {whole("v = [k, 3]\n"),
     R"~(f:1:6: error: this is not TOML: Error while parsing value: could not determine value type; write it in quotes: "k")~"},
    {whole("v = [(k+1)/2, 3]\n"),
     R"~(f:1:6: error: this is not TOML: Error while parsing value: could not determine value type; write it in quotes: "(k+1)/2")~"},
    {whole("v = [-k, 3]\n"),
     R"~(f:1:6: error: this is not TOML: Error while parsing value: could not determine value type; write it in quotes: "-k")~"},
    {whole("topology = triangle-strip\n"),
     R"~(f:1:14: error: this is not TOML: Error while parsing boolean: expected 'true', saw 'tri'; write it in quotes: "triangle-strip")~"},
    {whole("v = [8 8]\n"),
     R"~(f:1:8: error: this is not TOML: Error while parsing array: expected comma or closing ']', saw '8')~"},
    {whole("v = [1.2.3]\n"),
     R"~(f:1:9: error: this is not TOML: Error while parsing floating-point: expected decimal digit or exponent, saw '.')~"},
    // Files that break an assertion of the parser, or reach what it takes for unreachable.
    {whole("[=\n"), "f:1:1: error: this is not TOML: a key or a value is missing in this line"},
    {whole("format = 1\n\nv=[3,}\n[target]\n"),
     "f:3:1: error: this is not TOML: a key or a value is missing in this line"},
    {whole("x = 1 \u029c\n"),
     "f:1:7: error: this is not TOML: Error while parsing key-value pair: expected a comment or "
     "whitespace, saw '\u029c'"},
    {whole(R"~(x = [[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]
)~"),
     R"~(f:1:37: error: the file nests arrays and tables too deeply; at most 32 levels are read)~"},
    {whole(R"~(description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:1:1: error: the key format is missing; write format = 1)~"},
    {whole(R"~(format = 2
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:1:10: error: format is not 1, the only one that is read)~"},
    {whole(R"~(format = 1
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:1:1: error: the key description is missing; say in one sentence what is claimed)~"},
    {whole(R"~(format = 1
description = " "
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:2:15: error: description is empty; write a sentence)~"},
    {whole(R"~(format = 1
description = 3
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:2:15: error: description is the number 3; write a string)~"},
    {whole(R"~(format = 1
description = "d"
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:1:1: error: the key rules is missing; name at least one rule of docs/rules.md)~"},
    {whole(R"~(format = 1
description = "d"
rules = []
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:3:9: error: rules is empty, so the case claims nothing; name at least one rule of docs/rules.md)~"},
    {whole(R"~(format = 1
description = "d"
rules = "cover.inside"
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:3:9: error: rules is the string "cover.inside"; write an array)~"},
    {whole(R"~(format = 1
description = "d"
rules = [1]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:3:10: error: a rule is the number 1; write a string)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.insid"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:3:10: error: no rule is called "cover.insid"; did you mean "cover.inside"?)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["discard.test", "tie.topleft", "covr.inside", "wrong"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:3:10: error: no rule is called "discard.test"; there are discard.rasterizer, discard.fragment, discard.value, discard.early-tests
f:3:26: error: no rule is called "tie.topleft"; did you mean "tie.top-left"?
f:3:41: error: no rule is called "covr.inside"; did you mean "cover.inside"?
f:3:56: error: no rule is called "wrong"; docs/rules.md lists all)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["quality"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:3:10: error: no rule is called "quality"; docs/rules.md lists all)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside", "cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:3:26: error: the rule "cover.inside" stands twice)~"},
    {top(R"~(catches = "")~"),
     R"~(f:4:11: error: catches is empty; write a sentence)~"},
    {top(R"~(catches = [1])~"),
     R"~(f:4:11: error: catches is an array; write a string)~"},
    {top(R"~(links = "https://x")~"),
     R"~(f:4:9: error: links is the string "https://x"; write an array)~"},
    {top(R"~(links = ["ftp://x"])~"),
     R"~(f:4:10: error: the link "ftp://x" does not start with https://)~"},
    {top(R"~(links = [1979-05-27])~"),
     R"~(f:4:10: error: a link is a date or time; write a string)~"},
    {top(R"~(catchs = "x")~"),
     R"~(f:4:1: error: a case file has no key "catchs"; did you mean "catches"?)~"},
    {top(R"~(zzz = 1)~"),
     R"~(f:4:1: error: a case file has no key "zzz"; its keys are format, description, catches, rules, links, leaves, relations, matrix, fuzz, target, blit, draw, expect)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:1:1: error: the key target is missing; write [target] with size = [width, height])~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
target = 1
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:4:10: error: target is the number 1; write a table)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
)~"),
     R"~(f:1:1: error: the key draw is missing; write [[draw]] with vertices)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
[draw]
vertices = []
)~"),
     R"~(f:6:1: error: draw is not an array of tables; write [[draw]])~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
draw = []
[target]
size = [8, 8]
)~"),
     R"~(f:4:8: error: a case has 1 to 256 draws, not 0)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
draw = [1]
[target]
size = [8, 8]
)~"),
     R"~(f:4:9: error: draw is the number 1; write a table)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
layers = 3
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
layer = 3
)~"),
     R"~(f:9:9: error: the target has 3 layers, 0 to 2)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
layers = 2
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
[[draw.clip_distance]]
values = [1, 1, -1]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
layer = 1
)~"),
     R"~(f:9:1: error: clip_distance does not go with draws to several layers; leave out layer)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
[[draw.cull_distance]]
values = [1, 1, -1]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
viewport_index = 1
)~"),
     R"~(f:8:1: error: cull_distance does not go with draws to several viewports; leave out viewport_index)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["blit.nearest"]
[target]
size = [8, 8]
layers = 2
[target.color]
format = "rgba8-unorm"
[blit]
size = [8, 8]
)~"),
     R"~(f:9:1: error: a blit writes to one sample a pixel and to one layer)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
layers = 2
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
[expect]
hits = "11"
)~"),
     R"~(f:10:8: error: the target has 2 layers, so hits is an array of 2 pictures, layer 0 first)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
samples = 4
layers = 2
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
[expect]
hits = ["11", "11"]
)~"),
     R"~(f:11:8: error: the target has 2 layers of 4 samples a pixel, so hits is an array of 8 pictures, all samples of layer 0 first)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 4]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
rotate = 90
)~"),
     R"~(f:8:10: error: rotate by 90 or 270 needs a square target; make its sides equal)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
samples = 2
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
[expect]
hits = "11"
)~"),
     R"~(f:10:8: error: the target has 2 samples a pixel, so hits is an array of 2 pictures, sample 0 first)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
samples = 2
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
[expect]
hits = ["11", "111"]
)~"),
     R"~(f:10:15: error: row 0 of picture 1 of hits has 3 characters, but the target is 2 pixels wide)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
samples = 2
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
sample_mask = -1
)~"),
     R"~(f:9:15: error: sample_mask is not an integer from 0 to 4294967295)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
shader_mask = 0.5
)~"),
     R"~(f:8:15: error: shader_mask is not an integer from 0 to 4294967295)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
conservative_extra = 0.5
)~"),
     R"~(f:8:22: error: conservative_extra enlarges what is overestimated; write conservative = "overestimate", or leave it out)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
conservative = "overestimate"
conservative_extra = 5
)~"),
     R"~(f:9:22: error: conservative_extra is outside 0..4; write by how many pixels the triangles are enlarged)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
conservative = "overestimated"
)~"),
     R"~(f:8:16: error: conservative is "overestimated"; did you mean "overestimate"?)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
conservative = "underestimate"
[[draw.clip_distance]]
constant = 1
)~"),
     R"~(f:8:16: error: conservative does not go with clip and cull distances; leave out one of them)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
conservative = "overestimate"
[[draw.attribute]]
constant = 1
auxiliary = "centroid"
)~"),
     R"~(f:8:16: error: conservative does not go with centroid inputs and probes; leave out one of them)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
discard_by = "demote"
)~"),
     R"~(f:8:14: error: discard_by without discard means nothing; leave it out)~"},
    {triangle(R"~(discard = "front"
discard_attribute = "a")~"),
     R"~(f:9:21: error: discard_attribute needs discard = "negative"; leave it out)~"},
    {triangle(R"~(discard = "negative")~"),
     R"~(f:8:11: error: discard = "negative" needs an attribute whose values it tests; write [[draw.attribute]])~"},
    {triangle(R"~(discard = "negative"
discard_attribute = "b"
[[draw.attribute]]
name = "a"
constant = 1)~"),
     R"~(f:9:21: error: discard_attribute is "b"; write "a")~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
samples = 4
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
shader_mask = 1
discard = "checker"
)~"),
     R"~(f:10:11: error: a shader that discards has plain values and writes no gl_SampleMask here; leave out discard, or every source, probe and shader_mask)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
samples = 4
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
discard = "front"
[[draw.attribute]]
source = "sample-mask-in"
)~"),
     R"~(f:9:11: error: a shader that discards has plain values and writes no gl_SampleMask here; leave out discard, or every source, probe and shader_mask)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [2, 1]
samples = 4
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
discard = "back"
[[draw.attribute]]
probe = "dfdx"
values = [1,2,3]
)~"),
     R"~(f:9:11: error: a shader that discards has plain values and writes no gl_SampleMask here; leave out discard, or every source, probe and shader_mask)~"},
    {triangle(R"~(min_sample_shading = 1.5)~"),
     R"~(f:8:22: error: min_sample_shading is outside 0..1; write the fraction of the samples that is shaded at least)~"},
    {whole(R"~(expect = 1
format = 1
description = "d"
rules = ["cover.inside"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
)~"),
     R"~(f:1:10: error: expect is the number 1; write a table)~"},
};
// clang-format on

}  // namespace

TEST(LoadErrors, OfFiles) {
    expect_words(kFilesRows);
}

}  // namespace cases
