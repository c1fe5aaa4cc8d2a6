// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints docs/rules.md: every rule, where the specification has it, the code that decides it, and
// the case files that exercise it.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "cases/loader.hpp"
#include "cases/rule.hpp"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: generate_rules_page SUITE\n", stderr);
        return 2;
    }
    const cases::Suite suite = cases::load_suite(argv[1]);
    for (const cases::Error& error : suite.errors) {
        std::fputs((to_string(error) + "\n").c_str(), stderr);
    }
    if (!suite.errors.empty()) {
        return 3;
    }
    std::map<std::string, std::set<std::string>> files_of_rule;
    std::map<std::string, size_t> leaves_of_rule;
    for (const cases::Case& c : suite.cases) {
        for (const std::string& rule : c.rules) {
            files_of_rule[rule].insert(c.id.substr(0, c.id.find(':')));
            ++leaves_of_rule[rule];
        }
    }
    fmt::print(
        "# The rules\n\n"
        "Generated from `cases/rule.cpp` and the suite by `scripts/generate-docs`; do not edit.\n\n"
        "The profile is the loosest one at which breaking the rule is a finding: `vulkan` is what "
        "the Vulkan "
        "text forbids, `practice` adds floor/ceil snapping and binary32-like arithmetic, "
        "`direct3d` adds what "
        "Direct3D 11 writes down and nearly all devices do. Only a finding at `vulkan` says that a "
        "device is "
        "not conformant.\n\n"
        "| rule | profile | demands | leaves |\n| --- | --- | --- | --- |\n");
    for (const cases::Rule& rule : cases::all_rules()) {
        fmt::print(
            "| [`{}`](#{}) | {} | {} | {} |\n", rule.id,
            [&] {
                std::string anchor(rule.id);
                anchor.erase(std::remove(anchor.begin(), anchor.end(), '.'), anchor.end());
                return anchor;
            }(),
            to_string(rule.profile), rule.title, leaves_of_rule[std::string(rule.id)]);
    }
    for (const cases::Rule& rule : cases::all_rules()) {
        fmt::print("\n## {}\n{}. {}\n\n", rule.id, rule.title, rule.text);
        if (!rule.anchor.empty()) {
            fmt::print(
                "* Vulkan: "
                "[{0}](https://registry.khronos.org/vulkan/specs/latest/html/vkspec.html#{0})\n",
                rule.anchor);
        }
        if (!rule.direct3d.empty()) {
            fmt::print("* Direct3D 11.3 functional specification: section {}\n", rule.direct3d);
        }
        fmt::print("* Decided in: `{}`\n* Cases:", rule.code);
        const auto& files = files_of_rule[std::string(rule.id)];
        for (const std::string& file : files) {
            fmt::print(" `{}`", file);
        }
        fmt::print("{}\n",
                   files.empty() ? " none; it is found by the comparison in every case" : "");
    }
    return 0;
}
