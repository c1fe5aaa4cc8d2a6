// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/prepare/command_lines.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string_view>

#include "cases/model/rule_ids.hpp"
#include "cases/model/way.hpp"
#include "cli/prepare/doors.hpp"
#include "cli/reproducer/reproducer.hpp"
#include "report/text/sentences.hpp"

namespace cli {

namespace fs = std::filesystem;
using report::CaseRecord;
using report::Status;

namespace {

// The words of a command line; an option that is as usual is left out.
class Words {
  public:
    Words() = default;
    Words(const Program& program, std::vector<std::string> words) : words_{program.called} {
        words_.insert(words_.end(), words.begin(), words.end());
    }

    Words& flag(const char* option, bool is_given) {
        if (is_given) {
            words_.emplace_back(option);
        }
        return *this;
    }
    Words& text(const char* option, const std::string& value, std::string_view usual = {}) {
        if (value != usual) {
            words_.insert(words_.end(), {option, value});
        }
        return *this;
    }
    template <class T>
    Words& number(const char* option, T value, T usual) {
        return text(option, fmt::format("{}", value), fmt::format("{}", usual));
    }
    Words& suite_and_profile(const RunOptions& options) {
        const char* const set = std::getenv("EDGECASE_SUITE");
        const std::string& own = options.suite.suite;
        return text("--suite", own.empty() && set != nullptr ? set : own)
            .text("--profile", std::string(cases::to_string(options.profile)),
                  cases::to_string(cases::Profile::direct3d));
    }
    Words& device(const JudgedDevice& device) {
        const JudgedDevice usual;
        return number("--subpixel-bits", device.subpixel_bits, usual.subpixel_bits)
            .text("--sample-locations", device.sample_locations)
            .text("--depth-beside-stencil", device.depth_beside_stencil,
                  usual.depth_beside_stencil);
    }
    Words& fail_at(const RunOptions& options) {
        const auto level = own_fail_level(options);
        return text("--fail-at", level ? std::string(cases::to_string(*level)) : std::string());
    }
    Words& expectations(const RunOptions& options) {
        flag("--no-expect", options.no_expect);
        for (const std::string& file : options.expect) {
            text("--expect", file);
        }
        return *this;
    }
    std::string line() const {
        std::string line;
        for (const std::string& word : words_) {
            line += (line.empty() ? "" : " ") + shell_quote(word);
        }
        return line;
    }

  private:
    std::vector<std::string> words_;
};

// How "NAME=VALUE" begins of the variables that a run records. The first ones change pictures, so
// they belong before a command that draws again.
constexpr std::array<std::string_view, 20> kRecorded = {
    // Drivers and layers for the loader, layers that are on without being named, other libraries.
    "VK_", "ENABLE_", "DISABLE_", "NODEVICE_", "LD_LIBRARY_", "LD_PRELOAD",
    // What drivers read: threads, width of vectors, versions.
    "LP_", "LVP_", "MESA_", "GALLIUM_", "LIBGL_", "SWIFTSHADER_", "EDGECASE_SELF_PREFIX=",
    // Faults on purpose, of the program and of the layers in tests/.
    "EDGECASE_FAULT=", "EDGECASE_BREAK=", "EDGECASE_DEVICE_CLASS=", "EDGECASE_PRETENDED",
    "EDGECASE_HOSTILE",
    // Options, which the line has; and what every session of a desktop sets.
    "EDGECASE_", "XDG_DATA_DIRS"};
constexpr size_t kOfPictures = 18;

// Those that are set, of the first `count`.
std::vector<std::pair<std::string, std::string>> variables(size_t count) {
    std::vector<std::pair<std::string, std::string>> recorded;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string_view text = *variable;
        const size_t equals = text.find('=');
        const auto begins = [&](std::string_view start) { return text.starts_with(start); };
        if (equals != text.npos && std::ranges::any_of(std::span(kRecorded).first(count), begins)) {
            recorded.emplace_back(text.substr(0, equals), text.substr(equals + 1));
        }
    }
    std::ranges::sort(recorded);
    return recorded;
}

// What is to be put before a command that draws again: "VK_DRIVER_FILES=a.json ".
std::string settings_before() {
    std::string text;
    for (const auto& [name, value] : variables(kOfPictures)) {
        text += name + "=" + shell_quote(value) + " ";
    }
    return text;
}

// The door through which a finding is seen and in no other picture; empty if there is none. What is
// written beside an attachment is told with the picture that did it.
std::string door_of(const diff::Finding& finding) {
    constexpr std::string_view kBefore = ", door ";
    const size_t at = finding.quantity.rfind(kBefore);
    return finding.rule == cases::rule::write_outside && at != std::string::npos
               ? finding.quantity.substr(at + kBefore.size())
               : finding.door;
}

}  // namespace

std::optional<cases::Profile> own_fail_level(const RunOptions& options) {
    return options.fail_at == options.profile ? std::nullopt : options.fail_at;
}

std::string settings_of(const RunOptions& options) {
    const RunOptions usual;
    return Words()
        .flag("--require-support", options.require_support)
        .flag("--strict", options.strict)
        .flag("--validation", options.device.validation)
        .fail_at(options)
        .text("--doors", options.doors)
        .text("--ways", options.ways)
        .number("--repeat", options.repeat, usual.repeat)
        .number("--retries", options.retries, usual.retries)
        .line();
}

std::string selector_of(const RunOptions& options, const std::string& id) {
    const size_t of_file = cases::split_way(id).base.size();
    const size_t end = std::min(id.find(':'), of_file);
    const std::string base = id.substr(0, end);
    const std::string leaf = id.substr(end);  // and the way
    std::vector<std::string> selectors = options.suite.selectors;
    if (!options.suite.carried.empty()) {
        selectors.push_back(options.suite.carried);
    }
    for (const std::string& words : selectors) {
        std::error_code ignored;
        const std::string selector(fs::exists(words, ignored) ? words
                                                              : cases::split_way(words).base);
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
        if (fs::is_regular_file(file, ignored)) {
            return file.string() + leaf;
        }
    }
    return id;
}

std::string rerun_line(const Program& program, const RunOptions& options, const std::string& id,
                       const Rerun& rerun) {
    Words words(program, {"run", selector_of(options, id)});
    words.suite_and_profile(options)
        .text("--device", options.device.device)
        .text("--icd", options.device.icd)
        .flag("--validation", options.device.validation)
        .text("--renderer", options.device.renderer)
        .text("--doors", rerun.doors)
        .number("--timeout", options.device.timeout, DeviceOptions().timeout)
        .fail_at(options)
        .flag("--require-support", options.require_support)
        .flag("--strict", options.strict)
        .expectations(options)
        .number("--repeat", std::max({options.repeat, rerun.repeats, 1U}), 1U);
    for (const std::string& other : rerun.with) {
        words.flag(selector_of(options, other).c_str(), true);
    }
    return settings_before() + words.line();
}

std::string diff_line(const Program& program, const DiffOptions& options, const std::string& id) {
    RunOptions named = options.run;
    named.suite.carried.clear();  // what the export carries is known by its id
    return Words(program, {"diff", selector_of(named, id), "--captures", options.captures})
        .text("--exported", options.exported)
        .suite_and_profile(options.run)
        .device(options.judged)
        .text("--name", options.name)
        .fail_at(options.run)
        .flag("--require-support", options.run.require_support)
        .expectations(options.run)
        .line();
}

std::string explain_line(const Program& program, const RunOptions& options,
                         const JudgedDevice& device, const cases::Case& c,
                         const CaseRecord& record) {
    if (record.outcome.findings.empty()) {
        return {};
    }
    return Words(program, {"explain", selector_of(options, record.id)})
               .suite_and_profile(options)
               .device(device)
               .line() +
           report::sample_options(report::leading_finding(record), c.target);
}

void add_command_lines(const Program& program, const RunOptions& options,
                       const JudgedDevice& device, const cases::Case& c, CaseRecord& record) {
    constexpr uint32_t kRepeatsOfDeath = 10;  // of a batch whose worker died once
    const bool died = record.status == Status::crash || record.status == Status::timeout ||
                      record.status == Status::device_lost;
    const bool is_flake = report::actual_status(record) == Status::flake;
    const bool is_wrong = !record.outcome.findings.empty();
    Rerun rerun;
    if (died || is_flake || !is_wrong || record.status == Status::improved) {
        rerun.doors = doors_words(options.doors, record.doors);
    } else {
        const auto news = report::leading_news(record);
        const std::string door = news ? news->door : door_of(report::leading_finding(record));
        const bool is_of_file = std::ranges::find(record.doors, door) == record.doors.end();
        rerun.doors = is_of_file ? "" : door;
    }
    if (is_flake) {
        rerun.with = record.death.suspects;
        std::erase(rerun.with, record.id);
        rerun.repeats = record.death.suspects.empty() ? record.drawn.attempts : kRepeatsOfDeath;
    }
    record.rerun = rerun_line(program, options, record.id, rerun);
    if (record.drawn.is_brief) {
        return;
    }
    record.commands.explain = explain_line(program, options, device, c, record);
    if (!died && !is_wrong) {
        return;
    }
    // The program draws the plain picture: what only doors show it would not.
    std::string& missing = record.commands.no_reproducer;
    const bool is_of_doors =
        !died && std::ranges::all_of(record.outcome.findings,
                                     [](const auto& f) { return !door_of(f).empty(); });
    missing = is_of_doors ? report::kDoorsAlone : undrawable_part(c);
    if (missing.empty()) {
        missing = may_be_too_large(c) ? "many values" : "";
        record.commands.reproducer =
            Words(program, {"export", "--reproducer", selector_of(options, record.id)})
                .suite_and_profile(options)
                .device(device)
                .text("-o", "repro.c")
                .line();
    }
}

std::vector<std::pair<std::string, std::string>> recorded_environment() {
    auto recorded = variables(kRecorded.size());
    std::error_code ignored;
    recorded.emplace_back("PWD", fs::current_path(ignored).string());
    return recorded;
}

}  // namespace cli
