// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fuzzing/known_causes.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "cases/base/checksum.hpp"
#include "cases/model/door.hpp"
#include "cases/write/to_toml.hpp"
#include "cli/prepare/expectations.hpp"
#include "cli/prepare/run_plan.hpp"
#include "fuzz/same_cause.hpp"

namespace cli {

using fuzz::Entry;
using fuzz::Symptom;
using report::CaseRecord;
using report::Status;

namespace {

constexpr size_t kMostCauses = 96;   // more are no list that anybody keeps
constexpr size_t kMostRounds = 200;  // of one reduction
constexpr size_t kMostDeaths = 1;    // cases of one line that are drawn to see a crash or a hang

bool is_known_failure(Status status) {
    return status == Status::fail || status == Status::flake || status == Status::crash ||
           status == Status::timeout || status == Status::device_lost;
}

}  // namespace

ExpectedFailures expected_failures(const Program& program, const RunOptions& options,
                                   const capture::DeviceInfo& device) {
    ExpectedFailures out;
    if (options.no_expect) {
        return out;
    }
    SuiteOptions whole;
    whole.suite = options.suite.suite;
    LoadedSuite names;
    try {
        names = load_and_select(program, whole, cases::Contents::ids);
    } catch (const Stop&) {
        // A hunt that makes its own cases needs no suite, unless somebody names one.
        if (!options.expect.empty() || !options.suite.suite.empty()) {
            throw;
        }
        return out;
    }
    Selection selection;
    selection.root = names.root;
    selection.known_ids = selection.suite_ids = names.ids();
    report::Run header;
    header.device = device;
    RunOptions asking = options;
    asking.doors = "all";  // a hunt draws cases through any of them
    auto lines = expectations_of(asking, selection, header);
    for (const auto& [word, bug] : header.skipped_doors) {
        if (const std::optional<cases::Door> door = cases::find_door(word)) {
            out.broken_doors.insert(*door);
        }
    }
    std::map<std::string, size_t> deaths;  // by line
    std::erase_if(lines, [&](const auto& named) {
        const run::ExpectationLine& line = named.second;
        return !is_known_failure(line.status) || line.is_past ||
               (line.status != Status::fail && line.status != Status::flake &&
                ++deaths[line.where.file + ":" + std::to_string(line.where.line)] > kMostDeaths);
    });
    if (lines.empty()) {
        return out;
    }
    for (const auto& [id, line] : lines) {
        whole.selectors.push_back(id);
    }
    LoadedSuite suite = load_selected(program, whole);
    uint64_t hash = 0;
    std::set<std::string> files;
    for (const size_t k : suite.selected) {
        cases::Case& c = suite.cases[k];
        const run::ExpectationLine& line = lines.at(c.id);
        hash = cases::stable_hash(c.id + " " + line.bug + " " + to_text(line.cause), hash);
        files.insert(line.where.file);
        out.cases.push_back({std::move(c), line});
    }
    out.files = files.size();
    out.checksum = cases::hex(hash);
    return out;
}

// The cases that fail as their lines say. What a line does not speak of is not known.
void KnownCauses::draw_all(const run::DrawAndJudge& draw, const std::function<bool()>& is_over) {
    std::vector<cases::Case> cases;
    for (const ExpectedFailures::Failing& one : expected_.cases) {
        cases.push_back(one.data);
    }
    const std::vector<CaseRecord> records = draw(cases, {}).records;
    if (is_over()) {
        return;
    }
    is_drawn_ = true;
    for (size_t k = 0; k < records.size(); ++k) {
        CaseRecord record = records[k];
        apply(expected_.cases[k].line, record);
        cases::Case c = std::move(expected_.cases[k].data);
        c.claim.expected_hits.reset();
        const cases::Expected<std::string> text = cases::to_toml(c);
        std::vector<Symptom> symptoms = fuzz::symptoms_of(records[k]);
        if (record.status == Status::xfail && text && !symptoms.empty()) {
            open_.push_back(
                {c.id, *text, record.known.bug, fuzz::facts_of(*text), std::move(symptoms)});
        }
    }
    failing_ = open_.size();
    // The shortest first: nearest to what it will be.
    std::ranges::stable_sort(
        open_, [](const Open& a, const Open& b) { return a.text.size() < b.text.size(); });
}

// Leaves out what entries explain.
void KnownCauses::explain(const std::vector<Entry>& entries) {
    for (Open& open : open_) {
        std::erase_if(open.symptoms, [&](const Symptom& symptom) {
            return std::ranges::any_of(entries, [&](const Entry& entry) {
                return fuzz::explains(entry, symptom, open.facts);
            });
        });
    }
    std::erase_if(open_, [](const Open& open) { return open.symptoms.empty(); });
}

std::optional<Entry> KnownCauses::next(const std::vector<Entry>& entries,
                                       const run::DrawAndJudge& draw,
                                       const std::function<bool()>& is_over, const Tell& tell) {
    const auto begin = std::chrono::steady_clock::now();
    std::optional<Entry> entry;
    if (!is_drawn_) {
        tell("drawing expected failures");
        draw_all(draw, is_over);
    }
    while (is_drawn_ && !entry && !is_over()) {
        explain(entries);
        if (open_.empty()) {
            break;
        }
        Open& open = open_.front();
        if (causes_ < kMostCauses) {
            tell("reducing known " + open.id);
            entry = fuzz::reduce_case(open.text, open.symptoms.front(), draw, kMostRounds, is_over);
        } else {
            ++left_;
        }
        if (is_over()) {
            entry.reset();
            break;
        }
        open.symptoms.erase(open.symptoms.begin());
        if (entry) {
            ++causes_;
            entry->is_known = true;
            entry->bug = open.bug;
            entry->count = 0;
        }
    }
    explain(entries);
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return entry;
}

}  // namespace cli
