// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/expected/seen_pictures.hpp"

#include <gtest/gtest.h>

namespace run {
namespace {

using report::Status;

constexpr const char* kSeen = "0123456789abcdef";
constexpr const char* kOther = "fedcba9876543210";
constexpr const char* kHead = "# edgecase-pictures 1\n# device: GPU*\n";

SeenPictures parsed(const std::string& lines) {
    const auto file = parse_pictures(kHead + lines, "f.pictures");
    EXPECT_TRUE(file) << (file ? "" : cases::to_string(file.error().front()));
    return file ? *file : SeenPictures();
}

report::CaseRecord failed(const char* bits, Status status = Status::fail) {
    report::CaseRecord record;
    record.id = "fam/c1";
    record.status = status;
    record.outcome.groups = {
        {diff::FindingKind::extra, "cover.outside", cases::Profile::vulkan, 1, 0}};
    record.drawn.bits = bits;
    return record;
}

ExpectationLine known(const std::string& words) {
    const auto file = parse_expectations(
        "# edgecase-expectations 2\n# device: GPU*\nfam/* " + words + " # Known.\n", "f.txt",
        "2026-01-01");
    EXPECT_TRUE(file) << (file ? "" : cases::to_string(file.error().front()));
    return file->lines.front();
}

// What a record counts as, and whether its picture is new.
std::pair<Status, bool> judged(const std::string& words, report::CaseRecord record,
                               const std::string& pictures, bool is_strict,
                               const std::string& device = "GPU 1") {
    std::map<std::string, ExpectationLine> expected = {{record.id, known(words)}};
    capture::DeviceInfo on;
    on.name = device;
    tell_pictures(expected, {parsed(pictures)}, on, is_strict);
    const Status counts = counts_as(expected.at(record.id), record);
    apply(expected.at(record.id), record);
    EXPECT_EQ(record.status, counts);
    return {record.status, record.known.unseen_picture};
}

TEST(SeenPictures, AreKnowledgeAndNoCondition) {
    const std::string fails = "fail bug#1 extra:cover.outside@vulkan<=9";
    const std::string seen = std::string("fam/c1 ") + kSeen + "\n";
    using Outcome = std::pair<Status, bool>;
    EXPECT_EQ(judged(fails, failed(kSeen), seen, false), Outcome(Status::xfail, false));
    EXPECT_EQ(judged(fails, failed(kOther), seen, false), Outcome(Status::xfail, true));
    EXPECT_EQ(judged(fails, failed(kOther), "", false), Outcome(Status::xfail, true));
    EXPECT_EQ(judged(fails, failed(kSeen), seen, true), Outcome(Status::xfail, false));
    EXPECT_EQ(judged(fails, failed(kOther), seen, true), Outcome(Status::fail, true));
    // A file about another device knows nothing.
    EXPECT_EQ(judged(fails, failed(kOther), seen, true, "other"), Outcome(Status::xfail, false));
    // What has no picture, has many, is known by its bits or is not excused anyway.
    EXPECT_EQ(judged(fails, failed(""), seen, true), Outcome(Status::xfail, false));
    EXPECT_EQ(judged("flake bug#1 extra:cover.outside@vulkan<=9", failed(kOther, Status::flake),
                     seen, true),
              Outcome(Status::xfail, false));
    EXPECT_EQ(judged(std::string("fail bug#1 bits=") + kOther, failed(kOther), seen, true),
              Outcome(Status::xfail, false));
    EXPECT_EQ(judged("fail bug#1 extra:cover.outside@practice<=9", failed(kOther), seen, true),
              Outcome(Status::fail, false));
    EXPECT_EQ(judged(fails, failed(kOther, Status::pass), seen, true),
              Outcome(Status::xpass, false));
}

TEST(SeenPictures, AreAddedAndWritten) {
    report::Run drawn;
    drawn.device.name = "GPU [x]*";
    drawn.cases = {failed(kOther), failed(kOther, Status::pass), failed(kSeen, Status::flake)};
    drawn.cases[0].status = Status::xfail;
    drawn.cases[0].known.actual = Status::fail;
    drawn.cases[1].id = "fam/c2";
    drawn.cases[2].id = "fam/c3";
    SeenPictures fresh = new_pictures(drawn, "f.pictures");
    EXPECT_TRUE(fits(fresh, drawn.device));
    add_pictures(fresh, drawn);
    drawn.cases[0].drawn.bits = kSeen;
    add_pictures(fresh, drawn);
    const std::string text = to_text(fresh);
    EXPECT_EQ(text,
              "# edgecase-pictures 1\n# device: GPU \\[x\\]\\*\nfam/c1 0123456789abcdef "
              "fedcba9876543210\n");
    const auto again = parse_pictures(text, "f.pictures");
    ASSERT_TRUE(again);
    EXPECT_EQ(to_text(*again), text);
    drawn.device.name = "GPU x*";
    EXPECT_FALSE(fits(*again, drawn.device));
}

TEST(SeenPictures, WrongLinesAreTold) {
    const auto why = [](const std::string& text) {
        const auto file = parse_pictures(text, "f.pictures");
        return file ? std::string() : cases::to_string(file.error().front());
    };
    EXPECT_EQ(why(""),
              "f.pictures:1:1: error: the file is empty; its first line must be '# "
              "edgecase-pictures 1'");
    EXPECT_EQ(why("# edgecase-expectations 2\n"),
              "f.pictures:1:1: error: the first line must be '# edgecase-pictures 1'");
    EXPECT_EQ(why("# edgecase-pictures 1\nfam/c1 0123456789abcdef\n"),
              "f.pictures:1:1: error: no line says which device is meant; add '# device: "
              "NAME-GLOB'");
    const std::string head = kHead;
    EXPECT_EQ(why(head + "# device: x\n"),
              "f.pictures:3:1: error: a second 'device:' header; one "
              "file speaks of one device");
    EXPECT_EQ(why(head + "fam/c1\n"),
              "f.pictures:3:1: error: 'fam/c1' has no picture; write 'ID BITS'");
    EXPECT_EQ(why(head + "fam/c1 0123456789ABCDEF\n"),
              "f.pictures:3:1: error: '0123456789ABCDEF' is no picture; write the sixteen "
              "hexadecimal digits that results.json has in bits");
    const std::string line = std::string("fam/c1 ") + kSeen + "\n";
    EXPECT_EQ(why(head + line + line),
              "f.pictures:4:1: error: 'fam/c1' has a line already; write "
              "its pictures in one");
    EXPECT_EQ(why(head + line + "# End.\n"),
              "f.pictures:4:1: error: a comment must stand above the first case");
    EXPECT_EQ(why(head + "# More.\n\n" + line), "");
}

}  // namespace
}  // namespace run
