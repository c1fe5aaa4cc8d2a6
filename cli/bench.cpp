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
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "cli/commands.hpp"
#include "cli/prepare/suite.hpp"
#include "diff/verdict.hpp"
#include "run/worker/backend.hpp"
#include "vk_harness/public/harness.hpp"

extern char** environ;

namespace cli {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
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
    if (!device.device.empty()) {
        words.insert(words.end(), {"--device", device.device});
    }
    if (!device.icd.empty()) {
        words.insert(words.end(), {"--icd", device.icd});
    }
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
vk_harness::Result<double> draw_bare(vk_harness::Renderer& renderer,
                                     const std::vector<cases::Case>& cases) {
    const Clock::time_point begin = Clock::now();
    size_t drawn = 0;
    for (size_t k = 0; k < cases.size(); k += kBatch) {
        const size_t count = std::min(kBatch, cases.size() - k);
        const auto batch = renderer.render_bare(std::span(cases).subspan(k, count));
        if (!batch) {
            return tl::unexpected<vk_harness::Failure>(batch.error());
        }
        drawn += *batch;
    }
    if (drawn == 0) {
        vk_harness::Failure nothing;
        nothing.message = "this device supports none of the selected cases; select others";
        return tl::unexpected<vk_harness::Failure>(std::move(nothing));
    }
    return seconds_since(begin);
}

// The child: one line "cold warm", seconds of the first and the second pass over all cases.
int bare_command(const Program& program, const BenchOptions& options) {
    OrStop<LoadedSuite> suite = load_and_select(program, options.suite);
    if (!suite) {
        return report_stop(suite.error());
    }
    const std::vector<cases::Case> cases = selected_cases(*suite);
    vk_harness::Options vulkan;
    vulkan.device = options.device.device;
    vulkan.icd_file = options.device.icd;
    vk_harness::Result<vk_harness::Renderer> renderer = vk_harness::Renderer::create(vulkan);
    if (!renderer) {
        complain(renderer.error().message);
        return report::kExitDevice;
    }
    const vk_harness::Result<double> cold = draw_bare(*renderer, cases);
    // A second pass only when asked: the whole process is what the parent times.
    const bool twice = std::getenv("EDGECASE_BENCH_TWICE") != nullptr;
    const vk_harness::Result<double> warm = twice ? draw_bare(*renderer, cases) : cold;
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
    double help = 0;                    // seconds, median
    double run = 0, bare = 0;           // seconds of the whole processes, medians
    double ratio = 0;                   // run / bare, median of the pairs
    double bare_warm = 0;               // seconds of the second pass over all cases in one process
    double reference = 0, compare = 0;  // seconds over all cases, one thread
};

// Reference and comparison in this process, on captures that need no driver.
void time_reference(const std::vector<cases::Case>& cases, Figures& figures) {
    const ref::Limits limits;
    for (const cases::Case& c : cases) {
        if (c.blit) {
            continue;  // texels, not triangles
        }
        const capture::Capture capture = rasterizers::draw_by_reference(c);
        Clock::time_point begin = Clock::now();
        const ref::Expectation expectation = ref::expect(c, limits, cases::Profile::direct3d);
        figures.reference += seconds_since(begin);
        begin = Clock::now();
        const diff::Verdict verdict = diff::compare(c, expectation, capture);
        figures.compare += seconds_since(begin);
        if (!verdict.ok()) {
            fmt::print(stderr,
                       "edgecase: note: the reference's own picture of {} is not accepted\n", c.id);
        }
    }
}

std::string text_of(const Figures& f) {
    const auto cases = static_cast<double>(f.cases);
    const auto samples = static_cast<double>(f.samples);
    const double checking = f.reference + f.compare;
    return fmt::format(
        "{} cases, {} samples\n"
        "run          {:8.1f} ms   {:7.0f} cases/s   {:6.3f} ms a case, whole process, cold\n"
        "bare         {:8.1f} ms   {:7.0f} cases/s   drawing only, whole process, cold\n"
        "run / bare   {:8.2f}\n"
        "drawing      {:8.1f} ms   {:7.1f} million samples/s, warm, in one process\n"
        "reference    {:8.1f} ms   {:7.1f} million samples/s, one thread\n"
        "comparison   {:8.1f} ms   {:7.1f} million samples/s, one thread\n"
        "both         {:8.1f} ms   {:7.1f} million samples/s, {:.2f} times the speed of drawing\n"
        "--help       {:8.2f} ms\n",
        f.cases, f.samples, f.run * 1e3, cases / f.run, f.run * 1e3 / cases, f.bare * 1e3,
        cases / f.bare, f.ratio, f.bare_warm * 1e3, samples / f.bare_warm * 1e-6, f.reference * 1e3,
        samples / f.reference * 1e-6, f.compare * 1e3, samples / f.compare * 1e-6, checking * 1e3,
        samples / checking * 1e-6, f.bare_warm / checking, f.help * 1e3);
}

std::string json_of(const Figures& f) {
    return fmt::format(
        "{{\"cases\": {}, \"samples\": {}, \"run_seconds\": {}, \"bare_seconds\": {}, \"ratio\": "
        "{}, "
        "\"drawing_seconds\": {}, \"reference_seconds\": {}, \"comparison_seconds\": {}, "
        "\"help_seconds\": {}}}\n",
        f.cases, f.samples, f.run, f.bare, f.ratio, f.bare_warm, f.reference, f.compare, f.help);
}

}  // namespace

int bench_command(const Program& program, const BenchOptions& options) {
    if (options.bare) {
        return bare_command(program, options);
    }
    OrStop<LoadedSuite> suite = load_and_select(program, options.suite);
    if (!suite) {
        return report_stop(suite.error());
    }
    const std::string root = suite->root.string();
    const std::vector<cases::Case> cases = selected_cases(*suite);
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
    std::vector<double> runs, bares, ratios, helps;
    for (uint32_t k = 0; k <= options.runs && !failed; ++k) {
        std::filesystem::remove_all(folder + "/run");
        const std::optional<double> a = timed(run, "/dev/null", errors, exit_code);
        failed = !a || exit_code > report::kExitUnexpected;
        if (failed) {
            tell_failure("'run'", errors, exit_code);
            break;
        }
        const std::optional<double> b = timed(bare, text, errors, exit_code);
        failed = !b || exit_code != 0;
        if (failed) {
            tell_failure("bare drawing", errors, exit_code);
            break;
        }
        if (k > 0) {  // the first pair warms the disk cache
            runs.push_back(*a);
            bares.push_back(*b);
            ratios.push_back(*a / *b);
        }
    }
    if (!failed) {
        setenv("EDGECASE_BENCH_TWICE", "1", 1);
        failed = !timed(bare, text, errors, exit_code) || exit_code != 0;
        unsetenv("EDGECASE_BENCH_TWICE");
        double cold = 0;
        std::ifstream(text) >> cold >> figures.bare_warm;
        for (int k = 0; k < 15; ++k) {
            if (const std::optional<double> t =
                    timed(self(program, "--help"), "/dev/null", errors, exit_code)) {
                helps.push_back(*t);
            }
        }
    }
    std::filesystem::remove_all(folder);
    if (failed) {
        return exit_code == 0 ? report::kExitInternal : exit_code;
    }
    figures.run = median(runs);
    figures.bare = median(bares);
    figures.ratio = median(ratios);
    figures.help = median(helps);
    time_reference(cases, figures);
    std::fputs((options.json ? json_of(figures) : text_of(figures)).c_str(), stdout);
    return report::kExitOk;
}

}  // namespace cli
