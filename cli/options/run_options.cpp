// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/run_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "cases/base/regex.hpp"
#include "cli/options/parse.hpp"
#include "cli/options/shared_options.hpp"
#include "report/record/run.hpp"

namespace cli {

namespace {

// A resumed run has the options of the interrupted one, so others would be ignored.
void check_resume(const CLI::App& run, const Words& words) {
    // The last four only repeat what the run began with (prepare_resume).
    const std::vector<std::string> may = {"--resume",   "--jobs", "--quiet", "--verbose", "--color",
                                          "--progress", "--icd",  "--json",  "--junit",   "--html"};
    for (const CLI::Option* option : run.get_options()) {
        const std::string name = option->get_name();
        const bool is_variable = !option->get_envname().empty() && !is_given(*option, words);
        if (option->count() > 0 && !is_variable && std::ranges::find(may, name) == may.end()) {
            const bool is_option = !name.empty() && name.front() == '-';
            throw usage_error(
                "--resume goes on with the cases and options of the interrupted run, so " +
                    (is_option ? name + " cannot be given" : "no selector can be given") +
                    "; leave it out or start a new run",
                "run");
        }
    }
}

}  // namespace

void declare_run(CLI::App& app, RunOptions& o) {
    CLI::App* const run = &app;
    add_suite(run, o.suite);
    run->add_flag("--quick", o.quick, "the first and the last leaf of each case file alone")
        ->group("Selection");
    add_value(run, "--failed-in", o.failed_in,
              "only the cases that ended unexpectedly in an earlier run", "DIR", "Selection");
    add_shard(run, o.shard, "the I-th of N parts, by a hash of the id; 1 <= I <= N");
    add_value(run, "--doors", o.doors,
              "draw each case through other ways of the API, too: all, default (each door with "
              "each family), all,-NAME (without this one), or names of 'edgecase doors', separated "
              "by commas; doors that an expectation file knows to be broken are left out of sets "
              "[default for the whole suite of this program, none for a selection]",
              "NAMES", "Selection");
    add_value(
        run, "--ways", o.ways,
        "draw each case as applications do, too, without what tells of fragments: all, "
        "default (some with each case file), none, or names of 'edgecase doors', separated by "
        "commas, with '*' [as --doors]",
        "NAMES", "Selection");
    run->add_flag("--shuffle", o.shuffle, "in an order that depends on the seed")
        ->group("Selection");
    add_value(run, "--seed", o.seed, "seed of --shuffle [1]", "N", "Selection")
        ->check(in_range<uint64_t>(0, UINT64_MAX));
    add_value(run, "--repeat", o.repeat, "draw each case N times; other bits make a flake [1]", "N",
              "Selection")
        ->check(in_range(1U, 1000000U));
    add_device(run, o.device);
    add_value(run, "--require-device", o.require_device,
              "stop unless the device's name and driver match this regular expression", "REGEX",
              "Device");
    add_validation(run, o.device);
    add_require_support(run, o, "device");
    add_profile(run, o.profile);
    add_fail_at(run, o.fail_at);
    add_expectations(run, o);
    run->add_flag("--strict", o.strict,
                  "a known failure with bits that no file of pictures knows is unexpected")
        ->group("Judging");
    add_jobs(run, o);
    add_value(run, "--batch", o.batch, "cases in one submission, at most; 1 to 1024 [16]", "N",
              "Isolation")
        ->check(in_range(1U, 1024U));
    add_value(run, "--gpu-budget", o.gpu_budget,
              "milliseconds of a submission; batches are made smaller to keep to it [no bound]",
              "MS", "Isolation")
        ->check(in_range(1U, 600000U));
    add_value(run, "--retries", o.retries,
              "how often a failure is drawn again, an unexpected one alone [1]", "N", "Isolation")
        ->check(in_range(0U, 1000U));
    add_value(run, "--debugger", o.debugger,
              "run the worker of one case under 'gdb', 'lldb' or other words, on this terminal",
              "WORDS", "Isolation");
    run->add_flag("--fail-fast", o.fail_fast,
                  "end at the first unexpected result; the cases without one are skipped")
        ->group("Isolation");
    add_value(run, "--resume", o.resume, "go on with an interrupted run", "DIR", "Isolation");
    add_outputs(run, o, "where the reports go [out/<time>-<device>]", true);
    run->add_option(
           "--tell",
           [&o](const CLI::results_t& words) {
               const std::string& word = words.back();
               size_t most = SIZE_MAX;
               const auto read = std::from_chars(word.data(), word.data() + word.size(), most);
               o.tell = most;
               return word == "all" ||
                      (read.ec == std::errc{} && read.ptr == word.data() + word.size());
           },
           fmt::format(
               "of how many unexpected failures all is told and kept, pictures and {} findings; of "
               "more the level, the rules and one finding [{}; all with --verbose or "
               "--capture all]",
               diff::kMaxFindings, kTold))
        ->type_name("N|all")
        ->group("Output");
}

void check_run(const CLI::App& run, const RunOptions& o, const Words& words) {
    if (!o.resume.empty()) {
        check_resume(run, words);
    }
    if (o.no_expect && !o.expect.empty()) {
        throw usage_error("--expect and --no-expect exclude each other", "run");
    }
    if (o.no_expect && o.strict) {
        throw usage_error(
            "--strict asks how known failures look, and with --no-expect none is known; leave out "
            "one of the two",
            "run");
    }
    if (auto checked = cases::check_regex(o.require_device); !checked) {
        throw usage_error("--require-device: " + checked.error().message, "run");
    }
    check_fail_at(run, o);
}

RunOptions parse_run_arguments(const Words& arguments) {
    RunOptions options;
    const Command run{{"run", kChecking, "", nullptr}, [&](CLI::App& app) {
                          declare_run(app, options);
                          const auto check = [&](const CLI::App& command, const Words& words) {
                              check_device(command, options.device, words);
                              check_run(command, options, words);
                          };
                          return Action{check, {}};
                      }};
    if (arguments.size() < 2 || arguments[1] != "run") {
        throw stop_with(report::kExitInvalidFile, "the journal's command line is not one of 'run'");
    }
    parse({&run, 1}, arguments);
    return options;
}

}  // namespace cli
