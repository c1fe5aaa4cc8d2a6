// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Every mutant is caught by the cases that are named for it, and no legal device by any. What was
// recorded of all of them (recorded.hpp) is held against what happens now.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <ostream>
#include <set>
#include <string>

#include "cases/model/rule.hpp"
#include "folders.hpp"
#include "mutants/expected_catches.hpp"
#include "mutants/judge.hpp"
#include "mutants/lead.hpp"
#include "mutants/matrix.hpp"
#include "rasterizers/strength/recorded.hpp"
#include "report/text/sentences.hpp"
#include "share.hpp"

namespace mutants {

// How ctest names a parameter.
void PrintTo(const LegalDevice& device, std::ostream* out) {
    *out << device.name;
}
void PrintTo(const FaultRow& info, std::ostream* out) {
    *out << info.name;
}

}  // namespace mutants

namespace mutants {
namespace {

const Matrix& recorded() {
    static const Matrix matrix = read_matrix(test_support::source_dir() + "/rasterizers/strength");
    return matrix;
}

const cases::Suite& suite() {
    static const cases::Suite loaded =
        cases::load_suite(test_support::source_dir() + "/cases/suite");
    return loaded;
}

// One line for each case of the suite that is `asked` and whose verdict `is_wrong`.
template <class Asked, class Wrong>
std::vector<std::string> wrong_cases(const Device& device, cases::Profile profile,
                                     const Asked& asked, const Wrong& is_wrong) {
    std::mutex mutex;
    std::vector<std::string> lines;
    for_each_parallel(suite().cases.size(), [&](size_t k) {
        const cases::Case& c = suite().cases[k];
        if (!asked(k, c)) {
            return;
        }
        const diff::Verdict verdict = judge(c, device, profile);
        if (is_wrong(verdict)) {
            const std::lock_guard lock(mutex);
            lines.push_back(describe(c, verdict));
        }
    });
    std::sort(lines.begin(), lines.end());
    return lines;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) {
        text += "\n  " + line;
    }
    return text;
}

TEST(Suite, LoadsWithoutErrors) {
    for (const cases::Error& error : suite().errors) {
        ADD_FAILURE() << cases::to_string(error);
    }
    EXPECT_GE(suite().cases.size(), 200U);
}

// EDGECASE_ALL_LEAVES in the environment asks every device for every leaf.
bool is_every_leaf_asked() {
    return std::getenv("EDGECASE_ALL_LEAVES") != nullptr;
}

// A black picture is a finding of every case, at the loosest profile: of the first leaf of each
// file, and of every 32nd of the others.
TEST(Suite, NothingDrawnFailsEveryCase) {
    Device device;
    device.fault = "draws-nothing"_fault;
    const auto passed = wrong_cases(
        device, cases::Profile::vulkan,
        [](size_t k, const cases::Case& c) {
            return is_every_leaf_asked() || k % 32 == 0 ||
                   suite().cases[k - 1].claim.where.file != c.claim.where.file;
        },
        [](const diff::Verdict& verdict) { return !verdict.error.empty() || verdict.ok(); });
    EXPECT_TRUE(passed.empty()) << "these notice no black picture:" << joined(passed);
}

class Legal : public testing::TestWithParam<LegalDevice> {};

// Each device is asked for every kShare-th leaf, another share than its neighbours, so that every
// leaf meets some device. All devices on all leaves: legal.tsv.
constexpr size_t kShare = 32;

TEST_P(Legal, HasNoFinding) {
    const std::vector<LegalDevice> all = legal_devices();
    const auto self = std::find_if(all.begin(), all.end(), [](const LegalDevice& device) {
        return device.name == GetParam().name;
    });
    const auto number = static_cast<size_t>(self - all.begin());
    const auto alarms = wrong_cases(
        GetParam().device, GetParam().profile,
        [&](size_t k, const cases::Case& c) {
            // Blits meet few devices otherwise that blit in their own way.
            return is_every_leaf_asked() || k % kShare == number % kShare ||
                   (c.blit && GetParam().name.starts_with("blit")) ||
                   (family_of(c) == "viewport" && GetParam().name.starts_with("viewports")) ||
                   (family_of(c) == "conservative" && (GetParam().name.starts_with("enlarges") ||
                                                       GetParam().name.starts_with("mitres"))) ||
                   (family_of(c) == "barycentric" && GetParam().name.starts_with("strips"));
        },
        [](const diff::Verdict& verdict) { return !verdict.ok(); });
    EXPECT_TRUE(alarms.empty()) << alarms.size() << " false alarms:" << joined(alarms);
}

INSTANTIATE_TEST_SUITE_P(Devices, Legal, testing::ValuesIn(legal_devices()),
                         [](const auto& device) { return device.param.name; });

// A choice that only looser profiles allow is one that direct3d's cases see: the device really
// makes it, and the profiles really differ.
TEST(Suite, WhatOnlyLooserProfilesAllowIsSeenAtDirect3d) {
    const std::set<std::string> families = {
        "ties",        "snap",  "facing",       "thin",          "topology",
        "multisample", "store", "conservative", "fragment-size", "alpha-to-coverage"};
    for (const LegalDevice& legal : legal_devices()) {
        if (legal.profile == cases::Profile::direct3d || legal.name.starts_with("plain")) {
            continue;
        }
        EXPECT_TRUE(std::any_of(suite().cases.begin(), suite().cases.end(),
                                [&](const cases::Case& c) {
                                    return families.count(family_of(c)) > 0 && is_small(c) &&
                                           !judge(c, legal.device, cases::Profile::direct3d).ok();
                                }))
            << legal.name;
    }
}

// Names are checked first: a case that was renamed must not silently stop to guard.
TEST(Mutants, EveryNamedCaseExists) {
    for (const ExpectedCatch& row : expected_catches()) {
        for (const std::string_view id : row.cases) {
            EXPECT_TRUE(std::any_of(suite().cases.begin(), suite().cases.end(),
                                    [&](const cases::Case& c) { return is_named(c, id); }))
                << to_string(row.fault) << ": no case is called " << id;
        }
    }
}

TEST(Mutants, EveryFaultHasItsCases) {
    for (const FaultRow& info : cases::kFaults) {
        const auto rows = expected_catches();
        const auto row = std::find_if(rows.begin(), rows.end(), [&](const ExpectedCatch& r) {
            return r.fault == info.fault;
        });
        ASSERT_NE(row, rows.end()) << info.name;
        EXPECT_FALSE(row->cases.empty()) << info.name;
    }
}

// The cheapest leaves of two families, those that catch the fault at the loosest profile first.
std::vector<Kill> examples(Fault fault) {
    std::vector<Kill> kills = kills_of(recorded(), fault);
    std::stable_sort(kills.begin(), kills.end(),
                     [](const Kill& a, const Kill& b) { return a.level < b.level; });
    kills.resize(std::min<size_t>(kills.size(), 2));
    return kills;
}

TEST(Recorded, EveryFaultIsCaughtByTwoFamilies) {
    for (const FaultRow& info : cases::kFaults) {
        std::set<std::string> families;
        for (const Kill& kill : kills_of(recorded(), info.fault)) {
            families.insert(kill.family);
            EXPECT_TRUE(kill.leaf.starts_with(kill.family + "/")) << info.name << ": " << kill.leaf;
            EXPECT_TRUE(std::any_of(suite().cases.begin(), suite().cases.end(),
                                    [&](const cases::Case& c) { return c.id == kill.leaf; }))
                << info.name << ": no case is called " << kill.leaf
                << "; build the target record_mutants";
        }
        EXPECT_GE(families.size(), 2U) << info.name;
    }
}

// What `edgecase run --quick` draws, the first and the last leaf of each file, is enough.
TEST(Recorded, EveryFaultIsCaughtByAFirstOrLastLeaf) {
    const std::vector<cases::Case>& all = suite().cases;
    const auto file_of = [&](size_t k) { return all[k].id.substr(0, all[k].id.find(':')); };
    std::set<std::string> quick;
    for (size_t k = 0; k < all.size(); ++k) {
        if (k == 0 || k + 1 == all.size() || file_of(k - 1) != file_of(k) ||
            file_of(k + 1) != file_of(k)) {
            quick.insert(all[k].id);
        }
    }
    for (const FaultRow& info : cases::kFaults) {
        const std::vector<Kill> kills = kills_of(recorded(), info.fault);
        EXPECT_TRUE(std::any_of(kills.begin(), kills.end(), [&](const Kill& kill) {
            return quick.count(std::string(kill.leaf)) > 0;
        })) << info.name;
    }
}

// A rule's profile is the loosest at which breaking it is a finding: no finding is looser.
TEST(Recorded, NoFindingIsLooserThanItsRule) {
    for (const Kill& kill : recorded().kills) {
        std::vector<Lead> leads = {kill.lead};
        for (const LeadCount& count : kill.leads) {
            leads.push_back(count.lead);
        }
        for (const Lead& lead : leads) {
            const cases::Rule* rule = cases::find_rule(lead.rule);
            ASSERT_NE(rule, nullptr) << lead.rule;
            EXPECT_GE(lead.level, rule->profile)
                << to_string(kill.fault) << ", " << kill.family << ": " << lead.rule;
        }
    }
}

TEST(Recorded, LevelsAreNoStricterThanExpected) {
    for (const ExpectedCatch& row : expected_catches()) {
        EXPECT_LE(loosest(kills_of(recorded(), row.fault)), row.profile) << to_string(row.fault);
    }
}

// What a report tells first is a rule that the fault breaks, for nine of ten faults or more.
TEST(Recorded, TheFirstRuleIsABrokenOne) {
    size_t found = 0;
    std::string others;
    for (const FaultRow& info : cases::kFaults) {
        const std::string rule = top_rule(kills_of(recorded(), info.fault));
        if (is_broken(info, rule)) {
            ++found;
        } else {
            others += fmt::format("\n  {}: {}", info.name, rule);
        }
    }
    EXPECT_GE(10 * found, 9 * cases::kFaults.size()) << "misleading:" << others;
    RecordProperty("percent",
                   fmt::format("{:.1f}", 100.0 * static_cast<double>(found) /
                                             static_cast<double>(cases::kFaults.size())));
}

TEST(Recorded, EveryLegalDeviceHasNoFalseAlarm) {
    const std::vector<LegalDevice> devices = legal_devices();
    EXPECT_GE(devices.size(), 12U);
    for (const LegalDevice& device : devices) {
        const auto result =
            std::find_if(recorded().legal.begin(), recorded().legal.end(),
                         [&](const LegalResult& r) { return r.device == device.name; });
        ASSERT_NE(result, recorded().legal.end()) << device.name;
        EXPECT_EQ(result->alarms, 0U) << device.name;
        EXPECT_GT(result->leaves, 1000U) << device.name;
    }
}

// Which faults are run on all the cases that expected_catches() names: the k-th of n shares, by
// EDGECASE_MUTANT_SHARE=I/N (1/1: all). Without it an eighth, another one whenever the suite grows.
bool is_in_share(std::string_view name) {
    return test_support::share_of(8, suite().cases.size(), "EDGECASE_MUTANT_SHARE").has(name);
}

class Mutant : public testing::TestWithParam<FaultRow> {
  protected:
    Mutant() { device_.fault = GetParam().fault; }
    Device device_;
};

// Two families catch it, each at the recorded profile, and lead with the recorded rule.
TEST_P(Mutant, IsCaughtAsRecorded) {
    for (const Kill& kill : examples(GetParam().fault)) {
        const auto c = std::find_if(suite().cases.begin(), suite().cases.end(),
                                    [&](const cases::Case& one) { return one.id == kill.leaf; });
        ASSERT_NE(c, suite().cases.end()) << kill.leaf;
        report::CaseRecord record;
        const diff::Verdict verdict = judge(*c, device_, cases::Profile::direct3d);
        record.outcome.findings = verdict.findings;
        ASSERT_EQ(verdict.error, "");
        ASSERT_FALSE(verdict.ok()) << kill.leaf << " does not catch it any more";
        const diff::Finding& lead = report::leading_finding(record);
        EXPECT_EQ(cases::to_string(lead.level), cases::to_string(kill.level)) << kill.leaf;
        for (const diff::Finding& finding : verdict.findings) {
            const cases::Rule* rule = cases::find_rule(finding.rule);
            ASSERT_NE(rule, nullptr) << finding.rule;
            EXPECT_GE(finding.level, rule->profile) << kill.leaf << ": " << finding.rule;
        }
        EXPECT_EQ(lead.rule, kill.lead.rule)
            << kill.leaf << "; if that is better, build the target record_mutants";
    }
}

// A leaf of each named case has a finding, at the profile of the row and at stricter ones.
TEST_P(Mutant, IsCaughtByItsCases) {
    if (!is_in_share(GetParam().name)) {
        return;
    }
    const auto rows = expected_catches();
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const ExpectedCatch& r) {
        return r.fault == GetParam().fault;
    });
    ASSERT_NE(row, rows.end());
    for (const cases::Profile profile : cases::kProfiles) {
        if (profile < row->profile) {
            continue;
        }
        for (const std::string_view id : row->cases) {
            const bool caught =
                std::any_of(suite().cases.begin(), suite().cases.end(), [&](const cases::Case& c) {
                    if (!is_named(c, id)) {
                        return false;
                    }
                    const diff::Verdict verdict = judge(c, device_, profile);
                    return verdict.error.empty() && !verdict.ok();
                });
            EXPECT_TRUE(caught) << id << " does not catch it at " << cases::to_string(profile);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Faults, Mutant, testing::ValuesIn(cases::kFaults), [](const auto& fault) {
    std::string name(fault.param.name);
    std::ranges::replace(name, '-', '_');
    return name;
});

}  // namespace
}  // namespace mutants
