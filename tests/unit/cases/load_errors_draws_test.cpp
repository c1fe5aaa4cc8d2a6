// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Of [[draw]], its vertices and its state.
#include "load_errors.hpp"

namespace cases {

namespace {

// clang-format off
const Row kDrawsRows[] = {
    {draw(R"~(clear = {})~"),
     R"~(f:7:9: error: the clear clears nothing; write color, depth or stencil)~"},
    {draw(R"~(clear = { depth = 0.5, rects = [] })~"),
     R"~(f:7:32: error: a clear has 1 to 256 rectangles, not 0)~"},
    {draw(R"~(clear = { depth = 0.5, rects = [[0,0,0,8]] })~"),
     R"~(f:7:38: error: a rectangle is not an integer from 1 to 8)~"},
    {draw(R"~(clear = { depth = 0.5, rects = [[4,0,5,8]] })~"),
     R"~(f:7:33: error: a rectangle reaches beyond the target, which Vulkan forbids)~"},
    {draw(R"~(clear = { depth = 0.5, layers = 2 })~"),
     R"~(f:7:9: error: the clear reaches layer 1, and the target has 1)~"},
    {draw(R"~(clear = { depth = 1.5 })~"),
     R"~(f:7:19: error: depth is outside 0..1, which Vulkan does not allow)~"},
    {draw(R"~(clear = { stencil = 3 })~"),
     R"~(f:7:21: error: the target has no stencil; leave it out of the clear)~"},
    {draw(R"~(clear = { color = [0,0,0,0] })~"),
     R"~(f:7:19: error: the target has no color; leave it out of the clear)~"},
    {draw(R"~(clear = { depth = 0.5 }
scissor = [0,0,1,1])~"),
     R"~(f:8:1: error: a [[draw]] with clear has no key "scissor"; its keys are clear, layer)~"},
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
     R"~(f:7:25: error: vertex 2 has 1 number; write [x,y], [x,y,z] or [x,y,z,w])~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,8,1,1,1]])~"),
     R"~(f:7:25: error: vertex 2 has 5 numbers; write [x,y], [x,y,z] or [x,y,z,w])~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,true]])~"),
     R"~(f:7:28: error: y of vertex 2 is true; write a number or an expression in quotes)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,nan]])~"),
     R"~(f:7:28: error: y of vertex 2 is not a finite number; inf and nan may stand in positions of space "clip" and in attributes only)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[inf,0]])~"),
     R"~(f:7:26: error: x of vertex 2 is not a finite number; inf and nan may stand in positions of space "clip" and in attributes only)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,"1/0"]])~"),
     R"~(f:7:28: error: y of vertex 2: "1/0" is not a number: it divides by zero)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,"bits(0x7fc00001)"]])~"),
     R"~(f:7:28: error: y of vertex 2: "bits(0x7fc00001)" may stand in positions of space "clip" and in attributes only)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,"inf"]])~"),
     R"~(f:7:28: error: y of vertex 2: "inf" is not a number: inf is no number here)~"},
    {draw(R"~(vertices = [[0,0],[8,0],[0,"2^999"]])~"),
     R"~(f:7:25: error: y of vertex 2 is larger than the largest binary32 in clip space)~"},
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
    {draw(R"~(space = "ndc"
vertices = [[0,0],["nan",0],[0,1]])~"),
     R"~(f:8:20: error: x of vertex 1: "nan" is not a number: nan is no number here)~"},
    {draw(R"~(space = "ndc"
vertices = [[0,0],["1/3",0],[0,1]])~"),
     R"~(f:8:20: error: x of vertex 1 is not a binary32; its neighbours are "0x1.555554p-2" (0.3333333) and "0x1.555556p-2" (0.33333334))~"},
    {draw(R"~(space = "ndc"
vertices = [[0,0],["2^127",0,0,4],[0,1]])~"),
     R"~(f:8:19: error: x of vertex 1 is larger than the largest binary32 in clip space)~"},
    {draw(R"~(space = "screen"
vertices = [[0,0],[8,0],[0,8]])~"),
     R"~(f:7:9: error: space is "screen"; write "pixels", "ndc" or "clip")~"},
    {draw(R"~(space = 3
vertices = [[0,0],[8,0],[0,8]])~"),
     R"~(f:7:9: error: space is the number 3; write a string)~"},
    {draw(R"~(vertices = [[0,0,0,"2^-200"],[8,0],[0,8]])~"),
     R"~(f:7:13: error: w of vertex 0 is not a binary32 other than zero)~"},
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
    {triangle(R"~(indices = [0,1,"restart",2])~"),
     R"~(f:8:11: error: 2 indices make no triangle; write at least 3)~"},
    {triangle(R"~(indices = [0,1,"reset"])~"),
     R"~(f:8:16: error: an index: "reset" is not a number: the name reset is unknown; names are the keys of [matrix])~"},
    {triangle(R"~(indices = [0,1,-1])~"),
     R"~(f:8:16: error: an index is not an integer from 0 to 2)~"},
    {triangle(R"~(instances = 0)~"), R"~(f:8:13: error: instances is not an integer from 1 to 16)~"},
    {triangle(R"~(instances = 17)~"), R"~(f:8:13: error: instances is not an integer from 1 to 16)~"},
    {triangle(R"~(first_instance = 16)~"),
     R"~(f:8:18: error: first_instance is not an integer from 0 to 15)~"},
    {triangle(R"~(instances = 2
offsets = [[0,0,0,0]])~"),
     R"~(f:9:11: error: offsets has 1 entries for 2 instances)~"},
    {triangle(R"~(offsets = [[0,0]])~"),
     R"~(f:8:12: error: offsets has 2 numbers instead of 4)~"},
    {triangle(R"~(instances = 2
offsets = [[0,0,0,0],["1/16777216",0,0,0]])~"),
     R"~(f:9:11: error: of instance 1 no binary32 is the sum of a vertex and its offset, or one of the three is denormal; write rounder numbers)~"},
    {draw(R"~(space = "clip"
vertices = [[nan,0,0,1],[1,0,0,1],[0,1,0,1]]
instances = 2)~"),
     R"~(f:6:1: error: of instance 0 no binary32 is the sum of a vertex and its offset, or one of the three is denormal; write rounder numbers)~"},
    {draw(R"~(instances = 2
generate = { kind = "surface", columns = 9, rows = 9 })~"),
     R"~(f:7:13: error: instances does not go with the generator "surface"; leave it out)~"},
    {target("size = [8, 8]\nattachments = \"color\"\ncolor = { format = \"rgba8-unorm\" }") +
         "instances = 2\nmatrix = true\ncolor = { value = [0, 0, 0, 1], from = \"constant\" }\n",
     R"~(f:8:1: error: a draw of instances goes with no matrix, and with clip or cull distances, but not with both)~"},
    {triangle(R"~(instances = 2
[[draw.clip_distance]]
constant = 1
[[draw.cull_distance]]
constant = 1)~"),
     R"~(f:6:1: error: a draw of instances goes with no matrix, and with clip or cull distances, but not with both)~"},
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
    {target("size = [8, 8]\nattachments = \"color\"\ncolor = { format = \"rgba8-unorm\" }") +
         "query = \"occlusion\"\ncolor = { value = [0, 0, 0, 1] }\n",
     R"~(f:10:9: error: a query needs the attachments that count hits; leave attachments out of [target])~"},
    {triangle(R"~(query = "precise")~"),
     R"~(f:8:9: error: query is "precise"; write "none", "occlusion", "occlusion-precise", "input-vertices", "input-primitives", "vertex-invocations", "clipping-invocations", "clipping-primitives" or "fragment-invocations")~"},
    {triangle(R"~(query = "occlusion"
early_tests = true
sample_mask = 1)~"),
     R"~(f:8:9: error: with early tests a device may count what the sample mask takes away; leave out query, early_tests or sample_mask)~"},
    {triangle(R"~(frag_depth = 0.5)~"),
     R"~(f:8:14: error: frag_depth is a number; write a table)~"},
    {triangle(R"~(frag_depth = {})~"),
     R"~(f:8:14: error: frag_depth has no number; write value, or from = "frag-coord")~"},
    {triangle(R"~(frag_depth = { value = 0.5, from = "frag-coord" })~"),
     R"~(f:8:14: error: frag_depth has both value and from; keep one)~"},
    {triangle(R"~(frag_depth = { value = 0.5, other = 0.25 })~"),
     R"~(f:8:14: error: other is written where the pattern `where` says: they need value and each other)~"},
    {triangle(R"~(frag_depth = { value = 0.5, other = 0.25, where = "front" })~"),
     R"~(f:8:51: error: where is "front"; write "none", "odd-columns", "odd-rows" or "checker")~"},
    {triangle(R"~(frag_depth = { value = "2^-130" })~"),
     R"~(f:8:24: error: value is a denormal number, which a shader may take for 0; write 0 or at least 2^-126)~"},
    {triangle(R"~(frag_depth = { value = 1.5 })~"),
     R"~(f:8:14: error: without depth clamp Vulkan leaves undefined what becomes of a depth beyond the viewport's, 0 to 1; write depth = { clamp = true } or another number)~"},
    {triangle(R"~(frag_depth = { from = "frag-coord" }
depth = { bias = { constant = 1 } })~"),
     R"~(f:8:14: error: gl_FragCoord.z of a draw with a bias has the bias or not; leave out bias, or write a value)~"},
    {triangle(R"~(frag_depth = { value = 0.25, layout = "greater" })~"),
     R"~(f:8:14: error: the layout "greater" promises depths above the draw's own, which reach 0.5; write larger ones or leave layout out)~"},
    {triangle(R"~(frag_depth = { value = 0.75, layout = "less" })~"),
     R"~(f:8:14: error: the layout "less" promises depths below the draw's own, which begin at 0.5; write smaller ones or leave layout out)~"},
    {triangle(R"~(frag_depth = { value = 0.5, layout = "unchanged" })~"),
     R"~(f:8:14: error: the layout "unchanged" promises the fragment's own depth; write from = "frag-coord")~"},
    {triangle(R"~(frag_depth = { value = 0.5 }
shader_mask = 1)~"),
     R"~(f:8:14: error: a shader that writes depth has plain values and writes no gl_SampleMask here; leave out frag_depth, or every source, probe and shader_mask)~"},
    {triangle(R"~(frag_depth = { value = 0.5 }
[[draw.attribute]]
probe = "dfdx"
values = [1,2,3])~"),
     R"~(f:8:14: error: a shader that writes depth has plain values and writes no gl_SampleMask here; leave out frag_depth, or every source, probe and shader_mask)~"},
    {triangle(R"~(depth = { bounds = 0.5 })~"),
     R"~(f:8:20: error: bounds is a number; write an array of 2 numbers)~"},
    {triangle(R"~(depth = { bounds = [0, 1.5] })~"),
     R"~(f:8:24: error: a depth bound is outside 0..1, which Vulkan does not allow)~"},
    {triangle(R"~(depth = { bounds = [1, 0.5] })~"),
     R"~(f:8:20: error: no depth lies in bounds whose minimum is larger than their maximum; write [minimum, maximum])~"},
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
     R"~(f:8:22: error: depth has 1 number instead of 2)~"},
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
     R"~(f:8:10: error: offset has 1 number instead of 2)~"},
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
    {triangle(R"~(attribute = 1)~"),
     R"~(f:8:13: error: attribute is the number 1; write an array)~"},
    {triangle(R"~(attribute = [1])~"),
     R"~(f:8:14: error: attribute is the number 1; write a table)~"},
    {triangle(R"~(attribute = [{constant=1},{constant=1},{constant=1},{constant=1},{constant=1}])~"),
     R"~(f:8:13: error: 5 attributes are too many; a draw has at most 4)~"},
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
    {triangle(R"~(fragment_size = [2])~"),
     R"~(f:8:17: error: fragment_size has 1 number; write [width, height])~"},
    {triangle(R"~(fragment_size = [3, 2])~"),
     R"~(f:8:18: error: a side of fragment_size is 1, 2 or 4, not 3)~"},
    {triangle(R"~(fragment_size = [2, 8])~"),
     R"~(f:8:21: error: fragment_size is not an integer from 1 to 4)~"},
    {triangle(R"~(fragment_size = [2, 1]
min_sample_shading = 1)~"),
     R"~(f:8:17: error: fragment_size does not go with sample shading; leave out one of them)~"},
    {triangle(R"~(fragment_size = [1, 2]
conservative = "underestimate")~"),
     R"~(f:8:17: error: fragment_size does not go with conservative; leave out one of them)~"},
    {triangle(R"~(fragment_size = [1, 2]
discard = "odd-rows")~"),
     R"~(f:8:17: error: fragment_size does not go with a discard by pixels or values; leave out one of them)~"},
    {triangle(R"~(fragment_size = [1, 2]
frag_depth = { value = 0.5 })~"),
     R"~(f:8:17: error: fragment_size does not go with frag_depth; leave out one of them)~"},
    {triangle(R"~(fragment_size = [1, 2]
shader_mask = 1)~"),
     R"~(f:8:17: error: fragment_size does not go with shader_mask; leave out one of them)~"},
    {triangle(R"~(fragment_size = [1, 2]
query = "fragment-invocations")~"),
     R"~(f:8:17: error: fragment_size does not go with a query of fragment invocations; leave out one of them)~"},
    {triangle(R"~(fragment_size = [1, 2]
[[draw.clip_distance]]
constant = 1)~"),
     R"~(f:8:17: error: fragment_size does not go with clip and cull distances; leave out one of them)~"},
    {triangle(R"~(fragment_size = [1, 2]
[[draw.attribute]]
constant = 1
probe = "dfdx")~"),
     R"~(f:8:17: error: fragment_size does not go with probes; leave out one of them)~"},
    {triangle(R"~(fragment_size = [1, 2]
[[draw.attribute]]
source = "barycentric")~"),
     R"~(f:8:17: error: fragment_size does not go with barycentric inputs; leave out one of them)~"},
    {triangle(R"~(fragment_size = [1, 2]
[[draw.attribute]]
source = "sample-id")~"),
     R"~(f:8:17: error: fragment_size does not go with sample shading; leave out one of them)~"},
    {triangle(R"~([[draw.attribute]]
source = "shading-rate"
[[draw.attribute]]
source = "sample-id")~"),
     R"~(f:8:1: error: no shader here reads the shading rate beside probes, barycentric inputs, gl_SampleID and gl_SamplePosition; put them into two draws)~"},
    {triangle(R"~(shader_mask = 1
[[draw.attribute]]
source = "shading-rate")~"),
     R"~(f:9:1: error: no shader here reads the shading rate and writes a colour, a sample mask or a depth, or discards; leave out one of them)~"},
    {triangle(R"~([[draw.attribute]]
source = "shading-rate"
constant = 1)~"),
     R"~(f:10:12: error: constant goes with source = "vertex" only)~"},
    {whole(kHead + "[target]\nsize = [8, 8]\nsamples = 4\n" + kDraw +
           "fragment_size = [4, 4]\n"),
     R"~(f:9:17: error: a fragment of 4 x 4 pixels has 64 samples, at most 32 are judged; write a smaller one)~"},
    {whole(kHead + "[target]\nsize = [8, 8]\nsamples = 4\n" + kDraw +
           "fragment_size = [4, 2]\n[[draw.attribute]]\nsource = \"sample-mask-in\"\n"),
     R"~(f:9:17: error: a fragment of 4 x 2 pixels has 32 samples, at most 16 are judged with source = "sample-mask-in"; write a smaller one)~"},
    {whole("relations = [{ scissor-tiles = [3, 4] }]\n" + kHead + kTarget + kDraw +
           "fragment_size = [1, 4]\n"),
     R"~(no error)~"},
    {whole("relations = [{ scissor-tiles = [3, 4] }]\n" + kHead + kTarget + kDraw +
           "fragment_size = [2, 1]\n"),
     R"~(f:1:14: error: the relation scissor-tiles has tiles that cut fragments; make their sides multiples of fragment_size)~"},
    {draw(R"~(generate = 1)~"),
     R"~(f:7:12: error: generate is the number 1; write a table)~"},
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

}  // namespace

TEST(LoadErrors, OfDraws) {
    expect_words(kDrawsRows);
}

}  // namespace cases
