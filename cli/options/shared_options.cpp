// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/shared_options.hpp"

#include "cases/model/device.hpp"
#include "cli/renderers/renderers.hpp"

namespace cli {

namespace {

const std::map<std::string, cases::Profile> kProfileNames = {
    {"vulkan", cases::Profile::vulkan},
    {"practice", cases::Profile::practice},
    {"direct3d", cases::Profile::direct3d}};
const std::map<std::string, std::string> kBesideStencil = {{"d32-float", "d32-float"},
                                                           {"d24-unorm", "d24-unorm"}};
const std::map<std::string, std::optional<cases::Profile>> kLevelNames = {
    {"vulkan", cases::Profile::vulkan},
    {"practice", cases::Profile::practice},
    {"direct3d", cases::Profile::direct3d}};
const std::map<std::string, Ci> kCiNames = {
    {"auto", Ci::automatic}, {"github", Ci::github}, {"gitlab", Ci::gitlab}, {"none", Ci::none}};

const std::map<std::string, ProgressStyle> kProgressNames = {{"auto", ProgressStyle::automatic},
                                                             {"plain", ProgressStyle::plain},
                                                             {"none", ProgressStyle::none}};
const std::map<std::string, run::KeepPictures> kCaptureNames = {
    {"failed", run::KeepPictures::failed},
    {"all", run::KeepPictures::all},
    {"none", run::KeepPictures::none}};

bool parse_number(std::string_view text, uint32_t& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

const std::map<std::string, When>& when_names() {
    static const std::map<std::string, When> kNames = {
        {"auto", When::automatic}, {"always", When::always}, {"never", When::never}};
    return kNames;
}

const std::map<std::string, std::string>& renderer_names() {
    static const std::map<std::string, std::string> kNames = [] {
        std::map<std::string, std::string> names;
        for (const capture::RendererKind& kind : all_renderers()) {
            names.emplace(kind.name, names.empty() ? "" : kind.name);  // the first needs no name
        }
        return names;
    }();
    return kNames;
}

bool takes_choices(const std::string& words, std::string& renderer) {
    const capture::RendererKind* const kind = capture::find_renderer(all_renderers(), words);
    if (kind == nullptr || kind->wrong_choices == nullptr) {
        return false;
    }
    const std::string_view choices = std::string_view(words).substr(words.find(':') + 1);
    if (const std::string wrong = kind->wrong_choices(choices); !wrong.empty()) {
        throw CLI::ValidationError("--renderer", wrong);
    }
    renderer = words;
    return true;
}

bool parse_pair(const std::string& text, char separator, uint32_t& a, uint32_t& b) {
    const size_t at = text.find(separator);
    return at != std::string::npos && parse_number(std::string_view(text).substr(0, at), a) &&
           parse_number(std::string_view(text).substr(at + 1), b);
}

void add_suite_folder(CLI::App* app, SuiteOptions& o) {
    add_value(app, "--suite", o.suite, "the folder of the suite (EDGECASE_SUITE)", "DIR",
              "Selection");
}

void add_suite(CLI::App* app, SuiteOptions& o) {
    app->add_option("SELECTOR", o.selectors, "which cases; all without one")->type_name("");
    add_suite_folder(app, o);
}

void add_case(CLI::App* app, SuiteOptions& o) {
    app->add_option("CASE", o.selectors, "the id or the file of one case")
        ->multi_option_policy(CLI::MultiOptionPolicy::Throw)  // not the last one of several
        ->expected(0, 1)
        ->type_name("");
    add_suite_folder(app, o);
}

void add_profile(CLI::App* app, cases::Profile& profile) {
    add_choice(app, "--profile", profile, kProfileNames, "what the device is held to")
        ->envname("EDGECASE_PROFILE")
        ->group("Judging");
}

void add_fail_at(CLI::App* app, std::optional<cases::Profile>& level) {
    add_choice(app, "--fail-at", level, kLevelNames,
               "a case fails the run only if it breaks this level or a looser one [the profile]")
        ->group("Judging");
}

void add_judged_device(CLI::App* app, JudgedDevice& device) {
    add_value(app, "--subpixel-bits", device.subpixel_bits,
              "subpixel precision bits of the device, 4 to 16 [8]", "N", "Judging")
        ->check(in_range(cases::kLeastSubpixelBits, cases::kMostSubpixelBits));
    add_value(app, "--sample-locations", device.sample_locations,
              "where its samples are, in 1/16 pixel, if not at the standard locations: a list a "
              "sample count, as \"12,4;4,12\"",
              "LISTS", "Judging")
        ->check([](const std::string& text) {
            const auto lists = cases::parse_sample_locations(text);
            return lists ? std::string() : lists.error().message;
        });
    add_choice(app, "--depth-beside-stencil", device.depth_beside_stencil, kBesideStencil,
               "the depth beside a stencil where a case names none")
        ->group("Judging");
}

void add_device(CLI::App* app, DeviceOptions& o) {
    add_value(app, "--device", o.device, "a part of its name, its index or its UUID", "DEVICE",
              "Device")
        ->envname("EDGECASE_DEVICE");
    add_value(app, "--icd", o.icd, "the driver's manifest file, and no other driver", "FILE",
              "Device")
        ->envname("EDGECASE_ICD");
    add_value(app, "--timeout", o.timeout,
              fmt::format("seconds without a sign of life that end a worker [{}]", o.timeout),
              "SECONDS", "Isolation")
        ->envname("EDGECASE_TIMEOUT")
        ->check(in_range(0.01, 86400.0));
    add_choice(
        app, "--renderer", o.renderer, renderer_names(),
        "what draws: a driver, an algorithm of docs/algorithms.md, or software:KEY=VALUE,..., "
        "the software rasterizer with such choices",
        takes_choices)
        ->group("Device");
}

void add_terminal(CLI::App* app, bool& quiet, bool& verbose, When& color) {
    app->add_flag("-q,--quiet", quiet, "only unexpected results")->group("Output");
    app->add_flag("-v,--verbose", verbose, "tell every unexpected case, with a picture")
        ->group("Output");
    add_choice(app, "--color", color, when_names(), "colours")->group("Output");
}

void add_report_files(CLI::App* app, std::string& json, std::string& junit, std::string& html) {
    for (const auto& [name, target] :
         {std::pair{"--json", &json}, std::pair{"--junit", &junit}, std::pair{"--html", &html}}) {
        app->add_option(name, *target, "write this report also to FILE ('-': standard output)")
            ->type_name("FILE")
            ->group("Output");
    }
}

void add_ci(CLI::App* app, Ci& ci) {
    add_choice(app, "--ci", ci, kCiNames, "what continuous integration is told")->group("Output");
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

void add_jobs(CLI::App* app, RunOptions& o) {
    add_value(app, "-j,--jobs", o.jobs, "workers, 1 to 256 [one a core, at most 4]", "N",
              "Isolation")
        ->envname("EDGECASE_JOBS")
        ->check(in_range(1U, 256U));
}

void add_validation(CLI::App* app, DeviceOptions& o) {
    app->add_flag("--validation", o.validation, "with the Khronos validation layer")
        ->group("Device");
}

}  // namespace cli
