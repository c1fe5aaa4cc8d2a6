// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/expected/expectation_file.hpp"

#include <gtest/gtest.h>

#include "run/expected/date.hpp"
#include "run/worker/fault.hpp"

namespace run {
namespace {

using report::Status;

capture::DeviceInfo lavapipe() {
    capture::DeviceInfo device;
    device.name = "llvmpipe (LLVM 15.0.6, 256 bits)";
    device.driver_name = "llvmpipe";
    device.driver_info = "Mesa 22.3.6 (LLVM 15.0.6)";
    return device;
}

std::string mismatch_of(const std::string& header) {
    const auto file =
        parse_expectations("# edgecase-expectations 2\n# " + header + "\n", "f", "2026-01-01");
    EXPECT_TRUE(file) << header;
    return file ? mismatch(*file, lavapipe(), cases::Profile::direct3d) : "not parsed";
}

TEST(Expectations, HeadersFitOrSayWhyNot) {
    EXPECT_EQ(mismatch_of("device: llvmpipe*"), "");
    EXPECT_EQ(mismatch_of("device: llvmpipe*  driver: Mesa >=22.3 <23"), "");
    EXPECT_EQ(mismatch_of("device: *  driver: Mesa =22.3  profile: vulkan direct3d"), "");
    EXPECT_NE(mismatch_of("device: Swift*"), "");
    EXPECT_NE(mismatch_of("device: *  driver: Mesa >=22.4"), "");
    EXPECT_NE(mismatch_of("device: *  driver: Mesa <22.3.6"), "");
    EXPECT_NE(mismatch_of("device: *  driver: Radeon"), "");
    EXPECT_NE(mismatch_of("device: *  profile: vulkan"), "");
}

// As case files have it.
TEST(Expectations, AByteOrderMarkIsNoPartOfTheFirstLine) {
    const auto file = parse_expectations("\xef\xbb\xbf# edgecase-expectations 2\r\n# device: *\r\n",
                                         "f", "2026-01-01");
    EXPECT_TRUE(file) << file.error().front().message;
}

TEST(Expectations, ABrokenDoorIsLeftOut) {
    const auto parsed = [](const std::string& line) {
        return parse_expectations("# edgecase-expectations 2\n# device: *\n" + line + "\n", "f",
                                  "2026-01-01");
    };
    const auto file =
        parsed("door=multi-draw-empty  skip  bug-1  until=2025-12-31  # It is empty.");
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->lines.empty());
    ASSERT_EQ(file->doors.size(), 1U);
    EXPECT_EQ(file->doors[0].glob, "multi-draw-empty");
    EXPECT_EQ(file->doors[0].bug, "bug-1");
    EXPECT_TRUE(file->doors[0].is_past);
    EXPECT_EQ(past_lines(*file).size(), 1U);
    const auto error = [&](const std::string& line) {
        const auto wrong = parsed(line);
        return wrong ? std::string("no error") : wrong.error().front().message;
    };
    EXPECT_EQ(error("door=multi-draw-emtpy  skip  bug  # Why."),
              "there is no door 'multi-draw-emtpy'; did you mean 'multi-draw-empty'?");
    EXPECT_EQ(error("door=index-8  fail  bug  # Why."),
              "a door can be left out as a whole by 'skip'; a failure through it is expected of "
              "cases, by causes like 'value:door.index=index-8@vulkan<=3'");
    EXPECT_EQ(error("door=index-8  skip  -  # Why."),
              "a door that is left out needs a reference to a bug in its third column");
}

TEST(Expectations, VersionsCompareAsNumbers) {
    using Relation = VersionBound::Relation;
    EXPECT_TRUE(satisfies({22, 10}, {Relation::at_least, {22, 9}}));
    EXPECT_FALSE(satisfies({22, 3, 6}, {Relation::above, {22, 3}}));
    EXPECT_TRUE(satisfies({22, 3, 6}, {Relation::at_most, {22, 3}}));
    EXPECT_TRUE(satisfies({22}, {Relation::below, {22, 0, 1}}));
    EXPECT_EQ(find_version("Mesa 22.3.6-1 (LLVM 15)", 0), (std::vector<uint32_t>{22, 3, 6}));
    EXPECT_TRUE(find_version("none", 0).empty());
}

TEST(Expectations, StatusesOfEveryPair) {
    const auto judge = [](Status actual, Status expected) {
        return judge_expected(actual, expected);
    };
    EXPECT_EQ(judge_expected(Status::fail, std::nullopt), Status::fail);
    for (const Status s : {Status::fail, Status::crash, Status::timeout, Status::device_lost}) {
        EXPECT_EQ(judge(s, s), Status::xfail);
        EXPECT_EQ(judge(Status::pass, s), Status::xpass);
        EXPECT_EQ(judge(Status::error, s), Status::error);
        EXPECT_EQ(judge(Status::not_run, s), Status::not_run);
        EXPECT_EQ(judge(Status::unsupported, s), Status::unsupported);
        EXPECT_EQ(judge(Status::flake, s), Status::flake);
    }
    for (const Status s : {Status::fail, Status::flake, Status::skip}) {  // its date is past
        EXPECT_EQ(judge_expected(Status::pass, s, true), Status::xpass);
        EXPECT_EQ(judge_expected(Status::fail, s, true), Status::fail);
        EXPECT_EQ(judge_expected(Status::flake, s, true), Status::flake);
    }
    EXPECT_EQ(judge(Status::crash, Status::fail), Status::crash);
    EXPECT_EQ(judge(Status::fail, Status::crash), Status::improved);
    EXPECT_EQ(judge(Status::timeout, Status::device_lost), Status::timeout);
    EXPECT_EQ(judge(Status::pass, Status::flake), Status::pass);
    EXPECT_EQ(judge(Status::flake, Status::flake), Status::xfail);
    EXPECT_EQ(judge(Status::fail, Status::flake), Status::xfail);
    EXPECT_EQ(judge(Status::crash, Status::flake), Status::crash);
}

TEST(Expectations, DatesAreDaysOfTheCalendar) {
    for (const char* good : {"2026-11-22", "2028-02-29", "2000-02-29"}) {
        EXPECT_TRUE(is_date(good)) << good;
    }
    for (const char* bad : {"2026-02-29", "2100-02-29", "2026-13-01", "2026-00-10", "2026-04-31",
                            "2026-1-01", "2026/01/01", "", "2026-01-011", "20x6-01-01"}) {
        EXPECT_FALSE(is_date(bad)) << bad;
    }
}

TEST(Expectations, APastDateIsKnownToTheDay) {
    const auto past_on = [](const std::string& today) {
        const auto file = parse_expectations(
            "# edgecase-expectations 2\n# device: *\na flake b until=2026-05-01  # R.\n", "f",
            today);
        return file ? past_lines(*file).size() : size_t{99};
    };
    EXPECT_EQ(past_on("2026-04-30"), 0U);
    EXPECT_EQ(past_on("2026-05-01"), 0U);  // the last day
    EXPECT_EQ(past_on("2026-05-02"), 1U);
}

TEST(Faults, CommasInsideIdsDoNotSeparate) {
    const auto faults = parse_faults("segv@a/b:x=1,y=2,hang,noise@c");
    ASSERT_TRUE(faults);
    ASSERT_EQ(faults->size(), 3U);
    EXPECT_EQ((*faults)[0].glob, "a/b:x=1,y=2");
    EXPECT_NE(find_fault(*faults, FaultKind::segv, "a/b:x=1,y=2"), nullptr);
    EXPECT_EQ(find_fault(*faults, FaultKind::segv, "a/b:x=1,y=3"), nullptr);
    EXPECT_NE(find_fault(*faults, FaultKind::hang, "anything"), nullptr);
    EXPECT_FALSE(parse_faults("segv,nosie"));
    const auto later = parse_faults("flip-pixel+12@a,shift-value+3");
    ASSERT_TRUE(later);
    EXPECT_EQ((*later)[0].skipped, 12U);
    EXPECT_EQ((*later)[1].skipped, 3U);
    for (const char* bad : {"segv+1", "flip-pixel+", "flip-pixel+x", "flip-pixel+1x"}) {
        EXPECT_FALSE(parse_faults(bad)) << bad;
    }
}

}  // namespace
}  // namespace run
