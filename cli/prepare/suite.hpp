// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Finding, loading and selecting the suite, with the exit codes that its failures have.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cases/load/loader.hpp"
#include "cases/model/case.hpp"
#include "cli/options/options.hpp"
#include "cli/options/program.hpp"
#include "cli/options/stop.hpp"

namespace cli {

// --suite, else EDGECASE_SUITE, else "cases/suite" or, where it is installed,
// "share/edgecase/cases/suite" in a folder above the program, else the source tree that the program
// was built from.
std::filesystem::path find_suite_root(const Program& program, const std::string& option);

// Whether a selector, with or without a way, names case files outside the suite: a file, a leaf of
// one, or a folder.
bool is_outside(const std::string& selector, const std::filesystem::path& root);

// A hash of the paths and bytes of all case files below the folder: whether two runs had the same
// suite.
uint64_t suite_hash(const std::filesystem::path& root);

// A hash of the bytes of files, and of their names without their folders, in hexadecimal; empty
// without any.
std::string hash_of_files(const std::set<std::string>& files);

// The files of cases and their texts, by name, of long ones head and tail; those that cannot be
// read are left out.
std::vector<std::pair<std::string, std::string>> sources_of(
    const std::vector<report::CaseRecord>& cases);

struct LoadedSuite {
    std::filesystem::path root;
    std::vector<cases::Case> cases;  // the suite's, then those of files outside that selectors name
    std::vector<size_t> selected;    // indices into cases, in suite order
    size_t outside = 0;              // the index of the first case that is not the suite's
    std::set<std::string> parts;     // files of which a selector names single leaves
    struct Drawn {
        size_t index = 0;  // into cases
        bool is_suites = false;
    };
    std::map<std::string, Drawn> by_ways = {};  // cases that ways make, by id
    // Whether a case is the suite's, or is drawn of one by a way.
    bool is_suites(size_t k) const;
    // The index of what a way makes of case k, added behind all cases unless it is there.
    size_t add(cases::Case made, size_t k);
    std::vector<std::string> ids() const;        // of all cases
    std::vector<std::string> suite_ids() const;  // of the suite's alone
};
// Loads all and selects. Errors: invalid files (3), a selector that matches nothing (4).
LoadedSuite load_and_select(const Program& program, const SuiteOptions& options,
                            cases::Contents contents = cases::Contents::all);

// As load_and_select, for commands that look at selected cases only: of the other cases of the
// suite the ids are read.
LoadedSuite load_with_ids(const Program& program, const SuiteOptions& options);

// As load_with_ids, but no id is read if all selectors name files outside of the suite.
LoadedSuite load_selected(const Program& program, const SuiteOptions& options);

// As load_selected, for commands on a single case.
cases::Case load_one_case(const Program& program, const SuiteOptions& options);
// The same for a device that is not asked; an error (2), too, if the case has several samples and
// the locations that are given are of other sample counts.
cases::Case load_one_case(const Program& program, const SuiteOptions& options,
                          const JudgedDevice& device);

}  // namespace cli
