// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The outputs for continuous integration: which one, and where they go.
#pragma once

#include <cstdio>
#include <filesystem>

#include "cases/base/error.hpp"
#include "cli/options/options.hpp"
#include "report/record/run.hpp"

namespace cli {

// What --ci comes to: `automatic` is github if GITHUB_ACTIONS is "true", gitlab if GITLAB_CI is,
// else none.
Ci chosen_ci(Ci option);

// True in a job of continuous integration (the variable CI is set and not "false").
bool is_ci();

// github: annotations on `console`, the summary appended to the file of GITHUB_STEP_SUMMARY;
// gitlab: FOLDER/gl-code-quality.json. Returns what could not be written.
cases::Errors write_ci(const report::Run& run, Ci ci, const std::filesystem::path& folder,
                       std::FILE* console);

}  // namespace cli
