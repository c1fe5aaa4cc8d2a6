// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/command_options.hpp"

#include <charconv>
#include <map>

#include "cli/options/command_examples.hpp"
#include "cli/options/shared_options.hpp"

namespace cli {

namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  edgecase run                                   the whole suite on the first device\n"
    "  edgecase run 'coverage/**' -o out/mine         one family, reports in out/mine\n"
    "  edgecase run my-case.toml --device llvmpipe    a file of your own on a chosen device\n"
    "  edgecase explain ties/apex-up --pixel 10,11    why a sample must be covered\n"
    "  edgecase doctor                                what is installed, what is missing\n"
    "\n"
    "Selectors: globs on ids ('*' within a part, '**' across), '@rule:PATTERN', a case file or "
    "folder,\n"
    "  '-' for ids on standard input, '!' in front excludes. Without any, the whole suite.\n"
    "\n"
    "Exit codes:\n"
    "    0  every selected case ended as expected\n"
    "    1  an unexpected result: fail, crash, timeout, device lost, flake, xpass, improved\n"
    "    2  wrong use of the command line\n"
    "    3  an invalid case, suite, expectation file or journal\n"
    "    4  no case is selected\n"
    "    5  no device, or not the demanded one\n"
    "    6  everything was skipped or unsupported\n"
    "    7  internal error, or cases were not run or could not be judged, or a report could not be "
    "written\n"
    "  130  interrupted; the reports hold what was done\n";

const std::map<std::string, std::string>& shell_names() {
    static const std::map<std::string, std::string> kNames = {
        {"bash", "bash"}, {"fish", "fish"}, {"zsh", "zsh"}};
    return kNames;
}

const std::map<std::string, ProgressStyle> kProgressNames = {{"auto", ProgressStyle::automatic},
                                                             {"plain", ProgressStyle::plain},
                                                             {"none", ProgressStyle::none}};
const std::map<std::string, run::KeepPictures> kCaptureNames = {
    {"failed", run::KeepPictures::failed},
    {"all", run::KeepPictures::all},
    {"none", run::KeepPictures::none}};

// What 'render' takes: no driver.
const std::map<std::string, std::string>& drawing_names() {
    static const std::map<std::string, std::string> kNames = [] {
        std::map<std::string, std::string> names = renderer_names();
        names.erase("vulkan");
        names.emplace("allowed", "");
        return names;
    }();
    return kNames;
}

// What run, gtest and diff have in common.
void add_expect(CLI::App* app, RunOptions& o, const char* what) {
    app->add_option("--expect", o.expect, what)
        ->type_name("FILE")
        ->type_size(1)
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group("Judging");
}
void add_expectations(CLI::App* app, RunOptions& o) {
    add_expect(app, o, "an expectation file, instead of those beside the suite");
    app->add_flag("--no-expect", o.no_expect, "no expectation files")->group("Judging");
}
void add_outputs(CLI::App* app, RunOptions& o, const char* folder, bool tells_ci) {
    add_value(app, "-o,--output", o.output, folder, "DIR", "Output");
    add_report_files(app, o.json, o.junit, o.html);
    add_choice(app, "--capture", o.capture, kCaptureNames,
               "of which cases the reports keep pictures")
        ->group("Output");
    app->add_flag_callback(
           "--no-diagnosis", [&o] { o.diagnosis = false; },
           "do not look for what the device does wrong, where cases fail")
        ->group("Output");
    add_terminal(app, o.quiet, o.verbose, o.color);
    if (tells_ci) {
        add_ci(app, o.ci);
    }
    add_choice(app, "--progress", o.progress, kProgressNames, "how progress is shown")
        ->group("Output");
}

void add_shard(CLI::App* app, Shard& shard, const char* what) {
    app->add_option(
           "--shard",
           [&shard](const CLI::results_t& results) {
               return parse_pair(results.back(), '/', shard.index, shard.count) &&
                      shard.index >= 1 && shard.index <= shard.count;
           },
           what)
        ->type_name("I/N")
        ->group("Selection");
}

void add_require_support(CLI::App* to, RunOptions& o, const std::string& who) {
    to->add_flag(
          "--require-support", o.require_support,
          "a case that the " + who + " does not support fails, unless a 'skip' line names it")
        ->group("Judging");
}

void define_run(CLI::App& app, RunOptions& o) {
    CLI::App* run =
        app.add_subcommand("run", "draw cases on a device and compare with the exact reference");
    run->footer(kFooter);
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
    run->add_flag("--validation", o.device.validation, "with the Khronos validation layer")
        ->group("Device");
    add_require_support(run, o, "device");
    add_profile(run, o.profile);
    add_fail_at(run, o.fail_at);
    add_expectations(run, o);
    run->add_flag("--strict", o.strict,
                  "a known failure with bits that no file of pictures knows is unexpected")
        ->group("Judging");
    add_value(run, "-j,--jobs", o.jobs, "workers, 1 to 256 [one a core, at most 4]", "N",
              "Isolation")
        ->envname("EDGECASE_JOBS")
        ->check(in_range(1U, 256U));
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
}

void define_gtest(CLI::App& app, GtestOptions& o) {
    CLI::App* gtest =
        app.add_subcommand("gtest", "draw cases as a GoogleTest program does, for deqp-runner");
    add_suite(gtest, o.run.suite);
    gtest->add_flag("--gtest_list_tests", o.list, "list the tests, draw nothing")
        ->group("Selection");
    add_value(gtest, "--gtest_filter", o.filter,
              "tests to draw, separated by ':', '*' and '?' as in GoogleTest [*]", "NAMES",
              "Selection");
    // A hang costs it twice, with others and alone: less than the 60 s after which deqp-runner
    // would end this process, and blame another case.
    o.run.device.timeout = 20;
    add_device(gtest, o.run.device);
    gtest->add_flag("--validation", o.run.device.validation, "with the Khronos validation layer")
        ->group("Device");
    add_profile(gtest, o.run.profile);
    add_fail_at(gtest, o.run.fail_at);
    add_expect(gtest, o.run, "an expectation file: what ends as it says is OK [none]");
    add_value(gtest, "-o,--output", o.run.output,
              "keep the reports, in a new folder below DIR for each process [not kept]", "DIR",
              "Output");
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

void define_fuzz(CLI::App& app, FuzzOptions& o) {
    CLI::App* fuzz =
        app.add_subcommand("fuzz", "draw cases that nobody wrote, and reduce what fails");
    fuzz->add_option("SELECTOR", o.run.suite.selectors,
                     "cases to change a few things of; a file with [fuzz] is varied as that says")
        ->type_name("");
    add_suite_folder(fuzz, o.run.suite);
    add_value(fuzz, "--seed", o.run.seed, "a seed and a number make a case [1]", "N", "Selection")
        ->check(in_range<uint64_t>(0, UINT64_MAX));
    add_value(fuzz, "--cases", o.cases, "the cases with numbers below N [no end]", "N", "Selection")
        ->check(in_range<uint64_t>(1, uint64_t{1} << 48));
    fuzz->add_option(
            "--time",
            [&o](const CLI::results_t& results) {
                return parse_duration(results.back(), o.seconds);
            },
            "end after this time, from when expected failures are reduced: 90s, 10m, 2h [no end]")
        ->type_name("TIME")
        ->group("Selection");
    add_value(fuzz, "--print", o.printed, "print the case with this number, draw nothing", "N",
              "Selection")
        ->check(in_range<uint64_t>(0, uint64_t{1} << 24));
    add_shard(fuzz, o.run.shard,
              "every N-th pose (or group of changed cases) from the I-th on; 1 <= I <= N");
    add_device(fuzz, o.run.device);
    fuzz->add_flag("--validation", o.run.device.validation, "with the Khronos validation layer")
        ->group("Device");
    add_profile(fuzz, o.run.profile);
    add_expectations(fuzz, o.run);
    add_value(fuzz, "--known", o.known,
              "the folder of an earlier hunt, whose causes are known; repeatable", "DIR", "Judging")
        ->type_size(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_value(fuzz, "-j,--jobs", o.run.jobs, "workers, 1 to 256 [one a core, at most 4]", "N",
              "Isolation")
        ->envname("EDGECASE_JOBS")
        ->check(in_range(1U, 256U));
    add_value(fuzz, "--resume", o.run.resume, "go on with an interrupted hunt", "DIR", "Isolation");
    add_value(fuzz, "-o,--output", o.run.output, "where the causes go [out/fuzz/<time>-<device>]",
              "DIR", "Output");
    fuzz->add_flag("-q,--quiet", o.run.quiet, "only causes and the summary")->group("Output");
}

void define_reduce(CLI::App& app, ReduceOptions& o) {
    CLI::App* reduce =
        app.add_subcommand("reduce", "make a failing case as small as it can be, on the device");
    add_case(reduce, o.run.suite);
    add_device(reduce, o.run.device);
    reduce->add_flag("--validation", o.run.device.validation, "with the Khronos validation layer")
        ->group("Device");
    add_value(reduce, "--captures-command", o.captures_command,
              "a renderer without Vulkan: words of a shell that draw the exported cases of the "
              "folder %in into the folder %out",
              "COMMAND", "Device");
    add_profile(reduce, o.run.profile);
    add_judged_device(reduce, o.judged);
    add_value(reduce, "-o,--output", o.run.output, "the case file to write [standard output]",
              "FILE", "Output");
    reduce->add_flag("-q,--quiet", o.run.quiet, "say nothing else")->group("Output");
}

void define_diagnose(CLI::App& app, DiagnoseOptions& o) {
    CLI::App* diagnose = app.add_subcommand("diagnose", "say what the device of a run does wrong");
    diagnose->add_option("DIR", o.directory, "the folder of a run")->required()->type_name("");
    diagnose->add_flag("--known", o.known, "explain expected failures, too");
    add_value(diagnose, "--suite", o.suite.suite, "where the cases are [as in the run]", "DIR",
              "Selection");
}

void define_probe(CLI::App& app, ProbeOptions& o) {
    CLI::App* probe =
        app.add_subcommand("probe", "measure what a rasterizer does where it may choose");
    add_device(probe, o.device);
    probe
        ->add_option("--compare", o.compared,
                     "two files of 'probe --json', or names of devices: say what differs")
        ->type_name("A B")
        ->expected(2)
        ->allow_extra_args(false)
        ->group("Selection");
    probe->add_option("--json", o.json, "write the datasheet also to FILE ('-': standard output)")
        ->type_name("FILE")
        ->group("Output");
    probe->add_option("--html", o.html, "write it as a page with pictures to FILE")
        ->type_name("FILE")
        ->group("Output");
    probe->add_flag("-v,--verbose", o.verbose, "tell each experiment, too")->group("Output");
}

// Rendering by others: what they get, and how it is judged.
void define_images(CLI::App& app, AllOptions& all) {
    CLI::App* out = app.add_subcommand("export", "write cases as JSON that any program can draw");
    add_suite(out, all.export_cases.suite);
    out->add_option("-o,--output", all.export_cases.output,
                    "where the files go; with --reproducer the C file")
        ->type_name("PATH")
        ->required();
    out->add_flag("--reproducer", all.export_cases.reproducer,
                  "one case as a C program for a bug report, needs the Vulkan loader alone");
    add_profile(out, all.export_cases.profile);
    add_judged_device(out, all.export_cases.judged);
    for (const char* judging : {"--profile", "--subpixel-bits", "--sample-locations"}) {
        // The environment says how runs are judged, which is no reason to refuse an export.
        out->get_option(judging)->needs("--reproducer")->envname("");
    }

    CLI::App* in = app.add_subcommand("diff", "judge what another program drew of exported cases");
    RunOptions& o = all.diff.run;
    add_suite(in, o.suite);
    in->add_option("--captures", all.diff.captures, "the folder with what was drawn")
        ->type_name("DIR")
        ->required()
        ->group("Selection");
    add_value(in, "--exported", all.diff.exported,
              "judge all cases of this export [those that have a folder in the captures]", "DIR",
              "Selection");
    add_value(in, "--name", all.diff.name, "of the renderer, for the reports", "NAME", "Output");
    add_profile(in, o.profile);
    add_fail_at(in, o.fail_at);
    add_judged_device(in, all.diff.judged);
    add_require_support(in, o, "renderer");
    add_expectations(in, o);
    add_outputs(in, o, "where the reports go [out/<time>-captures]", false);
}

void define_others(CLI::App& app, AllOptions& all) {
    CLI::App* list = app.add_subcommand("list", "list case ids");
    add_suite(list, all.list.suite);
    list->add_flag("--long", all.list.long_form, "with file, rules, description and notes");
    list->add_flag("--ids", all.list.ids, "ids only, one a line");
    list->add_flag("--json", all.list.json, "as JSON");

    app.add_subcommand("doors", "list the doors that a run can take: other ways of the API");

    CLI::App* lint =
        app.add_subcommand("lint", "check case and expectation files; needs no Vulkan");
    add_suite(lint, all.lint.suite);
    lint->add_flag("--strength", all.lint.strength,
                   "tell which faults of the software device the cases catch");
    lint->add_flag("-q,--quiet", all.lint.quiet, "print errors only");
    lint->add_flag("-v,--verbose", all.lint.verbose,
                   "tell which samples of each case exercise its rules");

    CLI::App* explain =
        app.add_subcommand("explain", "why a sample must, must not or may be covered");
    add_case(explain, all.explain.suite);
    explain
        ->add_option(
            "--pixel",
            [&all](const CLI::results_t& results) {
                all.explain.has_pixel = true;
                return parse_pair(results.back(), ',', all.explain.x, all.explain.y);
            },
            "the pixel; without it the case as a whole is told")
        ->type_name("X,Y");
    explain->add_option("--rule", all.explain.rule, "explain a rule instead")->type_name("ID");
    explain->add_option("--sample", all.explain.sample, "the sample in it [0]")->type_name("S");
    explain->add_option("--layer", all.explain.layer, "the layer of the target [0]")
        ->type_name("L");
    add_profile(explain, all.explain.profile);
    add_judged_device(explain, all.explain.judged);

    CLI::App* render =
        app.add_subcommand("render", "write the reference picture of a case; needs no Vulkan");
    add_case(render, all.render.suite);
    render
        ->add_option("-o,--output", all.render.output,
                     "*.exr (values), *.png (to look at) or *.json")
        ->type_name("FILE")
        ->required();
    add_value(render, "--scale", all.render.scale,
              "*.png: pixels on each side of a pixel, 1 to 512 [the longer side near 512]", "N",
              "Output")
        ->check(in_range(1U, 512U));
    add_profile(render, all.render.profile);
    add_judged_device(render, all.render.judged);
    add_choice(render, "--renderer", all.render.renderer, drawing_names(),
               "what draws: an algorithm of docs/algorithms.md, the reference or the software "
               "rasterizer; allowed: no drawing, but what the reference allows",
               takes_choices);
    define_images(app, all);

    CLI::App* doctor =
        app.add_subcommand("doctor", "what is installed, which devices there are, what is missing");
    add_device(doctor, all.doctor.device);
    doctor->add_flag("--json", all.doctor.json, "as JSON");

    CLI::App* report =
        app.add_subcommand("report", "rebuild the reports of a run from its journal");
    report->add_option("DIR", all.report.directories, "the folder of the run")
        ->required()
        ->type_name("");
    report->add_flag("--merge", all.report.merge,
                     "several folders, the shards of one run, become one");
    add_value(report, "-o,--output", all.report.output,
              "where the reports go [DIR, with --merge out/merged]", "DIR", "Output");
    add_ci(report, all.report.ci);
    add_report_files(report, all.report.json, all.report.junit, all.report.html);
    add_terminal(report, all.report.quiet, all.report.verbose, all.report.color);

    CLI::App* expect =
        app.add_subcommand("expect", "check an expectation file, or bring it up to date");
    expect->add_option("FILE", all.expect.file, "the expectation file")->required()->type_name("");
    expect->add_option("--update", all.expect.update, "write what a run has seen into the file")
        ->type_name("DIR");
    expect->add_option("--bug", all.expect.bug, "reference to a bug, for new lines")
        ->type_name("WORD");
    expect->add_option("--reason", all.expect.reason, "reason of new lines [what the run says]")
        ->type_name("TEXT");
    expect
        ->add_option("--until", all.expect.until,
                     "last day of new lines and of lines that ended and are still true")
        ->type_name("DATE");
    expect->add_flag("--bits", all.expect.bits,
                     "a line a case that excuses this picture only, bit for bit");
    expect->add_flag("--dry-run", all.expect.dry_run, "show what would change, write nothing");
    expect
        ->add_option("--suite", all.expect.suite.suite, "the folder of the suite [that of the run]")
        ->type_name("DIR");

    CLI::App* compare = app.add_subcommand("compare", "set runs side by side");
    compare
        ->add_option("DIR", all.compare.directories, "the folders of runs, the first is the base")
        ->required()
        ->type_name("");
    compare
        ->add_option("--json", all.compare.json,
                     "write the comparison to FILE ('-': standard output)")
        ->type_name("FILE");
    compare
        ->add_option("--html", all.compare.html,
                     "write a page with both sides of each case to FILE")
        ->type_name("FILE");
    compare->add_flag("-v,--verbose", all.compare.verbose,
                      "list every difference, draw where kept pictures differ");
    compare->add_flag("--common", all.compare.common, "leave out cases that a run lacks");
    compare->add_flag("--strict", all.compare.strict, "exit 1 with any difference of bits");
    add_choice(compare, "--color", all.compare.color, when_names(), "colours");

    CLI::App* bench = app.add_subcommand("bench", "what checking costs beside drawing");
    add_suite(bench, all.bench.suite);
    add_device(bench, all.bench.device);
    bench->add_option("--runs", all.bench.runs, "pairs of processes that are timed [3]")
        ->type_name("N")
        ->check(in_range(1U, 1000U));
    bench->add_flag("--json", all.bench.json, "as JSON");
    bench->add_flag("--bare", all.bench.bare, "")->group("");

    CLI::App* completion =
        app.add_subcommand("completion", "print the completion script of a shell");
    add_choice(completion, "SHELL", all.shell, shell_names(), "the shell")->required();
    app.add_subcommand("man", "print the manual page");
    app.add_subcommand("version", "print the version");
}

}  // namespace

void define(CLI::App& app, AllOptions& all) {
    app.footer(kFooter);
    app.set_help_flag("-h,--help", "this help");
    app.add_flag("--version", all.version, "print the version");
    app.require_subcommand(0, 1);
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    define_run(app, all.run);
    define_gtest(app, all.gtest);
    define_fuzz(app, all.fuzz);
    define_reduce(app, all.reduce);
    define_diagnose(app, all.diagnose);
    define_probe(app, all.probe);
    define_others(app, all);
    for (CLI::App* command : app.get_subcommands({})) {
        command->set_help_flag("-h,--help", "this help");
        if (command->get_name() != "run") {
            command->footer("");  // the program's is about run
        }
        for (const Examples& e : kExamples) {
            if (command->get_name() == e.command) {
                command->footer(std::string("Examples:\n") + e.text);
            }
        }
        command->group("The program");
        for (const Group& g : kGroups) {
            if (command->get_name() == g.command) {
                command->group(g.name);
            }
        }
        command->allow_extras();  // so that unknown options get our own words
    }
}

}  // namespace cli
