// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the cases of 'fuzz' come from: from nowhere, or from cases that selectors name.
#pragma once

#include <string>

#include "cli/options/options.hpp"
#include "cli/options/program.hpp"
#include "cli/prepare/suite.hpp"
#include "fuzz/generate/source.hpp"

namespace cli {

struct StartCases {
    fuzz::MakeSource source;
    std::string suite;     // the folder, absolute; empty without selectors
    std::string checksum;  // of the files of the cases and of their ids; empty without selectors
    size_t count = 0;      // of the cases; 0 without selectors
};

// What fuzz::check_open_values() says of the files of the selected cases.
cases::Errors check_open_values(const LoadedSuite& suite);

// Errors: invalid files, or a value of [fuzz] with which no case can be loaded (3), a selector that
// matches nothing (4).
StartCases start_cases(const Program& program, const SuiteOptions& options, uint64_t seed);

}  // namespace cli
