// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "fuzz": hunts for causes that nobody wrote a case for.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "cases/base/counted.hpp"
#include "cases/base/printable.hpp"
#include "cli/commands.hpp"
#include "cli/fuzzing/hunt_end.hpp"
#include "cli/fuzzing/hunt_folder.hpp"
#include "cli/fuzzing/hunt_status.hpp"
#include "cli/fuzzing/hunt_text.hpp"
#include "cli/fuzzing/known_causes.hpp"
#include "cli/fuzzing/start_cases.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/run_plan.hpp"
#include "fuzz/hunt.hpp"
#include "fuzz/ledger.hpp"
#include "run/session.hpp"

namespace cli {

namespace fs = std::filesystem;
using cases::counted;
using fuzz::Entry;
using fuzz::Hunt;

namespace {

struct FuzzOptions {
    RunOptions run;      // its device, judging, output and, to start from cases, its suite
    uint64_t cases = 0;  // numbers from here on are not made; 0: no end
    double seconds = 0;  // 0: no end
    std::vector<std::string> known;   // folders of earlier hunts
    std::optional<uint64_t> printed;  // the number of a case to print; nothing is drawn then
};

// What all parts of a hunt that goes on counted.
fuzz::HuntCounts sum_of(fuzz::HuntCounts sum, const fuzz::HuntCounts& now) {
    const fuzz::HuntCounts before = std::exchange(sum, now);
    fuzz::HuntCounts::fields(
        [](const cases::Field&, auto& all, const auto& earlier) { all += earlier; }, sum, before);
    sum.next_case = now.next_case;
    sum.poses = now.poses;
    sum.pairs = now.pairs;
    return sum;
}

class FuzzCommand {
  public:
    FuzzCommand(const Program& program, const FuzzOptions& options)
        : program_(program), options_(options), status_(options.run) {}

    int run() {
        read_earlier();
        find_cases();
        run::LoopConfig config = loop_config(program_, options_.run);
        config.judging.pictures = run::KeepPictures::symptoms;
        config.judging.profile = ledger_.profile;
        config.schedule.retries = 0;  // a reduction begins with drawing the case again
        run::SignalFd signals;
        ReadyWorker first = ready_first_worker(config, signals);
        name_device(first.device);
        RunOptions judging = options_.run;
        judging.profile = ledger_.profile;
        judging.suite.suite = ledger_.suite.empty() ? judging.suite.suite : ledger_.suite;
        judging.no_expect = ledger_.no_expect;
        judging.expect = ledger_.expect;
        ExpectedFailures expected = expected_failures(program_, judging, first.device);
        HuntFolder files(folder_, ledger_);
        if (!options_.run.quiet) {
            // A hunt that goes on has no end of its own: --cases and --time are of each command.
            const bool is_endless = options_.cases == 0 && !(options_.seconds > 0);
            say(fmt::format(
                "fuzzing {} {}with seed {} at profile {}, into {}{}{}\n", ledger_.device,
                starts_ == 0 ? "" : fmt::format("from {} on, ", counted(starts_, "case")),
                ledger_.seed, cases::to_string(ledger_.profile), folder_.string(),
                options_.run.resume.empty()
                    ? ""
                    : fmt::format(", from case {} on", ledger_.counts.next_case),
                is_endless ? "; end it with ctrl-c" : ""));
            std::fflush(stdout);
        }
        run::Session session(config, std::move(first.client), first.device, signals);
        // From here on the hunt can go on, whatever ends it.
        run::SignalFd::set_last_words(cases::printable(
            "interrupted; go on with 'edgecase fuzz --resume " + folder_.string() + "'"));
        files.keep_earlier();
        return hunt(session, std::move(expected), files);
    }

  private:
    // What earlier hunts found, and how far the one came that goes on.
    void read_earlier() {
        if (!options_.run.resume.empty()) {
            auto loaded = must(fuzz::load_ledger(options_.run.resume), report::kExitInvalidFile,
                               "--resume: ");
            ledger_ = std::move(loaded);
            folder_ = options_.run.resume;
            device_of_earlier_ = ledger_.device + ledger_.driver;
            seconds_before_ = ledger_.seconds;
        } else {
            ledger_.tool_version = kVersion;
            ledger_.arguments = program_.arguments;
            ledger_.selectors = options_.run.suite.selectors;
            ledger_.seed = options_.run.seed;
            ledger_.shard = options_.run.shard.index;
            ledger_.shards = options_.run.shard.count;
            ledger_.profile = options_.run.profile;
        }
        // A hunt that goes on judges by the same files, unless others are named.
        if (options_.run.resume.empty() || options_.run.no_expect || !options_.run.expect.empty()) {
            ledger_.no_expect = options_.run.no_expect;
            ledger_.expect = options_.run.expect;
            for (std::string& file : ledger_.expect) {
                file = fs::absolute(file).lexically_normal().string();
            }
        }
        for (const std::string& known : options_.known) {
            auto loaded = must(fuzz::load_ledger(known), report::kExitInvalidFile, "--known: ");
            if (ledger_.expectations.empty()) {
                known_expectations_ = loaded.expectations;
                known_device_ = loaded.device + loaded.driver;
            }
            for (Entry& entry : loaded.entries) {
                entry.is_known = true;
                entry.count = 0;
                entry.file.clear();  // keep_earlier() copies it
                // What is not reduced explains next to nothing. Hunts that know the same third one
                // each bring its causes.
                if (entry.is_reduced && std::ranges::none_of(ledger_.entries, [&](const Entry& e) {
                        return e.text == entry.text;
                    })) {
                    ledger_.entries.push_back(std::move(entry));
                }
            }
        }
    }

    // The cases that the hunt starts from, which must be those of before if it goes on.
    void find_cases() {
        SuiteOptions suite = options_.run.suite;
        suite.selectors = ledger_.selectors;
        suite.suite = ledger_.suite.empty() ? suite.suite : ledger_.suite;
        StartCases found = start_cases(program_, suite, ledger_.seed);
        if (!options_.run.resume.empty() && found.checksum != ledger_.cases_checksum) {
            throw stop_with(
                report::kExitInvalidFile,
                "the hunt cannot go on: the cases that it starts from have changed, so its numbers "
                "mean other ones; start a new hunt");
        }
        ledger_.suite = found.suite;
        ledger_.cases_checksum = found.checksum;
        starts_ = found.count;
        source_ = std::move(found.source);
    }

    void name_device(const capture::DeviceInfo& device) {
        ledger_.device = device.name;
        ledger_.driver = device.driver_name + " " + device.driver_info;
        if (!device_of_earlier_.empty() && device_of_earlier_ != ledger_.device + ledger_.driver) {
            throw stop_with(report::kExitDevice,
                            "the hunt cannot go on: it was on another device or driver than '" +
                                ledger_.device + ", " + ledger_.driver + "'");
        }
        if (folder_.empty()) {
            folder_ = options_.run.output.empty()
                          ? new_folder("out/fuzz", file_name_of(device.name))
                          : fs::path(options_.run.output);
            std::error_code none;
            if (fs::exists(folder_ / fuzz::kLedgerFile, none)) {
                throw stop_with(report::kExitUsage,
                                "'" + folder_.string() +
                                    "' holds a hunt already; go on with it by --resume, or "
                                    "name another folder with -o");
            }
        }
    }

    // Whether causes of expectation files are known already, by this hunt or an earlier one.
    bool are_known(const ExpectedFailures& expected) {
        if (known_device_ == ledger_.device + ledger_.driver &&
            known_expectations_ == expected.checksum) {
            ledger_.expectations = expected.checksum;  // --known has brought the causes
        }
        return expected.cases.empty() || expected.checksum == ledger_.expectations;
    }

    // Once all that expectation files explain is reduced.
    void tell_known(const KnownCauses& known) {
        ledger_.expectations = known.expected().checksum;
        status_.clear();
        if (!options_.run.quiet) {
            say(fmt::format(
                "known by {}: {} that {} as expected, by {}{}, reduced in {:.0f} s\n",
                counted(known.expected().files, "expectation file"),
                counted(known.failing(), "case"), known.failing() == 1 ? "fails" : "fail",
                counted(known.causes(), "cause"),
                options_.known.empty() ? "" : " that no --known explains", known.seconds()));
            std::fflush(stdout);
        }
        if (known.left() > 0) {
            complain(
                fmt::format("{} of expected failures not reduced, so what they come of will "
                            "be told as new; take more causes for known by --known",
                            counted(known.left(), "finding")));
        }
    }

    int hunt(run::Session& session, ExpectedFailures expected, HuntFolder& files) {
        fuzz::HuntOptions hunt;
        hunt.broken_doors = std::move(expected.broken_doors);
        const bool is_known = are_known(expected);
        KnownCauses known(std::move(expected));
        if (!is_known) {
            hunt.known_failures = &known;
            if (!options_.run.quiet) {
                say(fmt::format(
                    "{} known to fail by {}; as soon as a case fails, they are reduced to causes, "
                    "once for this hunt; --no-expect leaves it out\n",
                    counted(known.expected().cases.size(), "case"),
                    counted(known.expected().files, "expectation file")));
                std::fflush(stdout);
            }
        }
        hunt.source = source_;
        hunt.first_case = ledger_.counts.next_case;
        hunt.most_cases = options_.cases == 0 ? 0 : options_.cases;
        hunt.shard = ledger_.shard;
        hunt.shards = ledger_.shards;
        if (options_.seconds > 0) {
            hunt.deadline = std::chrono::steady_clock::now() +
                            std::chrono::milliseconds(static_cast<int64_t>(options_.seconds * 1e3));
        }
        const fuzz::HuntCounts before = ledger_.counts;
        files.take_out_not_reduced();
        hunt.left = ledger_.left;
        const run::DrawAndJudge draw = [&session](std::vector<cases::Case> cases,
                                                  const auto& on_progress) {
            return session.draw(std::move(cases), on_progress);
        };
        Hunt hunter(hunt, draw, std::move(ledger_.entries), ledger_.waiting,
                    [this](const auto&... progress) { status_.show(progress...); });
        Hunt::State state = Hunt::State::goes_on;
        for (bool is_first = true; state == Hunt::State::goes_on; is_first = false) {
            if (!is_first) {
                state = hunter.step();
            }
            if (hunt.known_failures != nullptr && known.is_empty() &&
                ledger_.expectations != known.expected().checksum) {
                tell_known(known);
            }
            ledger_.counts = sum_of(before, hunter.counts());
            ledger_.seconds = seconds_before_ + status_.seconds();
            ledger_.is_finished = state == Hunt::State::done;
            files.keep(hunter, [this](const Entry& entry) {
                if (!entry.is_known) {
                    status_.clear();
                    tell_cause(entry, folder_);
                }
            });
        }
        status_.clear();
        return end_hunt(hunter, state, ledger_, folder_, starts_);
    }

    const Program& program_;
    const FuzzOptions& options_;
    HuntStatus status_;
    fuzz::Ledger ledger_;
    fuzz::MakeSource source_;
    size_t starts_ = 0;  // cases that the hunt starts from; 0: it makes its own
    fs::path folder_;
    std::string device_of_earlier_;
    std::string known_expectations_, known_device_;  // of the last hunt of --known
    double seconds_before_ = 0;
};

int carry_out(const Program& program, const FuzzOptions& options) {
    if (options.printed) {
        const StartCases cases = start_cases(program, options.run.suite, options.run.seed);
        const std::string text = fuzz::text_of_case(*cases.source(), *options.printed);
        if (text.empty()) {
            throw stop_with(
                report::kExitNothingSelected,
                fmt::format("number {} of seed {} has no case: no change of those that were tried "
                            "made one; print another number",
                            *options.printed, options.run.seed));
        }
        say(text);
        return report::kExitOk;
    }
    return FuzzCommand(program, options).run();
}

// "90", "90s", "10m", "2h", "1.5h": seconds.
bool parse_duration(const std::string& text, double& seconds) {
    const std::map<char, double> units = {{'s', 1}, {'m', 60}, {'h', 3600}};
    const auto unit = text.empty() ? units.end() : units.find(text.back());
    const std::string number = unit == units.end() ? text : text.substr(0, text.size() - 1);
    const char* const end = number.data() + number.size();
    const auto read = std::from_chars(number.data(), end, seconds);
    if (number.empty() || read.ec != std::errc() || read.ptr != end || !(seconds > 0) ||
        !(seconds < 1e9)) {
        return false;
    }
    seconds *= unit == units.end() ? 1 : unit->second;
    return true;
}

void declare(CLI::App& app, FuzzOptions& o) {
    app.add_option("SELECTOR", o.run.suite.selectors,
                   "cases to change a few things of; a file with [fuzz] is varied as that says")
        ->type_name("");
    add_suite_folder(&app, o.run.suite);
    add_value(&app, "--seed", o.run.seed, "a seed and a number make a case [1]", "N", "Selection")
        ->check(in_range<uint64_t>(0, UINT64_MAX));
    add_value(&app, "--cases", o.cases, "the cases with numbers below N [no end]", "N", "Selection")
        ->check(in_range<uint64_t>(1, uint64_t{1} << 48));
    app.add_option(
           "--time",
           [&o](const CLI::results_t& results) {
               return parse_duration(results.back(), o.seconds);
           },
           "end after this time: 90s, 10m, 2h [no end]")
        ->type_name("TIME")
        ->group("Selection");
    add_value(&app, "--print", o.printed, "print the case with this number, draw nothing", "N",
              "Selection")
        ->check(in_range<uint64_t>(0, uint64_t{1} << 24));
    add_shard(&app, o.run.shard,
              "an N-th of the poses (or groups of changed cases), in turn; 1 <= I <= N");
    add_device(&app, o.run.device);
    add_validation(&app, o.run.device);
    add_profile(&app, o.run.profile);
    add_expectations(&app, o.run);
    add_value(&app, "--known", o.known,
              "the folder of an earlier hunt, whose causes are known; repeatable", "DIR", "Judging")
        ->type_size(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_jobs(&app, o.run);
    add_value(&app, "--resume", o.run.resume, "go on with an interrupted hunt", "DIR", "Isolation");
    add_value(&app, "-o,--output", o.run.output, "where the causes go [out/fuzz/<time>-<device>]",
              "DIR", "Output");
    app.add_flag("-q,--quiet", o.run.quiet, "only causes and the summary")->group("Output");
}

// A hunt that goes on has the seed, shard and profile that it began with; where it ends, which
// device of that name draws and what else is known may be said anew.
void check(const CLI::App& fuzz, const FuzzOptions& o, const Words& words) {
    check_alternatives(fuzz, "--print",
                       {"--cases", "--time", "--shard", "--known", "--resume", "--output"});
    const auto refused = [](const std::string& what) {
        throw usage_error(
            "--resume goes on with the cases, seed, shard, profile and folder of the hunt, so " +
                what + (what.starts_with("no ") ? " can" : " cannot") +
                " be given; leave it out or start a new hunt",
            "fuzz");
    };
    for (const char* name : {"--seed", "--shard", "--profile", "--output", "--print", "--suite"}) {
        if (!o.run.resume.empty() && is_given(fuzz, name, words)) {
            refused(name);
        }
    }
    if (!o.run.resume.empty() && !o.run.suite.selectors.empty()) {
        refused("no selector");
    }
    if (o.run.no_expect && !o.run.expect.empty()) {
        throw usage_error("--expect and --no-expect exclude each other", "fuzz");
    }
}

}  // namespace

Command fuzz_command() {
    return make_command<FuzzOptions>(
        {"fuzz", kChecking, "draw cases that nobody wrote, and reduce what fails",
         "  edgecase fuzz --cases 1024 -o out/hunt         what does my driver get wrong\n"
         "  edgecase fuzz --cases 1024 --known out/hunt --seed 2\n"
         "  edgecase fuzz 'depth-bias/**' --cases 1024 --known out/hunt   cases, changed a little\n"
         "  edgecase fuzz my-case.toml --cases 1024 --known out/hunt      or what its [fuzz] "
         "says\n"},
        declare, carry_out, check);
}

}  // namespace cli
