// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>
#include <vector>

#include "cases/base/limits.hpp"
#include "cases/fault/fault.hpp"
#include "cases/model/profile.hpp"
#include "cli/prepare/on_threads.hpp"
#include "cli/prepare/outputs.hpp"
#include "diff/verdict.hpp"
#include "rasterizers/strength/recorded.hpp"
#include "rasterizers/strength/strength.hpp"

namespace cli {

namespace {

// A fault that cases of a file catch, by its loosest finding.
struct Catch {
    cases::Profile level = cases::Profile::direct3d;
    std::string rule;
    std::string leaf;
};
using Catches = std::map<cases::Fault, Catch>;

// Of equal levels the first leaf's, whichever thread came first.
void keep(Catches& catches, cases::Fault fault, const Catch& found) {
    const auto [old, is_new] = catches.try_emplace(fault, found);
    if (!is_new &&
        std::tie(found.level, found.leaf) < std::tie(old->second.level, old->second.leaf)) {
        old->second = found;
    }
}

std::string family_of(const std::string& id) {
    return id.substr(0, id.find('/'));
}

// Other families of the suite that are recorded to catch a fault at this level or a looser one.
size_t others(cases::Fault fault, cases::Profile level, const std::string& family) {
    return static_cast<size_t>(
        std::ranges::count_if(software::built_in_kills(), [&](const software::Kill& kill) {
            return kill.fault == fault && kill.level <= level && kill.family != family;
        }));
}

void tell(const std::string& file, const Catches& catches) {
    struct Line {
        size_t others;
        std::string text;
    };
    std::vector<Line> lines;
    for (const auto& [fault, found] : catches) {
        const size_t n = others(fault, found.level, family_of(found.leaf));
        const std::string who =
            n == 0 ? fmt::format("nothing else in the suite does at {}", to_string(found.level))
                   : fmt::format("{} of the suite {} it, too",
                                 n == 1 ? "1 other family" : fmt::format("{} other families", n),
                                 n == 1 ? "catches" : "catch");
        const cases::FaultRow& info = cases::row_of(fault);
        lines.push_back({n, fmt::format("    {}: {}\n        {} [{}]; {}\n", info.name,
                                        info.sentence, found.rule, to_string(found.level), who)});
    }
    std::ranges::stable_sort(lines, {}, &Line::others);
    const auto alone = std::ranges::count(lines, size_t{0}, &Line::others);
    std::string text = fmt::format("{} catches {} of {} known faults{}\n", file, catches.size(),
                                   cases::kFaults.size(),
                                   alone > 0 ? fmt::format(", {} of them alone", alone) : "");
    for (const Line& line : lines) {
        text += line.text;
    }
    say(text);
}

}  // namespace

cases::Errors tell_strength(const LoadedSuite& suite, const std::vector<size_t>& selected,
                            bool quiet) {
    std::vector<cases::Fault> faults;
    for (const cases::FaultRow& info : cases::kFaults) {
        faults.push_back(info.fault);
    }
    std::mutex mutex;
    std::map<std::string, Catches> files;
    for (const size_t k : selected) {
        files[suite.cases[k].claim.where.file];  // also of those that catch nothing
    }
    std::map<size_t, cases::Error> errors;  // by number of the case: in its order
    for_each_on_threads(selected.size(), [&](size_t k) {
        const cases::Case& c = suite.cases[selected[k]];
        Catches own;
        std::string why;
        try {
            const auto wrong = software::try_faults(
                c, faults, [&](cases::Fault fault, const diff::Verdict& verdict) {
                    const auto loosest =
                        std::ranges::min_element(verdict.findings, {}, &diff::Finding::level);
                    own[fault] = {verdict.level, loosest->rule, c.id};
                });
            if (wrong) {
                why = wrong->error.empty() ? wrong->findings.front().why : wrong->error;
            }
        } catch (const std::exception& e) {
            why = cases::reason_of(e);
        }
        const std::lock_guard lock(mutex);
        if (!why.empty()) {
            errors[k] = {
                c.claim.where,
                fmt::format("{}: the software device fails without any fault: {}", c.id, why)};
        }
        for (const auto& [fault, found] : own) {
            keep(files[c.claim.where.file], fault, found);
        }
    });
    if (!quiet) {
        for (const auto& [file, catches] : files) {
            tell(file, catches);
        }
    }
    cases::Errors out;
    for (const auto& [k, error] : errors) {
        out.push_back(error);
    }
    return out;
}

}  // namespace cli
