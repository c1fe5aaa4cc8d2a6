// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/document/document.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "suite_documents.hpp"

namespace fuzz {
namespace {

Document read(const std::string& text) {
    const cases::Expected<cases::TomlValue> document = cases::read_toml(text, "test.toml");
    EXPECT_TRUE(document) << cases::to_string(document.error()) << "\n" << text;
    return document ? *document : Document{};
}

TEST(Document, EveryFileOfTheSuiteReadsBackAsTheSameTree) {
    const std::vector<SuiteDocument> files = suite_documents();
    for (const SuiteDocument& file : files) {
        const Document before = read(file.text);
        const std::string text = to_text(before);
        const Document after = read(text);
        EXPECT_TRUE(is_same(before, after)) << file.name << "\n" << text;
        EXPECT_EQ(to_text(after), text) << "a second writing differs: " << file.name;
    }
    EXPECT_GT(files.size(), 600U);
}

TEST(Document, IsWrittenForPeople) {
    const Document document = read(R"(
target = { size = [8, 4], color = { format = "r32-float" } }
rules = ["cover.inside"]
description = "A text."
format = 1
[[draw]]
vertices = [[0,0],[8,0.5],[-0.0,1e-9]]
depth = { write = false, compare = "less" }
attribute = [{ values = [1, 2, 3], name = "a" }]
cull = "none"
[expect]
hits = """
..
"""
)");
    EXPECT_EQ(to_text(document), R"(format = 1
description = "A text."
rules = ["cover.inside"]

[target]
size = [8, 4]

[target.color]
format = "r32-float"

[[draw]]
cull = "none"
depth = { compare = "less", write = false }
vertices = [
    [0, 0],
    [8, 0.5],
    [-0.0, 1e-09]
]

[[draw.attribute]]
name = "a"
values = [1, 2, 3]

[expect]
hits = """
..
"""
)");
}

TEST(Document, NumbersAndTextsOfEveryKindComeBack) {
    const double inf = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Document document = table();
    set(document, "numbers",
        numbers({0, -0.0, 0.1, -1e300, 5e-324, inf, -inf, nan, -nan, 0x1p53, -0x1p52, 1e15}));
    set(document, "a key\nof two lines", text("quotes \" and \\ and \t and \x7f and \xc3\xa4"));
    set(document, "lines", text("one\ntwo \\ two\n"));
    set(document, "quote at the end", text("one\n\""));
    set(document, "empty", list({}));
    set(document, "inner", list({table(), boolean(true), text("")}));
    Document many = list({});
    for (int k = 0; k < 40000; ++k) {  // 65536 bytes a line are read
        many.array.push_back(number(k + 0.5));
    }
    set(document, "many", many);
    const Document after = read(to_text(document));
    EXPECT_TRUE(is_same(document, after)) << to_text(document).substr(0, 1000);
    EXPECT_EQ(document.find("numbers")->array[1].kind, Document::Kind::floating);
    EXPECT_EQ(document.find("numbers")->array[8].string, "-nan");
    EXPECT_EQ(document.find("numbers")->array[10].kind, Document::Kind::integer);
}

TEST(Document, TablesAreChangedInPlace) {
    Document document = table();
    set(document, "a", number(1));
    set(document, "b", number(2));
    set(document, "a", number(3));
    EXPECT_EQ(to_text(document), "a = 3\nb = 2\n");
    EXPECT_NE(find(document, "b"), nullptr);
    EXPECT_TRUE(erase(document, "b"));
    EXPECT_FALSE(erase(document, "b"));
    EXPECT_EQ(find(document, "b"), nullptr);
    EXPECT_FALSE(is_same(document, table()));
    EXPECT_FALSE(is_same(number(0), number(-0.0)));
}

}  // namespace
}  // namespace fuzz
