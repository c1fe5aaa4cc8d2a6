// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What continuous integration shows of a run. Paths of case files are told relative to `base`, the
// root of the checkout; pages of CI cannot show a file that lies elsewhere (an installed suite).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/record/run.hpp"

namespace report {

// GitHub shows ten errors of a step, so the first ten causes are told, each by one workflow command
// (::error file=,line=,title=::text), and one line says how many more there are. Empty if nothing
// is unexpected.
inline constexpr size_t kMaxAnnotations = 10;
std::string to_github_annotations(const Run& run, const std::filesystem::path& base);

// The same for a run that could not begin: its sentences as one error.
std::string to_github_annotation(const std::vector<std::string>& sentences);

// Markdown for $GITHUB_STEP_SUMMARY: totals, causes, commands. Below GitHub's limit of 1 MiB.
std::string to_github_summary(const Run& run);

// gl-code-quality.json of GitLab (the Code Climate report): one issue an unexpected case, with a
// fingerprint that stays the same as long as the case fails in the same way.
std::string to_gitlab(const Run& run, const std::filesystem::path& base);

}  // namespace report
