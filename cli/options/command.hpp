// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A command of the program as its file gives it: what help says of it, its options, what is checked
// of them, and what it does.
#pragma once

#include <functional>
#include <memory>

#include "cli/options/options.hpp"
#include "cli/options/value_checks.hpp"

namespace cli {

struct Program;

// The groups of 'edgecase --help'.
inline constexpr const char* kChecking = "Checking a device";
inline constexpr const char* kCases = "Cases";
inline constexpr const char* kElsewhere = "Renderers elsewhere";
inline constexpr const char* kProgram = "The program";

struct Help {
    const char* name;
    const char* group;
    const char* text;      // what it does, a part of a sentence
    const char* examples;  // what its help ends with; nullptr: what the program's ends with
};

// What is left to be done once the words are parsed. Both throw the Stop of a command that cannot
// go on.
struct Action {
    std::function<void(const CLI::App&, const Words&)> check;
    std::function<int(const Program&)> carry_out;  // an exit code of report/record/run.hpp
};

struct Command {
    Help help;
    std::function<Action(CLI::App&)> declare;  // the options
};

// Checks what options mean beside each other that several commands have.
void check_device(const CLI::App& command, DeviceOptions& o, const Words& words);
void check_fail_at(const CLI::App& command, const RunOptions& o);

// A command with such options. `check` may be left out.
template <class Options>
Command make_command(Help help, void (*declare)(CLI::App&, Options&),
                     int (*carry_out)(const Program&, const Options&),
                     void (*check)(const CLI::App&, const Options&, const Words&) = nullptr) {
    return {help, [=](CLI::App& app) {
                const auto o = std::make_shared<Options>();
                declare(app, *o);
                const auto check_all = [=](const CLI::App& command, const Words& words) {
                    if constexpr (requires { o->device; }) {
                        check_device(command, o->device, words);
                    } else if constexpr (requires { o->run.device; }) {
                        check_device(command, o->run.device, words);
                    }
                    if (check != nullptr) {
                        check(command, *o, words);
                    }
                };
                return Action{check_all,
                              [=](const Program& program) { return carry_out(program, *o); }};
            }};
}

// A command without options.
inline Command make_command(Help help, int (*carry_out)(const Program&)) {
    return {help, [=](CLI::App&) { return Action{[](const auto&, const auto&) {}, carry_out}; }};
}

}  // namespace cli
