// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// At which profiles a device is wrong: what a run found at each level, what of it was expected, and
// which level makes the run fail.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <vector>

#include "cases/model/profile.hpp"
#include "report/record/run.hpp"

namespace report {

// Whether a picture of the case was compared to its end, so that what was found says something of
// the device at each level of the run's profile: it passed or failed, or it is a flake with
// findings. A death, an error, and what was not drawn have no level.
bool is_judged(const CaseRecord& record);

// What of a case's findings an expectation speaks of.
enum class Of : uint8_t { all, news };
// Whether a case that was judged has findings of a level; of those, `news` are the unexpected
// ones: the record's status is unexpected, and fewer of their group are known than there are.
bool has_findings(const CaseRecord& record, cases::Profile level, Of which);
// The loosest level of all findings, or of those that are new; nothing if there is none. An
// unexpected case whose findings are all known (its picture is new, or its signal) has no new one.
std::optional<cases::Profile> level_of(const CaseRecord& record, Of which);

// What a run found at one level.
struct LevelCount {
    cases::Profile level = cases::Profile::vulkan;
    bool is_judged = true;  // false: the run's profile is looser, so nothing is known of it
    // Cases that have findings of this very level, whatever others they have: unexpected ones, and
    // those whose findings of the level are all expected.
    std::vector<const CaseRecord*> unexpected, expected;
};
// A row a level, vulkan first, and of how many cases they are.
struct Levels {
    size_t judged = 0;    // is_judged()
    size_t unjudged = 0;  // selected ones that ended otherwise, unsupported and skipped ones apart
    std::array<LevelCount, std::size(cases::kProfiles)> rows;
};
Levels levels(const Run& run);

// The strictest level at which a finding makes the run fail.
cases::Profile fail_level(const Run& run);
// Whether a result makes the run end with exit code 1: every unexpected one but a failure whose new
// findings are all of stricter levels than this.
bool makes_fail(const CaseRecord& record, cases::Profile fail_level);
bool makes_fail(const Run& run, const CaseRecord& record);

}  // namespace report
