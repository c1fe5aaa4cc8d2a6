// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints which cases catch which fault, at which profile; and, with "legal", what is found wrong
// about devices that break no rule. Not a test: it shows where the suite is thin.
//
//     mutant_table [FAULT...]        one line a fault, by first leaves, until two families have it
//     mutant_table --all [...]       by every leaf (hours, for all faults)
//     mutant_table --cases FAULT...  the catching cases, one a line
//     mutant_table --legal [NAME...] legal devices and every false alarm
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "folders.hpp"
#include "mutants/judge.hpp"
#include "mutants/matrix.hpp"

namespace {

// Small leaves by turn, then the others.
std::vector<size_t> leaves_of(const std::vector<cases::Case>& suite) {
    std::vector<size_t> leaves = mutants::leaves_by_turn(suite);
    std::stable_partition(leaves.begin(), leaves.end(),
                          [&](size_t k) { return mutants::is_small(suite[k]); });
    return leaves;
}

void print_faults(const std::vector<cases::Case>& suite, const std::set<std::string>& wanted,
                  bool with_cases, bool all) {
    std::vector<mutants::MatrixRow> rows;
    for (const auto& info : cases::kFaults) {
        if (wanted.empty() || wanted.count(std::string(info.name)) > 0) {
            mutants::MatrixRow row;
            row.fault = info.fault;
            rows.push_back(row);
        }
    }
    std::vector<size_t> leaves = leaves_of(suite);
    if (!all) {
        std::erase_if(leaves, [&](size_t k) { return !mutants::is_small(suite[k]); });
    }
    mutants::measure(
        suite, leaves, rows,
        [&](const mutants::MatrixRow& row) { return with_cases || all || row.files.size() < 2; },
        [](const std::string& line) { fmt::print("false alarm: {}\n", line); });
    fmt::print("{:<30}{:>6} {:>6}  {:<9} families\n", "mutant", "leaves", "files", "loosest");
    for (mutants::MatrixRow& row : rows) {
        std::string families;
        for (const auto& [name, files] : row.files) {
            families += fmt::format("{}{} {}", families.empty() ? "" : ", ", name, files.size());
        }
        fmt::print("{:<30}{:>6} {:>6}  {:<9} {}\n", cases::to_string(row.fault), row.leaves(),
                   row.file_count(), row.leaves() > 0 ? cases::to_string(row.loosest) : "-",
                   families);
        if (with_cases) {
            std::sort(row.lines.begin(), row.lines.end());
            for (const std::string& line : row.lines) {
                fmt::print("    {}\n", line);
            }
        }
    }
}

int print_legal(const std::vector<cases::Case>& suite, const std::set<std::string>& wanted,
                bool all) {
    size_t alarms = 0;
    std::vector<size_t> leaves = leaves_of(suite);
    if (!all) {
        std::erase_if(leaves, [&](size_t k) { return !mutants::is_small(suite[k]); });
    }
    for (const mutants::LegalDevice& legal : mutants::legal_devices()) {
        if (!wanted.empty() && wanted.count(legal.name) == 0) {
            continue;
        }
        std::mutex mutex;
        std::vector<std::string> lines;
        double worst = 0;
        std::string worst_id;
        mutants::for_each_parallel(leaves.size(), [&](size_t n) {
            const cases::Case& c = suite[leaves[n]];
            const auto verdict = mutants::judge(c, legal.device, legal.profile);
            const std::lock_guard lock(mutex);
            if (!verdict.ok()) {
                lines.push_back(mutants::describe(c, verdict));
            } else if (verdict.worst_ratio > worst) {
                worst = verdict.worst_ratio;
                worst_id = c.id;
            }
        });
        std::sort(lines.begin(), lines.end());
        fmt::print("{:<36}{:<9}{:>5} false alarms, worst accepted {:.3f} budgets in {}\n",
                   legal.name, cases::to_string(legal.profile), lines.size(), worst, worst_id);
        for (const std::string& line : lines) {
            fmt::print("    {}\n", line);
        }
        alarms += lines.size();
        std::fflush(stdout);
    }
    return alarms > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    std::set<std::string> words(argv + 1, argv + argc);
    const bool legal = words.erase("--legal") > 0;
    const bool with_cases = words.erase("--cases") > 0;
    const bool all = words.erase("--all") > 0;
    cases::Suite suite = cases::load_suite(test_support::source_dir() + "/cases/suite");
    for (const cases::Error& error : suite.errors) {
        fmt::print(stderr, "{}\n", cases::to_string(error));
    }
    if (legal) {
        return print_legal(suite.cases, words, all);
    }
    print_faults(suite.cases, words, with_cases, all);
    return 0;
}
