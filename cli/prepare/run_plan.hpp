// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a run is made of before any worker draws: which cases, in which order, with which
// expectations.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/prepare/doors.hpp"
#include "cli/prepare/suite.hpp"
#include "run/run_loop.hpp"

namespace cli {

struct Selection {
    std::filesystem::path root;
    std::vector<cases::Case> cases;      // in the order of the run
    std::string of_all_shards;           // report::RunHeader::selection
    std::string own_hash;                // report::RunHeader::own_hash
    std::vector<std::string> known_ids;  // of the whole suite, and of the cases outside of it
    std::vector<std::string> suite_ids;  // of the suite alone
    bool whole_suite = false;
    bool names_limits = false;  // cases::kLimitsCase is selected, which is none of the cases
    LeftOutDoors left_out_doors;
    std::set<std::string> own_files;   // of the cases that are not the suite's
    std::set<std::string> part_files;  // of which some leaves are selected, and others are not
};
// Applies selectors, --quick, --failed-in, --shard and --shuffle. An empty selection is a Stop,
// unless the device's limits are selected.
Selection select_cases(const Program& program, const RunOptions& options);

// What is known of a run before its device is: how, where and when it was started, its suite and
// what was selected.
report::Run new_header(const Program& program, const RunOptions& options,
                       const Selection& selection);

// "2026-11-21T05:00:00Z", which SOURCE_DATE_EPOCH (seconds since 1970) sets for reports that are
// built again; for file names "20261121T050000Z", always the time of the day.
std::string utc_now(bool compact);

// A folder of this time of the day below `parent` that is not there yet:
// "out/20261121T050000Z-llvmpipe", or with "-2" and so on where another one began in that second.
std::filesystem::path new_folder(const std::filesystem::path& parent, const std::string& name);

}  // namespace cli
