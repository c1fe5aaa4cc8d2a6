// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "diff/whole_case.hpp"

namespace diff {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(StrayWrite, IsToldByItsMemoryAndBelongsToNoSample) {
    cases::Case c;
    c.target.width = 5;
    c.target.height = 3;
    c.target.samples = 4;
    c.target.layers = 2;
    const std::vector<capture::StrayWrite> writes = {
        {"depth", true, 12, 0xed9eca5eU, 0x3f800000U, 7, 1},
        {"attribute 1", false, 0, 0xed9eca5eU, 0, 1, 16},
    };
    Verdict verdict;
    add_stray_writes(c, writes, verdict);
    EXPECT_FALSE(verdict.ok());
    EXPECT_EQ(verdict.level, cases::Profile::vulkan);
    ASSERT_EQ(verdict.findings.size(), 2U);

    const Finding& before = verdict.findings[0];
    EXPECT_EQ(before.rule, "write.outside");
    EXPECT_EQ(before.quantity, "memory before depth");
    EXPECT_EQ(before.expected, "0xed9eca5e");
    EXPECT_EQ(before.got, "0x3f800000");
    EXPECT_THAT(before.why, HasSubstr("7 of its words changed, the nearest 12 bytes before the "
                                      "first byte"));
    EXPECT_THAT(before.why, Not(HasSubstr("renderings")));
    EXPECT_TRUE(before.of_case);

    const Finding& after = verdict.findings[1];
    EXPECT_EQ(after.quantity, "memory after attribute 1");
    EXPECT_THAT(after.why, HasSubstr("0 bytes after the last byte; 16 renderings were in the "
                                     "submission, and none of them did it alone"));
    EXPECT_TRUE(after.of_case);
}

TEST(StrayWrite, OfTexelsTheFirstIsTold) {
    Verdict verdict;
    add_stray_writes({},
                     std::vector<capture::StrayWrite>{{"depth, door image-level", false, 0, 0x3a3aU,
                                                       7, 5, 1, "(3, 0) of layer 0, level 2"}},
                     verdict);
    ASSERT_EQ(verdict.findings.size(), 1U);
    const Finding& finding = verdict.findings[0];
    EXPECT_EQ(finding.rule, "write.outside");
    EXPECT_EQ(finding.level, cases::Profile::vulkan);
    EXPECT_EQ(finding.quantity, "image of depth, door image-level");
    EXPECT_EQ(finding.expected, "0x00003a3a");
    EXPECT_THAT(finding.why, HasSubstr("texel (3, 0) of layer 0, level 2"));
    EXPECT_THAT(finding.why, HasSubstr("5 of those texels changed"));
}

TEST(StrayWrite, NothingIsNoFinding) {
    Verdict verdict;
    add_stray_writes({}, {}, verdict);
    EXPECT_TRUE(verdict.ok());
}

}  // namespace
}  // namespace diff
