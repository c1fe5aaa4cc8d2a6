// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/run_plan.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "cases/base/checksum.hpp"
#include "cases/base/counted.hpp"
#include "cases/model/device.hpp"
#include "cli/renderers/renderers.hpp"
#include "report/journal/journal.hpp"
#include "run/order.hpp"

namespace cli {

namespace fs = std::filesystem;

namespace {

// What ended unexpectedly in the run of --failed-in. Where no selector chooses, all of it is meant:
// a case of one's own that nobody names must not look as if it passed.
OrStop<std::set<std::string>> failed_ids(const RunOptions& options, const LoadedSuite& suite) {
    const cases::Expected<report::Run> earlier = report::load_journal(options.failed_in);
    if (!earlier) {
        return tl::unexpected(
            Stop{report::kExitInvalidFile, {"--failed-in: " + cases::to_string(earlier.error())}});
    }
    std::set<std::string> failed, selected;
    for (const size_t k : suite.selected) {
        selected.insert(suite.cases[k].id);
    }
    std::vector<const report::CaseRecord*> left_out;
    for (const report::CaseRecord& record : earlier->cases) {
        if (!report::is_expected(record.status)) {
            failed.insert(record.id);
            if (!selected.contains(record.id) && record.id != cases::kLimitsCase) {
                left_out.push_back(&record);
            }
        }
    }
    if (left_out.empty() || left_out.size() == failed.size()) {
        return failed;  // where none is left, that is told
    }
    const std::string what =
        fmt::format("{} that failed in '{}' {} not selected: '{}' of {}{}",
                    cases::counted(left_out.size(), "case"), options.failed_in,
                    left_out.size() == 1 ? "is" : "are", left_out.front()->id,
                    left_out.front()->file, left_out.size() == 1 ? "" : ", ...");
    if (!options.suite.selectors.empty()) {
        complain("warning: " + what);
        return failed;
    }
    return tl::unexpected(stop_with(
        report::kExitNothingSelected,
        what + "; name files or folders of your own, too, and '**' for the suite's cases"));
}

// The same for the same cases, whatever selected them in whichever order.
std::string selection_text(std::vector<std::string> ids) {
    std::sort(ids.begin(), ids.end());
    uint64_t hash = 0;
    for (const std::string& id : ids) {
        hash = cases::stable_hash(id, hash);
    }
    return fmt::format("{}, {}", cases::counted(ids.size(), "case"), cases::hex(hash));
}

// The level of --fail-at, unless it is the profile anyway.
std::optional<cases::Profile> own_fail_level(const RunOptions& options) {
    return options.fail_at == options.profile ? std::nullopt : options.fail_at;
}

// The options that change what counts as expected, as they would be given.
std::string settings_of(const RunOptions& options) {
    std::vector<std::string> words;
    for (const auto& [is_given, name] : {std::pair(options.require_support, "--require-support"),
                                         std::pair(options.strict, "--strict"),
                                         std::pair(options.device.validation, "--validation")}) {
        if (is_given) {
            words.emplace_back(name);
        }
    }
    const RunOptions usual;
    if (const auto level = own_fail_level(options)) {
        words.push_back(fmt::format("--fail-at {}", cases::to_string(*level)));
    }
    if (options.doors != usual.doors) {
        words.push_back("--doors " + options.doors);
    }
    for (const auto& [name, value, other] :
         {std::tuple("--repeat", options.repeat, usual.repeat),
          std::tuple("--retries", options.retries, usual.retries)}) {
        if (value != other) {
            words.push_back(fmt::format("{} {}", name, value));
        }
    }
    return fmt::format("{}", fmt::join(words, " "));
}

}  // namespace

OrStop<Selection> select_cases(const Program& program, const RunOptions& options) {
    Selection selection;
    SuiteOptions wanted = options.suite;
    selection.names_limits = std::erase(wanted.selectors, cases::kLimitsCase) > 0;
    const bool is_alone = selection.names_limits && wanted.selectors.empty();
    OrStop<LoadedSuite> suite = is_alone ? load_and_select(program, wanted, cases::Contents::ids)
                                         : load_with_ids(program, wanted);
    if (!suite) {
        return tl::unexpected(suite.error());
    }
    if (is_alone) {
        suite->selected.clear();
    }
    std::set<std::string> failed;
    if (!options.failed_in.empty()) {
        OrStop<std::set<std::string>> ids = failed_ids(options, *suite);
        if (!ids) {
            return tl::unexpected(ids.error());
        }
        failed = std::move(*ids);
        selection.names_limits = selection.names_limits || failed.contains(cases::kLimitsCase);
    }
    selection.root = suite->root;
    selection.known_ids = suite->ids();
    selection.suite_ids = suite->suite_ids();
    for (size_t k = suite->outside; k < suite->cases.size(); ++k) {
        selection.own_files.insert(suite->cases[k].claim.where.file);
    }
    if (!options.doors.empty() && options.doors != "none" &&
        renderer_of(options.device).needs == nullptr) {
        return tl::unexpected(
            stop_with(report::kExitUsage,
                      "--doors needs a Vulkan driver, and --renderer names another; "
                      "leave one of them out"));
    }
    std::map<std::string, size_t> left_out;  // leaves by file
    for (const cases::Case& c : suite->cases) {
        ++left_out[c.claim.where.file];
    }
    std::vector<std::string> ids;
    std::set<std::string> own;
    std::vector<cases::Case*> chosen;  // of all shards
    for (const size_t k :
         options.quick ? run::first_and_last(suite->cases, suite->selected) : suite->selected) {
        cases::Case& c = suite->cases[k];
        if (!options.failed_in.empty() && !failed.contains(c.id)) {
            continue;
        }
        ids.push_back(c.id);
        if (k >= suite->outside) {
            own.insert(c.claim.where.file);
        }
        chosen.push_back(&c);
    }
    OrStop<LeftOutDoors> doors = choose_doors(doors_of(options), chosen);
    if (!doors) {
        return tl::unexpected(doors.error());
    }
    selection.left_out_doors = std::move(*doors);
    for (cases::Case* c : chosen) {
        if (run::shard_of(c->id, options.shard.count) == options.shard.index) {
            --left_out[c->claim.where.file];
            selection.cases.push_back(std::move(*c));
        }
    }
    selection.part_files = suite->parts;
    for (const auto& [file, leaves] : left_out) {
        if (leaves > 0) {
            selection.part_files.insert(file);
        }
    }
    selection.of_all_shards = selection_text(std::move(ids));
    selection.own_hash = hash_of_files(own);
    selection.whole_suite = selection.cases.size() == selection.known_ids.size();
    if (selection.cases.empty() && !selection.names_limits) {
        std::string why = "no case is selected";
        if (suite->cases.empty()) {
            why = "the suite '" + suite->root.string() + "' holds no case";
        } else if (!options.failed_in.empty()) {
            why += "; no case of this selection failed in '" + options.failed_in + "'";
        } else if (options.shard.count > 1) {
            why += "; the selection has none in shard " + std::to_string(options.shard.index) +
                   "/" + std::to_string(options.shard.count);
        }
        return tl::unexpected(Stop{report::kExitNothingSelected, {why}});
    }
    if (options.shuffle) {
        run::shuffle(selection.cases, options.seed);
    }
    return selection;
}

report::Run new_header(const Program& program, const RunOptions& options,
                       const Selection& selection) {
    report::Run header;
    header.tool_version = kVersion;
    header.arguments = program.arguments;
    header.environment = recorded_environment();
    header.started = utc_now(false);
    utsname name{};
    ::uname(&name);
    header.host = std::string(name.sysname) + " " + name.release + " " + name.machine;
    header.profile = options.profile;
    header.fail_at = own_fail_level(options);
    header.seed = options.seed;
    std::error_code ignored;
    header.suite_root = fs::absolute(selection.root, ignored).lexically_normal().string();
    header.suite_hash = cases::hex(suite_hash(selection.root));
    header.selection = selection.of_all_shards;
    header.own_hash = selection.own_hash;
    header.settings = settings_of(options);
    return header;
}

namespace {

std::string join(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) {
        line += (line.empty() ? "" : " ") + shell_quote(word);
    }
    return line;
}

void add_given(std::vector<std::string>& words, const char* option, const std::string& value) {
    if (!value.empty()) {
        words.insert(words.end(), {option, value});
    }
}

void add_judged_device(std::vector<std::string>& words, const JudgedDevice& device) {
    if (device.subpixel_bits != 8) {
        words.insert(words.end(), {"--subpixel-bits", std::to_string(device.subpixel_bits)});
    }
    add_given(words, "--sample-locations", device.sample_locations);
    if (device.depth_beside_stencil != JudgedDevice().depth_beside_stencil) {
        words.insert(words.end(), {"--depth-beside-stencil", device.depth_beside_stencil});
    }
}

void add_suite_and_profile(std::vector<std::string>& words, const RunOptions& options) {
    add_given(words, "--suite", options.suite.suite);
    if (options.profile != cases::Profile::direct3d) {
        words.insert(words.end(), {"--profile", std::string(cases::to_string(options.profile))});
    }
}

void add_fail_at(std::vector<std::string>& words, const RunOptions& options) {
    if (const auto level = own_fail_level(options)) {
        words.insert(words.end(), {"--fail-at", std::string(cases::to_string(*level))});
    }
}

void add_expectations(std::vector<std::string>& words, const RunOptions& options) {
    if (options.no_expect) {
        words.emplace_back("--no-expect");
    }
    for (const std::string& file : options.expect) {
        words.insert(words.end(), {"--expect", file});
    }
}

}  // namespace

std::string selector_of(const RunOptions& options, const std::string& id) {
    const size_t end = std::min(id.find(':'), id.size());
    const std::string base = id.substr(0, end);
    const std::string leaf = id.substr(end);
    std::vector<std::string> selectors = options.suite.selectors;
    if (!options.suite.carried.empty()) {
        selectors.push_back(options.suite.carried);
    }
    for (const std::string& selector : selectors) {
        const fs::path own = selector.substr(0, selector.find(".toml:") + 5);
        if (selector.find(".toml:") != std::string::npos && own.stem() == base) {
            return own.string() + leaf;
        }
        if (selector.ends_with(".toml") && fs::path(selector).stem() == base) {
            return selector + leaf;
        }
        // A folder of one's own: its file; the suite's folders are not below the working directory
        // by their ids.
        const fs::path file = fs::path(selector) / (base + ".toml");
        std::error_code ignored;
        if (fs::is_regular_file(file, ignored)) {
            return file.string() + leaf;
        }
    }
    return id;
}

namespace {

// The settings that choose or change a driver, to be put before a command: "VK_DRIVER_FILES=a.json
// ".
std::string driver_settings() {
    constexpr std::array<std::string_view, 6> kPrefixes = {
        "VK_", "EDGECASE_SELF_PREFIX", "LP_", "LVP_", "MESA_", "GALLIUM_"};
    std::string text;
    for (const auto& [name, value] : recorded_environment()) {
        if (std::any_of(
                kPrefixes.begin(), kPrefixes.end(),
                [&, &n = name](std::string_view prefix) { return n.starts_with(prefix); })) {
            text += name + "=" + shell_quote(value) + " ";
        }
    }
    return text;
}

}  // namespace

std::string rerun_line(const Program& program, const RunOptions& options, const std::string& id,
                       const std::vector<std::string>& doors) {
    std::vector<std::string> words = {program.arguments.front(), "run", selector_of(options, id)};
    add_suite_and_profile(words, options);
    add_given(words, "--device", options.device.device);
    add_given(words, "--icd", options.device.icd);
    if (options.device.validation) {
        words.emplace_back("--validation");
    }
    add_given(words, "--renderer", options.device.renderer);
    if (!doors.empty()) {
        words.insert(words.end(), {"--doors", doors_words(options.doors, doors)});
    }
    if (options.repeat > 1) {
        words.insert(words.end(), {"--repeat", std::to_string(options.repeat)});
    }
    if (std::abs(options.device.timeout - DeviceOptions().timeout) > 0) {
        words.insert(words.end(), {"--timeout", fmt::format("{}", options.device.timeout)});
    }
    add_fail_at(words, options);
    if (options.require_support) {
        words.emplace_back("--require-support");
    }
    if (options.strict) {
        words.emplace_back("--strict");
    }
    add_expectations(words, options);
    return driver_settings() + join(words);
}

std::string diff_line(const Program& program, const DiffOptions& options, const std::string& id) {
    RunOptions named = options.run;
    named.suite.carried.clear();  // what the export carries is known by its id
    std::vector<std::string> words = {program.arguments.front(), "diff", selector_of(named, id),
                                      "--captures", options.captures};
    add_given(words, "--exported", options.exported);
    add_suite_and_profile(words, options.run);
    add_judged_device(words, options.judged);
    add_given(words, "--name", options.name);
    add_fail_at(words, options.run);
    if (options.run.require_support) {
        words.emplace_back("--require-support");
    }
    add_expectations(words, options.run);
    return join(words);
}

std::string explain_line(const Program& program, const RunOptions& options, const std::string& id,
                         const JudgedDevice& device) {
    std::vector<std::string> words = {program.arguments.front(), "explain",
                                      selector_of(options, id)};
    add_suite_and_profile(words, options);
    add_judged_device(words, device);
    return join(words);
}

std::string reproducer_line(const Program& program, const RunOptions& options,
                            const std::string& id, const JudgedDevice& device) {
    std::vector<std::string> words = {program.arguments.front(), "export", "--reproducer",
                                      selector_of(options, id)};
    add_suite_and_profile(words, options);
    add_judged_device(words, device);
    words.insert(words.end(), {"-o", "repro.c"});
    return join(words);
}

std::vector<std::pair<std::string, std::string>> recorded_environment() {
    constexpr std::array<std::string_view, 14> kPrefixes = {
        "VK_",         "EDGECASE_",  "LP_",          "LVP_",         "MESA_",
        "GALLIUM_",    "LIBGL_",     "ENABLE_",      "DISABLE_",     "NODEVICE_",
        "LD_LIBRARY_", "LD_PRELOAD", "SWIFTSHADER_", "XDG_DATA_DIRS"};
    std::vector<std::pair<std::string, std::string>> recorded;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string_view text = *variable;
        const size_t equals = text.find('=');
        const bool wanted =
            std::any_of(kPrefixes.begin(), kPrefixes.end(),
                        [&](std::string_view prefix) { return text.starts_with(prefix); });
        if (wanted && equals != std::string_view::npos) {
            recorded.emplace_back(text.substr(0, equals), text.substr(equals + 1));
        }
    }
    std::error_code ignored;
    recorded.emplace_back("PWD", fs::current_path(ignored).string());
    std::sort(recorded.begin(), recorded.end());
    return recorded;
}

std::string utc_now(bool compact) {
    std::time_t now = std::time(nullptr);
    const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
    const std::string_view digits = compact || epoch == nullptr ? "" : epoch;
    std::time_t given = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), given);
    if (read.ec == std::errc{} && read.ptr == digits.data() + digits.size()) {
        now = given;
    }
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), compact ? "%Y%m%dT%H%M%SZ" : "%Y-%m-%dT%H:%M:%SZ",
                  &utc);
    return text.data();
}

std::filesystem::path new_folder(const std::filesystem::path& parent, const std::string& name) {
    const std::filesystem::path first = parent / (utc_now(true) + "-" + name);
    std::filesystem::path out = first;
    std::error_code none;
    for (int n = 2; std::filesystem::exists(out, none); ++n) {
        out = first.string() + "-" + std::to_string(n);
    }
    return out;
}

}  // namespace cli
