// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/parse.hpp"

#include <algorithm>
#include <string_view>

#include "cases/select/selector.hpp"
#include "cli/options/value_checks.hpp"
#include "report/record/run.hpp"

namespace cli {

namespace {

std::vector<std::string> names_of_commands(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(command->get_name());
    }
    return names;
}

// An error for words that no option took.
Stop unknown_words(const CLI::App& command, const std::vector<std::string>& unknown) {
    for (const std::string& word : unknown) {
        if (word.size() > 1 && word.front() == '-') {
            std::vector<std::string> names;
            for (const CLI::Option* option : command.get_options()) {
                for (const std::string& name : option->get_lnames()) {
                    if (!option->get_group().empty()) {
                        names.push_back("--" + name);
                    }
                }
            }
            const std::string bare = word.substr(0, word.find('='));
            return usage_error("unknown option '" + bare + "'" + cases::did_you_mean(bare, names),
                               command.get_name());
        }
    }
    return usage_error("'" + unknown.front() + "' was not expected here", command.get_name());
}

// The sentence, which begins with the name of an option, about its variable if that was meant.
std::string name_variable(const std::string& text, const CLI::App& command, const Words& words) {
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_name() + ":";
        if (text.starts_with(name) && !option->get_envname().empty() && !is_given(*option, words)) {
            return option->get_envname() + text.substr(name.size() - 1);
        }
    }
    return text;
}

// What CLI11 says, as one sentence.
Stop parse_error(const CLI::ParseError& error, const CLI::App& app, const std::string& command,
                 const Words& words) {
    std::string text = error.what();
    std::ranges::replace(text, '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) {
        text.pop_back();
    }
    // "Could not convert: --shard = 0/3" says neither what is wrong nor where to look.
    constexpr std::string_view kConversion = "Could not convert: ";
    const size_t equals = text.find(" = ");
    if (text.starts_with(kConversion) && equals != std::string::npos) {
        const std::string name = text.substr(kConversion.size(), equals - kConversion.size());
        const CLI::Option* option =
            command.empty() ? nullptr : app.get_subcommand(command)->get_option_no_throw(name);
        const std::string form = option == nullptr ? "" : option->get_type_name();
        text = name + ": '" + text.substr(equals + 3) + "' is not a value that it takes" +
               (form.empty() ? "" : "; write " + form) +
               (form == "I/N"    ? " with 1 <= I <= N"
                : form == "TIME" ? " as seconds or like 90s, 10m or 2h"
                                 : "");
    }
    // "--seed: 1 required N missing"
    constexpr std::string_view kRequired = ": 1 required ", kMissing = " missing";
    if (const size_t at = text.find(kRequired);
        at != std::string::npos && text.ends_with(kMissing)) {
        const size_t begin = at + kRequired.size();
        text = text.substr(0, at) + " needs a value; write " + text.substr(0, at) + " " +
               text.substr(begin, text.size() - kMissing.size() - begin);
    }
    if (text.starts_with("CASE: At Most 1 ")) {
        text = "this command works on one case, and several are given; give the id of one";
    }
    if (!command.empty()) {
        text = name_variable(text, *app.get_subcommand(command), words);
    }
    return usage_error(text, command);
}

void check_loudness(const CLI::App& command) {
    for (const char* name : {"--quiet", "--verbose"}) {
        const CLI::Option* option = command.get_option_no_throw(name);
        if (option == nullptr || option->count() == 0) {
            return;
        }
    }
    throw Stop{report::kExitUsage, {"-q and -v contradict each other; leave one out"}};
}

constexpr const char* kSummary =
    "Edgecase: checks triangle rasterization of Vulkan drivers against an exact reference.";
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

}  // namespace

// An algorithm has no driver, so these would be ignored.
void check_device(const CLI::App& command, DeviceOptions& o, const Words& words) {
    for (const char* name : {"--device", "--icd"}) {
        if (!o.renderer.empty() && is_given(command, name, words)) {
            throw usage_error(std::string(name) + " chooses a driver, and '" + o.renderer +
                                  "' draws without one; leave out one of the two",
                              command.get_name());
        }
    }
    o.icd_from = is_given(command, "--icd", words) ? "--icd" : "EDGECASE_ICD";
}

// Of a level that is stricter than the profile nothing is known, so that no run would fail at it.
void check_fail_at(const CLI::App& command, const RunOptions& o) {
    if (!o.fail_at || *o.fail_at <= o.profile) {
        return;
    }
    const std::string level(cases::to_string(*o.fail_at)), profile(cases::to_string(o.profile));
    throw usage_error("--fail-at " + level + " is stricter than the profile " + profile +
                          ", at which nothing of that level is judged; write --fail-at " + profile +
                          " or --profile " + level,
                      command.get_name());
}

std::vector<Action> declare(CLI::App& app, std::span<const Command> commands) {
    app.footer(kFooter);
    app.set_help_flag("-h,--help", "this help");
    app.add_flag("--version")->description("print the version");
    app.require_subcommand(0, 1);
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    std::vector<Action> actions;
    for (const Command& command : commands) {
        CLI::App* const own = app.add_subcommand(command.help.name, command.help.text);
        actions.push_back(command.declare(*own));
        own->set_help_flag("-h,--help", "this help");
        if (const std::string_view examples =
                command.help.examples == nullptr ? std::string_view() : command.help.examples;
            command.help.examples != nullptr) {
            own->footer(examples.empty() ? "" : "Examples:\n" + std::string(examples));
        }
        own->group(command.help.group);
        own->allow_extras();  // so that unknown options get our own words
    }
    return actions;
}

CarryOut parse(std::span<const Command> commands, const Words& words) {
    CLI::App app(kSummary, "edgecase");
    const std::vector<Action> actions = declare(app, commands);
    const std::vector<std::string> names = names_of_commands(app);
    const std::string first = words.size() > 1 ? words[1] : "";
    const auto named = std::ranges::find(names, first);
    const bool is_command = named != names.end();
    if (first.empty()) {
        throw usage_error("a command is missing, for example 'edgecase run'", "");
    }
    if (!is_command && first.front() != '-') {
        const std::string hint = first == "help"    ? "; did you mean '--help'?"
                                 : first == "merge" ? "; did you mean 'report --merge'?"
                                                    : cases::did_you_mean(first, names);
        throw usage_error("unknown command '" + first + "'" + hint, "");
    }
    if (!is_command && first != "-h" && first != "--help" && first != "--version") {
        throw usage_error(
            "unknown option '" + first + "'" + cases::did_you_mean(first, {"--help", "--version"}),
            "");
    }
    std::vector<std::string> reversed(words.rbegin(), words.rend() - 1);  // as CLI11 wants them
    try {
        app.parse(reversed);
    } catch (const CLI::CallForHelp&) {
        const CLI::App* command = is_command ? app.get_subcommand(first) : &app;
        std::fputs((is_command ? command->help("edgecase") : app.help()).c_str(), stdout);
        return [](const Program&) { return int{report::kExitOk}; };
    } catch (const CLI::ParseError& error) {
        if (is_command) {
            check_empty_values(*app.get_subcommand(first), words);
        }
        throw parse_error(error, app, is_command ? first : "", words);
    }
    const auto chosen = is_command ? named : std::ranges::find(names, "version");
    const Action& action = actions.at(static_cast<size_t>(chosen - names.begin()));
    if (!is_command) {
        return action.carry_out;
    }
    CLI::App* command = app.get_subcommand(first);
    check_empty_values(*command, words);
    std::vector<std::string> unknown = command->remaining();
    if (const auto end = std::ranges::find(unknown, "--"); end != unknown.end()) {
        unknown.erase(end);  // it ends the options, and CLI11 keeps it
    }
    if (!unknown.empty()) {
        throw unknown_words(*command, unknown);
    }
    check_files(*command);
    check_loudness(*command);
    action.check(*command, words);
    return action.carry_out;
}

}  // namespace cli
