// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Every sentence the loader can say of a case file, with its place, word for word.
#include <gtest/gtest.h>

#include <string>

#include "cases/loader.hpp"

namespace cases {

namespace {

const std::string kHead = "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n";
const std::string kTarget = "[target]\nsize = [8, 8]\n";
const std::string kDraw = "[[draw]]\nvertices = [[0,0],[8,0],[0,8]]\n";

// A case file that is right but for `text`: all of it, its top, [target], [matrix] (two leaves for
// `leaves`), [[draw]], what follows a triangle, a generator or an attribute.
std::string whole(const std::string& text) {
    return text;
}
std::string top(const std::string& text) {
    return kHead + text + "\n" + kTarget + kDraw;
}
std::string target(const std::string& text) {
    return kHead + "[target]\n" + text + "\n" + kDraw;
}
std::string matrix(const std::string& text) {
    return kHead + "[matrix]\n" + text + "\n" + kTarget + kDraw;
}
std::string leaves(const std::string& text) {
    return kHead + "[matrix]\nk = [0, 1]\n" + kTarget + "[[draw]]\n" + text + "\n";
}
std::string draw(const std::string& text) {
    return kHead + kTarget + "[[draw]]\n" + text + "\n";
}
std::string triangle(const std::string& text) {
    return kHead + kTarget + kDraw + text + "\n";
}
std::string generator(const std::string& text) {
    return draw("generate = { " + text + " }");
}
std::string attribute(const std::string& text) {
    return triangle("[[draw.attribute]]\n" + text);
}

std::string errors_of(const std::string& toml) {
    const ExpectedAll<std::vector<Case>> loaded = load_text(toml, "f", "id");
    if (loaded) {
        return "no error";
    }
    std::string text;
    for (const Error& error : loaded.error()) {
        text += (text.empty() ? "" : "\n") + to_string(error);
    }
    return text;
}

struct Row {
    std::string toml;
    std::string errors;
};

// clang-format off
const Row kRows[] = {
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
     R"~(f:4:1: error: a case file has no key "zzz"; its keys are format, description, catches, rules, links, matrix, target, draw, blit, expect, relations)~"},
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
    {target(R"~(samples = 1)~"),
     R"~(f:4:1: error: [target] has no size; write size = [width, height])~"},
    {target(R"~(size = 8)~"),
     R"~(f:5:8: error: size is the number 8; write an array)~"},
    {target(R"~(size = [8])~"),
     R"~(f:5:8: error: size has 1 numbers; write [width, height])~"},
    {target(R"~(size = [0, 8])~"),
     R"~(f:5:9: error: the target's width is not an integer from 1 to 16384)~"},
    {target(R"~(size = [8, 16385])~"),
     R"~(f:5:12: error: the target's height is not an integer from 1 to 16384)~"},
    {target(R"~(size = [8, 2.5])~"),
     R"~(f:5:12: error: the target's height is not an integer from 1 to 16384)~"},
    {target(R"~(size = [16384, 16384])~"),
     R"~(f:5:8: error: the target has more than 2^26 pixels; make it smaller)~"},
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
     R"~(f:5:8: error: the target has more than 2^26 pixels; make it smaller)~"},
    {target(R"~(size = [8, 8]
samples = 4
layers = 2
resolve = "average"
[target.color]
format = "rgba8-unorm")~"),
     R"~(f:8:11: error: resolve does not go with several layers; leave out layers)~"},
    {target(R"~(size = [8, 8]
samples = 4
layers = 2
depth_resolve = "min")~"),
     R"~(f:8:17: error: depth_resolve does not go with several layers; leave out layers)~"},
    {target(R"~(size = [8192, 8192]
samples = 2)~"),
     R"~(f:5:8: error: the target has more than 2^26 samples; make it smaller)~"},
    {target(R"~(size = [8, 8]
samples = 2
sample_locations = [[1, 2]])~"),
     R"~(f:7:20: error: sample_locations has 1 entries for 2 sample(s); write one [x, y] a sample)~"},
    {target(R"~(size = [8, 8]
samples = 2
sample_locations = [[1, 2], [3]])~"),
     R"~(f:7:29: error: a sample location has 1 numbers; write [x, y] in sixteenths of a pixel)~"},
    {target(R"~(size = [8, 8]
samples = 2
sample_locations = [[1, 2], [16, 0]])~"),
     R"~(f:7:30: error: a sample location is not an integer from 0 to 15)~"},
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
    {matrix(R"~()~"),
     R"~(f:4:1: error: matrix is not a table of arrays; write [matrix] with key = [value, ...] or leave it out)~"},
    {matrix(R"~(k = 1)~"),
     R"~(f:5:5: error: the matrix key k has no array of values; write k = [value, ...])~"},
    {matrix(R"~(k = [])~"),
     R"~(f:5:5: error: the matrix key k has no array of values; write k = [value, ...])~"},
    {matrix(R"~(k = [1, 1])~"),
     R"~(f:5:9: error: the value 1 of the matrix key k stands twice)~"},
    {matrix(R"~(k = [[1]])~"),
     R"~(f:5:6: error: a value of the matrix key k is an array; write a number or a string)~"},
    {matrix(R"~(k = [inf])~"),
     R"~(f:5:6: error: a value of the matrix key k is not a finite number)~"},
    {matrix(R"~(k = ["a b"])~"),
     R"~(f:5:6: error: a value of the matrix key k has characters that an id cannot have; write letters, digits and +-./^())~"},
    {matrix(R"~("k-k" = [1])~"),
     R"~(f:5:1: error: the matrix key "k-k" is not a name; write letters, digits and _)~"},
    {matrix(R"~(k = [1])~"),
     R"~(f:5:1: error: the matrix key k is used nowhere; use it or leave it out)~"},
    {matrix(R"~(k = [1, 2]
j = [1,2])~"),
     R"~(f:5:1: error: the matrix key k is used nowhere; use it or leave it out
f:6:1: error: the matrix key j is used nowhere; use it or leave it out)~"},
    {top(R"~(matrix = 1)~"),
     R"~(f:4:10: error: matrix is not a table of arrays; write [matrix] with key = [value, ...] or leave it out)~"},
    {leaves(R"~(vertices = [[0,0],[8,0],["1/(1-k)",8]])~"),
     R"~(f:9:26: error: x of vertex 2: "1/(1-k)" is not a number: it divides by zero (in the leaf k=1))~"},
    {leaves(R"~(vertices = [[0,0],[8,0],["j",8]])~"),
     R"~(f:9:26: error: x of vertex 2: "j" is not a number: the name j is unknown; names are the keys of [matrix])~"},
    {leaves(R"~(vertices = [[0,0],[8,0],["kk",8]])~"),
     R"~(f:9:26: error: x of vertex 2: "kk" is not a number: the name kk is unknown; did you mean k?)~"},
    {leaves(R"~(vertices = [[0,0],[8,0],["k",8]]
[expect]
hits = "")~"),
     R"~(f:11:1: error: the matrix has no leaf "hits"; write [expect."k=0"])~"},
    {leaves(R"~(vertices = [[0,0],[8,0],["k",8]]
[expect."k=2"]
hits = "")~"),
     R"~(f:10:9: error: the matrix has no leaf "k=2"; did you mean "k=0"?)~"},
    {leaves(R"~(vertices = [[0,0],[8,0],["k",8]]
[expect]
"k=1" = 3)~"),
     R"~(f:11:9: error: the expectation of k=1 is the number 3; write a table)~"},
    {leaves(R"~(vertices = [[0,0],[8,0],["k",8]]
[expect."k=1"]
hits = "")~"),
     R"~(f:11:8: error: hits has 0 rows, but the target is 8 pixels high (in the leaf k=1))~"},
    {leaves(R"~(vertices = [[0,0],[8,0],[0,8]]
[[draw.attribute]]
plane = "q")~"),
     R"~(f:11:9: error: plane: "q" is not a number: the name q is unknown; names are the keys of [matrix])~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[matrix]
x = [0, 1]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],["x",8]]
[[draw.attribute]]
plane = "x"
)~"),
     R"~(f:11:9: error: plane cannot tell the matrix key x from the vertex's own x; rename the key)~"},
    {whole(R"~(format = 1
description = "d"
rules = ["cover.inside"]
[matrix]
c = ["none", "bakc"]
[target]
size = [8, 8]
[[draw]]
vertices = [[0,0],[8,0],[0,8]]
cull = "c"
)~"),
     R"~(f:10:8: error: cull is "bakc"; did you mean "back"? (in the leaf c=bakc))~"},
    {draw(R"~(vertexes = 1)~"),
     R"~(f:7:1: error: [[draw]] has no key "vertexes"; did you mean "vertices"?)~"},
    {draw(R"~(topology = "triangle-list")~"),
     R"~(f:6:1: error: [[draw]] has no vertices; write vertices or generate)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,8]]
generate = {})~"),
     R"~(f:6:1: error: [[draw]] has both vertices and generate; keep one)~"},
    {draw(R"~(vertices = 1)~"),
     R"~(f:7:12: error: vertices is the number 1; write an array)~"},
    {draw(R"~(vertices = [1,2,3])~"),
     R"~(f:7:13: error: vertex 0 is the number 1; write an array
f:7:15: error: vertex 1 is the number 2; write an array
f:7:17: error: vertex 2 is the number 3; write an array)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0]])~"),
     R"~(f:7:25: error: vertex 2 has 1 numbers; write [x,y], [x,y,z] or [x,y,z,w])~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,8,1,1,1]])~"),
     R"~(f:7:25: error: vertex 2 has 5 numbers; write [x,y], [x,y,z] or [x,y,z,w])~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,true]])~"),
     R"~(f:7:28: error: y of vertex 2 is true; write a number or an expression in quotes)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,nan]])~"),
     R"~(f:7:28: error: y of vertex 2 is not a finite number; inf and nan cannot be drawn)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[inf,0]])~"),
     R"~(f:7:26: error: x of vertex 2 is not a finite number; inf and nan cannot be drawn)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,"1/0"]])~"),
     R"~(f:7:28: error: y of vertex 2: "1/0" is not a number: it divides by zero)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,"inf"]])~"),
     R"~(f:7:28: error: y of vertex 2: "inf" is not a number: inf is no number here)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,"2^999"]])~"),
     R"~(f:6:1: error: y of vertex 2 is larger than the largest binary32 in clip space)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,8,0,0]])~"),
     R"~(f:7:32: error: w of vertex 2 is 0, which only the space "clip" can express)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,8]]
viewport_index = 16)~"),
     R"~(f:8:18: error: viewport_index is not an integer from 0 to 15)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,8]]
layer = 1)~"),
     R"~(f:8:9: error: the target has one layer; write layers = N in [target])~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,8]]
layer = -1)~"),
     R"~(f:8:9: error: layer is not an integer from 0 to 255)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,8]]
layers = 1)~"),
     R"~(f:8:1: error: [[draw]] has no key "layers"; did you mean "layer"?)~"},
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
    {draw(R"~(generate = { kind = "surface", columns = 4, rows = 4, shape = "disk" })~"),
     R"~(f:7:63: error: shape is "disk"; did you mean "disc"?)~"},
    {draw(R"~(generate = { kind = "surface", columns = 4, rows = 4 }
offset = [1, 1])~"),
     R"~(f:8:10: error: offset does not go with the generator "surface"; leave it out)~"},
    {draw(R"~(generate = { kind = "surface", columns = 4000, rows = 4000 })~"),
     R"~(f:7:42: error: 16008001 vertices are too many; a draw has at most 1048576)~"},
    {draw(R"~(vertices = [[0,0],[8,0]])~"),
     R"~(f:7:12: error: 2 vertices make no triangle; write at least 3)~"},
    {draw(R"~(vertices = [])~"),
     R"~(f:7:12: error: 0 vertices make no triangle; write at least 3)~"},
    {draw(R"~(space = "clip"
vertices = [[0,0,0,1],[0.1,0,0,1],[0,1,0,1]])~"),
     R"~(f:8:24: error: x of vertex 1 is not a binary32; its neighbours are "0x1.999998p-4" (0.099999994) and "0x1.99999ap-4" (0.1))~"},
    {draw(R"~(space = "clip"
vertices = [[0,0,0,1],[1,0,0,1],[0,1,0]])~"),
     R"~(f:8:33: error: vertex 2 has 3 numbers; write [x,y,z,w])~"},
    {draw(R"~(space = "clip"
vertices = [[0,0,0,1],["2^128",0,0,1],[0,1,0,1]])~"),
     R"~(f:8:24: error: x of vertex 1 is larger than the largest binary32)~"},
    {draw(R"~(space = "clip"
vertices = [[0,0,0,1],["bits(0x7fc)",0,0,1],[0,1,0,1]])~"),
     R"~(f:8:24: error: x of vertex 1: "bits(0x7fc)" is not the bits of a binary32; write eight hexadecimal digits as in "bits(0x7fc00001)")~"},
    {draw(R"~(space = "clip"
vertices = [[0,0,0,1],[1,0,0,1],["nan",1,0,1]]
[[draw.attribute]]
plane = "x")~"),
     R"~(f:10:9: error: plane has no x and y at vertex 2, whose position is not finite)~"},
    {draw(R"~(space = "ndc"
vertices = [[0,0],["nan",0],[0,1]])~"),
     R"~(f:8:20: error: x of vertex 1: "nan" is not a number: nan is no number here)~"},
    {draw(R"~(space = "ndc"
vertices = [[0,0],["1/3",0],[0,1]])~"),
     R"~(f:8:20: error: x of vertex 1 is not a binary32; its neighbours are "0x1.555554p-2" (0.3333333) and "0x1.555556p-2" (0.33333334))~"},
    {draw(R"~(space = "ndc"
vertices = [[0,0],["2^127",0,0,4],[0,1]])~"),
     R"~(f:6:1: error: x of vertex 1 is larger than the largest binary32 in clip space)~"},
    {draw(R"~(space = "screen"
vertices = [[0,0],[8,0],[0,8]])~"),
     R"~(f:7:9: error: space is "screen"; write "pixels", "ndc" or "clip")~"},
    {draw(R"~(space = 3
vertices = [[0,0],[8,0],[0,8]])~"),
     R"~(f:7:9: error: space is the number 3; write a string)~"},
    {draw(R"~(vertices = [[0,0,0,"2^-200"],[8,0],[0,8]])~"),
     R"~(f:6:1: error: w of vertex 0 is not a binary32 other than zero)~"},
    {draw(R"~(topology = "triangle-lists"
vertices = [[0,0],[8,0],[0,8]])~"),
     R"~(f:7:12: error: topology is "triangle-lists"; did you mean "triangle-list"?)~"},
    {triangle(R"~(cull = "both")~"),
     R"~(f:8:8: error: cull is "both"; write "none", "front", "back" or "front-and-back")~"},
    {triangle(R"~(front_face = "clockwse")~"),
     R"~(f:8:14: error: front_face is "clockwse"; did you mean "clockwise"?)~"},
    {triangle(R"~(indices = [0,1,3])~"),
     R"~(f:8:16: error: an index is not an integer from 0 to 2)~"},
    {triangle(R"~(indices = [0,1])~"),
     R"~(f:8:11: error: 2 indices make no triangle; write at least 3)~"},
    {triangle(R"~(indices = 0)~"),
     R"~(f:8:11: error: indices is the number 0; write an array)~"},
    {triangle(R"~(indices = [0,1,2,"restart"])~"),
     R"~(f:8:18: error: "restart" needs a strip or a fan; a list has no restart)~"},
    {triangle(R"~(indices = [0,1,"reset"])~"),
     R"~(f:8:16: error: an index: "reset" is not a number: the name reset is unknown; names are the keys of [matrix])~"},
    {triangle(R"~(indices = [0,1,-1])~"),
     R"~(f:8:16: error: an index is not an integer from 0 to 2)~"},
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
    {target("size = [8, 8]\nstencil = true\ndepth = \"d16-unorm\""),
     R"~(f:6:11: error: stencil is judged by the hit counter and lies beside d32-float; leave out attachments and depth)~"},
    {triangle(R"~(depth = "less")~"), R"~(f:8:9: error: depth is the string "less"; write a table)~"},
    {triangle(R"~(depth = { compair = "less" })~"),
     R"~(f:8:11: error: depth has no key "compair"; did you mean "compare"?)~"},
    {triangle(R"~(depth = { compare = "smaller" })~"),
     R"~(f:8:21: error: compare is "smaller"; write "never", "less", "equal", "less-or-equal", "greater", "not-equal", "greater-or-equal" or "always")~"},
    {triangle(R"~(depth = { write = 1 })~"),
     R"~(f:8:19: error: write is the number 1; write true or false)~"},
    {triangle(R"~(depth = { clamp = "yes" })~"),
     R"~(f:8:19: error: clamp is the string "yes"; write true or false)~"},
    {triangle(R"~(depth = { clip = 0 })~"),
     R"~(f:8:18: error: clip is the number 0; write true or false)~"},
    {triangle(R"~(depth = { bias = 2 })~"),
     R"~(f:8:18: error: bias is the number 2; write a table)~"},
    {triangle(R"~(depth = { bias = { scale = 2 } })~"),
     R"~(f:8:20: error: bias has no key "scale"; its keys are constant, slope, clamp, representation, exact)~"},
    {triangle(R"~(depth = { bias = { representation = "unorm" } })~"),
     R"~(f:8:37: error: representation is "unorm"; write "format", "force-unorm" or "float")~"},
    {triangle(R"~(depth = { bias = { slope = true } })~"),
     R"~(f:8:28: error: slope is true; write a number or an expression in quotes)~"},
    {triangle(R"~(viewport = [0,0,8])~"),
     R"~(f:8:12: error: viewport has 3 numbers instead of 4)~"},
    {triangle(R"~(viewport = 8)~"),
     R"~(f:8:12: error: viewport is the number 8; write an array of 4 numbers)~"},
    {triangle(R"~(viewport = [0,0,0,8])~"),
     R"~(f:8:17: error: the viewport's width is not larger than 0)~"},
    {triangle(R"~(viewport = [0,0,-8,8])~"),
     R"~(f:8:17: error: the viewport's width is not larger than 0)~"},
    {triangle(R"~(viewport = [0,0,8,0])~"),
     R"~(f:8:19: error: the viewport's height is 0; write another, negative ones flip)~"},
    {triangle(R"~(viewport = [0,0,16385,8])~"),
     R"~(f:8:12: error: the viewport is larger than 16384 pixels)~"},
    {triangle(R"~(viewport = [40000,0,8,8])~"),
     R"~(f:8:12: error: the viewport reaches beyond -32768..32767 pixels)~"},
    {triangle(R"~(viewport = [0,0,8,"2^200"])~"),
     R"~(f:8:19: error: viewport is larger than the largest binary32)~"},
    {triangle(R"~(viewport = { rect = [0,0,8,8], depth = [0,1.5] })~"),
     R"~(f:8:43: error: depth is outside 0..1, which Vulkan does not allow)~"},
    {triangle(R"~(viewport = { depth = [0] })~"),
     R"~(f:8:22: error: depth has 1 numbers instead of 2)~"},
    {triangle(R"~(viewport = { rct = [0,0,8,8] })~"),
     R"~(f:8:14: error: viewport has no key "rct"; did you mean "rect"?)~"},
    {triangle(R"~(scissor = [0,0,8])~"),
     R"~(f:8:11: error: scissor has 3 numbers instead of 4)~"},
    {triangle(R"~(scissor = [-1,0,8,8])~"),
     R"~(f:8:12: error: scissor is not an integer from 0 to 2147483647)~"},
    {triangle(R"~(scissor = [0,0,8.5,8])~"),
     R"~(f:8:16: error: scissor is not an integer from 0 to 2147483647)~"},
    {triangle(R"~(scissor = [2147483647,0,8,8])~"),
     R"~(f:8:11: error: the scissor rectangle reaches beyond 2^31 - 1 pixels)~"},
    {triangle(R"~(mirror = "z")~"),
     R"~(f:8:10: error: mirror is "z"; write "none", "x", "y" or "xy")~"},
    {triangle(R"~(rotate = 45)~"),
     R"~(f:8:10: error: rotate is not 0, 90, 180 or 270)~"},
    {triangle(R"~(rotate = "a quarter")~"),
     R"~(f:8:10: error: rotate: "a quarter" is not a number: the name a is unknown; names are the keys of [matrix])~"},
    {triangle(R"~(offset = [1])~"),
     R"~(f:8:10: error: offset has 1 numbers instead of 2)~"},
    {triangle(R"~(offset = [1,2,3])~"),
     R"~(f:8:10: error: offset has 3 numbers instead of 2)~"},
    {triangle(R"~(winding = "reverse")~"),
     R"~(f:8:11: error: winding is "reverse"; did you mean "reversed"?)~"},
    {triangle(R"~(first = 3)~"),
     R"~(f:8:9: error: first is not an integer from 0 to 2)~"},
    {triangle(R"~(order = 1)~"),
     R"~(f:8:9: error: order is the number 1; write a string)~"},
    {triangle(R"~(topology = "triangle-fan"
winding = "reversed")~"),
     R"~(f:9:11: error: winding needs a triangle list without indices)~"},
    {triangle(R"~(topology = "triangle-strip"
first = 1)~"),
     R"~(f:9:9: error: first needs a triangle list without indices)~"},
    {triangle(R"~(indices = [0,1,2]
order = "reversed")~"),
     R"~(f:9:9: error: order needs a triangle list without indices)~"},
    {draw(R"~(space = "clip"
vertices = [[0,0,0,1],[1,0,0,1],[0,1,0,1]]
rotate = 90)~"),
     R"~(f:9:10: error: rotate does not go with the space "clip"; write the vertices in pixels or ndc)~"},
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
    {triangle(R"~(attribute = 1)~"),
     R"~(f:8:13: error: attribute is the number 1; write an array)~"},
    {triangle(R"~(attribute = [1])~"),
     R"~(f:8:14: error: attribute is the number 1; write a table)~"},
    {triangle(R"~(attribute = [{constant=1},{constant=1},{constant=1},{constant=1},{constant=1}])~"),
     R"~(f:8:13: error: 5 attributes are too many; a draw has at most 4)~"},
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
     R"~(f:9:17: error: interpolation is "perspective"; did you mean "noperspective"?)~"},
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
     R"~(f:11:10: error: offset has 1 numbers instead of 2)~"},
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
     R"~(f:11:11: error: texture has 1 numbers; write [width, height])~"},
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
    {triangle(R"~([expect]
hits = """
........
""")~"),
     R"~(f:9:8: error: hits has 1 rows, but the target is 8 pixels high)~"},
    {triangle(R"~([expect]
hits = """
.......
.......
.......
.......
.......
.......
.......
.......
""")~"),
     R"~(f:9:8: error: row 0 of hits has 7 characters, but the target is 8 pixels wide)~"},
    {triangle(R"~([expect]
hits = """
........
........
........
........
........
........
........
....x...
""")~"),
     R"~(f:9:8: error: column 4 of row 7 of hits is not ., 1 to 9 or ?)~"},
    {triangle(R"~([expect]
hit = "")~"),
     R"~(f:9:1: error: [expect] has no key "hit"; did you mean "hits"?
f:8:1: error: [expect] has no hits; draw one row a pixel row)~"},
    {triangle(R"~([expect]
hits = 1)~"),
     R"~(f:9:8: error: hits is the number 1; write a string)~"},
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
min_sample_shading = 1.5
)~"),
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
    {draw(R"~(generate = 1)~"),
     R"~(f:7:12: error: generate is the number 1; write a table)~"},
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
     R"~(f:7:59: error: from has 1 numbers instead of 2)~"},
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
    {generator(R"~(kind = "triangles", count = 1, class = "offgrid")~"),
     R"~(f:7:53: error: class is "offgrid"; did you mean "off-grid"?)~"},
    {generator(R"~(kind = "triangles", count = 1, to = ["1/256", 1])~"),
     R"~(f:7:50: error: the rectangle is smaller than two grid steps; make it larger)~"},
    {generator(R"~(kind = "triangles", count = 1, grid = 65536, to = [65536, 65536])~"),
     R"~(f:7:52: error: the rectangle has too many grid steps; make it smaller or grid coarser)~"},
    {draw(R"~(space = "ndc"
generate = { kind = "mesh", points = 1 })~"),
     R"~(f:7:9: error: generate works in pixels; leave space out)~"},
    {draw(R"~(indices = [0,1,2]
generate = { kind = "mesh", points = 1 })~"),
     R"~(f:7:11: error: indices do not go with generate; leave them out)~"},
    {draw(R"~(topology = "triangle-fan"
generate = { kind = "mesh", points = 1 })~"),
     R"~(f:7:12: error: this generator makes a "triangle-list"; leave topology out)~"},
};
// clang-format on

std::string list(int count) {
    std::string text = "[0";
    for (int i = 1; i < count; ++i) {
        text += "," + std::to_string(i);
    }
    return text + "]";
}

}  // namespace

TEST(LoadErrors, AreTheseWords) {
    for (const Row& row : kRows) {
        EXPECT_EQ(errors_of(row.toml), row.errors) << row.toml;
    }
}

TEST(LoadErrors, OfLimits) {
    EXPECT_EQ(errors_of(matrix("a = " + list(65) + "\nb = " + list(64))),
              "f:4:1: error: the matrix has more than 4096 combinations; split the file");
    EXPECT_EQ(errors_of("#" + std::string(70000, ' ')),
              "f: error: the file has a line of more than 65536 bytes; break it");
    EXPECT_EQ(errors_of(std::string((size_t{4} << 20U) + 1, '\n')),
              "f: error: the file has 4194305 bytes, more than the 4 MiB of a case file; split it");
    std::string draws = kHead + kTarget;
    for (int i = 0; i < 257; ++i) {
        draws += kDraw;
    }
    EXPECT_EQ(errors_of(draws), "f:6:1: error: a case has 1 to 256 draws, not 257");
    EXPECT_EQ(errors_of(triangle("offset = [\"" + std::string(1025, '1') + "\", 0]")),
              "f:8:11: error: offset: an expression of 1025 characters is too long; at most 1024 "
              "are read");
}

TEST(LoadErrors, OfBytesThatAreNoText) {
    EXPECT_EQ(
        errors_of(std::string("format = 1\n\0\n", 13)).rfind("f:2:1: error: this is not TOML", 0),
        0U);
    EXPECT_EQ(
        errors_of("\xff\xfe" + std::string("f\0o\0", 4)).rfind("f:1:1: error: this is not TOML", 0),
        0U);
    EXPECT_NE(errors_of("").find("f:1:1: error: the key format is missing"), std::string::npos);
    // Deep nesting ends in an error, whatever makes it.
    EXPECT_NE(errors_of("a = " + std::string(60000, '[')).find("error"), std::string::npos);
    std::string dotted = "[a";
    for (int i = 0; i < 30000; ++i) {
        dotted += ".a";
    }
    EXPECT_NE(errors_of(dotted + "]").find("too deeply"), std::string::npos);
}

// Cutting a good file anywhere never crashes; and no cut before the last vertex is a good case.
TEST(LoadErrors, OfEveryCut) {
    const std::string good = triangle("cull = \"back\"\n[[draw.attribute]]\nplane = [\"x/8\", 1]");
    ASSERT_EQ(errors_of(good), "no error");
    const size_t vertices = good.find("]]\n", good.find("vertices"));
    for (size_t length = 0; length <= vertices; ++length) {
        EXPECT_NE(errors_of(good.substr(0, length)), "no error") << length;
    }
    for (size_t length = vertices; length < good.size(); ++length) {
        errors_of(good.substr(0, length));
    }
}

}  // namespace cases
