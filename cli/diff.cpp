// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "diff": judges what another program rendered of exported cases. Nothing is drawn
// here.
#include <poll.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "capture/exchange/plane_files.hpp"
#include "cases/base/counted.hpp"
#include "cases/base/input_file.hpp"
#include "cases/base/printable.hpp"
#include "cases/select/selector.hpp"
#include "cli/bench/clock.hpp"
#include "cli/commands.hpp"
#include "cli/diagnose.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/command_lines.hpp"
#include "cli/prepare/expectations.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/prepare_run.hpp"
#include "cli/prepare/run_console.hpp"
#include "cli/prepare/run_plan.hpp"
#include "report/journal/journal.hpp"
#include "run/judge.hpp"
#include "run/process/pool.hpp"
#include "run/process/signal_fd.hpp"

namespace cli {

namespace fs = std::filesystem;
using report::CaseRecord;
using report::Status;

namespace {

struct Work {
    const DiffOptions& options;
    ref::Limits limits;
};

// What the folder of one case holds, and what is to be said of it.
void judge_folder(CaseRecord& record, std::vector<std::string>& skipped, const cases::Case& c,
                  const Work& work) {
    const auto begin = Clock::now();
    const fs::path folder = fs::path(work.options.captures) / capture::folder_of(c.id);
    const auto say = [&](Status status, const std::string& reason) {
        record.status = status;
        record.reason = reason;
    };
    if (const std::string wrong = run::check_before_running(c); !wrong.empty()) {
        say(Status::error, wrong);
        return;
    }
    std::error_code none;
    if (fs::exists(folder, none)) {
        if (const auto place = cases::place_inside(work.options.captures, folder); !place) {
            say(Status::error, "'" + folder.string() + "' cannot be read: " +
                                   place.error().message + "; put a copy in its place");
            return;
        }
    }
    const cases::Expected<capture::ReadPlanes> read =
        capture::read_planes(folder, ref::as_drawn(c, work.limits).value_or(c));
    record.drawn.attempts = 1;
    if (!read) {
        say(Status::error, read.error().message);
    } else if (!read->unsupported.empty()) {
        say(Status::unsupported, "the renderer says: " + cases::printable(read->unsupported));
    } else if (read->planes.is_empty()) {
        say(Status::not_run, "no plane was delivered in '" + folder.string() + "'");
        record.drawn.attempts = 0;
    } else {
        run::judge_delivered(record, c, read->planes, work.limits, work.options.run.profile,
                             work.options.run.capture);
        if (record.status == Status::pass || record.status == Status::fail) {
            skipped = diff::not_judged(c, read->planes);
            record.drawn.not_judged = skipped;
            std::string list;
            for (const std::string& word : skipped) {
                list += (list.empty() ? "not judged: " : ", ") + word;
            }
            record.reason = list;
        }
    }
    record.drawn.seconds = seconds_since(begin);
}

// Folders with files below the captures that belong to no case of the suite: a renderer's mistake
// must not look like a case that was left out.
std::vector<std::string> unknown_folders(const fs::path& captures,
                                         const std::vector<std::string>& ids) {
    std::set<std::string> known;
    for (const std::string& id : ids) {
        known.insert(capture::folder_of(id));
    }
    std::set<std::string> unknown;
    std::error_code error;
    for (fs::recursive_directory_iterator it(captures, error), end; !error && it != end;
         it.increment(error)) {
        std::error_code ignored;
        if (!it->is_regular_file(ignored) || it->path().extension() == ".json" ||
            it->path().lexically_relative(captures).begin()->string() == kCarried) {
            continue;  // an export may lie in the same folder
        }
        const std::string folder = it->path().parent_path().lexically_relative(captures).string();
        if (!known.contains(folder)) {
            unknown.insert(folder);
        }
    }
    return {unknown.begin(), unknown.end()};
}

// The cases of an export, by its list.
std::set<std::string> exported_ids(const fs::path& folder) {
    const fs::path file = folder / "index.json";
    std::set<std::string> ids;
    try {
        const auto index = nlohmann::json::parse(cases::read_inside(folder, file).value_or(""));
        if (index.at("schema") == "edgecase-export-1") {
            for (const auto& entry : index.at("cases")) {
                ids.insert(entry.at("id").get<std::string>());
            }
            return ids;
        }
    } catch (const std::exception&) {
        // told below
    }
    throw stop_with(report::kExitInvalidFile,
                    "'" + cases::printable(file.string()) +
                        "' is no list of exported cases; name the folder that "
                        "'edgecase export' wrote");
}

void check_captures(const DiffOptions& options, const std::vector<std::string>& ids) {
    std::error_code ignored;
    if (!fs::is_directory(options.captures, ignored)) {
        throw stop_with(report::kExitInvalidFile,
                        "--captures '" + options.captures +
                            "' is no folder; name the one with the planes that "
                            "were rendered");
    }
    if (!options.exported.empty()) {
        // Without its list, cases of one's own would be told to be unknown.
        exported_ids(options.exported);
    }
    const std::vector<std::string> unknown = unknown_folders(options.captures, ids);
    if (unknown.empty()) {
        return;
    }
    std::vector<std::string> folders;
    for (const std::string& id : ids) {
        folders.push_back(capture::folder_of(id));
    }
    const std::string more =
        unknown.size() == 1 ? "" : " and " + std::to_string(unknown.size() - 1) + " more";
    throw stop_with(
        report::kExitInvalidFile,
        "'" + cases::printable((fs::path(options.captures) / unknown.front()).string()) + "'" +
            more + (more.empty() ? " belongs" : " belong") + " to no case of the suite" +
            cases::did_you_mean(unknown.front(), folders,
                                "; folders have the names that 'edgecase export' writes, and cases "
                                "of your own are known by --exported DIR or by their file or "
                                "folder, as there"));
}

// Without selectors, what was exported or drawn is judged; the sentence says so.
std::string keep_captured(const DiffOptions& options, Selection& selection) {
    const size_t all = selection.cases.size();
    if (!options.exported.empty()) {
        const std::set<std::string> ids = exported_ids(options.exported);
        std::set<std::string> unknown = ids;
        for (const cases::Case& c : selection.cases) {
            unknown.erase(c.id);
        }
        if (options.run.suite.selectors.empty() && !unknown.empty()) {
            throw stop_with(
                report::kExitInvalidFile,
                "'" + cases::printable(options.exported) + "' has the case '" +
                    cases::printable(*unknown.begin()) +
                    "', which is not in the suite; export the cases of this suite again");
        }
        std::erase_if(selection.cases, [&](const cases::Case& c) { return !ids.contains(c.id); });
    } else if (options.run.suite.selectors.empty()) {
        std::erase_if(selection.cases, [&](const cases::Case& c) {
            std::error_code ignored;
            return !fs::is_directory(fs::path(options.captures) / capture::folder_of(c.id),
                                     ignored);
        });
    } else {
        return std::string();
    }
    if (selection.cases.empty()) {
        throw stop_with(
            report::kExitNothingSelected,
            "no case is selected: " + (options.exported.empty()
                                           ? "'" + options.captures + "' holds a folder of none"
                                           : "'" + options.exported + "' lists none of them"));
    }
    const size_t left_out = all - selection.cases.size();
    selection.whole_suite = selection.whole_suite && left_out == 0;
    const bool is_told = options.exported.empty() && left_out > 0;
    return is_told ? cases::counted(left_out, "case") +
                         " without a folder in the captures left out; --exported DIR judges all "
                         "that was exported\n"
                   : std::string();
}

using ExpectedById = std::map<std::string, run::ExpectationLine>;

report::Run make_header(const Program& program, const DiffOptions& options,
                        const Selection& selection) {
    report::Run header = new_header(program, options.run, selection);
    header.jobs = cases::cores();
    header.device.name = options.name.empty() ? "captures" : options.name;
    header.device.driver_name = "files";
    header.device.driver_info = "in " + options.captures;
    header.device.type = "other";
    header.device.subpixel_bits = options.judged.subpixel_bits;
    header.device.sample_locations = options.judged.sample_locations;
    header.device.depth_beside_stencil = options.judged.depth_beside_stencil;
    header.device.has_primitive_id = true;
    for (const cases::Case& c : selection.cases) {
        header.cases.push_back(run::planned_case(c));
        header.cases.back().rerun = diff_line(program, options, c.id);
    }
    header.sources = sources_of(header.cases);
    return header;
}

// What the record counts as, given what was expected of it.
void settle(CaseRecord& record, const ExpectedById& expected, bool requires_support) {
    const auto found = expected.find(record.id);
    if (found != expected.end() && record.status != Status::not_run) {
        apply(found->second, record);
    }
    if (requires_support) {
        run::require_support(record);
    }
}

// "not judged: depth in 12 cases, writer in 3 cases"
std::string skipped_text(const std::map<std::string, size_t>& skipped) {
    std::string text;
    for (const auto& [word, count] : skipped) {
        text +=
            (text.empty() ? "not judged: " : ", ") + word + " in " + cases::counted(count, "case");
    }
    return text.empty() ? text : text + "\n";
}

// What is to be judged, and what was expected of it.
struct Asked {
    Selection selection;
    std::string left_out;  // a sentence
    report::Run header;
    ExpectedById expected;
};

Asked ask(const Program& program, const DiffOptions& options) {
    const RunOptions& o = options.run;
    try {
        Asked asked{select_cases(program, o), {}, {}, {}};
        check_captures(options, asked.selection.known_ids);
        asked.left_out = keep_captured(options, asked.selection);
        asked.header = make_header(program, options, asked.selection);
        asked.expected = expectations_of(o, asked.selection, asked.header);
        return asked;
    } catch (const Stop&) {
        // Nothing was judged; the reports of an earlier call would look like this one's.
        remove_reports_of_last_run(o);
        throw;
    }
}

int carry_out(const Program& program, const DiffOptions& given) {
    run::SignalFd signals;
    DiffOptions options = given;
    options.run.suite.carried =
        (fs::path(given.exported.empty() ? given.captures : given.exported) / kCarried).string();
    const RunOptions& o = options.run;
    Asked asked = ask(program, options);
    const Selection& selection = asked.selection;
    const ExpectedById& expected = asked.expected;
    report::Run& header = asked.header;
    const fs::path folder = o.output.empty() ? new_folder("out", "captures") : fs::path(o.output);
    report::Journal journal = open_journal(folder, header, false);
    remove_reports({folder, o.json, o.junit, o.html});
    std::vector<std::string> ids;
    for (const cases::Case& c : selection.cases) {
        ids.push_back(c.id);
    }
    RunConsole console(o, folder, ids, ids.size());
    console.begin(header, asked.left_out);
    run::SignalFd::set_last_words(cases::printable(
        fmt::format("interrupted, and no reports were written within a second; have them by "
                    "'edgecase report {}'",
                    console.style().folder)));
    const Clock::time_point begin = Clock::now();
    Work work{options, {}};
    work.limits = limits_of(options.judged);
    std::map<std::string, size_t> skipped;
    std::string failure;
    size_t done = 0;
    std::vector<std::vector<std::string>> not_judged(selection.cases.size());
    run::Pool pool(cases::cores());
    for (size_t k = 0; k < selection.cases.size(); ++k) {
        const cases::Case& c = selection.cases[k];
        CaseRecord& record = header.cases[k];
        const auto finish = [&, k] {
            settle(record, expected, o.require_support);
            record.commands.explain = explain_line(program, o, options.judged, c, record);
            if (auto written = journal.write_end(record); !written && failure.empty()) {
                failure = written.error().message;
            }
            for (const std::string& word : not_judged[k]) {
                ++skipped[word];
            }
            ++done;
            console.add(record);
            record.evidence.pictures = {};
            record.outcome.findings.clear();
        };
        if (const auto found = expected.find(c.id);
            found != expected.end() && skips(found->second)) {
            record.status = Status::skip;
            record.reason = found->second.note;
            pool.submit([] {}, finish);
            continue;
        }
        pool.submit([&, k] { judge_folder(record, not_judged[k], c, work); }, finish);
    }
    while (pool.outstanding() > 0 && failure.empty() && !header.interrupted) {
        std::array<pollfd, 2> fds{{{signals.fd(), POLLIN, 0}, {pool.fd(), POLLIN, 0}}};
        ::poll(fds.data(), fds.size(), 200);
        header.interrupted = signals.has_come();
        pool.collect();
        console.show(done);
    }
    console.end();
    header.ended = utc_now(false);
    header.seconds = seconds_since(begin);
    if (auto written = journal.write_stop(header); !written && failure.empty()) {
        failure = written.error().message;
    }
    Ending ending{failure, "judging stopped early", skipped_text(skipped), {}};
    if (o.diagnosis && !header.interrupted) {
        ending.complete = [&](report::Run& run) {
            const auto each = [&](const auto& visit) {
                std::ranges::for_each(selection.cases, visit);
            };
            diagnose(run, each);
            keep_diagnoses(run, journal);
        };
    }
    return conclude(folder, o, Ci::none, console.file(), console.style(), ending);
}

void declare(CLI::App& app, DiffOptions& o) {
    add_suite(&app, o.run.suite);
    app.add_option("--captures", o.captures, "the folder with what was drawn")
        ->type_name("DIR")
        ->required()
        ->group("Selection");
    add_value(&app, "--exported", o.exported,
              "judge all cases of this export [those that have a folder in the captures]", "DIR",
              "Selection");
    add_value(&app, "--name", o.name, "of the renderer, for the reports", "NAME", "Output");
    add_profile(&app, o.run.profile);
    add_fail_at(&app, o.run.fail_at);
    add_judged_device(&app, o.judged);
    add_require_support(&app, o.run, "renderer");
    add_expectations(&app, o.run);
    add_outputs(&app, o.run, "where the reports go [out/<time>-captures]", false);
}

void check(const CLI::App& app, const DiffOptions& o, const Words&) {
    check_fail_at(app, o.run);
}

}  // namespace

Command diff_command() {
    return make_command<DiffOptions>(
        {"diff", kElsewhere, "judge what another program drew of exported cases",
         "  edgecase diff --captures captures                      what was drawn, whatever it is\n"
         "  edgecase diff --captures captures --exported cases     all that was exported to cases\n"
         "  edgecase diff 'ties/**' --captures captures -o out/me  one family, reports in out/me\n"
         "  edgecase diff --captures captures --subpixel-bits 4    of a renderer that snaps to "
         "1/16\n"
         "\n"
         "A case whose folder holds no plane is 'not run' (exit 7); with a file unsupported.txt, "
         "whose\n"
         "first line says why, it is 'unsupported'. Planes that are missing are not judged.\n"},
        declare, carry_out, check);
}

}  // namespace cli
