// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Hand-drawn pictures of cases against the reference.
#include <gtest/gtest.h>

#include "diff/verdict.hpp"
#include "perfect_capture.hpp"

namespace {

TEST(ExpectedHits, AgreesOrNamesTheFirstPixel) {
    cases::Case c = pixel_case(4, 4, {{0, 0}, {4, 0}, {0, 4}});
    EXPECT_EQ(diff::check_expected_hits(c), "");
    c.claim.expected_hits = cases::ExpectedHits{{"111.", "11..", "1...", "...."}, {}};
    EXPECT_EQ(diff::check_expected_hits(c), "");
    c.claim.expected_hits->rows[1] = "111.";
    EXPECT_EQ(diff::check_expected_hits(c),
              "the picture has '1' at pixel (2, 1), the reference says 0 hits");
}

TEST(ExpectedHits, OnePictureASample) {
    // Sample 0 of two lies at (3/4, 3/4), sample 1 at (1/4, 1/4).
    cases::Case c = pixel_case(2, 2, {{0, 0}, {1, 0}, {0, 1}});
    c.target.samples = 2;
    c.claim.expected_hits = cases::ExpectedHits{{"..", "..", "1.", ".."}, {}};
    EXPECT_EQ(diff::check_expected_hits(c), "");
    c.claim.expected_hits = cases::ExpectedHits{{"1.", "..", "..", ".."}, {}};
    EXPECT_EQ(diff::check_expected_hits(c),
              "the picture has '1' at pixel (0, 0), sample 0, the reference says 0 hits");
}

}  // namespace
