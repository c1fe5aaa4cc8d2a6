// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/entry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cases/load/loader.hpp"
#include "diff/color.hpp"
#include "fuzz/ledger.hpp"
#include "ref/expectation/expectation.hpp"

namespace fuzz {
namespace {

using cases::Profile;
using diff::FindingKind;
using report::CaseRecord;
using report::Status;

bool is_sloping(const cases::Case& c) {
    return std::any_of(c.draws.begin(), c.draws.end(), [](const cases::Draw& draw) {
        return std::any_of(draw.positions.begin(), draw.positions.end(), [&](const auto& p) {
            return std::abs(p.z * draw.positions[0].w - draw.positions[0].z * p.w) > 0;
        });
    });
}

// A device that takes the depth of samples at another place: a clamped depth is told by another
// rule, and so gravely only with several draws.
std::vector<CaseRecord> draw_sample_depth(const std::vector<cases::Case>& all) {
    std::vector<CaseRecord> records;
    for (const cases::Case& c : all) {
        CaseRecord record;
        record.status = Status::pass;
        const bool is_clamped = std::any_of(c.draws.begin(), c.draws.end(),
                                            [](const auto& draw) { return draw.depth.clamp; });
        if (c.target.samples > 1 && is_sloping(c)) {
            record.status = Status::fail;
            record.outcome.groups = {
                {FindingKind::value, is_clamped ? "depth.clamp" : "depth.linear",
                 is_clamped && c.draws.size() > 1 ? Profile::vulkan : Profile::practice, 1, 0}};
        }
        records.push_back(record);
    }
    return records;
}

// As a session on a device whose records those are.
template <class Records>
run::DrawAndJudge judged_by(const Records& records_of) {
    return [records_of](const std::vector<cases::Case>& all, const auto&) {
        return run::Session::Results{records_of(all), false, ""};
    };
}

const char* const kClamped =
    "format = 1\ndescription = \"D\"\nrules = [\"cover.inside\"]\n[target]\nsize = [4, 4]\nsamples "
    "= "
    "4\n[[draw]]\ncull = \"back\"\ndepth = { clamp = true }\nvertices = [[-9, -9, 0], [30, -9, 1], "
    "[-9, 30, 0]]\n[[draw]]\nvertices = [[-9, -9], [30, -9], [-9, 30]]\n";

TEST(ReduceCase, EssentialIsWhatAnyLikeFailureNeeds) {
    const Symptom symptom = *parse_symptom("value of depth.clamp [vulkan]");
    const auto entry = reduce_case(kClamped, symptom, judged_by(draw_sample_depth), 400);
    ASSERT_TRUE(entry);
    // The case that is kept shows the symptom as it was met.
    EXPECT_THAT(entry->text, testing::HasSubstr("clamp = true"));
    EXPECT_EQ(to_text(entry->symptom), "value of depth.clamp [vulkan]");
    EXPECT_THAT(to_texts(entry->essentials),
                testing::ElementsAre("several samples", "sloping depth"));
}

// The device may be out of reach when somebody reads the case.
TEST(ReduceCase, TellsWhatTheDeviceLeft) {
    const auto draw = [](const std::vector<cases::Case>& all) {
        std::vector<CaseRecord> records = draw_sample_depth(all);
        for (CaseRecord& record : records) {
            for (const auto& group : record.outcome.groups) {
                record.outcome.findings.push_back({group.kind, group.rule, group.level, 3, 1, 2,
                                                   "depth", "0.5", "0.75",
                                                   "it is another sample's"});
            }
        }
        return records;
    };
    const Symptom symptom = *parse_symptom("value of depth.clamp [vulkan]");
    const auto entry = reduce_case(kClamped, symptom, judged_by(draw), 400);
    ASSERT_TRUE(entry);
    EXPECT_EQ(entry->seen,
              "pixel (3, 1), sample 2: depth: expected 0.5, got 0.75; it is another sample's");
    Ledger ledger;
    EXPECT_THAT(found_text(*entry, ledger),
                testing::HasSubstr("\n# Seen: pixel (3, 1), sample 2: depth: expected 0.5, "
                                   "got 0.75; it is another sample's.\n"));
}

// What is told is of the entry's own case, not of a larger one that showed it, too.
TEST(ReduceCase, TellsWhatItsOwnCaseShows) {
    const auto size_of = [](const cases::Case& c) {
        return std::to_string(c.target.width * c.target.height);
    };
    const auto draw = [&](const std::vector<cases::Case>& all) {
        std::vector<CaseRecord> records = draw_sample_depth(all);
        for (size_t k = 0; k < all.size(); ++k) {
            for (const auto& group : records[k].outcome.groups) {
                records[k].outcome.findings.push_back({group.kind, group.rule, group.level, 0, 0, 0,
                                                       "", "none", size_of(all[k]) + " pixels",
                                                       "so"});
            }
        }
        return records;
    };
    const auto entry = reduce_case(kClamped, *parse_symptom("value of depth.clamp [vulkan]"),
                                   judged_by(draw), 400);
    ASSERT_TRUE(entry);
    const auto loaded = cases::load_text(entry->text, "reduced.toml", "reduced");
    ASSERT_TRUE(loaded) << entry->text;
    EXPECT_THAT(entry->seen, testing::HasSubstr("got " + size_of(loaded->front()) + " pixels"));
    EXPECT_NE(size_of(loaded->front()), size_of(*load_one(kClamped, "drawn")));
}

// At vulkan this sliver need not cover its sample, so that no picture is wrong there; at direct3d
// it has to, and to be seen.
TEST(ReduceCase, StaysAsSoundAsTheDrawnCase) {
    const std::string text =
        "format = 1\ndescription = \"D\"\nrules = [\"cover.inside\"]\n[target]\nsize = [1, 1]\n"
        "samples = 4\nattachments = \"color\"\n[target.color]\nformat = \"rgba8-unorm\"\n[[draw]]\n"
        "vertices = [[6.25, 9.75], [-2, -3.25], [7, 10]]\ncolor = { value = [1, 1, 1, 1] }\n";
    const auto fails = [](const std::vector<cases::Case>& all) {
        std::vector<CaseRecord> records(all.size());
        for (CaseRecord& record : records) {
            record.status = Status::fail;
            record.outcome.groups = {{FindingKind::value, "store.unorm", Profile::direct3d, 1, 0}};
        }
        return records;
    };
    const std::optional<cases::Case> drawn = load_one(text, "drawn");
    ASSERT_TRUE(drawn);
    ASSERT_FALSE(diff::fails_if_empty(*drawn, Profile::vulkan));
    ASSERT_TRUE(diff::fails_if_empty(*drawn, Profile::direct3d));
    const auto entry =
        reduce_case(text, *parse_symptom("value of store.unorm [direct3d]"), judged_by(fails), 400);
    ASSERT_TRUE(entry);
    EXPECT_TRUE(diff::fails_if_empty(*load_one(entry->text, "reduced"), Profile::direct3d))
        << entry->text;
}

// A picture of colours alone, in which every sample may keep the clear colour, proves nothing.
TEST(ReduceCase, KeepsATriangleThatIsSeen) {
    const std::string text =
        "format = 1\ndescription = \"D\"\nrules = [\"cover.inside\"]\n[target]\nsize = [4, 4]\n"
        "attachments = \"color\"\n[target.color]\nformat = \"rgba8-unorm\"\n[[draw]]\n"
        "vertices = [[0, 0], [8, 0], [0, 8]]\ncolor = { value = [1, 1, 1, 1] }\n";
    // A device that is wrong wherever colours alone are attached, also where nothing is seen of
    // them.
    const auto fails = [](const std::vector<cases::Case>& all) {
        std::vector<CaseRecord> records;
        for (const cases::Case& c : all) {
            CaseRecord& record = records.emplace_back();
            record.status = c.target.has_instruments ? Status::pass : Status::fail;
            if (!c.target.has_instruments) {
                record.outcome.groups = {
                    {FindingKind::value, "store.unorm", Profile::vulkan, 1, 0}};
            }
        }
        return records;
    };
    const auto entry =
        reduce_case(text, *parse_symptom("value of store.unorm [vulkan]"), judged_by(fails), 400);
    ASSERT_TRUE(entry);
    const auto loaded = cases::load_text(entry->text, "reduced.toml", "reduced");
    ASSERT_TRUE(loaded) << entry->text;
    const cases::Case& c = loaded->front();
    EXPECT_TRUE(c.target.has_instruments ||
                !diff::may_stay_clear(c, ref::expect(c, ref::Limits{}, Profile::vulkan)))
        << entry->text;
}

// The same, but a depth that is not clamped breaks Direct3D's rules only.
TEST(ReduceCase, ALikeFailureIsNoLessGrave) {
    const auto draw = [](const std::vector<cases::Case>& all) {
        std::vector<CaseRecord> records = draw_sample_depth(all);
        for (CaseRecord& record : records) {
            for (auto& group : record.outcome.groups) {
                group.level = group.rule == "depth.linear" ? Profile::direct3d : group.level;
            }
        }
        return records;
    };
    const auto entry = reduce_case(kClamped, *parse_symptom("value of depth.clamp [vulkan]"),
                                   judged_by(draw), 400);
    ASSERT_TRUE(entry);
    EXPECT_THAT(to_texts(entry->essentials),
                testing::ElementsAre("draw.depth.clamp=true", "several samples", "sloping depth"));
}

// Of a neighbour that the device does not support nobody knows whether it passes.
TEST(ReduceCase, TellsWhatTheDeviceDoesNotDraw) {
    const auto draw = [](const std::vector<cases::Case>& all) {
        std::vector<CaseRecord> records = draw_sample_depth(all);
        for (size_t k = 0; k < all.size(); ++k) {
            if (all[k].target.samples == 2) {
                records[k] = {};
                records[k].status = Status::unsupported;
            }
        }
        return records;
    };
    const auto entry = reduce_case(kClamped, *parse_symptom("value of depth.clamp [vulkan]"),
                                   judged_by(draw), 400);
    ASSERT_TRUE(entry);
    EXPECT_THAT(entry->undrawn, testing::ElementsAre("with 2 samples"));
    EXPECT_THAT(entry->needs, testing::Not(testing::Contains("not with 2 samples")));
    EXPECT_THAT(need_text(*entry),
                testing::AllOf(testing::HasSubstr("# The device draws nothing with 2 samples.\n"),
                               testing::HasSubstr("# It passes with 1 sample in place of 4.\n"),
                               testing::Not(testing::HasSubstr("not "))));
}

// What is needed is not said twice where it is known to pass so.
TEST(NeedText, SaysNothingTwice) {
    Entry entry;
    entry.needs = {"not with 1 sample", "not with one draw"};
    entry.passes = {"with 1 sample in place of 4"};
    EXPECT_EQ(need_text(entry),
              "# It passes, or fails otherwise, with one draw.\n"
              "# It passes with 1 sample in place of 4.\n");
}

TEST(Essentials, KnowATriangleThatIsThinOnTheGrid) {
    const auto words = [](const std::string& draw) {
        const Facts facts = facts_of(
            "format = 1\ndescription = \"D\"\nrules = [\"cover.inside\"]\n[target]\n"
            "size = [8, 4]\n[[draw]]\n" +
            draw + "\n");
        return to_texts(facts.essentials);
    };
    EXPECT_THAT(words("vertices = [[0, 0], [8, 0], [0, 4]]"), testing::IsEmpty());
    EXPECT_THAT(words("vertices = [[0, 0], [8, 0], [0, 0.25]]"), testing::IsEmpty());
    for (const char* thin :
         {"vertices = [[0, 0], [8, 0], [0, 0.125]]", "vertices = [[1, 1], [2, 2], [5, 5]]",
          "vertices = [[1, 1], [1, 1], [1, 1]]",
          // Pixels are 1/4 wide in clip space, and 1/2 high.
          "space = \"clip\"\nvertices = [[0, 0, 0.5, 1], [1, 0, 0.5, 1], [0, 0.0625, 0.5, 1]]",
          "vertices = [[0, 0], [8, 0], [0, 4], [9, 0]]\nindices = [0, 1, 2, 0, 1, 3]"}) {
        EXPECT_THAT(words(thin), testing::Contains("thin triangle")) << thin;
    }
    // A vertex at infinity has no place.
    EXPECT_THAT(words("space = \"clip\"\nvertices = [[0, 0, 0.5, 1], [1, 0, 0.5, 1], [0, 1, 0.5, "
                      "0]]"),
                testing::Not(testing::Contains("thin triangle")));
}

TEST(Essentials, SlopesAreSeenBesideAnyW) {
    const auto words = [](const std::string& vertices) {
        return to_texts(essentials(*cases::read_toml("[[draw]]\n" + vertices + "\n", "f")));
    };
    EXPECT_THAT(words("vertices = [[0, 0, 0.5, 1], [8, 0, 0.5, 2], [0, 8, 0.25, 1]]"),
                testing::ElementsAre("sloping depth", "unequal w"));
    EXPECT_THAT(words("space = \"clip\"\nvertices = [[0, 0, 0.5, 1], [8, 0, 1, 2], [0, 8, 2, 4]]"),
                testing::Not(testing::Contains("sloping depth")));
}

}  // namespace
}  // namespace fuzz
