// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The rules that case files claim to test, and whether some sample is decided by each; and their
// draws, and whether something can be seen of each.
#pragma once

#include <atomic>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cases/base/error.hpp"
#include "cases/model/case.hpp"
#include "ref/exercise/exercise.hpp"

namespace cli {

// The cases of a file, which claim the same rules, and which of these some sample exercises.
struct ClaimedFile {
    const cases::Case* first = nullptr;
    std::vector<size_t> cases;  // the chosen ones
    bool is_whole = false;      // they are all cases of the file
    std::vector<std::atomic<bool>> exercised;
    std::vector<std::atomic<ref::Sight>> draws;  // the best sight of each

    explicit ClaimedFile(const cases::Case& c)
        : first(&c), exercised(c.claim.rules.size()), draws(c.draws.size()) {}
    // The claims of which no sample is known yet.
    std::vector<std::string> open_rules() const;
    // Whether a sample is known that exercises the rule, which is claimed.
    bool has(std::string_view rule) const;
    // Takes down what a case exercises; several threads may do so at once.
    void note(const ref::Exercise& found);
};

// The fewest subpixel bits that a device may have [Vulkan, "Required Limits"]: with these, more
// samples are near edges.
inline constexpr int kFewestSubpixelBits = 4;

// Where the case's file claims the rule; the case's place if that cannot be told. Reads the file.
cases::SourceLocation rule_place(const cases::Case& c, std::string_view rule);

// The files of the chosen cases (indices into `all`), by name. `all` stays where it is, and has all
// cases of a file unless that is one of `parts`.
std::map<std::string, ClaimedFile> claimed_files(const std::vector<cases::Case>& all,
                                                 const std::vector<size_t>& chosen,
                                                 const std::set<std::string>& parts);

// Warns of vertices of the chosen cases (indices into `all`) that make no triangle, once a file.
void warn_of_left_over(const std::vector<cases::Case>& all, const std::vector<size_t>& chosen);

// One error for each open claim of a whole file that no sample exercises with the fewest subpixel
// bits either; and one for each draw of which nothing can be seen in any case of a whole file.
cases::Errors check_claims(const std::vector<cases::Case>& all,
                           std::map<std::string, ClaimedFile>& files);

}  // namespace cli
