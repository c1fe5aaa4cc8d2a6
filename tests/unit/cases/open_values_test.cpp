// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The table [fuzz]: what ordinary commands draw of it, and every sentence about it.
#include "cases/load/open_values.hpp"

#include "load_errors.hpp"

namespace cases {

namespace {

// A file whose [fuzz] is `open`, with x and y in a vertex.
std::string fuzz(const std::string& open) {
    return kHead + "[fuzz]\n" + open + "\n" + kTarget +
           "[[draw]]\nvertices = [[\"x\",\"y\"],[8,0],[0,8]]\n";
}

std::vector<OpenName> names_of(const std::string& toml) {
    const auto root = read_toml(toml, "f");
    const auto matrix = read_matrix(root->find("matrix"), nullptr);
    return *read_open(root->find("fuzz"), *matrix);
}

// clang-format off
const Row kRows[] = {
    {fuzz(R"~()~"),
     R"~(f:4:1: error: [fuzz] leaves nothing open; write [value, value, ...], or { from = 0, to = 8, step = "1/256" } for numbers, or leave [fuzz] out)~"},
    {top(R"~(fuzz = 1)~"),
     R"~(f:4:8: error: [fuzz] leaves nothing open; write [value, value, ...], or { from = 0, to = 8, step = "1/256" } for numbers, or leave [fuzz] out)~"},
    {fuzz("x = 1\ny = [0, 1]"),
     R"~(f:5:5: error: the [fuzz] key x is the number 1; write [value, value, ...], or { from = 0, to = 8, step = "1/256" } for numbers)~"},
    {fuzz("x = [1]\ny = [0, 1]"),
     R"~(f:5:5: error: the [fuzz] key x has one value, so nothing is open; write [value, value, ...], or { from = 0, to = 8, step = "1/256" } for numbers)~"},
    {fuzz("x = []\ny = [0, 1]"),
     R"~(f:5:5: error: the [fuzz] key x has no value, so nothing is open; write [value, value, ...], or { from = 0, to = 8, step = "1/256" } for numbers)~"},
    {fuzz("x = [1, 1, 2]\ny = [0, \"a b\"]"),
     R"~(f:5:9: error: the value 1 of the [fuzz] key x stands twice
f:6:9: error: a value of the [fuzz] key y has characters that an id cannot have; write letters, digits and +-./^())~"},
    {fuzz("x = { from = 8, to = 0 }\ny = [0, 1]"),
     R"~(f:5:14: error: the range of x goes from 8 to 0; exchange from and to)~"},
    {fuzz("x = { from = 8, to = 8 }\ny = [0, 1]"),
     R"~(f:5:14: error: the range of x goes from 8 to 8; write the one value where it is used)~"},
    {fuzz("x = { from = 0, to = 1, step = 0 }\ny = [0, 1]"),
     R"~(f:5:32: error: the step of x is 0; write one above 0)~"},
    {fuzz("x = { from = 0, to = 1, step = \"2/3\" }\ny = [0, 1]"),
     R"~(f:5:22: error: from 0 no whole number of steps of 2/3 leads to 1; choose another to or step)~"},
    {fuzz("x = { from = 0, to = 1, step = \"2^-32\" }\ny = [0, 1]"),
     R"~(f:5:5: error: the range of x has more than 4294967296 values; write a larger step)~"},
    {fuzz("x = { to = 1 }\ny = { from = 1 }"),
     R"~(f:5:5: error: the [fuzz] key x has no from; write [value, value, ...], or { from = 0, to = 8, step = "1/256" } for numbers
f:6:5: error: the [fuzz] key y has no to; write [value, value, ...], or { from = 0, to = 8, step = "1/256" } for numbers)~"},
    {fuzz("x = { from = 0, to = 4, stepp = 1 }\ny = [0, 1]"),
     R"~(f:5:25: error: the [fuzz] key x has no key "stepp"; did you mean "step"?)~"},
    {fuzz("x = { from = 0, to = 4, nominal = \"1/2\" }\ny = [0, 1]"),
     R"~(f:5:35: error: nominal = 1/2 is none of the values of x; write 0 or another of them)~"},
    {fuzz("x = { from = 0, to = 4, nominal = 5 }\ny = [0, 1]"),
     R"~(f:5:35: error: nominal = 5 is none of the values of x; write 0 or another of them)~"},
    {fuzz("x = [0, 1]\ny = [0, 1]\nz = [0, 1]"),
     R"~(f:7:1: error: the [fuzz] key z is used nowhere; use it or leave it out)~"},
    {fuzz("x = [0, 1]\ny = [0, 1]\n[matrix]\nx = [0, 1]"),
     R"~(f:5:1: error: x is a key of [matrix], too; name one of the two otherwise)~"},
    {fuzz("\"x-x\" = [0, 1]\nx = [0, 1]\ny = [0, 1]"),
     R"~(f:5:1: error: the [fuzz] key "x-x" is not a name; write letters, digits and _)~"},
};
// clang-format on

}  // namespace

TEST(OpenValues, EverySentence) {
    expect_words(kRows);
}

// Every command but one draws the nominal case, and `list --long` says so.
TEST(OpenValues, TheNominalCaseIsDrawn) {
    const auto loaded =
        load_text(fuzz("x = { from = -2, to = 2, step = \"1/2\", nominal = \"3/2\" }\ny = [3, 4]"),
                  "f", "id");
    ASSERT_TRUE(loaded) << to_string(loaded.error().front());
    ASSERT_EQ(loaded->size(), 1U);
    const Case& c = loaded->front();
    EXPECT_EQ(c.id, "id");
    EXPECT_TRUE(c.claim.parameters.empty());
    EXPECT_EQ(c.draws[0].positions[0].x, 2 * 1.5F / 8 - 1);
    EXPECT_EQ(c.draws[0].positions[0].y, 2 * 3.0F / 8 - 1);
    ASSERT_EQ(c.claim.notes.size(), 1U);
    EXPECT_EQ(c.claim.notes[0],
              "[fuzz] leaves open what 'edgecase fuzz FILE' varies; here x = 3/2, y = 3");
}

TEST(OpenValues, RangesAndLists) {
    const std::vector<OpenName> names =
        names_of(fuzz("x = { from = -1, to = 1, step = \"1/256\" }\ny = [\"none\", \"back\"]"));
    ASSERT_EQ(names.size(), 2U);
    EXPECT_EQ(names[0].count, 513U);
    EXPECT_EQ(names[0].nominal, 0U);
    EXPECT_EQ(names[0].value(0).string, "-1");
    EXPECT_EQ(names[0].value(257).string, "1/256");
    EXPECT_EQ(names[0].value(512).string, "1");
    EXPECT_EQ(names[1].count, 2U);
    EXPECT_EQ(names[1].value(1).string, "back");
}

}  // namespace cases
