// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Hand-drawn pictures of cases against the reference.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "diff/verdict.hpp"
#include "perfect_capture.hpp"

namespace {

// What is wrong; empty if nothing is.
std::string wrong_of(const cases::Case& c) {
    const auto wrong = diff::check_expected_hits(c);
    return wrong ? wrong->message : "";
}

TEST(ExpectedHits, AgreesOrNamesTheFirstPixel) {
    cases::Case c = pixel_case(4, 4, {{0, 0}, {4, 0}, {0, 4}});
    EXPECT_EQ(wrong_of(c), "");
    c.claim.expected_hits = cases::ExpectedHits{{"111.", "11..", "1...", "...."}, {}};
    EXPECT_EQ(wrong_of(c), "");
    c.claim.expected_hits->rows[1] = "111.";
    EXPECT_EQ(wrong_of(c), "the picture has '1' at pixel (2, 1), the reference says 0 hits");
}

TEST(ExpectedHits, OnePictureASample) {
    // Sample 0 of two lies at (3/4, 3/4), sample 1 at (1/4, 1/4).
    cases::Case c = pixel_case(2, 2, {{0, 0}, {1, 0}, {0, 1}});
    c.target.samples = 2;
    c.claim.expected_hits = cases::ExpectedHits{{"..", "..", "1.", ".."}, {}};
    EXPECT_EQ(wrong_of(c), "");
    c.claim.expected_hits = cases::ExpectedHits{{"1.", "..", "..", ".."}, {}};
    EXPECT_EQ(wrong_of(c),
              "the picture has '1' at pixel (0, 0), sample 0, the reference says 0 hits");
}

// Line and column of the first pixel that differs, in a file that is written so.
TEST(ExpectedHits, ThePixelIsFoundInTheFile) {
    cases::Case c = pixel_case(2, 2, {{0, 0}, {1, 0}, {0, 1}});
    c.target.samples = 2;
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / "expected_hits_test.toml";
    const auto place = [&](const std::string& text, std::vector<std::string> rows) {
        std::ofstream(file) << text;
        c.claim.expected_hits = cases::ExpectedHits{std::move(rows), {file.string(), 2, 8}};
        const auto wrong = diff::check_expected_hits(c);
        std::filesystem::remove(file);
        EXPECT_EQ(wrong->where.file, file.string());
        return std::pair(wrong->where.line, wrong->where.column);
    };
    using Place = std::pair<uint32_t, uint32_t>;
    const std::string text =
        "[expect]\nhits = [\n\"\"\"\n..\n..\n\"\"\",\n# Sample 1.\n'''\n1.\n.1\n'''\n]\n";
    EXPECT_EQ(place(text, {"..", "..", "1.", ".1"}), (Place{10, 2}));
    std::string windows;
    for (const char letter : text) {
        windows += letter == '\n' ? "\r\n" : std::string(1, letter);
    }
    EXPECT_EQ(place(windows, {"..", "..", "1.", ".1"}), (Place{10, 2}));
    // Written otherwise, or another file by now.
    EXPECT_EQ(place("\nhits = ['..\\n..', '1.\\n.1']\n", {"..", "..", "1.", ".1"}), (Place{2, 8}));
    EXPECT_EQ(place(text, {"..", "..", "1.", "11"}), (Place{2, 8}));
    EXPECT_EQ(place("", {"..", "..", "1.", ".1"}), (Place{2, 8}));
}

}  // namespace
