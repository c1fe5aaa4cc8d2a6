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
    return program;
}

std::vector<std::string> worker_command(const Program& program) {
    std::vector<std::string> words;
    if (const char* prefix = std::getenv("EDGECASE_SELF_PREFIX"); prefix != nullptr) {
        std::istringstream in(prefix);
        for (std::string word; in >> word;) {
            words.push_back(word);
        }
    }
    words.push_back(program.path);
    words.emplace_back("worker");
    return words;
}

std::string shell_quote(const std::string& word) {
    constexpr const char* kHarmless =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:=,+@%^";
    if (!word.empty() && word.find_first_not_of(kHarmless) == std::string::npos) {
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
