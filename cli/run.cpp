// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "run": select, ask the device, draw and judge, write the reports.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "cases/base/counted.hpp"
#include "cases/base/printable.hpp"
#include "cases/base/regex.hpp"
#include "cli/commands.hpp"
#include "cli/diagnose.hpp"
#include "cli/options/parse.hpp"
#include "cli/options/run_options.hpp"
#include "cli/prepare/ci.hpp"
#include "cli/prepare/command_lines.hpp"
#include "cli/prepare/device_answer.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/prepare_run.hpp"
#include "cli/prepare/run_console.hpp"
#include "cli/renderers/renderers.hpp"
#include "cli/seen_results.hpp"
#include "report/files/ci.hpp"
#include "report/journal/journal.hpp"
#include "report/record/levels.hpp"
#include "report/text/console.hpp"
#include "run/process/library.hpp"
#include "run/process/pool.hpp"
#include "run/worker/derived.hpp"

namespace cli {

namespace fs = std::filesystem;
using report::CaseRecord;
using report::Run;

namespace {

// Checks every hand-drawn picture, on all cores, before a device is asked.
void check_pictures(std::vector<run::Task>& plan) {
    run::Pool pool(cases::cores());
    for (run::Task& c : plan) {
        if (c.data.claim.expected_hits) {
            pool.submit([&c] { c.error = run::check_before_running(c.data); }, [] {});
        }
    }
    while (pool.outstanding() > 0) {
        pool.wait();
        pool.collect();
    }
}

void check_required_device(const RunOptions& options, const capture::DeviceInfo& device) {
    if (options.require_device.empty()) {
        return;
    }
    const std::string text = device.name + " " + device.driver_name + " " + device.driver_info;
    if (!cases::find_regex(options.require_device, text)) {
        throw stop_with(report::kExitDevice, "--require-device '" + options.require_device +
                                                 "' does not match the device '" + text +
                                                 "'; choose another with --device or --icd");
    }
}

bool is_same_device(const capture::DeviceInfo& a, const capture::DeviceInfo& b) {
    return a.name == b.name && a.uuid == b.uuid && a.driver_version == b.driver_version &&
           a.subpixel_bits == b.subpixel_bits && a.sample_locations == b.sample_locations &&
           a.depth_beside_stencil == b.depth_beside_stencil;
}

// One case, drawn once, by a worker that a person looks at.
void set_debugger(const Program& program, const RunOptions& options, std::vector<run::Task>& plan,
                  run::LoopConfig& config) {
    if (plan.size() != 1) {
        throw stop_with(report::kExitUsage, "--debugger runs one case, and " +
                                                std::to_string(plan.size()) +
                                                " are selected; name one id");
    }
    config.command = must(debugged_worker_command(program, options.debugger), report::kExitUsage);
    plan.front().alone = true;
    config.timeout = std::chrono::hours(24 * 365);
    config.worker.device.longest_wait_ms = 0;
    config.schedule.lanes = 1;
    config.schedule.repeat = 1;
    config.schedule.retries = 0;
}

// Nothing was judged: there are no reports, so the CI is told here; those of an earlier run in the
// same folder would look like this one's.
int stopped(const RunOptions& options, const Stop& stop, bool owns_folder) {
    if (owns_folder) {
        remove_reports_of_last_run(options);
    }
    if (chosen_ci(options.ci) == Ci::github) {
        std::fputs(report::to_github_annotation(stop.lines).c_str(), stderr);
    }
    return report_stop(stop);
}

// What an interrupted run has told before.
std::string earlier_results(const Run& header, const std::string& folder) {
    const auto count = std::ranges::count_if(header.cases, [](const CaseRecord& record) {
        return record.status != report::Status::not_run && !report::is_expected(record.status);
    });
    return count == 0
               ? ""
               : fmt::format("{} before the interruption: edgecase report {}\n",
                             cases::counted(static_cast<uint64_t>(count), "unexpected result"),
                             folder);
}

// A prepared run, from its first worker to its reports.
class Conduct {
  public:
    Conduct(const Program& program, Prepared& prepared, run::LoopConfig config,
            run::SignalFd& signals, const RunTeller* teller)
        : program_(program),
          prepared_(prepared),
          header_(prepared.header),
          options_(prepared.options),
          config_(std::move(config)),
          signals_(signals),
          teller_(teller),
          is_resumed_(!header_.device.name.empty()) {
        const bool tells_all =
            teller_ != nullptr || options_.verbose || options_.capture == run::KeepPictures::all;
        config_.most_told = options_.tell.value_or(tells_all ? SIZE_MAX : kTold);
        if (options_.diagnosis && options_.capture == run::KeepPictures::none) {
            config_.judging.pictures = run::KeepPictures::failed;  // seen_ needs them
        }
    }

    int run(run::WorkerClient worker) {
        try {
            return conduct(std::move(worker));
        } catch (const Stop& stop) {
            return stopped(options_, stop, owns_folder_);
        }
    }

  private:
    int conduct(run::WorkerClient worker) {
        check_pictures(prepared_.plan);
        ReadyWorker first = await(std::move(worker));
        take_device(first.device);
        apply_expectations(prepared_);
        take_limits(first.device);
        owns_folder_ = false;  // another run may be writing there
        report::Journal journal = begin_journal(prepared_, is_resumed_);
        owns_folder_ = true;
        const std::vector<std::string> ids = this->ids();
        choose_told(prepared_.plan);
        look_.emplace(prepared_.plan);
        RunConsole console(options_, prepared_.folder, ids, prepared_.plan.size(),
                           teller_ != nullptr);
        console.begin(header_);
        console.print(is_resumed_ ? earlier_results(header_, console.style().folder) : "");
        if (teller_ != nullptr) {
            teller_->begin(ids);
        }
        if (limits_) {
            must(journal.write_end(*limits_), report::kExitInternal);
            goes_on_ = on_record(console, *limits_);
        }
        // Judgements that are left to themselves use it still.
        plan_ = std::make_shared<const std::vector<run::Task>>(std::move(prepared_.plan));
        const std::string failure = draw(std::move(first), console, journal);
        Ending ending{failure, "the run stopped early", {}, "interrupted" + way_on()};
        if (options_.diagnosis && teller_ == nullptr && !header_.interrupted) {
            ending.complete = [&](Run& run) { find_out(run, journal); };
        }
        return conclude(prepared_.folder, options_, chosen_ci(options_.ci), console.file(),
                        console.style(), ending);
    }

    // The first worker when it is ready; if it never is, what is wrong with the driver that was
    // named is told, too.
    ReadyWorker await(run::WorkerClient worker) {
        try {
            return await_first_worker(std::move(worker), config_, signals_);
        } catch (Stop& stop) {
            const auto drivers = find_drivers(options_.device).drivers;
            if (!options_.device.icd.empty() && !drivers.empty()) {
                if (const std::string why = run::load_problem(drivers.front()); !why.empty()) {
                    stop.lines.push_back("  " + why);
                }
            }
            throw;
        }
    }

    // The device goes into the header, and its limits into what is judged by.
    void take_device(const capture::DeviceInfo& device) {
        if (is_resumed_ && !is_same_device(device, header_.device)) {
            throw stop_with(report::kExitDevice, "the run cannot go on: it was on '" +
                                                     header_.device.name + "', this is '" +
                                                     device.name + "' or another driver version");
        }
        header_.device = device;
        config_.judging.limits = run::limits_of(device);
        check_required_device(options_, device);
    }

    void take_limits(const capture::DeviceInfo& device) {
        if (teller_ != nullptr) {
            warn_of_limits(device);  // it is none of the tests that the runner knows
            return;
        }
        limits_ = limits_record(program_, prepared_, device);
        if (limits_ && !is_resumed_) {
            header_.cases.emplace(header_.cases.begin(), report::PlannedCase(*limits_));
        }
    }

    // Of all cases, in the order in which they are told.
    std::vector<std::string> ids() const {
        std::vector<std::string> ids;
        if (limits_) {
            ids.push_back(limits_->id);
        }
        for (const run::Task& task : prepared_.plan) {
            ids.push_back(task.data.id);
        }
        return ids;
    }

    // False ends the run.
    bool on_record(RunConsole& console, const CaseRecord& record) const {
        console.add(record);
        return teller_ != nullptr ? teller_->end(record)
                                  : !options_.fail_fast || !report::makes_fail(header_, record);
    }

    // What over half of the plainest cases get wrong is told when all of them are judged.
    void look_at(const CaseRecord& record, RunConsole& console) {
        seen_.add(record);
        if (!look_->ends_with(record) || !options_.diagnosis || options_.quiet ||
            teller_ != nullptr) {
            return;
        }
        Run run = seen_.of(header_, header_.device, &look_->ids());
        if (report::first_look_text(run, console.style()).empty()) {
            return;
        }
        diagnose_seen(run, true);
        run.seconds = std::chrono::duration<double>(run::Clock::now() - begin_).count();
        console.print(report::first_look_text(run, console.style()));
    }

    void diagnose_seen(Run& run, bool goes_on) const {
        const auto each = [this](const auto& visit) {
            for (const run::Task& task : *plan_) {
                visit(task.data);
            }
        };
        diagnose(run, each, goes_on);
    }

    // How the run goes on if it ends before all is judged.
    std::string way_on() const {
        return "; go on with 'edgecase run --resume " + shell_quote(prepared_.folder.string()) +
               words_to_agree(options_) + "'";
    }

    // Draws and judges the plan. Returns why the run stopped early; empty if it did not.
    std::string draw(ReadyWorker first, RunConsole& console, report::Journal& journal) {
        run::SignalFd::set_last_words(cases::printable(
            fmt::format("interrupted, and no reports were written within a second{}, or have them "
                        "by 'edgecase report {}'",
                        way_on(), console.style().folder)));
        config_.complete = [&](const cases::Case& c, CaseRecord& record) {
            add_command_lines(program_, options_, judged_device(header_.device), c, record);
            look_at(record, console);
            if (options_.capture == run::KeepPictures::none) {
                record.evidence = {};
            }
        };
        config_.judged = [&](const cases::Case& c, const CaseRecord& record) {
            if (look_->holds(record)) {
                CaseRecord told = record;
                add_command_lines(program_, options_, judged_device(header_.device), c, told);
                look_at(told, console);
            }
        };
        const run::Clock::time_point begin = run::Clock::now();
        run::RunLoop loop(
            config_, plan_, &journal, signals_,
            [&](const CaseRecord& record) { return on_record(console, record); },
            [&](size_t done, size_t unconfirmed) {
                console.show(done, unconfirmed);
                return goes_on_;
            });
        std::vector<run::WorkerClient> workers;
        workers.push_back(std::move(first.client));
        run::RunLoop::End end = loop.run(std::move(workers), first.device);
        if (end.interrupted) {
            loop.abandon_judgements();
        }
        console.end();
        header_.ended = utc_now(false);
        header_.seconds += std::chrono::duration<double>(run::Clock::now() - begin).count();
        header_.interrupted = end.interrupted;
        if (auto written = journal.write_stop(header_); !written && end.failure.empty()) {
            end.failure = written.error().message;
        }
        return end.failure.empty() ? "" : "the run stopped early: " + end.failure + way_on();
    }

    // What the device does wrong, when all records are there.
    void find_out(Run& run, report::Journal& journal) const {
        if (is_resumed_) {
            diagnose_again(program_, run);
        } else {
            Run seen = seen_.of(run, run.device);
            seen.seconds = run.seconds;
            diagnose_seen(seen, false);
            run.diagnoses = std::move(seen.diagnoses);
        }
        keep_diagnoses(run, journal);
    }

    const Program& program_;
    Prepared& prepared_;
    Run& header_;
    const RunOptions& options_;
    run::LoopConfig config_;
    run::SignalFd& signals_;
    const RunTeller* teller_;
    bool is_resumed_;
    run::RunLoop::Plan plan_;
    SeenResults seen_;
    std::optional<FirstLook> look_;
    run::Clock::time_point begin_ = run::Clock::now();
    std::optional<CaseRecord> limits_;  // of the device: a case that no worker draws
    bool goes_on_ = true;
    bool owns_folder_ = true;
};

// The tests that a runner asks for, of all cases that are prepared.
void take_told(Prepared& prepared, const RunTeller& teller) {
    std::erase_if(prepared.plan, [&](const run::Task& c) { return !teller.takes(c.data.id); });
    std::erase_if(prepared.header.cases,
                  [&](const CaseRecord& record) { return !teller.takes(record.id); });
    if (prepared.plan.empty()) {
        throw stop_with(report::kExitNothingSelected,
                        "no selected case is one of the tests that are asked for; "
                        "'edgecase gtest --gtest_list_tests' lists their names");
    }
}

int run_told(const Program& program, const RunOptions& options, const RunTeller* teller) try {
    run::SignalFd signals;
    const bool resumes = !options.resume.empty();
    // The driver's start takes as long as reading the suite, so both are done at once. What is
    // wrong with the suite is told first all the same.
    std::optional<run::WorkerClient> worker;
    std::optional<Stop> no_worker;
    if (!resumes && options.debugger.empty()) {
        try {
            worker.emplace(start_first_worker(loop_config(program, options)));
        } catch (const Stop& stop) {
            no_worker = stop;
        }
    }
    Prepared prepared = resumes ? prepare_resume(program, options) : prepare(program, options);
    if (teller != nullptr) {
        take_told(prepared, *teller);
    }
    run::LoopConfig config = loop_config(program, prepared.options);
    if (!prepared.options.debugger.empty()) {
        set_debugger(program, prepared.options, prepared.plan, config);
    }
    if (no_worker) {
        throw *no_worker;
    }
    if (!worker) {
        worker.emplace(start_first_worker(config));
    }
    return Conduct(program, prepared, std::move(config), signals, teller).run(std::move(*worker));
} catch (const Stop& stop) {
    return stopped(options, stop, true);
}

int carry_out(const Program& program, const RunOptions& options) {
    return run_told(program, options, nullptr);
}

}  // namespace

Command run_command() {
    return make_command<RunOptions>(
        {"run", kChecking, "draw cases on a device and compare with the exact reference", nullptr},
        declare_run, carry_out, check_run);
}

int run_with(const Program& program, const RunOptions& options, const RunTeller& teller) {
    return run_told(program, options, &teller);
}

}  // namespace cli
