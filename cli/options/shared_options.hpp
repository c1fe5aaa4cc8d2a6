// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Options that several commands share, and checks of their values.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "cases/select/selector.hpp"
#include "cli/options/options.hpp"

namespace cli {

// An option of a group of the help, whose value is shown as `type`.
template <class T>
CLI::Option* add_value(CLI::App* app, const std::string& name, T& target, const std::string& what,
                       const std::string& type, const std::string& group) {
    return app->add_option(name, target, what)->type_name(type)->group(group);
}

// An option whose value is one of a few words, or another that `takes_other` takes.
template <class T>
CLI::Option* add_choice(CLI::App* app, const std::string& name, T& target,
                        const std::map<std::string, T>& names, const std::string& what,
                        bool (*takes_other)(const std::string& word, T& target) = nullptr) {
    std::vector<std::string> words;
    for (const auto& [word, value] : names) {
        words.push_back(word);
    }
    const auto parse = [&target, &names, words, name, takes_other](const CLI::results_t& results) {
        const auto found = names.find(results.back());
        if (found == names.end()) {
            if (takes_other != nullptr && takes_other(results.back(), target)) {
                return true;
            }
            throw CLI::ValidationError(
                name, fmt::format("'{}' is none of {}{}", results.back(), fmt::join(words, ", "),
                                  cases::did_you_mean(results.back(), words)));
        }
        target = found->second;
        return true;
    };
    std::string initial;
    for (const auto& [word, value] : names) {
        if (value == target) {
            initial = word;
        }
    }
    return app->add_option(name, parse, initial.empty() ? what : what + " [" + initial + "]")
        ->type_name(fmt::format("{}", fmt::join(words, "|")));
}

// Refuses what is no number of the range, in our own words.
template <class T>
CLI::Validator in_range(T least, T most) {
    return {[least, most](const std::string& text) {
                T value{};
                const auto [end, error] =
                    std::from_chars(text.data(), text.data() + text.size(), value);
                const bool is_number = error == std::errc() && end == text.data() + text.size();
                if (is_number && value >= least && value <= most) {
                    return std::string();
                }
                return fmt::format("'{}' is no {} from {} to {}", text,
                                   std::is_integral_v<T> ? "whole number" : "number", least, most);
            },
            ""};
}

// "A<separator>B"
bool parse_pair(const std::string& text, char separator, uint32_t& a, uint32_t& b);

// What --color takes.
const std::map<std::string, When>& when_names();
// What --renderer takes; the options keep a reference to it.
const std::map<std::string, std::string>& renderer_names();
// Whether it is one with choices: "software:ties=top-right".
bool takes_choices(const std::string& words, std::string& renderer);

void add_suite_folder(CLI::App* app, SuiteOptions& o);
void add_suite(CLI::App* app, SuiteOptions& o);
// For commands that work on one case.
void add_case(CLI::App* app, SuiteOptions& o);
void add_profile(CLI::App* app, cases::Profile& profile);
void add_fail_at(CLI::App* app, std::optional<cases::Profile>& level);
void add_judged_device(CLI::App* app, JudgedDevice& device);
void add_device(CLI::App* app, DeviceOptions& o);
void add_terminal(CLI::App* app, bool& quiet, bool& verbose, When& color);
void add_report_files(CLI::App* app, std::string& json, std::string& junit, std::string& html);
void add_ci(CLI::App* app, Ci& ci);
// The expectation files; with a way to have none.
void add_expect(CLI::App* app, RunOptions& o, const char* what);
void add_expectations(CLI::App* app, RunOptions& o);
// The folder of reports, and what is told of a run on the way.
void add_outputs(CLI::App* app, RunOptions& o, const char* folder, bool tells_ci);
void add_shard(CLI::App* app, Shard& shard, const char* what);
void add_require_support(CLI::App* to, RunOptions& o, const std::string& who);
void add_jobs(CLI::App* app, RunOptions& o);
void add_validation(CLI::App* app, DeviceOptions& o);

}  // namespace cli
