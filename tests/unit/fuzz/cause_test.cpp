// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/cause.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fuzz/ledger.hpp"

namespace fuzz {
namespace {

namespace fs = std::filesystem;
using cases::Profile;
using diff::FindingKind;
using report::Status;

report::CaseRecord failed() {
    report::CaseRecord record;
    record.status = Status::fail;
    record.groups = {{FindingKind::missing, "cover.inside", Profile::direct3d, 90, 0},
                     {FindingKind::value, "interp.linear", Profile::vulkan, 2, 0},
                     {FindingKind::extra, "cover.outside", Profile::vulkan, 7, 0}};
    return record;
}

TEST(Symptom, IsTheGravestAndOfTheseTheCommonest) {
    const auto symptom = symptom_of(failed());
    ASSERT_TRUE(symptom);
    EXPECT_EQ(to_text(*symptom), "extra of cover.outside [vulkan]");
    EXPECT_TRUE(shows(failed(), *symptom));
    report::CaseRecord other = failed();
    other.groups.pop_back();
    EXPECT_FALSE(shows(other, *symptom));
    other.status = Status::crash;
    other.signal = "SIGSEGV";
    EXPECT_EQ(to_text(*symptom_of(other)), "crash by SIGSEGV");
    EXPECT_FALSE(shows(other, *symptom));
}

TEST(Symptom, NoneOfWhatDoesNotFail) {
    for (const Status status : {Status::pass, Status::unsupported, Status::error, Status::skip}) {
        report::CaseRecord record = failed();
        record.status = status;
        EXPECT_FALSE(symptom_of(record));
    }
}

TEST(Symptom, TextsAreReadBack) {
    for (const char* text :
         {"extra of cover.outside [vulkan]", "order of tie.top-left [direct3d]",
          "value of interp.hull [practice]", "crash by SIGSEGV", "timeout", "device_lost"}) {
        const auto symptom = parse_symptom(text);
        ASSERT_TRUE(symptom) << text;
        EXPECT_EQ(to_text(*symptom), text);
    }
    for (const char* text :
         {"", "of", "extra of x", "extra of x [y]", "more of x [vulkan]", "pass"}) {
        EXPECT_FALSE(parse_symptom(text)) << text;
    }
}

std::set<std::string> words(const char* text) {
    return essentials(*cases::read_toml(text, "f"));
}

TEST(Essentials, AreWhatAPlainCaseHasNot) {
    EXPECT_THAT(
        words("format = 1\ndescription = \"D\"\nrules = [\"cover.inside\"]\n[target]\nsize = "
              "[8, 8]\n[[draw]]\nvertices = [[0, 0], [8, 0], [0, 8]]\n"),
        testing::IsEmpty());
    EXPECT_THAT(
        words("format = 1\nrelations = [\"same-twice\"]\n[target]\nsize = [8, 8]\nsamples = 4\n"
              "[target.color]\nformat = \"r32-float\"\n[[draw]]\nscissor = [1, 2, 3, 4]\n"
              "topology = \"triangle-fan\"\nvertices = [[0, 0, 0.5, 1], [8, 0, 0.5, -1], [0, 8, "
              "0.5, 1]]\ndepth = { compare = \"less\", clamp = true }\n[[draw.attribute]]\nvalues "
              "= [1, 2, 3]\nprobe = \"dfdx\"\n[[draw]]\nvertices = [[0, 0], [8, 0], [0, 8]]\n"),
        testing::ElementsAre("behind the eye", "color", "draw.attribute",
                             "draw.attribute.probe=dfdx", "draw.depth.clamp=true",
                             "draw.depth.compare", "draw.scissor", "draw.topology=triangle-fan",
                             "relation same-twice", "several draws", "several samples",
                             "unequal w"));
}

class LedgerTest : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / "edgecase-ledger";
        fs::create_directories(folder_ / "found");
    }
    void TearDown() override { fs::remove_all(folder_); }
    void put(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }
    fs::path folder_;
};

TEST_F(LedgerTest, IsReadBack) {
    Ledger ledger;
    ledger.device = "a \"device\"";
    ledger.arguments = {"edgecase", "fuzz"};
    ledger.seed = 18446744073709551615U;
    ledger.profile = Profile::practice;
    ledger.counts.next_case = 1024;
    ledger.counts.drawn = 1000;
    Entry entry;
    entry.symptom = *parse_symptom("value of interp.hull [vulkan]");
    entry.essentials = {"several samples"};
    entry.also = {{FindingKind::value, "interp.hull"}, {FindingKind::extra, "cover.outside"}};
    entry.text = "format = 1\n";
    entry.needs = {"not with 1 sample"};
    entry.file = "found/001-interp.hull.toml";
    entry.count = 7;
    entry.first_case = 33;
    ledger.entries = {entry};
    put(entry.file, found_text(entry, ledger));
    put(kLedgerFile, to_json(ledger));
    const auto read = load_ledger(folder_);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(to_json(*read), to_json(ledger));
    EXPECT_EQ(read->entries.front().also, entry.also);
    EXPECT_TRUE(read->entries.front().text.ends_with(
        "# It passes, or fails otherwise: not with 1 sample.\n"
        "# The reduction ended early: it may be larger than it has to be.\nformat = 1\n"));
}

TEST_F(LedgerTest, SaysWhatIsWrong) {
    EXPECT_THAT(load_ledger(folder_).error().message,
                testing::HasSubstr("is not the folder of a hunt: fuzz.json cannot be read"));
    put(kLedgerFile, "{");
    EXPECT_THAT(load_ledger(folder_).error().message, testing::HasSubstr("is malformed"));
    put(kLedgerFile, "{\"schema\": \"edgecase-results-1\"}");
    EXPECT_THAT(load_ledger(folder_).error().message, testing::HasSubstr("has another schema"));
    put(kLedgerFile, "{\"schema\": \"edgecase-fuzz-1\"}");
    EXPECT_THAT(load_ledger(folder_).error().message, testing::HasSubstr("is malformed"));
}

}  // namespace
}  // namespace fuzz
