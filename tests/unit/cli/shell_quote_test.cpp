// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Words that are printed for a shell mean themselves to it, whatever is in them.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "cli/options/program.hpp"

namespace cli {
namespace {

// What a command of a shell prints; nothing if there is no such shell.
std::optional<std::string> said(const std::string& shell, const std::string& script) {
    std::string name = testing::TempDir() + "edgecase-quote-XXXXXX";
    const int fd = ::mkstemp(name.data());
    EXPECT_GE(fd, 0);
    EXPECT_EQ(::write(fd, script.data(), script.size()), static_cast<ssize_t>(script.size()));
    ::close(fd);
    std::string text;
    std::FILE* pipe = ::popen((shell + " " + name + " 2>/dev/null").c_str(), "r");
    std::array<char, 4096> part{};
    for (size_t n = 0; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;) {
        text.append(part.data(), n);
    }
    const int status = ::pclose(pipe);
    ::unlink(name.c_str());
    constexpr int kNotFound = 127;
    return WEXITSTATUS(status) == kNotFound ? std::nullopt : std::optional(text);
}

TEST(ShellQuote, AnyWordMeansItselfToAnyShell) {
    std::vector<std::string> words = {
        "",    "=ls",   "~",  "-n", "a b",  "$(ls)", "`ls`", "'",   "''",   "\"", "a\nb",   "*",
        "[a]", "{a,b}", "!x", "#",  "a\\b", "%in",   "x=~",  "a;b", "a&&b", ">x", "\x1b[m", "\xff"};
    std::mt19937 random(1);
    std::uniform_int_distribution<int> length(0, 12), any(1, 255);
    const std::string hurtful = "'\"\\$`!*?[]{}()<>|&;#~=%^ \n\t-ab/.:,@+";
    std::uniform_int_distribution<size_t> one(0, hurtful.size() - 1);
    while (words.size() < 3000) {
        std::string word;
        for (int k = length(random); k > 0; --k) {
            word += words.size() % 2 == 0 ? hurtful[one(random)] : static_cast<char>(any(random));
        }
        words.push_back(word);
    }
    std::string expected;
    std::string script = "printf '%s\\0' --";
    for (const std::string& word : words) {
        script += " " + shell_quote(word);
        expected += word + '\0';
    }
    size_t shells = 0;
    for (const char* shell : {"sh", "bash", "zsh -f"}) {
        if (const std::optional<std::string> text = said(shell, script + "\n")) {
            EXPECT_EQ(*text, std::string("--") + '\0' + expected) << shell;
            ++shells;
        }
    }
    EXPECT_GE(shells, 2U);
}

}  // namespace
}  // namespace cli
