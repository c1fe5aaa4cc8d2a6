// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Of files at the loader's limits, of bytes that are no text, and of files that end too early.
#include "load_errors.hpp"

namespace cases {

namespace {

std::string list(int count) {
    std::string text = "[0";
    for (int i = 1; i < count; ++i) {
        text += "," + std::to_string(i);
    }
    return text + "]";
}

}  // namespace

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
