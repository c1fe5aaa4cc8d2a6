// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints docs/rules.md: every statement of the specifications, every rule, where the specification
// has it, the code that decides it, and the case files that exercise it.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "cases/load/loader.hpp"
#include "cases/model/rule.hpp"
#include "cases/statement/statement.hpp"
#include "ref/exercise/exercise.hpp"
#include "tests/docs/wrapped.hpp"

namespace {

using LeavesOfRule = std::map<std::string, size_t>;

std::string link_to(std::string_view rule) {
    std::string anchor(rule);
    anchor.erase(std::remove(anchor.begin(), anchor.end(), '.'), anchor.end());
    return fmt::format("[`{}`](#{})", rule, anchor);
}

// Whether the file that a rule names as the one that decides it is in the source tree.
bool code_is_there(const cases::Rule& rule, const std::filesystem::path& source) {
    const bool is_there = std::filesystem::exists(source / rule.code);
    if (!is_there) {
        fmt::print(stderr, "error: the rule {} is decided in {}, which does not exist\n", rule.id,
                   rule.code);
    }
    return is_there;
}

// The table of statements; false if one of them is judged by no case and does not say why, or if
// no statement names some rule.
bool print_statements(const LeavesOfRule& leaves) {
    bool is_complete = true;
    std::set<std::string_view> named;
    fmt::print(
        "\n## What the specifications say\n\n{}\n"
        "| statement | Vulkan | Direct3D | a finding from | how it is judged | rules | "
        "reference code |\n"
        "| --- | --- | --- | --- | --- | --- | --- |\n",
        wrapped(
            "The table has every statement of Vulkan 1.4 and Direct3D 11.3 on filled triangles, "
            "how strict it is, and what holds a device to it. *exact* means that there is one "
            "answer a sample; *tolerance* that the text states a bound; *free* that the device "
            "chooses among several answers; *undefined* that any value is right as long as "
            "nothing else is harmed; *unclear* that the text contradicts itself or is silent."));
    for (const cases::Statement& statement : cases::all_statements()) {
        std::string rules, code;
        cases::Profile profile = cases::Profile::direct3d;
        for (const std::string_view id : statement.rules) {
            if (id.empty()) {
                continue;
            }
            const cases::Rule* rule = cases::find_rule(id);
            const auto count = leaves.find(std::string(id));
            const bool is_met =
                count != leaves.end() || id == "write.consistent" || cases::is_of_device(id);
            if (rule == nullptr || !is_met) {
                fmt::print(stderr, "error: statement '{}' names the rule {}, which {}\n",
                           statement.topic, id, rule == nullptr ? "does not exist" : "has no case");
                is_complete = false;
                continue;
            }
            named.insert(rule->id);
            profile = std::min(profile, rule->profile);
            rules += (rules.empty() ? "" : " ") + link_to(id);
            const std::string file = fmt::format("`{}`", rule->code);
            if (code.find(file) == std::string::npos) {
                code += (code.empty() ? "" : " ") + file;
            }
        }
        if (rules.empty() && statement.reason.empty()) {
            fmt::print(stderr, "error: statement '{}' has neither a rule nor a reason\n",
                       statement.topic);
            is_complete = false;
        }
        fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", statement.topic,
                   to_string(statement.vulkan), to_string(statement.direct3d),
                   rules.empty() ? "not judged" : to_string(statement.from.value_or(profile)),
                   rules.empty() ? statement.reason : statement.judged, rules, code);
        if (statement.from && *statement.from <= profile) {
            fmt::print(stderr,
                       "error: statement '{}' is a finding from {} on by its rules already\n",
                       statement.topic, to_string(profile));
            is_complete = false;
        }
    }
    for (const cases::Rule& rule : cases::all_rules()) {
        if (named.count(rule.id) == 0) {
            fmt::print(stderr, "error: no statement names the rule {}\n", rule.id);
            is_complete = false;
        }
    }
    return is_complete;
}

}  // namespace

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
        for (const std::string& rule : c.claim.rules) {
            files_of_rule[rule].insert(c.id.substr(0, c.id.find(':')));
            ++leaves_of_rule[rule];
        }
    }
    fmt::print(
        "# The rules\n\n"
        "Generated from `cases/model/rule.cpp` and the suite by `scripts/generate-docs`; do not "
        "edit.\n\n"
        "{}\n| rule | profile | demands | leaves |\n| --- | --- | --- | --- |\n",
        wrapped(
            "The profile is the loosest one at which breaking the rule is a finding: `vulkan` is "
            "what the Vulkan text forbids, `practice` adds floor/ceil snapping and "
            "binary32-like arithmetic, `direct3d` adds what Direct3D 11 writes down and nearly "
            "all devices do. Only a finding at `vulkan` says that a device is not conformant. "
            "\"Exercised by\" tells where a case tests a rule: where a device that is wrong about "
            "it in one of the ways named would have a finding. `edgecase lint` looks for such a "
            "sample for each rule that a case claims (`ref/exercise/exercise_table.cpp`)."));
    for (const cases::Rule& rule : cases::all_rules()) {
        fmt::print("| {} | {} | {} | {} |\n", link_to(rule.id), to_string(rule.profile), rule.title,
                   leaves_of_rule[std::string(rule.id)]);
    }
    bool is_complete = print_statements(leaves_of_rule);
    const std::filesystem::path suite_folder = argv[1];
    for (const cases::Rule& rule : cases::all_rules()) {
        is_complete &= code_is_there(rule, suite_folder.parent_path().parent_path());
        fmt::print("\n## {}\n{}\n", rule.id, wrapped(fmt::format("{}. {}", rule.title, rule.text)));
        if (!rule.anchor.empty()) {
            fmt::print(
                "* Vulkan: "
                "[{0}](https://registry.khronos.org/vulkan/specs/latest/html/vkspec.html#{0})\n",
                rule.anchor);
        }
        if (!rule.direct3d.empty()) {
            fmt::print("* Direct3D 11.3 functional specification: section {}\n", rule.direct3d);
        }
        if (cases::is_of_device(rule.id)) {
            fmt::print("* Decided in: `{}`, of the device itself; no case claims it\n", rule.code);
            continue;
        }
        fmt::print(
            "{}",
            wrapped(fmt::format("* Exercised by a sample {}", ref::exercise_of(rule.id)), "  "));
        std::string cases = "* Cases:";
        for (const std::string& file : files_of_rule[std::string(rule.id)]) {
            cases += " `" + file + "`";
        }
        if (cases.ends_with(':')) {
            cases += " none; it is found by the comparison in every case";
        }
        fmt::print("* Decided in: `{}`\n{}", rule.code, wrapped(cases, "  "));
    }
    return is_complete ? 0 : 3;
}
