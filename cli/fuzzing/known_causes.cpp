// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fuzzing/known_causes.hpp"

#include <algorithm>
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

// A case that fails as an expectation file says, and what no entry explains of it.
struct Open {
    std::string text, bug;
    fuzz::Facts facts;
    std::vector<Symptom> symptoms;
};

bool is_explained(const std::vector<Entry>& entries, const Symptom& symptom, const Open& open) {
    return std::ranges::any_of(
        entries, [&](const Entry& e) { return fuzz::explains(e, symptom, open.facts); });
}

bool is_known_failure(Status status) {
    return status == Status::fail || status == Status::crash || status == Status::timeout ||
           status == Status::device_lost;
}

class Reducer {
  public:
    Reducer(run::Session& session, KnownCauses& out, const std::function<void()>& on_progress)
        : session_(session), out_(out), on_progress_(on_progress) {}

    run::Session::Results draw(std::vector<cases::Case> cases) {
        if (is_over()) {
            return {std::vector<CaseRecord>(cases.size()), false, ""};
        }
        run::Session::Results results = session_.draw(std::move(cases), [this](size_t) {
            on_progress_();
            return true;
        });
        out_.is_interrupted = out_.is_interrupted || results.interrupted;
        if (out_.failure.empty()) {
            out_.failure = results.failure;
        }
        return results;
    }
    bool is_over() const {
        out_.is_interrupted = out_.is_interrupted || run::SignalFd::has_come();
        return out_.is_interrupted || !out_.failure.empty();
    }

    std::optional<Entry> reduce(const Open& open, const Symptom& symptom) {
        return fuzz::reduce_case(
            open.text, symptom,
            [this](std::vector<cases::Case> cases, const auto&) { return draw(std::move(cases)); },
            kMostRounds, [this] { return is_over(); });
    }

  private:
    run::Session& session_;
    KnownCauses& out_;
    const std::function<void()>& on_progress_;
};

// The cases that fail as their lines say. What a line does not speak of is not known.
std::vector<Open> failing_cases(const ExpectedFailures& expected, Reducer& reducer) {
    std::vector<cases::Case> cases;
    for (const ExpectedFailures::Failing& one : expected.cases) {
        cases.push_back(one.data);
    }
    const std::vector<CaseRecord> records = reducer.draw(cases).records;
    std::vector<Open> all;
    for (size_t k = 0; k < records.size() && !reducer.is_over(); ++k) {
        CaseRecord record = records[k];
        apply(expected.cases[k].line, record);
        cases::Case c = expected.cases[k].data;
        c.claim.expected_hits.reset();
        const cases::Expected<std::string> text = cases::to_toml(c);
        std::vector<Symptom> symptoms = fuzz::symptoms_of(records[k]);
        if (record.status == Status::xfail && text && !symptoms.empty()) {
            all.push_back({*text, record.known.bug, fuzz::facts_of(*text), std::move(symptoms)});
        }
    }
    // The shortest first: nearest to what it will be.
    std::ranges::stable_sort(
        all, [](const Open& a, const Open& b) { return a.text.size() < b.text.size(); });
    return all;
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
               (line.status != Status::fail &&
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

KnownCauses reduce_known(const ExpectedFailures& expected, const std::vector<Entry>& known,
                         run::Session& session, const std::function<void()>& on_progress,
                         const KeepEntry& keep) {
    KnownCauses out;
    Reducer reducer(session, out, on_progress);
    const std::vector<Open> all = failing_cases(expected, reducer);
    out.failing = all.size();
    std::vector<Entry> entries = known;
    size_t reduced = 0;
    for (const Open& open : all) {
        for (const Symptom& symptom : open.symptoms) {
            if (reducer.is_over()) {
                return out;
            }
            if (is_explained(entries, symptom, open)) {
                continue;
            }
            if (reduced >= kMostCauses) {
                ++out.left;
                continue;
            }
            std::optional<Entry> entry = reducer.reduce(open, symptom);
            if (!entry || reducer.is_over()) {
                continue;
            }
            entry->is_known = true;
            entry->bug = open.bug;
            entry->count = 0;
            ++reduced;
            keep(*entry);
            entries.push_back(std::move(*entry));
        }
    }
    return out;
}

}  // namespace cli
