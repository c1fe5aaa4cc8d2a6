// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the command line says. What only one command has stands in its file.
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

inline constexpr size_t kTold = 256;

struct RunOptions {
    SuiteOptions suite;
    DeviceOptions device;
    std::string failed_in, resume;
    bool quick = false, fail_fast = false, require_support = false, diagnosis = true;
    Shard shard;
    std::string doors;  // cli/prepare/doors.hpp; empty: as doors_of() chooses
    std::string ways;   // cli/prepare/ways.hpp; empty: as ways_of() chooses
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
    // Of so many failures all is told; nothing: kTold, or of all with --verbose or --capture all.
    std::optional<size_t> tell;
    bool quiet = false, verbose = false;
    When color = When::automatic;
    ProgressStyle progress = ProgressStyle::automatic;
    Ci ci = Ci::automatic;
};

struct DiffOptions {
    RunOptions run;        // what judging and reporting have in common
    std::string captures;  // folder
    std::string
        exported;      // folder whose index.json lists the cases, "": those that captures are of
    std::string name;  // of the renderer, for the reports
    JudgedDevice judged;
};

}  // namespace cli
