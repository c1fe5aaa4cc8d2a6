// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/parse.hpp"

#include <algorithm>
#include <variant>

#include "cases/base/regex.hpp"
#include "cases/select/selector.hpp"
#include "cli/options/command_options.hpp"
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
std::string name_variable(const std::string& text, const CLI::App& command,
                          const std::vector<std::string>& words) {
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
                 const std::vector<std::string>& words) {
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
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

// A resumed run has the options of the interrupted one, so others would be ignored.
OrStop<std::monostate> check_resume(const CLI::App& run, const std::vector<std::string>& words) {
    // The last four only repeat what the run began with (prepare_resume).
    const std::vector<std::string> may = {"--resume",   "--jobs", "--quiet", "--verbose", "--color",
                                          "--progress", "--icd",  "--json",  "--junit",   "--html"};
    for (const CLI::Option* option : run.get_options()) {
        const std::string name = option->get_name();
        const bool is_variable = !option->get_envname().empty() && !is_given(*option, words);
        if (option->count() > 0 && !is_variable &&
            std::find(may.begin(), may.end(), name) == may.end()) {
            const bool is_option = !name.empty() && name.front() == '-';
            return tl::unexpected(usage_error(
                "--resume goes on with the cases and options of the interrupted run, so " +
                    (is_option ? name + " cannot be given" : "no selector can be given") +
                    "; leave it out or start a new run",
                "run"));
        }
    }
    return std::monostate{};
}

// Of a level that is stricter than the profile nothing is known, so that no run would fail at it.
OrStop<std::monostate> check_fail_at(const RunOptions& o, const std::string& command) {
    if (!o.fail_at || *o.fail_at <= o.profile) {
        return std::monostate{};
    }
    const std::string level(cases::to_string(*o.fail_at)), profile(cases::to_string(o.profile));
    return tl::unexpected(
        usage_error("--fail-at " + level + " is stricter than the profile " + profile +
                        ", at which nothing of that level is judged; write --fail-at " + profile +
                        " or --profile " + level,
                    command));
}

OrStop<std::monostate> check_run(const CLI::App& run, const RunOptions& o,
                                 const std::vector<std::string>& words) {
    if (!o.resume.empty()) {
        if (auto checked = check_resume(run, words); !checked) {
            return checked;
        }
    }
    if (o.no_expect && !o.expect.empty()) {
        return tl::unexpected(usage_error("--expect and --no-expect exclude each other", "run"));
    }
    if (o.no_expect && o.strict) {
        return tl::unexpected(usage_error(
            "--strict asks how known failures look, and with --no-expect none is known; leave out "
            "one of the two",
            "run"));
    }
    if (auto checked = cases::check_regex(o.require_device); !checked) {
        return tl::unexpected(usage_error("--require-device: " + checked.error().message, "run"));
    }
    return std::monostate{};
}

// A hunt that goes on has the seed, shard and profile that it began with; where it ends, which
// device of that name draws and what else is known may be said anew.
OrStop<std::monostate> check_fuzz(const CLI::App& fuzz, const FuzzOptions& o,
                                  const std::vector<std::string>& words) {
    const auto refused = [](const std::string& what) {
        return tl::unexpected(usage_error(
            "--resume goes on with the cases, seed, shard, profile and folder of the hunt, so " +
                what + (what.starts_with("no ") ? " can" : " cannot") +
                " be given; leave it out or start a new hunt",
            "fuzz"));
    };
    for (const char* name : {"--seed", "--shard", "--profile", "--output", "--print", "--suite"}) {
        if (!o.run.resume.empty() && is_given(fuzz, name, words)) {
            return refused(name);
        }
    }
    if (!o.run.resume.empty() && !o.run.suite.selectors.empty()) {
        return refused("no selector");
    }
    if (o.run.no_expect && !o.run.expect.empty()) {
        return tl::unexpected(usage_error("--expect and --no-expect exclude each other", "fuzz"));
    }
    return std::monostate{};
}

// A command takes the place of a device.
OrStop<std::monostate> check_reduce(const CLI::App& reduce, const ReduceOptions& o,
                                    const std::vector<std::string>& words) {
    const auto refused = [](const std::string& sentence) {
        return tl::unexpected(usage_error(sentence, "reduce"));
    };
    if (!is_given(reduce, "--captures-command", words)) {
        for (const std::string name : {"--subpixel-bits", "--sample-locations"}) {
            if (is_given(reduce, name.c_str(), words)) {
                return refused(name +
                               " is for a renderer that --captures-command starts; devices tell it "
                               "themselves");
            }
        }
        return std::monostate{};
    }
    for (const char* name : {"--device", "--icd", "--renderer", "--validation"}) {
        if (is_given(reduce, name, words)) {
            return refused(std::string(name) +
                           " chooses a device, and --captures-command draws without one; leave one "
                           "of them out");
        }
    }
    for (const char* word : {"%in", "%out"}) {
        if (o.captures_command.find(word) == std::string::npos) {
            return refused(std::string("--captures-command has no ") + word +
                           ", the folder of the " +
                           (word[1] == 'i' ? "exported cases" : "captures") +
                           "; write for example 'my-renderer %in %out'");
        }
    }
    return std::monostate{};
}

OrStop<std::monostate> check_expect(const CLI::App& expect, const ExpectOptions& o,
                                    const std::vector<std::string>& words) {
    for (const char* name : {"--bits", "--bug", "--reason", "--until", "--dry-run"}) {
        if (o.update.empty() && is_given(expect, name, words)) {
            return tl::unexpected(usage_error(
                std::string(name) + " says how a file is brought up to date; give --update too",
                "expect"));
        }
    }
    return std::monostate{};
}

OrStop<std::monostate> check_loudness(const CLI::App& command) {
    for (const char* name : {"--quiet", "--verbose"}) {
        const CLI::Option* option = command.get_option_no_throw(name);
        if (option == nullptr || option->count() == 0) {
            return std::monostate{};
        }
    }
    return tl::unexpected(
        Stop{report::kExitUsage, {"-q and -v contradict each other; leave one out"}});
}

// An algorithm has no driver, so these would be ignored.
OrStop<std::monostate> check_device(const CLI::App& command, DeviceOptions& o,
                                    const std::vector<std::string>& words) {
    for (const char* name : {"--device", "--icd"}) {
        if (!o.renderer.empty() && is_given(command, name, words)) {
            return tl::unexpected(usage_error(std::string(name) + " chooses a driver, and '" +
                                                  o.renderer +
                                                  "' draws without one; leave out one of the two",
                                              command.get_name()));
        }
    }
    o.icd_from = is_given(command, "--icd", words) ? "--icd" : "EDGECASE_ICD";
    return std::monostate{};
}

OrStop<std::monostate> check_explain(const ExplainOptions& o) {
    if (o.rule.empty() && !o.has_pixel && (o.sample > 0 || o.layer > 0)) {
        return tl::unexpected(
            usage_error("--sample and --layer name a sample of a pixel; add --pixel", "explain"));
    }
    if (!o.rule.empty() && (o.has_pixel || !o.suite.selectors.empty())) {
        return tl::unexpected(usage_error(
            "--rule explains a rule, not a case; leave out the selector and --pixel", "explain"));
    }
    return std::monostate{};
}

}  // namespace

OrStop<std::string> parse(CLI::App& app, AllOptions& all, std::vector<std::string> words) {
    define(app, all);
    const std::vector<std::string> commands = names_of_commands(app);
    const std::string first = words.size() > 1 ? words[1] : "";
    const bool is_command = std::find(commands.begin(), commands.end(), first) != commands.end();
    if (first.empty()) {
        return tl::unexpected(usage_error("a command is missing, for example 'edgecase run'", ""));
    }
    if (!is_command && first.front() != '-') {
        const std::string hint = first == "help"    ? "; did you mean '--help'?"
                                 : first == "merge" ? "; did you mean 'report --merge'?"
                                                    : cases::did_you_mean(first, commands);
        return tl::unexpected(usage_error("unknown command '" + first + "'" + hint, ""));
    }
    if (!is_command && first != "-h" && first != "--help" && first != "--version") {
        return tl::unexpected(usage_error(
            "unknown option '" + first + "'" + cases::did_you_mean(first, {"--help", "--version"}),
            ""));
    }
    std::vector<std::string> reversed(words.rbegin(), words.rend() - 1);  // as CLI11 wants them
    try {
        app.parse(reversed);
    } catch (const CLI::CallForHelp&) {
        const CLI::App* command = is_command ? app.get_subcommand(first) : &app;
        std::fputs((is_command ? command->help("edgecase") : app.help()).c_str(), stdout);
        return std::string("help");
    } catch (const CLI::ParseError& error) {
        if (is_command) {
            if (auto checked = check_empty_values(*app.get_subcommand(first), words); !checked) {
                return tl::unexpected(checked.error());
            }
        }
        return tl::unexpected(parse_error(error, app, is_command ? first : "", words));
    }
    if (!is_command) {
        return std::string("version");
    }
    CLI::App* command = app.get_subcommand(first);
    if (const auto checked = check_empty_values(*command, words); !checked) {
        return tl::unexpected(checked.error());
    }
    std::vector<std::string> unknown = command->remaining();
    if (const auto end = std::find(unknown.begin(), unknown.end(), "--"); end != unknown.end()) {
        unknown.erase(end);  // it ends the options, and CLI11 keeps it
    }
    if (!unknown.empty()) {
        return tl::unexpected(unknown_words(*command, unknown));
    }
    for (const auto& check : {check_alternatives, check_files}) {
        if (const auto checked = check(*command); !checked) {
            return tl::unexpected(checked.error());
        }
    }
    if (first == "explain") {
        if (const auto checked = check_explain(all.explain); !checked) {
            return tl::unexpected(checked.error());
        }
    }
    for (const auto& [name, device] :
         {std::pair("run", &all.run.device), std::pair("gtest", &all.gtest.run.device),
          std::pair("fuzz", &all.fuzz.run.device), std::pair("reduce", &all.reduce.run.device),
          std::pair("doctor", &all.doctor.device), std::pair("bench", &all.bench.device),
          std::pair("probe", &all.probe.device)}) {
        if (first == name) {
            if (const auto checked = check_device(*command, *device, words); !checked) {
                return tl::unexpected(checked.error());
            }
        }
    }
    OrStop<std::monostate> checked = check_loudness(*command);
    if (checked && first == "run") {
        checked = check_run(*command, all.run, words);
        checked = checked ? check_fail_at(all.run, first) : checked;
    } else if (checked && first == "gtest") {
        checked = check_fail_at(all.gtest.run, first);
    } else if (checked && first == "diff") {
        checked = check_fail_at(all.diff.run, first);
    } else if (checked && first == "fuzz") {
        checked = check_fuzz(*command, all.fuzz, words);
    } else if (checked && first == "reduce") {
        checked = check_reduce(*command, all.reduce, words);
    } else if (checked && first == "expect") {
        checked = check_expect(*command, all.expect, words);
    }
    if (!checked) {
        return tl::unexpected(checked.error());
    }
    return first;
}

OrStop<RunOptions> parse_run_arguments(const std::vector<std::string>& arguments) {
    CLI::App app("", "edgecase");
    AllOptions all;
    const OrStop<std::string> command = parse(app, all, arguments);
    if (!command) {
        return tl::unexpected(command.error());
    }
    if (*command != "run") {
        return tl::unexpected(
            Stop{report::kExitInvalidFile, {"the journal's command line is not one of 'run'"}});
    }
    return all.run;
}

}  // namespace cli
