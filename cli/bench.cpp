// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The command "bench": what checking costs beside drawing. Whole processes are timed in turn (run,
// bare, run, bare, ...), so that a drift of the machine's speed meets both, and the ratio is taken
// pair by pair.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "cases/base/counted.hpp"
#include "cli/bench/clock.hpp"
#include "cli/bench/judging.hpp"
#include "cli/commands.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/prepare/suite.hpp"
#include "cli/renderers/renderers.hpp"
#include "run/order.hpp"

extern char** environ;

namespace cli {

namespace {

struct BenchOptions {
    SuiteOptions suite;
    DeviceOptions device;
    uint32_t runs = 3;  // counted pairs of whole processes
    bool json = false;
    bool bare = false;  // hidden: --bare, the child that draws without reading back or judging
};

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values.empty() ? 0 : values[values.size() / 2];
}

// Runs a command to its end with its output in `file` ("/dev/null" drops it) and its errors in
// `errors`; seconds it took, or nothing if it could not be started or was killed by a signal.
std::optional<double> timed(const std::vector<std::string>& command, const std::string& file,
                            const std::string& errors, int& exit_code) {
    std::vector<char*> argv;
    for (const std::string& word : command) {
        argv.push_back(const_cast<char*>(word.c_str()));
    }
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addopen(&actions, 2, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0644);
    const Clock::time_point begin = Clock::now();
    pid_t pid = -1;
    const int failed = posix_spawn(&pid, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (failed != 0 || waitpid(pid, &status, 0) != pid || !WIFEXITED(status)) {
        return std::nullopt;
    }
    exit_code = WEXITSTATUS(status);
    return seconds_since(begin);
}

// What the command that failed said itself, else its exit code.
void tell_failure(const std::string& command, const std::string& errors, int exit_code) {
    std::ifstream in(errors);
    const std::string said{std::istreambuf_iterator<char>(in), {}};
    if (said.empty()) {
        fmt::print(stderr, "edgecase: {} ended with exit code {}\n", command, exit_code);
    } else {
        std::fputs(said.c_str(), stderr);
    }
}

// The words that start the program again, under its driver's C library if there is one.
std::vector<std::string> self(const Program& program, const std::string& command) {
    std::vector<std::string> words = worker_command(program).words;
    words.back() = command;
    return words;
}

void add_device(std::vector<std::string>& words, const DeviceOptions& device) {
    for (const auto& [option, value] :
         {std::pair("--device", device.device), std::pair("--icd", device.icd),
          std::pair("--renderer", device.renderer)}) {
        if (!value.empty()) {
            words.insert(words.end(), {option, value});
        }
    }
}

// A file of one's own.
constexpr std::string_view kOwnCase =
    "format = 1\ndescription = \"One triangle.\"\nrules = [\"cover.inside\"]\n"
    "[target]\nsize = [64, 64]\n[[draw]]\nvertices = [[1, 1], [60, 5], [7, 62]]\n";

constexpr const char* kShaderCache = "MESA_SHADER_CACHE_DIR";

// Medians of commands that draw nothing, over a file in `folder`.
std::vector<std::pair<std::string, double>> time_commands(const Program& program,
                                                          const std::string& folder) {
    const std::string own = folder + "/own.toml";
    std::ofstream(own) << kOwnCase;
    const std::vector<std::pair<std::string, std::vector<std::string>>> commands = {
        {"--help", {}},
        {"lint", {own}},
        {"explain", {own, "--pixel", "20,20"}},
        {"render", {own, "-o", folder + "/own.json"}}};
    std::vector<std::pair<std::string, double>> out;
    for (const auto& [name, words] : commands) {
        std::vector<std::string> command = self(program, name);
        command.insert(command.end(), words.begin(), words.end());
        std::vector<double> seconds;
        int exit_code = 0;
        for (int k = 0; k < 9; ++k) {
            if (const auto t = timed(command, "/dev/null", folder + "/errors.txt", exit_code);
                t && exit_code == 0) {
                seconds.push_back(*t);
            }
        }
        out.emplace_back(name, median(seconds));
    }
    return out;
}

std::vector<cases::Case> selected_cases(LoadedSuite& suite) {
    std::vector<cases::Case> result;
    for (const size_t k : suite.selected) {
        result.push_back(std::move(suite.cases[k]));
    }
    return result;
}

uint64_t sample_count(const std::vector<cases::Case>& cases) {
    uint64_t count = 0;
    for (const cases::Case& c : cases) {
        count += uint64_t{c.target.width} * c.target.rows() * c.target.samples;
    }
    return count;
}

constexpr size_t kBatch = 16;  // cases in one submission, as `run` does it

// Draws all cases that the device supports once; seconds.
cases::Expected<double> draw_bare(capture::Renderer& renderer,
                                  const std::vector<cases::Case>& cases) {
    using capture::Rendered;
    const Clock::time_point begin = Clock::now();
    size_t drawn = 0;
    for (size_t k = 0; k < cases.size(); k += kBatch) {
        const size_t count = std::min(kBatch, cases.size() - k);
        for (const Rendered& result : renderer.render(std::span(cases).subspan(k, count),
                                                      capture::PlaneSet(), [](auto) {}, {})) {
            if (result.status == Rendered::Status::drawn) {
                ++drawn;
            } else if (result.status != Rendered::Status::unsupported) {
                return cases::failure("{}", result.reason);
            }
        }
    }
    if (drawn == 0) {
        return cases::failure("this device supports none of the selected cases; select others");
    }
    return seconds_since(begin);
}

// The child: one line "cold warm", seconds of the first and the second pass over all cases.
int bare_command(const Program& program, const BenchOptions& options) {
    LoadedSuite suite = load_and_select(program, options.suite);
    const std::vector<cases::Case> cases = selected_cases(suite);
    const auto renderer = renderer_of(options.device).make(options.device);
    if (!renderer) {
        complain(renderer.error().message);
        return report::kExitDevice;
    }
    const auto cold = draw_bare(**renderer, cases);
    // A second pass only when asked: the whole process is what the parent times.
    const bool twice = std::getenv("EDGECASE_BENCH_TWICE") != nullptr;
    const auto warm = twice ? draw_bare(**renderer, cases) : cold;
    if (!cold || !warm) {
        complain((cold ? warm : cold).error().message);
        return report::kExitAllSkipped;
    }
    fmt::print("{} {}\n", *cold, *warm);
    return report::kExitOk;
}

struct Figures {
    size_t cases = 0;
    uint64_t samples = 0;
    double run = 0, bare = 0;      // seconds of the whole processes, medians
    double ratio = 0;              // run / bare, median of the pairs
    double run_without_cache = 0;  // seconds, with nothing in Mesa's shader cache
    double bare_warm = 0;          // seconds of the second pass over all cases in one process
    std::vector<std::pair<std::string, double>> commands;  // that draw nothing, seconds, medians
    JudgingFigures judging;
};

std::string text_of(const Figures& f) {
    const auto cases = static_cast<double>(f.cases);
    const auto samples = static_cast<double>(f.samples);
    const JudgingFigures& judging = f.judging;
    const double checking = judging.reference + judging.compare;
    std::string out = fmt::format(
        "{} cases, {} samples\n"
        "run          {:8.1f} ms   {:7.0f} cases/s   {:6.3f} ms a case, whole process, cold\n"
        "bare         {:8.1f} ms   {:7.0f} cases/s   drawing only, whole process, cold\n"
        "run / bare   {:8.2f}\n"
        "empty cache  {:8.1f} ms   {:7.2f} times run, with nothing in Mesa's shader cache\n"
        "drawing      {:8.1f} ms   {:7.1f} million samples/s, warm, in one process\n"
        "reference    {:8.1f} ms   {:7.1f} million samples/s, one thread\n"
        "comparison   {:8.1f} ms   {:7.1f} million samples/s, one thread\n"
        "both         {:8.1f} ms   {:7.1f} million samples/s, {:.2f} times the speed of drawing\n",
        f.cases, f.samples, f.run * 1e3, cases / f.run, f.run * 1e3 / cases, f.bare * 1e3,
        cases / f.bare, f.ratio, f.run_without_cache * 1e3, f.run_without_cache / f.run,
        f.bare_warm * 1e3, samples / f.bare_warm * 1e-6, judging.reference * 1e3,
        samples / judging.reference * 1e-6, judging.compare * 1e3, samples / judging.compare * 1e-6,
        checking * 1e3, samples / checking * 1e-6, f.bare_warm / checking);
    out += fmt::format(
        "right        {:8.1f} ms   {:7.0f} cases/s   judged and recorded, half of --quick\n"
        "broken       {:8.1f} ms   {:7.2f} times right: half a pixel off, {} of {} cases fail\n",
        judging.right * 1e3, static_cast<double>(judging.quick_cases) / judging.right,
        judging.broken * 1e3, judging.broken / judging.right, judging.broken_cases,
        judging.quick_cases);
    for (const JudgingFigures::Size& size : judging.sizes) {
        out += fmt::format(
            "{:<12} {:8.2f} ns a sample, judged; the reference alone {:.0f} million samples/s\n",
            fmt::format("{0} x {0}", size.side), 1e9 / size.all, size.reference * 1e-6);
    }
    out += fmt::format("dearest size {:8.2f} times the cheapest, a sample\n",
                       spread_of(judging.sizes));
    for (const JudgingFigures::Small& small : judging.small) {
        out += fmt::format("small        {:8.0f} cases/s of {} in {} x {}, judged, one thread\n",
                           small.cases, cases::counted(small.triangles, "triangle"), small.side,
                           small.side);
    }
    for (const JudgingFigures::Megapixel& picture : judging.megapixels) {
        out += fmt::format("megapixel    {:8.2f} ms   {}, one triangle, one thread\n",
                           picture.seconds * 1e3, picture.what);
    }
    for (const auto& [name, seconds] : f.commands) {
        out += fmt::format("{:<12} {:8.2f} ms\n", name, seconds * 1e3);
    }
    return out;
}

std::string json_of(const Figures& f) {
    using Json = nlohmann::ordered_json;
    const JudgingFigures& judging = f.judging;
    Json out = {{"cases", f.cases},
                {"samples", f.samples},
                {"run_seconds", f.run},
                {"bare_seconds", f.bare},
                {"ratio", f.ratio},
                {"run_without_cache_seconds", f.run_without_cache},
                {"drawing_seconds", f.bare_warm},
                {"reference_seconds", judging.reference},
                {"comparison_seconds", judging.compare},
                {"right_seconds", judging.right},
                {"broken_seconds", judging.broken},
                {"quick_cases", judging.quick_cases},
                {"broken_cases", judging.broken_cases}};
    for (const JudgingFigures::Size& size : judging.sizes) {
        out["sizes"].push_back({{"side", size.side},
                                {"reference_samples_per_second", size.reference},
                                {"samples_per_second", size.all}});
    }
    for (const JudgingFigures::Small& small : judging.small) {
        out["small"].push_back({{"side", small.side},
                                {"triangles", small.triangles},
                                {"cases_per_second", small.cases}});
    }
    for (const JudgingFigures::Megapixel& picture : judging.megapixels) {
        out["megapixels"].push_back({{"what", picture.what}, {"seconds", picture.seconds}});
    }
    for (const auto& [name, seconds] : f.commands) {
        out["commands"].push_back({{"command", name}, {"seconds", seconds}});
    }
    return out.dump() + "\n";
}

int carry_out(const Program& program, const BenchOptions& options) {
    if (options.bare) {
        return bare_command(program, options);
    }
    LoadedSuite suite = load_and_select(program, options.suite);
    const std::string root = suite.root.string();
    const std::vector<cases::Case> cases = selected_cases(suite);
    Figures figures;
    figures.cases = cases.size();
    figures.samples = sample_count(cases);

    std::string folder =
        (std::filesystem::temp_directory_path() / "edgecase-bench-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) {
        fmt::print(stderr, "edgecase: cannot create a folder in {}\n",
                   std::filesystem::temp_directory_path().string());
        return report::kExitInternal;
    }
    const std::string text = folder + "/bare.txt";
    const std::string errors = folder + "/errors.txt";
    std::vector<std::string> run = self(program, "run");
    std::vector<std::string> bare = self(program, "bench");
    bare.emplace_back("--bare");
    run.insert(run.end(), {"-o", folder + "/run", "-q", "--suite", root});
    bare.insert(bare.end(), {"--suite", root});
    add_device(run, options.device);
    add_device(bare, options.device);
    run.insert(run.end(), options.suite.selectors.begin(), options.suite.selectors.end());
    bare.insert(bare.end(), options.suite.selectors.begin(), options.suite.selectors.end());

    int exit_code = 0;
    bool failed = false;
    std::vector<double> runs, bares, ratios;
    for (uint32_t k = 0; k <= options.runs && !failed; ++k) {
        std::filesystem::remove_all(folder + "/run");
        const std::optional<double> a = timed(run, "/dev/null", errors, exit_code);
        failed = !a || exit_code > report::kExitUnexpected;
        if (failed) {
            tell_failure("'run'", errors, exit_code);
            break;
        }
        if (k == 0) {
            continue;  // the first run warms the caches of the disk and of the driver
        }
        const std::optional<double> b = timed(bare, text, errors, exit_code);
        failed = !b || exit_code != 0;
        if (failed) {
            tell_failure("bare drawing", errors, exit_code);
            break;
        }
        runs.push_back(*a);
        bares.push_back(*b);
        ratios.push_back(*a / *b);
    }
    if (!failed) {
        setenv("EDGECASE_BENCH_TWICE", "1", 1);
        failed = !timed(bare, text, errors, exit_code) || exit_code != 0;
        unsetenv("EDGECASE_BENCH_TWICE");
        double cold = 0;
        std::ifstream(text) >> cold >> figures.bare_warm;
        figures.commands = time_commands(program, folder);
    }
    if (!failed) {
        const char* before = std::getenv(kShaderCache);
        const std::optional<std::string> kept =
            before != nullptr ? std::optional<std::string>(before) : std::nullopt;
        setenv(kShaderCache, (folder + "/cache").c_str(), 1);
        std::filesystem::remove_all(folder + "/run");
        const std::optional<double> seconds = timed(run, "/dev/null", errors, exit_code);
        failed = !seconds || exit_code > report::kExitUnexpected;
        figures.run_without_cache = seconds.value_or(0);
        if (kept) {
            setenv(kShaderCache, kept->c_str(), 1);
        } else {
            unsetenv(kShaderCache);
        }
    }
    std::filesystem::remove_all(folder);
    if (failed) {
        return exit_code == 0 ? report::kExitInternal : exit_code;
    }
    figures.run = median(runs);
    figures.bare = median(bares);
    figures.ratio = median(ratios);
    std::vector<size_t> all(cases.size());
    std::iota(all.begin(), all.end(), size_t{0});
    figures.judging = time_judging(cases, run::first_and_last(cases, all));
    std::fputs((options.json ? json_of(figures) : text_of(figures)).c_str(), stdout);
    return report::kExitOk;
}

void declare(CLI::App& app, BenchOptions& o) {
    add_suite(&app, o.suite);
    add_device(&app, o.device);
    app.add_option("--runs", o.runs, "pairs of processes that are timed [3]")
        ->type_name("N")
        ->check(in_range(1U, 1000U));
    app.add_flag("--json", o.json, "as JSON");
    app.add_flag("--bare", o.bare, "")->group("");
}

}  // namespace

Command bench_command() {
    return make_command<BenchOptions>({"bench", kProgram, "what checking costs beside drawing",
                                       "  edgecase bench 'coverage/**' --runs 5\n"},
                                      declare, carry_out);
}

}  // namespace cli
