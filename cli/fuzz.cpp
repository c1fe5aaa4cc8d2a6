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
#include "cases/base/limits.hpp"
#include "cases/base/output_file.hpp"
#include "cases/base/printable.hpp"
#include "cli/commands.hpp"
#include "cli/fuzzing/hunt_folder.hpp"
#include "cli/fuzzing/hunt_status.hpp"
#include "cli/fuzzing/hunt_text.hpp"
#include "cli/fuzzing/known_causes.hpp"
#include "cli/fuzzing/start_cases.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/loop_config.hpp"
#include "cli/prepare/outputs.hpp"
#include "cli/prepare/run_plan.hpp"
#include "fuzz/hunt.hpp"
#include "fuzz/ledger.hpp"
#include "run/session.hpp"

namespace cli {

namespace fs = std::filesystem;
using cases::counted;
using fuzz::Entry;
using fuzz::Hunt;
using fuzz::Ledger;

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
        open_hunt_folder(folder_);
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
        }
        run::Session session(config, std::move(first.client), first.device, signals);
        // From here on the hunt can go on, whatever ends it.
        run::SignalFd::set_last_words(cases::printable(
            "interrupted; go on with 'edgecase fuzz --resume " + folder_.string() + "'"));
        must(keep_earlier(), report::kExitInternal);
        if (const std::optional<int> ended = know(expected, session)) {
            return *ended;
        }
        return hunt(session, std::move(expected.broken_doors));
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
                if (entry.is_reduced &&
                    std::none_of(ledger_.entries.begin(), ledger_.entries.end(),
                                 [&](const Entry& e) { return e.text == entry.text; })) {
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

    // Reduces one case for each cause that expectation files explain, unless an earlier hunt has.
    // The exit code, if that is the end.
    std::optional<int> know(const ExpectedFailures& expected, run::Session& session) {
        if (known_device_ == ledger_.device + ledger_.driver &&
            known_expectations_ == expected.checksum) {
            ledger_.expectations = expected.checksum;  // --known has brought the causes
        }
        if (expected.cases.empty() || expected.checksum == ledger_.expectations) {
            return std::nullopt;
        }
        if (!options_.run.quiet) {
            // It takes minutes where many cases are expected to fail, and --time counts from its
            // end.
            say(fmt::format(
                "first, {} known to fail by {} {} reduced to causes, once for this "
                "hunt{}; --no-expect leaves it out\n",
                counted(expected.cases.size(), "case"), counted(expected.files, "expectation file"),
                expected.cases.size() == 1 ? "is" : "are",
                options_.seconds > 0 ? ", and --time counts from then on" : ""));
            std::fflush(stdout);
        }
        const double begin = status_.seconds();
        const KnownCauses known = reduce_known(
            expected, ledger_.entries, session,
            [this] { status_.show_words("reducing what expectation files explain"); },
            [this](const Entry& entry) { return keep_known(entry); });
        status_.clear();
        if (!known.failure.empty()) {
            throw stop_with(report::kExitInternal, known.failure);
        }
        if (known.is_interrupted) {
            say("interrupted while known causes were reduced; go on with 'edgecase fuzz --resume " +
                folder_.string() + "'\n");
            return report::kExitInterrupted;
        }
        ledger_.expectations = expected.checksum;
        must(write_ledger(), report::kExitInternal);
        const auto causes = static_cast<size_t>(
            std::count_if(ledger_.entries.begin(), ledger_.entries.end(),
                          [](const Entry& entry) { return entry.file.starts_with(fuzz::kKnown); }));
        if (!options_.run.quiet) {
            say(fmt::format("known by {}: {} that {} as expected, by {}{}, reduced in {:.0f} s\n",
                            counted(expected.files, "expectation file"),
                            counted(known.failing, "case"), known.failing == 1 ? "fails" : "fail",
                            counted(causes, "cause"),
                            options_.known.empty() ? "" : " that no --known explains",
                            status_.seconds() - begin));
            std::fflush(stdout);
        }
        status_.restart();  // the hunt's own time begins now
        if (known.left > 0) {
            complain(
                fmt::format("{} of expected failures not reduced, so what they come of will "
                            "be told as new; take more causes for known by --known",
                            counted(known.left, "finding")));
        }
        return std::nullopt;
    }

    // A cause that expectation files explain, as soon as it is reduced: a hunt that is ended before
    // all are goes on with it.
    cases::Expected<void> keep_known(Entry entry) {
        name_file(entry, fuzz::kKnown, ledger_.entries, folder_);
        if (auto written = write_below(entry.file, found_text(entry, ledger_)); !written) {
            return written;
        }
        ledger_.entries.push_back(std::move(entry));
        return write_ledger();
    }

    // Copies what earlier hunts found, so that this one can go on without their folders.
    cases::Expected<void> keep_earlier() {
        for (Entry& entry : ledger_.entries) {
            if (!entry.file.empty()) {
                continue;
            }
            name_file(entry, fuzz::kEarlier, ledger_.entries, folder_);
            if (auto written = write_below(entry.file, entry.text); !written) {
                return written;
            }
        }
        return write_ledger();
    }

    cases::Expected<void> write_below(const std::string& name, const std::string& text) const {
        auto made = cases::make_folders(folder_, folder_ / name);
        return made ? replace_text(folder_ / name, text) : made;
    }

    cases::Expected<void> write_ledger() const {
        return replace_text(folder_ / fuzz::kLedgerFile, fuzz::to_json(ledger_));
    }

    int hunt(run::Session& session, std::set<cases::Door> broken_doors) {
        fuzz::HuntOptions hunt;
        hunt.broken_doors = std::move(broken_doors);
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
        std::erase_if(ledger_.entries, [&](const Entry& entry) {
            if (!entry.is_reduced) {
                not_reduced_.insert(entry.file);
            }
            return !entry.is_reduced;
        });
        hunt.left = ledger_.left;
        const run::DrawAndJudge draw = [&session](std::vector<cases::Case> cases,
                                                  const auto& on_progress) {
            return session.draw(std::move(cases), on_progress);
        };
        Hunt hunter(hunt, draw, std::move(ledger_.entries), ledger_.waiting,
                    [this](const fuzz::HuntCounts& counts, size_t causes) {
                        status_.show(counts, causes);
                    });
        Hunt::State state = Hunt::State::goes_on;
        for (bool is_first = true; state == Hunt::State::goes_on; is_first = false) {
            if (!is_first) {
                state = hunter.step();
            }
            if (auto kept = keep(hunter, before, state == Hunt::State::done); !kept) {
                status_.clear();
                throw stop_with(report::kExitInternal, kept.error().message);
            }
        }
        status_.clear();
        return conclude_hunt(hunter, state);
    }

    // Writes new causes and the ledger: a hunt that is killed has lost nothing but its last step.
    cases::Expected<void> keep(Hunt& hunter, const fuzz::HuntCounts& before, bool is_finished) {
        std::set<std::string> stale;
        for (Entry& entry : hunter.entries()) {
            if (!entry.file.empty()) {
                continue;
            }
            name_file(entry, fuzz::kFound, ledger_.entries, folder_);
            if (auto written = write_below(entry.file, found_text(entry, ledger_)); !written) {
                return written;
            }
            status_.clear();
            tell_cause(entry, folder_);
            if (!entry.stale_file.empty()) {
                stale.insert(std::exchange(entry.stale_file, ""));
            }
        }
        ledger_.entries = hunter.entries();
        if (auto kept = keep_not_reduced(hunter); !kept) {
            return kept;
        }
        ledger_.waiting = hunter.waiting();
        ledger_.left = hunter.left();
        ledger_.counts = sum_of(before, hunter.counts());
        ledger_.seconds = seconds_before_ + status_.seconds();
        ledger_.is_finished = is_finished;
        if (auto written = write_ledger(); !written) {
            return written;
        }
        for (const std::string& file : stale) {
            std::error_code none;
            fs::remove(folder_ / file, none);
        }
        return {};
    }

    // The files of what is not reduced change with each step: those that are reduced meanwhile go.
    cases::Expected<void> keep_not_reduced(const Hunt& hunter) {
        const std::set<std::string> before = std::exchange(not_reduced_, {});
        for (Entry& entry : hunter.not_reduced()) {
            entry.file = fuzz::file_of_not_reduced(entry.first_case);
            not_reduced_.insert(entry.file);
            if (!before.contains(entry.file)) {
                entry.text = fuzz::described(entry.text, entry.symptom);
                if (auto written = write_below(entry.file, found_text(entry, ledger_)); !written) {
                    return written;
                }
            }
            ledger_.entries.push_back(std::move(entry));
        }
        for (const std::string& file : before) {
            std::error_code none;
            if (!not_reduced_.contains(file)) {
                fs::remove(folder_ / file, none);
            }
        }
        return {};
    }

    int conclude_hunt(Hunt& hunter, Hunt::State state) {
        size_t fresh = 0;
        for (const Entry& entry : ledger_.entries) {
            if (!entry.is_reduced) {
                tell_cause(entry, folder_);
            }
            fresh += entry.is_reduced && !entry.is_known ? 1U : 0U;
        }
        tell_counts(ledger_, starts_);
        const fuzz::HuntCounts& c = ledger_.counts;
        if (!ledger_.waiting.empty()) {
            say(
                fmt::format("not reduced, and explained by no cause: {}; go on with 'edgecase fuzz "
                            "--resume {}'\n",
                            counted(ledger_.waiting.size(), "failing case"), folder_.string()));
        }
        if (!ledger_.left.empty()) {
            say(fmt::format(
                "not judged, as the hunt ended before: {}, which --resume draws first\n",
                counted(ledger_.left.size(), "case")));
        }
        size_t number = 0;
        for (const std::string& text : hunter.unrepeated()) {
            const fs::path file = folder_ / fmt::format("unrepeated-{}.toml", ++number);
            must(replace_text(file, text), report::kExitInternal);
        }
        if (c.unrepeated > 0) {
            say(fmt::format("did not come again when drawn alone: {}; see {}\n",
                            counted(c.unrepeated, "failing case"),
                            (folder_ / "unrepeated-1.toml").string()));
        }
        std::set<std::string> told;
        for (const auto& [text, reason] : hunter.unjudged()) {
            if (!told.insert(reason).second) {
                continue;
            }
            const fs::path file = folder_ / fmt::format("unjudged-{}.toml", told.size());
            const auto written = replace_text(file, text);
            const bool is_limited = !cases::tight_limits().empty();
            complain("a case could not be judged: " + reason +
                     (written ? "; it is kept as " + file.string() +
                                    (is_limited ? "" : ", please report it")
                              : ""));
        }
        if (fresh > 0 || !ledger_.waiting.empty()) {
            say(fmt::format("look at them: edgecase run {} --no-expect\n",
                            (folder_ / "found").string()));
        }
        if (state == Hunt::State::interrupted) {
            say("interrupted; go on with 'edgecase fuzz --resume " + folder_.string() + "'\n");
            std::fflush(stdout);  // while threads end that make cases
            return report::kExitInterrupted;
        }
        if (state == Hunt::State::failed) {
            throw stop_with(report::kExitInternal, hunter.failure());
        }
        if (c.unjudged > 0) {
            return report::kExitInternal;
        }
        if (c.drawn == 0) {
            complain(fmt::format("no case was judged, so nothing was proven: {}",
                                 c.unsupported > 0
                                     ? fmt::format("{} supports none of the {} that were made",
                                                   ledger_.device, counted(c.unsupported, "case"))
                                     : "none was drawn"));
            return report::kExitAllSkipped;
        }
        // Nothing new may be said only of a hunt whose failures are all explained.
        const bool is_explained = ledger_.waiting.empty() && c.unrepeated == 0;
        return fresh > 0 || !is_explained ? report::kExitUnexpected : report::kExitOk;
    }

    const Program& program_;
    const FuzzOptions& options_;
    HuntStatus status_;
    Ledger ledger_;
    fuzz::MakeSource source_;
    size_t starts_ = 0;  // cases that the hunt starts from; 0: it makes its own
    fs::path folder_;
    std::set<std::string> not_reduced_;  // files of cases as they were drawn
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
           "end after this time, from when expected failures are reduced: 90s, 10m, 2h [no end]")
        ->type_name("TIME")
        ->group("Selection");
    add_value(&app, "--print", o.printed, "print the case with this number, draw nothing", "N",
              "Selection")
        ->check(in_range<uint64_t>(0, uint64_t{1} << 24));
    add_shard(&app, o.run.shard,
              "every N-th pose (or group of changed cases) from the I-th on; 1 <= I <= N");
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
