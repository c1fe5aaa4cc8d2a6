// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "run": select, ask the device, draw and judge, write the reports.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <variant>

#include "cases/base/printable.hpp"
#include "cases/base/regex.hpp"
#include "cases/model/device.hpp"
#include "cli/commands.hpp"
#include "cli/diagnose.hpp"
#include "cli/options/parse.hpp"
#include "cli/prepare/ci.hpp"
#include "cli/prepare/device_answer.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/prepare_run.hpp"
#include "cli/renderers/renderers.hpp"
#include "cli/reproducer/reproducer.hpp"
#include "report/files/ci.hpp"
#include "report/journal/journal.hpp"
#include "report/record/levels.hpp"
#include "report/text/sentences.hpp"
#include "report/text/unexpected.hpp"
#include "run/process/library.hpp"
#include "run/process/pool.hpp"
#include "run/worker/derived.hpp"

namespace cli {

namespace fs = std::filesystem;
using report::CaseRecord;
using report::Run;

namespace {

// Checks every hand-drawn picture, on all cores, before a device is asked.
void check_pictures(std::vector<run::PlannedCase>& plan) {
    run::Pool pool(cases::cores());
    for (run::PlannedCase& c : plan) {
        if (c.data.claim.expected_hits) {
            pool.submit([&c] { c.error = run::check_before_running(c.data); }, [] {});
        }
    }
    while (pool.outstanding() > 0) {
        pool.wait();
        pool.collect();
    }
}

OrStop<std::monostate> check_required_device(const RunOptions& options,
                                             const capture::DeviceInfo& device) {
    if (options.require_device.empty()) {
        return std::monostate{};
    }
    const std::string text = device.name + " " + device.driver_name + " " + device.driver_info;
    if (!cases::find_regex(options.require_device, text)) {
        return tl::unexpected(
            stop_with(report::kExitDevice, "--require-device '" + options.require_device +
                                               "' does not match the device '" + text +
                                               "'; choose another with --device or --icd"));
    }
    return std::monostate{};
}

bool is_same_device(const capture::DeviceInfo& a, const capture::DeviceInfo& b) {
    return a.name == b.name && a.uuid == b.uuid && a.driver_version == b.driver_version &&
           a.subpixel_bits == b.subpixel_bits && a.sample_locations == b.sample_locations &&
           a.depth_beside_stencil == b.depth_beside_stencil;
}

// One case, drawn once, by a worker that a person looks at.
OrStop<std::monostate> set_debugger(const Program& program, const RunOptions& options,
                                    std::vector<run::PlannedCase>& plan, run::LoopConfig& config) {
    if (plan.size() != 1) {
        return tl::unexpected(stop_with(report::kExitUsage, "--debugger runs one case, and " +
                                                                std::to_string(plan.size()) +
                                                                " are selected; name one id"));
    }
    cases::Expected<run::Command> command = debugged_worker_command(program, options.debugger);
    if (!command) {
        return tl::unexpected(stop_with(report::kExitUsage, command.error().message));
    }
    plan.front().alone = true;
    config.command = std::move(*command);
    config.timeout = std::chrono::hours(24 * 365);
    config.worker.device.longest_wait_ms = 0;
    config.schedule.lanes = 1;
    config.schedule.repeat = 1;
    config.schedule.retries = 0;
    return std::monostate{};
}

// Nothing was judged: there are no reports, so the CI is told here; those of an earlier run in the
// same folder would look like this one's.
int stopped(const RunOptions& options, const Stop& stop, bool owns_folder = true) {
    if (owns_folder) {
        remove_reports_of_last_run(options);
    }
    if (chosen_ci(options.ci) == Ci::github) {
        std::fputs(report::to_github_annotation(stop.lines).c_str(), stderr);
    }
    return report_stop(stop);
}

int run_prepared(const Program& program, Prepared& p, run::LoopConfig config,
                 run::WorkerClient worker, run::SignalFd& signals, const RunTeller* teller) {
    const bool resumed = !p.header.device.name.empty();
    const RunOptions& options = p.options;
    check_pictures(p.plan);
    OrStop<ReadyWorker> first = await_first_worker(std::move(worker), config, signals);
    if (!first) {
        Stop stop = first.error();
        const auto drivers = find_drivers(options.device).drivers;
        if (!options.device.icd.empty() && !drivers.empty()) {
            if (const std::string why = run::load_problem(drivers.front()); !why.empty()) {
                stop.lines.push_back("  " + why);
            }
        }
        return stopped(options, stop);
    }
    const capture::DeviceInfo device = first->device;
    if (resumed && !is_same_device(device, p.header.device)) {
        return stopped(options,
                       stop_with(report::kExitDevice,
                                 "the run cannot go on: it was on '" + p.header.device.name +
                                     "', this is '" + device.name + "' or another driver version"));
    }
    p.header.device = device;
    config.limits = run::limits_of(first->device);
    if (auto fits = check_required_device(options, device); !fits) {
        return stopped(options, fits.error());
    }
    if (auto applied = apply_expectations(p); !applied) {
        return stopped(options, applied.error());
    }
    const JudgedDevice judged{cases::judged_subpixel_bits(device.subpixel_bits),
                              device.sample_locations, device.depth_beside_stencil};
    for (run::PlannedCase& c : p.plan) {
        c.selector = shell_quote(selector_of(options, c.data.id));
        std::vector<std::string> doors;
        for (const cases::Door door : c.data.doors) {
            doors.emplace_back(cases::row_of(door).word);
        }
        c.rerun = rerun_line(program, options, c.data.id, doors);
        c.plain_rerun = rerun_line(program, options, c.data.id);
        c.explain = explain_line(program, options, c.data.id, judged);
        c.no_reproducer = undrawable_part(c.data);
        if (c.no_reproducer.empty()) {
            c.reproducer = reproducer_line(program, options, c.data.id, judged);
            c.no_reproducer = may_be_too_large(c.data) ? "many values" : "";
        }
    }
    std::optional<CaseRecord> limits;
    if (teller != nullptr) {
        warn_of_limits(first->device);  // it is none of the tests that the runner knows
    } else if (limits = limits_record(program, p, first->device); limits && !resumed) {
        CaseRecord& planned = *p.header.cases.emplace(p.header.cases.begin());
        static_cast<report::PlannedCase&>(planned) = *limits;
    }
    if (p.folder.empty()) {
        p.folder = new_folder("out", file_name_of(device.name));
    }
    OrStop<report::Journal> journal = open_journal(p.folder, p.header, resumed);
    if (!journal) {
        return stopped(options, journal.error(), false);
    }
    if (!resumed) {
        remove_reports({p.folder, options.json, options.junit, options.html});
    }

    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> nowhere(
        teller != nullptr ? std::fopen("/dev/null", "w") : nullptr, &std::fclose);
    std::FILE* console =
        nowhere ? nowhere.get() : console_beside(options.json, options.junit, options.html);
    report::ConsoleStyle style = console_style(console, options.color, options.verbose);
    style.folder = shell_quote(p.folder.string());
    style.quiet = options.quiet;
    if (!options.quiet) {
        std::fputs(report::console_header(p.header, style).c_str(), console);
        std::fflush(console);
    }
    if (const auto earlier = std::count_if(p.header.cases.begin(), p.header.cases.end(),
                                           [](const CaseRecord& record) {
                                               return record.status != report::Status::not_run &&
                                                      !report::is_expected(record.status);
                                           });
        resumed && earlier > 0) {
        std::fprintf(console, "%td unexpected %s before the interruption: edgecase report %s\n",
                     earlier, earlier == 1 ? "result" : "results", style.folder.c_str());
        std::fflush(console);
    }
    Progress progress(
        options.quiet || !options.debugger.empty() ? ProgressStyle::none : options.progress,
        p.plan.size());
    std::vector<std::string> ids;
    if (limits) {
        ids.push_back(limits->id);
    }
    for (const run::PlannedCase& c : p.plan) {
        ids.push_back(c.data.id);
    }
    report::UnexpectedResults unexpected(ids, style);
    const auto print = [&](const std::string& text) {
        if (!text.empty()) {
            progress.clear();
            std::fputs(text.c_str(), console);
            std::fflush(console);
        }
    };
    const auto on_record = [&](const CaseRecord& record) {
        print(unexpected.add(record));
        return teller != nullptr ? teller->end(record)
                                 : !options.fail_fast || !report::makes_fail(p.header, record);
    };
    if (teller != nullptr) {
        teller->begin(ids);
    }
    bool goes_on = true;
    if (limits) {
        if (auto written = journal->write_end(*limits); !written) {
            return stopped(options, stop_with(report::kExitInternal, written.error().message));
        }
        goes_on = on_record(*limits);
    }
    const run::Clock::time_point begin = run::Clock::now();
    const std::string resume = "; go on with 'edgecase run --resume " +
                               shell_quote(p.folder.string()) + words_to_agree(options) + "'";
    run::SignalFd::set_last_words(cases::printable(
        fmt::format("interrupted, and no reports were written within a second{}, or have them "
                    "by 'edgecase report {}'",
                    resume, style.folder)));
    // Judgements that are left to themselves use it still.
    const auto plan = std::make_shared<const std::vector<run::PlannedCase>>(std::move(p.plan));
    run::RunLoop loop(config, plan, &*journal, signals, on_record,
                      [&](size_t done, size_t unconfirmed) {
                          progress.show(done, unexpected.count() + unconfirmed);
                          return goes_on;
                      });
    std::vector<run::WorkerClient> workers;
    workers.push_back(std::move(first->client));
    const run::RunLoop::End end = loop.run(std::move(workers), first->device);
    if (end.interrupted) {
        loop.abandon_judgements();
    }
    progress.clear();
    print(unexpected.rest());

    Run& header = p.header;
    header.ended = utc_now(false);
    header.seconds += std::chrono::duration<double>(run::Clock::now() - begin).count();
    header.interrupted = end.interrupted;
    std::string failure = end.failure;
    if (auto written = journal->write_stop(header); !written && failure.empty()) {
        failure = written.error().message;
    }
    if (!failure.empty()) {
        failure = "the run stopped early: " + failure + resume;
    }
    Ending ending{failure, "the run stopped early", {}, "interrupted" + resume};
    if (options.diagnosis && teller == nullptr && !end.interrupted) {  // which takes a while
        ending.complete = [&](Run& run) {
            const auto each = [&](const auto& visit) {
                for (const run::PlannedCase& c : *plan) {
                    visit(c.data);
                }
            };
            if (resumed) {
                diagnose_again(program, run);
            } else {
                diagnose(run, each);
            }
            keep_diagnoses(run, *journal);
        };
    }
    return conclude(p.folder, options, chosen_ci(options.ci), console, style, ending);
}

int run_told(const Program& program, const RunOptions& options, const RunTeller* teller) {
    run::SignalFd signals;
    const bool resumes = !options.resume.empty();
    // The driver's start takes as long as reading the suite, so both are done at once. What is
    // wrong with the suite is told first all the same.
    std::optional<OrStop<run::WorkerClient>> worker;
    if (!resumes && options.debugger.empty()) {
        worker.emplace(start_first_worker(loop_config(program, options)));
    }
    OrStop<Prepared> prepared =
        resumes ? prepare_resume(program, options) : prepare(program, options);
    if (!prepared) {
        return stopped(options, prepared.error());
    }
    if (teller != nullptr) {
        std::erase_if(prepared->plan,
                      [&](const run::PlannedCase& c) { return !teller->takes(c.data.id); });
        std::erase_if(prepared->header.cases,
                      [&](const CaseRecord& record) { return !teller->takes(record.id); });
        if (prepared->plan.empty()) {
            return stopped(options,
                           stop_with(report::kExitNothingSelected,
                                     "no selected case is one of the tests that are asked for; "
                                     "'edgecase gtest --gtest_list_tests' lists their names"));
        }
    }
    run::LoopConfig config = loop_config(program, prepared->options);
    if (!prepared->options.debugger.empty()) {
        if (auto set = set_debugger(program, prepared->options, prepared->plan, config); !set) {
            return stopped(options, set.error());
        }
    }
    if (!worker) {
        worker.emplace(start_first_worker(config));
    }
    if (!*worker) {
        return stopped(options, worker->error());
    }
    return run_prepared(program, *prepared, config, std::move(**worker), signals, teller);
}

}  // namespace

int run_command(const Program& program, const RunOptions& options) {
    return run_told(program, options, nullptr);
}

int run_with(const Program& program, const RunOptions& options, const RunTeller& teller) {
    return run_told(program, options, &teller);
}

}  // namespace cli
