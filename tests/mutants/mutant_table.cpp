// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints which cases catch which fault, at which profile; and, with "legal", what is found wrong
// about devices that break no rule. Not a test: it shows where the suite is thin.
//
//     mutant_table [FAULT...]        one line a fault
//     mutant_table --small [...]     only cases of at most 64x64 samples: quick
//     mutant_table --cases FAULT...  the catching cases, one a line
//     mutant_table --legal [NAME...] legal devices and every false alarm
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "mutants/judge.hpp"

namespace {

using mutants::Fault;

std::string family(const std::string& id) {
    return id.substr(0, id.find('/'));
}

struct Row {
    size_t caught = 0;
    size_t errors = 0;
    cases::Profile loosest = cases::Profile::direct3d;
    std::map<std::string, size_t> families;
    std::vector<std::string> lines;
};

void print_faults(const std::vector<cases::Case>& suite, const std::set<std::string>& wanted,
                  bool with_cases) {
    std::vector<Fault> faults;
    for (const auto& info : mutants::all_faults()) {
        if (wanted.empty() || wanted.count(std::string(info.name)) > 0) {
            faults.push_back(info.fault);
        }
    }
    std::vector<Row> rows(faults.size());
    std::mutex mutex;
    mutants::for_each_parallel(suite.size(), [&](size_t k) {
        const cases::Case& c = suite[k];
        const auto expectation = ref::expect(c, {}, cases::Profile::direct3d);
        for (size_t f = 0; f < faults.size(); ++f) {
            mutants::Device device;
            device.fault = faults[f];
            const auto verdict = diff::compare(c, expectation, mutants::render(c, device));
            if (verdict.ok()) {
                continue;
            }
            const std::lock_guard lock(mutex);
            Row& row = rows[f];
            ++row.caught;
            ++row.families[family(c.id)];
            row.errors += verdict.error.empty() ? 0U : 1U;
            row.loosest = std::min(row.loosest, verdict.level);
            row.lines.push_back(fmt::format("{}  {}", cases::to_string(verdict.level),
                                            mutants::describe(c, verdict)));
        }
    });
    fmt::print("{:<26}{:>7}  {:<9} families\n", "mutant", "cases", "loosest");
    for (size_t f = 0; f < faults.size(); ++f) {
        Row& row = rows[f];
        std::string families;
        for (const auto& [name, count] : row.families) {
            families += fmt::format("{} {}, ", name, count);
        }
        if (!families.empty()) {
            families.resize(families.size() - 2);
        }
        fmt::print("{:<26}{:>7}  {:<9} {}{}\n", mutants::to_string(faults[f]), row.caught,
                   row.caught > 0 ? cases::to_string(row.loosest) : "-", families,
                   row.errors > 0 ? fmt::format(" ({} could not be judged)", row.errors) : "");
        if (with_cases) {
            std::sort(row.lines.begin(), row.lines.end());
            for (const std::string& line : row.lines) {
                fmt::print("    {}\n", line);
            }
        }
    }
}

int print_legal(const std::vector<cases::Case>& suite, const std::set<std::string>& wanted) {
    size_t alarms = 0;
    for (const mutants::LegalDevice& legal : mutants::legal_devices()) {
        if (!wanted.empty() && wanted.count(legal.name) == 0) {
            continue;
        }
        std::mutex mutex;
        std::vector<std::string> lines;
        double worst = 0;
        std::string worst_id;
        mutants::for_each_parallel(suite.size(), [&](size_t k) {
            const auto verdict = mutants::judge(suite[k], legal.device, legal.profile);
            const std::lock_guard lock(mutex);
            if (!verdict.ok()) {
                lines.push_back(mutants::describe(suite[k], verdict));
            } else if (verdict.worst_ratio > worst) {
                worst = verdict.worst_ratio;
                worst_id = suite[k].id;
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
    const bool small = words.erase("--small") > 0;
    cases::Suite suite = cases::load_suite(EDGECASE_SOURCE_DIR "/cases/suite");
    for (const cases::Error& error : suite.errors) {
        fmt::print(stderr, "{}\n", cases::to_string(error));
    }
    if (small) {
        std::erase_if(suite.cases, [](const cases::Case& c) {
            return c.target.width * c.target.rows() * c.target.samples > 64U * 64U;
        });
    }
    if (legal) {
        return print_legal(suite.cases, words);
    }
    print_faults(suite.cases, words, with_cases);
    return 0;
}
