// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Of [matrix], its leaves and what is expected of them.
#include "load_errors.hpp"

namespace cases {

namespace {

const std::string kAxes = "i = [0, 1]\nj = [0, 1]\nk = [0, 1]";

// clang-format off
const Row kMatricesRows[] = {
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
    {kHead + "[matrix]\na = [\"b\"]\nb = [1]\n" + kTarget +
         "[[draw]]\nvertices = [[0,0],[8,0],[\"a\",\"8*b\"]]\n",
     R"~(f:10:26: error: x of vertex 2: "a" is not a number: the value of the matrix key a in line 5 is no number; there, expressions have no names)~"},
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
    {top(R"~(leaves = "pairs")~"),
     R"~(f:4:10: error: leaves says which combinations of [matrix] are cases, but there is no [matrix]; leave it out)~"},
    {top(R"~(leaves = 2)~"),
     R"~(f:4:10: error: leaves is the number 2; write "all", "pairs" or an array of combinations)~"},
    {pairs(R"~(leaves = "most")~", R"~(k = [0, 1])~"),
     R"~(f:4:10: error: leaves is the string "most"; write "all", "pairs" or an array of combinations)~"},
    {pairs(R"~(leaves = "pairs")~", R"~(k = [0, 1]
j = [0, 1, 2])~"),
     R"~(f:4:10: error: leaves = "pairs" leaves out combinations of three matrix keys or more with several values each, and the matrix has 2; write "all")~"},
    {pairs(R"~(leaves = "pairs")~", R"~(k = [0, 1]
i = [3]
j = [0, 1, 2])~"),
     R"~(f:4:10: error: leaves = "pairs" leaves out combinations of three matrix keys or more with several values each, and the matrix has 2; write "all")~"},
    {pairs(R"~(leaves = "pairs")~", R"~(i = [0, 1]
j = [0, 1]
k = [0, 1])~", R"~([expect."i=0,j=1,k=1"]
hits = "")~"),
     R"~(f:13:9: error: the combination "i=0,j=1,k=1" is left out by leaves; write [expect."i=0,j=0,k=1"] or another)~"},
    {pairs(R"~(leaves = "pairs")~", R"~(i = [0, 1]
j = [0, 1]
k = [0, 1])~", R"~([expect."i=0,j=1,k=2"]
hits = "")~"),
     R"~(f:13:9: error: the matrix has no leaf "i=0,j=1,k=2"; did you mean "i=0,j=1,k=0"?)~"},
    {pairs(R"~(leaves = "pairs")~", R"~(i = [0, 1]
j = [0, 1]
k = [0, 1]
m = [0, 1])~"),
     R"~(f:9:1: error: the matrix key m is used nowhere; use it or leave it out)~"},
    {pairs(R"~(leaves = [])~", kAxes), R"~(f:4:10: error: leaves is empty; name some combinations of [matrix])~"},
    {pairs(R"~(leaves = [1, "i=0,j=0,k=3", "i=0,j=0,k=1", "x", "i=0,j=0,k=1"])~", kAxes),
     R"~(f:4:11: error: a leaf is the number 1; write a string
f:4:14: error: the matrix has no leaf "i=0,j=0,k=3"; did you mean "i=0,j=0,k=0"?
f:4:44: error: the matrix has no leaf "x"; write "i=0,j=0,k=0"
f:4:49: error: the leaf "i=0,j=0,k=1" stands twice)~"},
    {pairs(R"~(leaves = ["i=0,j=0,k=1", "i=1,j=0,k=1"])~", kAxes),
     R"~(f:7:9: error: leaves names no combination with the value 1 of the matrix key j; name one or leave the value out
f:8:6: error: leaves names no combination with the value 0 of the matrix key k; name one or leave the value out)~"},
    {pairs(R"~(leaves = ["k=1", "k=0"])~", "i = [0]\nj = [0]\nk = [0, 1]"),
     R"~(f:4:11: error: the matrix has no leaf "k=1"; write "i=0,j=0,k=0"
f:4:18: error: the matrix has no leaf "k=0"; write "i=0,j=0,k=0")~"},
    {leaves(R"~(vertices = [[0,0],[8,0],["k",8]])~", R"~(leaves = ["k=1", "k=0"])~"),
     R"~(f:4:10: error: leaves names every combination of [matrix]; leave it out)~"},
    {pairs(R"~(leaves = ["i=0,j=1,k=1", "i=1,j=0,k=0"])~", kAxes, R"~([expect."i=0,j=0,k=0"]
hits = "")~"),
     R"~(f:13:9: error: the combination "i=0,j=0,k=0" is left out by leaves; write [expect."i=1,j=0,k=0"] or another)~"},
};
// clang-format on

}  // namespace

TEST(LoadErrors, OfMatrices) {
    expect_words(kMatricesRows);
}

}  // namespace cases
