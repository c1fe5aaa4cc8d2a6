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
    record.outcome.groups = {{FindingKind::missing, "cover.inside", Profile::direct3d, 90, 0},
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
    other.outcome.groups.pop_back();
    EXPECT_FALSE(shows(other, *symptom));
    other.status = Status::crash;
    other.death.signal = "SIGSEGV";
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
    return to_texts(essentials(*cases::read_toml(text, "f")));
}

TEST(Essentials, AreReadFromTheirTexts) {
    for (const char* text : {"several draws", "several colours", "several samples", "thin triangle",
                             "several triangles", "behind the eye", "unequal w", "sloping depth",
                             "relation doors", "draw.topology=triangle-fan", "draw.scissor",
                             "draw.scissor beyond 32767", "stencil=true"}) {
        EXPECT_EQ(to_text(parse_essential(text)), text);
    }
    EXPECT_EQ(parse_essential("several draws"), Essential{Trait::several_draws});
    EXPECT_EQ(parse_essential("relation doors"), (Essential{Trait::relation, "doors"}));
    EXPECT_EQ(parse_essential("draw.scissor beyond 32767"),
              (Essential{Trait::far, "draw.scissor"}));
    EXPECT_EQ(parse_essential("draw.cull=back"), (Essential{Trait::key, "draw.cull", "back"}));
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

// Of numbers, only those beyond 15 bits count: a cause that needs a far scissor is none of every
// scissor.
TEST(Essentials, FarRectangles) {
    const auto with = [](const std::string& line) {
        return words(("format = 1\n[target]\nsize = [8, 8]\n[[draw]]\n" + line + "\n").c_str());
    };
    EXPECT_THAT(with("scissor = [0, 0, 32767, 32767]"), testing::ElementsAre("draw.scissor"));
    EXPECT_THAT(with("scissor = [1, 0, 32767, 8]"),
                testing::ElementsAre("draw.scissor", "draw.scissor beyond 32767"));
    EXPECT_THAT(with("scissor = [0, 32768, 8, 8]"),
                testing::ElementsAre("draw.scissor", "draw.scissor beyond 32767"));
    EXPECT_THAT(with("viewport = [-32768, 0, 8, 8]"),
                testing::ElementsAre("draw.viewport", "draw.viewport beyond 32767"));
    EXPECT_THAT(with("viewport = [0, 0, 8, 8]"), testing::ElementsAre("draw.viewport"));
}

class LedgerTest : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / "edgecase-ledger";
        fs::create_directories(folder_ / "found");
        fs::create_directories(folder_ / "known");
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
    ledger.selectors = {"ties/**", "my-case.toml"};
    ledger.suite = "/suite";
    ledger.cases_checksum = "0123456789abcdef";
    ledger.expectations = "fedcba9876543210";
    ledger.seed = 18446744073709551615U;
    ledger.profile = Profile::practice;
    ledger.counts.next_case = 1024;
    ledger.counts.drawn = 1000;
    ledger.counts.refused = 12;
    ledger.counts.missing = 3;
    Entry entry;
    entry.symptom = *parse_symptom("value of interp.hull [vulkan]");
    entry.essentials = {{Trait::several_samples}};
    entry.also = {{FindingKind::value, "interp.hull"}, {FindingKind::extra, "cover.outside"}};
    entry.text = "format = 1\n";
    entry.needs = {"not with 1 sample", "not with the format rgba8-unorm"};
    entry.needs_format = true;
    entry.undrawn = {"with 8 samples"};
    entry.passes = {"with 2 samples in place of 4"};
    entry.file = "found/001-interp.hull.toml";
    entry.count = 7;
    entry.first_case = 33;
    Entry known = entry;
    known.is_known = true;
    known.bug = "docs/bug.md";
    known.file = "known/001-interp.hull.toml";
    put(known.file, found_text(known, ledger));
    ledger.entries = {entry, known};
    put(entry.file, found_text(entry, ledger));
    put(kLedgerFile, to_json(ledger));
    const auto read = load_ledger(folder_);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(to_json(*read), to_json(ledger));
    EXPECT_EQ(read->entries.front().also, entry.also);
    EXPECT_TRUE(read->entries.front().text.ends_with(
        "# It passes, or fails otherwise, with 1 sample.\n"
        "# It passes, or fails otherwise, with the format rgba8-unorm.\n"
        "# The device draws nothing with 8 samples.\n"
        "# It passes with 2 samples in place of 4.\n"
        "# The reduction ended early: it may be larger than it has to be.\nformat = 1\n"));
    EXPECT_THAT(read->entries.front().text,
                testing::StartsWith("# value of interp.hull [vulkan], found by 'edgecase fuzz "
                                    "ties/** my-case.toml --seed 18446744073709551615' in case "
                                    "33 on a \"device\".\n"));
    EXPECT_THAT(read->entries.back().text,
                testing::StartsWith("# value of interp.hull [vulkan], known by an expectation file "
                                    "on a \"device\": docs/bug.md\n"));
    EXPECT_TRUE(read->entries.back().is_known);
    // What an older ledger lacks is nothing.
    std::string older = to_json(ledger);
    for (const char* key :
         {"selectors", "suite", "cases_checksum", "expectations", "passes", "bug", "undrawn",
          "needs_format", "overflows", "refused_changes", "numbers_without_case"}) {
        const std::string name = "\"" + std::string(key) + "\":";
        for (size_t at = older.find(name); at != std::string::npos; at = older.find(name)) {
            older.replace(at, name.size(), "\"x\":");
        }
    }
    put(kLedgerFile, older);
    const auto read_older = load_ledger(folder_);
    ASSERT_TRUE(read_older) << read_older.error().message;
    EXPECT_TRUE(read_older->selectors.empty());
    EXPECT_EQ(read_older->counts.refused, 0U);
    EXPECT_TRUE(read_older->entries.front().needs_format);  // as the words of its needs say
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
