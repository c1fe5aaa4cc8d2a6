// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the command line says. The option table itself, its help and its errors are
// command_line.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "capture/renderer.hpp"
#include "cases/base/parallel.hpp"
#include "cases/model/profile.hpp"
#include "run/judge.hpp"

namespace cli {

// The folder of an export that holds the case files from outside the suite, by their ids: 'diff'
// finds them there.
inline constexpr char kCarried[] = "own-cases";

enum class When { automatic, always, never };
enum class ProgressStyle { automatic, plain, none };
enum class Ci { automatic, github, gitlab, none };

// What commands that look at cases have in common.
struct SuiteOptions {
    std::string suite;  // empty: found by find_suite_root
    std::vector<std::string> selectors;
    // Cases that an export carries: part of the suite where it lists them, without being named.
    std::string carried = {};
};

struct DeviceOptions : capture::RendererOptions {
    double timeout = 30;  // seconds without a sign of life
};

struct Shard {
    uint32_t index = 1, count = 1;
};

// What the reference has to know of a device that is not asked.
struct JudgedDevice {
    uint32_t subpixel_bits = 8;
    std::string
        sample_locations;  // as cases::parse_sample_locations takes them; "": the standard ones
    std::string depth_beside_stencil = "d32-float";  // or d24-unorm; where a case names none
};

struct RunOptions {
    SuiteOptions suite;
    DeviceOptions device;
    std::string failed_in, resume;
    bool quick = false, fail_fast = false, require_support = false, diagnosis = true;
    Shard shard;
    std::string doors;  // cli/prepare/doors.hpp; empty: as doors_of() chooses
    bool shuffle = false;
    uint64_t seed = 1;
    uint32_t repeat = 1;
    std::string require_device;
    std::vector<std::string> expect;
    bool no_expect = false;
    bool strict = false;  // known failures with pictures that nobody has seen are unexpected
    cases::Profile profile = cases::Profile::direct3d;
    std::optional<cases::Profile> fail_at;  // the strictest level that makes it fail; the profile
    uint32_t jobs = std::min(cases::cores(), 4U);
    uint32_t batch = 16;
    uint32_t gpu_budget = 0;  // milliseconds; 0: none
    uint32_t retries = 1;
    std::string debugger;
    std::string output;
    std::string json, junit, html;
    run::KeepPictures capture = run::KeepPictures::failed;
    bool quiet = false, verbose = false;
    When color = When::automatic;
    ProgressStyle progress = ProgressStyle::automatic;
    Ci ci = Ci::automatic;
};

// Cases as a GoogleTest program: what deqp-runner and others start.
struct GtestOptions {
    RunOptions run;
    bool list = false;
    std::string filter = "*";
};

struct FuzzOptions {
    RunOptions run;      // its device, judging, output and, to start from cases, its suite
    uint64_t cases = 0;  // numbers from here on are not made; 0: no end
    double seconds = 0;  // 0: no end
    std::vector<std::string> known;   // folders of earlier hunts
    std::optional<uint64_t> printed;  // the number of a case to print; nothing is drawn then
};

struct ReduceOptions {
    RunOptions run;                // its suite with exactly one case, device, judging and output
    std::string captures_command;  // of a renderer that no worker drives; empty: a device draws
    JudgedDevice judged;           // that renderer
};

struct DiagnoseOptions {
    SuiteOptions suite;
    std::string directory;  // of a run
    bool known = false;     // expected failures, too
};

struct ProbeOptions {
    DeviceOptions device;
    std::vector<std::string> compared;  // none, or two: files of an earlier probe, or devices
    std::string json, html;
    bool verbose = false;
};

struct ListOptions {
    SuiteOptions suite;
    bool long_form = false, ids = false, json = false;
};

struct LintOptions {
    SuiteOptions suite;
    bool strength = false;
    bool quiet = false, verbose = false;
};

struct ExplainOptions {
    SuiteOptions suite;  // exactly one selector, one case
    std::string rule;    // or a rule, and no case
    bool has_pixel = false;
    uint32_t x = 0, y = 0, sample = 0, layer = 0;
    cases::Profile profile = cases::Profile::direct3d;
    JudgedDevice judged;
};

struct ExpectOptions {
    SuiteOptions suite;
    std::string file;
    std::string update;  // the folder of a run
    std::string bug, reason, until;
    bool bits = false, dry_run = false;
};

struct CompareOptions {
    std::vector<std::string> directories;
    std::string json, html;
    bool verbose = false, common = false, strict = false;
    When color = When::automatic;
};

struct RenderOptions {
    SuiteOptions suite;  // exactly one selector, one case
    std::string output;
    std::string renderer;  // "": what the reference allows; else what this one draws
    uint32_t scale = 0;    // side of a pixel in a *.png; 0: chosen by the target's size
    cases::Profile profile = cases::Profile::direct3d;
    JudgedDevice judged;
};

struct ExportOptions {
    SuiteOptions suite;
    std::string output;                                 // folder; of a reproducer the file
    bool reproducer = false;                            // one case as a C program
    cases::Profile profile = cases::Profile::direct3d;  // that a reproducer judges at
    JudgedDevice judged;                                // that it is for
};

struct DiffOptions {
    RunOptions run;        // what judging and reporting have in common
    std::string captures;  // folder
    std::string
        exported;      // folder whose index.json lists the cases, "": those that captures are of
    std::string name;  // of the renderer, for the reports
    JudgedDevice judged;
};

struct DoctorOptions {
    DeviceOptions device;
    bool json = false;
};

struct BenchOptions {
    SuiteOptions suite;
    DeviceOptions device;
    uint32_t runs = 3;  // counted pairs of whole processes
    bool json = false;
    bool bare = false;  // hidden: --bare, the child that draws without reading back or judging
};

struct ReportOptions {
    std::vector<std::string> directories;  // one, several with --merge
    bool merge = false;
    std::string output;
    Ci ci = Ci::automatic;
    std::string json, junit, html;
    bool quiet = false, verbose = false;
    When color = When::automatic;
};

}  // namespace cli
