// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The causes that expectation files explain, as a hunt knows causes: each reduced once, so that it
// is told apart by what it needs and not by the ids of cases.
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/options/program.hpp"
#include "cli/prepare/suite.hpp"
#include "fuzz/entry.hpp"
#include "report/record/run.hpp"
#include "run/expected/expectation_file.hpp"
#include "run/session.hpp"

namespace cli {

// Cases of the suite that are expected to fail here, and how.
struct ExpectedFailures {
    struct Failing {
        cases::Case data;
        run::ExpectationLine line;
    };
    std::vector<Failing> cases;
    std::set<cases::Door> broken_doors;  // "door=NAME skip"
    size_t files = 0;                    // expectation files that speak of them
    std::string checksum;                // of what they say of which cases; empty if nothing
};

// By --expect or the files beside the suite that fit the device; nothing with --no-expect, and
// where there is no suite. Errors: invalid files (3), an --expect that does not fit (5).
ExpectedFailures expected_failures(const Program& program, const RunOptions& options,
                                   const capture::DeviceInfo& device);

struct KnownCauses {
    size_t failing = 0;  // cases that fail as expected
    size_t left = 0;     // symptoms that were not reduced: too many causes
    bool is_interrupted = false;
    std::string failure;
};
// Keeps a known cause, which has no file yet.
using KeepEntry = std::function<void(const fuzz::Entry&)>;
// Draws the cases, and reduces of what they show what neither `known` nor an earlier one explains;
// each cause is kept at once.
KnownCauses reduce_known(const ExpectedFailures& expected, const std::vector<fuzz::Entry>& known,
                         run::Session& session, const std::function<void()>& on_progress,
                         const KeepEntry& keep);

}  // namespace cli
