// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Every mutant is caught by the cases that are named for it, and no legal device by any.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <ostream>

#include "mutants/expected_catches.hpp"
#include "mutants/judge.hpp"

namespace mutants {

// How ctest names a parameter.
void PrintTo(const LegalDevice& device, std::ostream* out) {
    *out << device.name;
}
void PrintTo(const ExpectedCatch& row, std::ostream* out) {
    *out << to_string(row.fault);
}

}  // namespace mutants

namespace mutants {
namespace {

const cases::Suite& suite() {
    static const cases::Suite loaded = cases::load_suite(EDGECASE_SOURCE_DIR "/cases/suite");
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
// file, and of every eighth of the others.
TEST(Suite, NothingDrawnFailsEveryCase) {
    Device device;
    device.fault = Fault::draws_nothing;
    const auto passed = wrong_cases(
        device, cases::Profile::vulkan,
        [](size_t k, const cases::Case& c) {
            return is_every_leaf_asked() || k % 8 == 0 ||
                   suite().cases[k - 1].where.file != c.where.file;
        },
        [](const diff::Verdict& verdict) { return !verdict.error.empty() || verdict.ok(); });
    EXPECT_TRUE(passed.empty()) << "these notice no black picture:" << joined(passed);
}

class Legal : public testing::TestWithParam<LegalDevice> {};

// Each device is asked for every kShare-th leaf, another share than its neighbours, so that every
// leaf meets two or more devices.
constexpr size_t kShare = 16;

TEST_P(Legal, HasNoFinding) {
    const std::vector<LegalDevice> all = legal_devices();
    const auto self = std::find_if(all.begin(), all.end(), [](const LegalDevice& device) {
        return device.name == GetParam().name;
    });
    const auto number = static_cast<size_t>(self - all.begin());
    const auto alarms = wrong_cases(
        GetParam().device, GetParam().profile,
        [&](size_t k, const cases::Case& c) {
            // The device cannot blit.
            return !c.blit && (is_every_leaf_asked() || k % kShare == number % kShare);
        },
        [](const diff::Verdict& verdict) { return !verdict.ok(); });
    EXPECT_TRUE(alarms.empty()) << alarms.size() << " false alarms:" << joined(alarms);
}

INSTANTIATE_TEST_SUITE_P(Devices, Legal, testing::ValuesIn(legal_devices()),
                         [](const auto& device) { return device.param.name; });

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
    for (const FaultInfo& info : all_faults()) {
        const auto rows = expected_catches();
        const auto row = std::find_if(rows.begin(), rows.end(), [&](const ExpectedCatch& r) {
            return r.fault == info.fault;
        });
        ASSERT_NE(row, rows.end()) << info.name;
        EXPECT_FALSE(row->cases.empty()) << info.name;
    }
}

class Mutant : public testing::TestWithParam<ExpectedCatch> {};

// A leaf of each named case has a finding, at the profile of the row and at stricter ones.
TEST_P(Mutant, IsCaught) {
    const ExpectedCatch& row = GetParam();
    Device device;
    device.fault = row.fault;
    for (const cases::Profile profile : cases::kProfiles) {
        if (profile < row.profile) {
            continue;
        }
        for (const std::string_view id : row.cases) {
            const bool caught =
                std::any_of(suite().cases.begin(), suite().cases.end(), [&](const cases::Case& c) {
                    if (!is_named(c, id)) {
                        return false;
                    }
                    const diff::Verdict verdict = judge(c, device, profile);
                    return verdict.error.empty() && !verdict.ok();
                });
            EXPECT_TRUE(caught) << id << " does not catch " << to_string(row.fault) << " at "
                                << cases::to_string(profile);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Faults, Mutant, testing::ValuesIn(expected_catches()),
                         [](const auto& row) { return std::string(to_string(row.param.fault)); });

}  // namespace
}  // namespace mutants
