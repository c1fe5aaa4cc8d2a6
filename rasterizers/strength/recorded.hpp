// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What was measured once and stands in the tree: matrix.tsv (which case files caught which fault)
// and legal.tsv (what was found wrong about devices that break no rule). The target record_mutants
// (tests/mutants) writes both; docs/mutants.md is made of them, and the program holds the first.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/model/profile.hpp"
#include "diff/verdict.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

// What the cases of a group lead with.
struct Lead {
    cases::Profile level = cases::Profile::direct3d;
    diff::FindingKind kind = diff::FindingKind::missing;
    std::string rule;
    bool operator==(const Lead&) const = default;
};

// Of the catching case files of a family those that lead with the same finding.
struct LeadCount {
    Lead lead;
    size_t files = 0;
};

// A fault and one family that caught it.
struct Kill {
    Fault fault = kNoFault;
    std::string family;
    cases::Profile level = cases::Profile::direct3d;  // the loosest at which it is caught
    // A leaf that does so and what it costs to judge: the cheapest of those at `level`.
    std::string leaf;
    Lead lead;                     // of that leaf
    std::vector<LeadCount> leads;  // of all files; the most frequent first
    size_t files() const;
};

struct LegalResult {
    std::string device;
    size_t leaves = 0, alarms = 0;
    double worst_ratio = 0;  // largest accepted error in budgets
};

struct Matrix {
    size_t leaves = 0, files = 0;  // of the suite that were asked
    std::vector<Kill> kills;       // sorted by fault (as in kFaults), then family
    std::vector<LegalResult> legal;
};

// Throws std::runtime_error with one sentence if a file is missing or holds anything else.
Matrix read_matrix(const std::filesystem::path& folder);
// The kills of the matrix.tsv that the program was built with.
const std::vector<Kill>& built_in_kills();
// The two files' texts.
std::string matrix_text(const Matrix& matrix);
std::string legal_text(const Matrix& matrix);

// Those of one fault.
std::vector<Kill> kills_of(const Matrix& matrix, Fault fault);
// The loosest level of any of them.
cases::Profile loosest(const std::vector<Kill>& kills);

}  // namespace software
