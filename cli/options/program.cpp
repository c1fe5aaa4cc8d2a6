// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/program.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace cli {

namespace fs = std::filesystem;

namespace {

std::string find_program(const std::string& name) {
    std::error_code ignored;
    if (name.find('/') == std::string::npos) {
        const char* path = std::getenv("PATH");
        std::istringstream folders(path != nullptr ? path : "/usr/bin:/bin");
        for (std::string folder; std::getline(folders, folder, ':');) {
            const fs::path candidate = fs::path(folder.empty() ? "." : folder) / name;
            if (::access(candidate.c_str(), X_OK) == 0 && fs::is_regular_file(candidate, ignored)) {
                return fs::absolute(candidate, ignored).lexically_normal().string();
            }
        }
    }
    return fs::absolute(name, ignored).lexically_normal().string();
}

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) {
        words.push_back(word);
    }
    return words;
}

}  // namespace

const char* const kVersion = EDGECASE_VERSION;

Program make_program(int argc, const char* const* argv) {
    Program program;
    for (int k = 0; k < argc; ++k) {
        program.arguments.emplace_back(argv[k]);
    }
    if (program.arguments.empty()) {
        program.arguments.emplace_back("edgecase");
    }
    program.path = find_program(program.arguments.front());
    std::error_code none;
    const std::string found = find_program("edgecase");  // in the working directory if nowhere
    const bool is_found =
        found != fs::absolute("edgecase", none) && fs::equivalent(found, program.path, none);
    program.called = is_found ? "edgecase" : program.arguments.front();
    return program;
}

run::Command worker_command(const Program& program) {
    const char* const prefix = std::getenv("EDGECASE_SELF_PREFIX");
    run::Command command;
    command.words = words_of(prefix != nullptr ? prefix : "");
    command.words.push_back(program.path);
    command.words.emplace_back("worker");
    return command;
}

cases::Expected<run::Command> debugged_worker_command(const Program& program,
                                                      const std::string& debugger) {
    run::Command command;
    command.keeps_terminal = true;
    command.words = words_of(debugger);
    const std::string name = command.words.empty() ? std::string() : command.words.front();
    const std::string path = find_program(name);
    if (name.empty() || ::access(path.c_str(), X_OK) != 0) {
        return cases::failure(
            "--debugger: there is no program '{}'; install it, or name another one", name);
    }
    command.words.front() = path;
    if (command.words.size() == 1) {
        const std::string file = fs::path(path).filename().string();
        const std::vector<std::string> starts =
            file == "gdb"    ? std::vector<std::string>{"-q", "-ex", "run", "--args"}
            : file == "lldb" ? std::vector<std::string>{"-o", "run", "--"}
                             : std::vector<std::string>{};
        command.words.insert(command.words.end(), starts.begin(), starts.end());
    }
    const std::vector<std::string> worker = worker_command(program).words;
    command.words.insert(command.words.end(), worker.begin(), worker.end());
    return command;
}

std::string shell_quote(const std::string& word) {
    constexpr const char* kHarmless =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:=,+@%^";
    // zsh takes "=ls" for the path of ls.
    if (!word.empty() && word.front() != '=' &&
        word.find_first_not_of(kHarmless) == std::string::npos) {
        return word;
    }
    std::string quoted = "'";
    for (const char c : word) {
        if (c == '\'') {
            quoted += "'\\''";
        } else {
            quoted += c;
        }
    }
    return quoted + "'";
}

}  // namespace cli
