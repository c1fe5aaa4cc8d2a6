// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/prepare_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "cases/base/checksum.hpp"
#include "cases/base/counted.hpp"
#include "cases/model/device.hpp"
#include "cases/model/rule.hpp"
#include "cases/model/way.hpp"
#include "cases/select/selector.hpp"
#include "cli/options/run_options.hpp"
#include "cli/prepare/claims.hpp"
#include "cli/prepare/command_lines.hpp"
#include "cli/prepare/device_answer.hpp"
#include "cli/prepare/expectations.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/on_threads.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/ways.hpp"
#include "report/journal/journal.hpp"
#include "run/limits_case.hpp"
#include "run/worker/fault.hpp"

namespace cli {

namespace fs = std::filesystem;
using report::CaseRecord;
using report::Run;

namespace {

// A fault that no case can show looks like a runner that does not see it.
void warn_of_idle_faults(const std::vector<std::string>& ids) {
    const char* list = std::getenv("EDGECASE_FAULT");
    const auto faults = run::parse_faults(list != nullptr ? list : "");
    if (!faults) {
        return;  // the worker says so
    }
    for (const run::Fault& fault : *faults) {
        if (fault.glob != "**" && std::ranges::none_of(ids, [&](const std::string& id) {
                return cases::glob_matches(fault.glob, id);
            })) {
            complain("warning: EDGECASE_FAULT: '" + fault.glob + "' matches no case");
        }
    }
}

// So many cases of one's own are looked at before they are drawn: some seconds at most.
constexpr size_t kMostOwnCases = 256;

void warn(cases::Error error) {
    if (error.where.line != 0) {
        error.where.file += fmt::format(":{}:{}", error.where.line, error.where.column);
    }
    complain("warning: " + error.where.file + ": " + error.message);
}

// A rule that the run's profile does not judge is told once, with the first file that claims it.
void warn_of_profile(const std::map<std::string, ClaimedFile>& files, cases::Profile profile) {
    std::map<std::string, std::vector<const ClaimedFile*>> claims;
    for (const auto& [name, file] : files) {
        for (const std::string& id : file.first->claim.rules) {
            const cases::Rule* const rule = cases::find_rule(id);
            if (rule != nullptr && rule->profile > profile) {
                claims[id].push_back(&file);
            }
        }
    }
    for (const auto& [id, claiming] : claims) {
        const size_t more = claiming.size() - 1;
        warn({rule_place(*claiming.front()->first, id),
              fmt::format(
                  "the rule {} is judged at profile {}, and this run is at {}: it says "
                  "nothing of it{}",
                  id, cases::to_string(cases::find_rule(id)->profile), cases::to_string(profile),
                  more == 0 ? std::string()
                            : fmt::format(", nor in {}", cases::counted(more, "other file")))});
    }
}

// A claim that no sample of one's own file exercises passes on every device; 'lint' refuses it, and
// who only runs the file, or its folder, hears of it, too; and of a claim that the run's profile
// does not judge.
void warn_of_claims(const Selection& selection, const SuiteOptions& suite, cases::Profile profile) {
    const std::vector<cases::Case>& selected = selection.cases;
    const std::set<std::string> named(suite.selectors.begin(), suite.selectors.end());
    std::vector<size_t> own;
    for (size_t k = 0; k < selected.size(); ++k) {
        const std::string& file = selected[k].claim.where.file;
        if (named.contains(file) || selection.own_files.contains(file)) {
            own.push_back(k);
        }
    }
    warn_of_left_over(selected, own);
    std::map<std::string, ClaimedFile> files = claimed_files(selected, own, selection.part_files);
    warn_of_profile(files, profile);
    size_t seen = 0, unseen = 0;
    std::vector<ClaimedFile*> looked_at;
    for (auto& [name, file] : files) {
        if (!file.is_whole) {
            continue;  // what is left out may exercise it
        }
        seen += file.cases.size();
        if (seen <= kMostOwnCases) {
            looked_at.push_back(&file);
        } else {
            file.is_whole = false;  // nothing is said of it
            ++unseen;
        }
    }
    for_each_on_threads(looked_at.size(), [&](size_t at) {
        for (const size_t k : looked_at[at]->cases) {
            try {
                looked_at[at]->note(ref::exercise(selected[k], ref::Limits{},
                                                  looked_at[at]->open_rules(), ref::Count::some));
            } catch (const std::exception&) {
                looked_at[at]->is_whole = false;  // the judge says so
            }
        }
    });
    for (const cases::Error& error : check_claims(selected, files)) {
        warn(error);
    }
    if (unseen > 0) {
        complain(
            fmt::format("warning: {} of your own not looked at for claims that no sample "
                        "exercises; 'edgecase lint' looks at all",
                        unseen == 1 ? "1 file is" : fmt::format("{} files are", unseen)));
    }
}

// What of a run that is gone on with is not as it was when it began, since the results of one suite
// and of another are no run; empty if nothing is known to be. Journals of older programs do not
// tell everything.
std::string what_changed(const Run& earlier) {
    if (earlier.tool_version != kVersion) {
        return fmt::format("it began with edgecase {} and this is {}", earlier.tool_version,
                           kVersion);
    }
    if (!earlier.suite_hash.empty() &&
        earlier.suite_hash != cases::hex(suite_hash(earlier.suite_root))) {
        return "the files of the suite '" + earlier.suite_root +
               "' are not those that it began with";
    }
    const auto now = sources_of(earlier.cases);
    for (const auto& source : earlier.sources) {
        if (std::ranges::find(now, source) == now.end()) {
            return "the file '" + source.first + "' is not as it was when it began";
        }
    }
    return {};
}

// By which options a run reaches out of its folder: one loads a library, the others write files.
using Outside = std::vector<std::pair<std::string, std::string>>;
Outside outside_of(const RunOptions& o) {
    Outside all = {
        {"--icd", o.device.icd}, {"--json", o.json}, {"--junit", o.junit}, {"--html", o.html}};
    std::erase_if(all, [](const auto& one) { return one.second.empty() || one.second == "-"; });
    for (auto& [option, file] : all) {
        file = fs::absolute(file).lexically_normal().string();
    }
    return all;
}

// A journal may be a stranger's, so whoever goes on with its run says these again.
void check_agreed(const RunOptions& then, const RunOptions& now, const Outside& agreed,
                  bool has_icd) {
    if (!then.debugger.empty()) {
        throw stop_with(report::kExitUsage,
                        "the run began with --debugger, which "
                        "starts a program; start a new run");
    }
    const Outside wanted = outside_of(then);
    const auto lacks = [](const Outside& all) {
        return [&all](const auto& one) { return std::ranges::find(all, one) == all.end(); };
    };
    if (std::ranges::any_of(wanted, lacks(agreed))) {
        throw stop_with(
            report::kExitUsage,
            "the run began with options that reach out of its folder, and its journal may be "
            "another one's; if you trust it, go on with 'edgecase run --resume " +
                shell_quote(now.resume) + words_to_agree(then) + "'");
    }
    const auto extra = std::ranges::find_if(agreed, lacks(wanted));
    if (extra != agreed.end() && (extra->first != "--icd" || !has_icd)) {
        throw stop_with(report::kExitUsage, "the run did not begin with " + extra->first + " '" +
                                                extra->second +
                                                "'; leave it out or start a new run");
    }
}

}  // namespace

std::string words_to_agree(const RunOptions& options) {
    std::string words;
    for (const auto& [option, file] : outside_of(options)) {
        words += " " + option + " " + shell_quote(file);
    }
    return words;
}

Prepared prepare_resume(const Program& program, const RunOptions& now) {
    Prepared p;
    const Outside agreed = outside_of(now);
    const bool has_icd = std::getenv("EDGECASE_ICD") != nullptr;
    std::vector<std::string> in_flight;
    std::error_code ignored;
    p.folder = fs::absolute(now.resume, ignored);
    const Run earlier = must_read(report::load_journal(p.folder, &in_flight), "--resume: ");
    for (const auto& [name, value] : earlier.environment) {
        if (name == "PWD") {  // paths of the first command line count from there
            fs::current_path(value, ignored);
        }
    }
    // What the first part took from variables, it takes again.
    for (const char* variable :
         {"EDGECASE_PROFILE", "EDGECASE_DEVICE", "EDGECASE_ICD", "EDGECASE_TIMEOUT"}) {
        ::unsetenv(variable);
        for (const auto& [name, value] : earlier.environment) {
            if (name == variable) {
                ::setenv(variable, value.c_str(), 1);
            }
        }
    }
    RunOptions options = parse_run_arguments(earlier.arguments);
    check_agreed(options, now, agreed, has_icd);
    p.options = std::move(options);
    p.options.resume = now.resume;  // its folder is not an earlier run's, whatever goes wrong
    p.options.jobs = now.jobs;
    p.options.quiet = now.quiet;
    p.options.verbose = now.verbose;
    p.options.color = now.color;
    p.options.progress = now.progress;
    SuiteOptions suite = p.options.suite;
    suite.suite = earlier.suite_root;
    std::erase_if(suite.selectors, [&](const std::string& s) {
        return !is_outside(s, earlier.suite_root);  // the journal has the ids
    });
    LoadedSuite loaded = load_and_select(program, suite);
    add_drawn(loaded, earlier);
    p.header = earlier;
    p.selection.root = loaded.root;
    p.selection.known_ids = loaded.ids();
    p.selection.suite_ids = loaded.suite_ids();
    std::map<std::string, const cases::Case*> by_id;
    for (const cases::Case& c : loaded.cases) {
        by_id.emplace(c.id, &c);
    }
    const auto is_of_device = [](const CaseRecord& r) { return r.id == cases::kLimitsCase; };
    p.selection.whole_suite =
        earlier.cases.size() ==
        loaded.cases.size() + (std::ranges::any_of(earlier.cases, is_of_device) ? 1U : 0U);
    const std::set<std::string> cut_off(in_flight.begin(), in_flight.end());
    for (const CaseRecord& record : earlier.cases) {
        const auto found = by_id.find(record.id);
        if (found != by_id.end() && !record.content.empty() &&
            run::planned_case(*found->second).content != record.content) {
            throw stop_with(
                report::kExitInvalidFile,
                "the run cannot go on: '" + record.id +
                    "' is another case under the same id than the run began with; start "
                    "a new run");
        }
        if (record.status != report::Status::not_run || is_of_device(record)) {
            continue;
        }
        if (found == by_id.end()) {
            throw stop_with(report::kExitInvalidFile,
                            "the run cannot go on: its case '" + record.id +
                                "' is no longer in the suite; start a new run");
        }
        run::Task task;
        task.data = *found->second;
        for (const std::string& word : record.doors) {
            if (const std::optional<cases::Door> door = cases::find_door(word)) {
                task.data.doors.push_back(*door);
            }
        }
        task.planned = run::planned_case(task.data);
        task.planned.left_out_doors = record.left_out_doors;
        task.alone = cut_off.contains(record.id);
        p.plan.push_back(std::move(task));
    }
    if (const std::string changed = what_changed(earlier); !changed.empty()) {
        throw stop_with(report::kExitInvalidFile,
                        "the run cannot go on: " + changed + "; start a new run");
    }
    p.is_resumed = true;
    return p;
}

Prepared prepare(const Program& program, const RunOptions& options) {
    Selection selection = select_cases(program, options);
    Prepared p;
    p.options = options;
    p.selection = std::move(selection);
    warn_of_idle_faults(p.selection.known_ids);
    warn_of_claims(p.selection, options.suite, options.profile);
    Run& header = p.header = new_header(program, options, p.selection);
    header.shard = options.shard.index;
    header.shards = options.shard.count;
    header.jobs = options.jobs;
    for (cases::Case& c : p.selection.cases) {
        run::Task task;
        task.planned = run::planned_case(c);
        task.planned.rerun =
            rerun_line(program, options, c.id, {doors_words(options.doors, task.planned.doors)});
        task.planned.left_out_doors = std::move(p.selection.left_out_doors[c.id]);
        task.data = std::move(c);
        header.cases.emplace_back(task.planned);
        p.plan.push_back(std::move(task));
    }
    header.sources = sources_of(header.cases);
    p.selection.cases.clear();
    p.folder = options.output;
    return p;
}

report::Journal open_journal(const fs::path& folder, const Run& header, bool resumed) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        throw stop_with(report::kExitUsage, "the folder '" + folder.string() +
                                                "' cannot be made: " + error.message() +
                                                "; choose another with -o");
    }
    report::Journal journal = must(report::Journal::open(folder, resumed), report::kExitUsage);
    if (!resumed) {
        must(journal.write_run(header), report::kExitInternal);
        must(journal.write_device(header.device), report::kExitInternal);
    }
    return journal;
}

report::Journal begin_journal(Prepared& p, bool resumed) {
    if (p.folder.empty()) {
        p.folder = new_folder("out", file_name_of(p.header.device.name));
    }
    report::Journal journal = open_journal(p.folder, p.header, resumed);
    if (!resumed) {
        remove_reports({p.folder, p.options.json, p.options.junit, p.options.html});
    }
    return journal;
}

namespace {

// Whether an expectation file leaves a door out.
bool is_skipped(const Run& run, std::string_view word) {
    return std::ranges::find(run.skipped_doors, word, [](const auto& skipped) {
               return std::string_view(skipped.first);
           }) != run.skipped_doors.end();
}

}  // namespace

void apply_expectations(Prepared& p) {
    const std::string hash_before = p.header.expectation_hash;
    const auto expected = expectations_of(p.options, p.selection, p.header);
    const bool tells_hash = !p.header.selection.empty();  // journals of older programs do not
    if (p.is_resumed && tells_hash && p.header.expectation_hash != hash_before) {
        throw stop_with(report::kExitInvalidFile,
                        "the run cannot go on: the expectation files are not those that it began "
                        "with; start a new run");
    }
    if (const auto found = expected.find(cases::kLimitsCase); found != expected.end()) {
        p.of_limits = found->second;
    }
    if (ways_of(p.options) == "default" && !p.is_resumed) {
        // A case that is known to be wrong mostly is so by each way, too.
        const auto is_known = [&](std::string_view id) {
            const auto [base, way] = cases::split_way(id);
            const auto of_base = expected.find(std::string(base));
            const auto of_way = expected.find(std::string(id));
            return !way.empty() && of_base != expected.end() &&
                   (of_way == expected.end() || skips(of_way->second));
        };
        std::erase_if(p.plan, [&](const run::Task& task) { return is_known(task.data.id); });
        std::erase_if(p.header.cases, [&](const CaseRecord& c) { return is_known(c.id); });
    }
    const auto skip_words = [&](report::PlannedCase& planned) {
        std::erase_if(planned.doors, [&](const auto& word) { return is_skipped(p.header, word); });
    };
    for (run::Task& task : p.plan) {
        if (const auto found = expected.find(task.data.id); found != expected.end()) {
            task.expected = found->second;
        }
        std::erase_if(task.data.doors, [&](cases::Door door) {
            return is_skipped(p.header, cases::row_of(door).word);
        });
        skip_words(task.planned);
    }
    std::ranges::for_each(p.header.cases, skip_words);
}

std::optional<CaseRecord> limits_record(const Program& program, const Prepared& p,
                                        const capture::DeviceInfo& device) {
    const auto& all = p.header.cases;
    const auto known = std::ranges::find(all, cases::kLimitsCase, &CaseRecord::id);
    const bool is_named = p.of_limits && p.of_limits->glob == cases::kLimitsCase;
    const bool is_due = p.is_resumed
                            ? known != all.end() && known->status == report::Status::not_run
                            : !device.wrong_limits.empty() || is_named || p.selection.names_limits;
    if (!is_due) {
        return std::nullopt;
    }
    CaseRecord record = run::judge_limits(device);
    record.rerun = rerun_line(program, p.options, record.id);
    if (p.of_limits && skips(*p.of_limits)) {
        record.outcome = {};
        record.status = report::Status::skip;
        record.reason = p.of_limits->note;
    }
    if (p.of_limits) {
        apply(*p.of_limits, record);
    }
    if (p.options.require_support) {
        run::require_support(record);
    }
    return record;
}

}  // namespace cli
