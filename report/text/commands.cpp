// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/text/commands.hpp"

#include <algorithm>
#include <cstddef>

namespace report {

namespace {

constexpr std::string_view kNameLetters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";

// Where the shell's word ends that begins at `at`.
size_t word_end(std::string_view text, size_t at) {
    bool is_quoted = false;
    for (; at < text.size() && (is_quoted || text[at] != ' '); ++at) {
        if (text[at] == '\'') {
            is_quoted = !is_quoted;
        } else if (text[at] == '\\' && !is_quoted) {
            ++at;
        }
    }
    return std::min(at, text.size());
}

}  // namespace

std::string_view settings_of(std::string_view command) {
    size_t end = 0;
    while (true) {
        const size_t equals = command.find_first_not_of(kNameLetters, end);
        if (equals == std::string_view::npos || equals == end || command[equals] != '=') {
            break;
        }
        const size_t after = word_end(command, equals);
        if (after == command.size()) {
            break;  // no program follows
        }
        end = after + 1;
    }
    return command.substr(0, end);
}

std::string rerun_of(const Cause& cause) {
    const CaseRecord& record = smallest_case(cause);
    std::string line = record.rerun, door = cause.door;
    // The doors of a rule share a cause where the plain picture is wrong, too: any of them shows
    // it.
    for (const diff::FindingGroup& group : record.outcome.groups) {
        door = door.empty() && group.rule == cause.rule ? group.door : door;
    }
    if (door.empty() || line.empty()) {
        return line;
    }
    constexpr std::string_view kOption = " --doors ";
    if (const size_t at = line.find(kOption); at != std::string::npos) {
        line.erase(at, word_end(line, at + kOption.size()) - at);
    }
    return line + std::string(kOption) + door;
}

std::string debug_line(const CaseRecord& record) {
    const bool died = record.status == Status::crash || record.status == Status::timeout;
    return died && !record.rerun.empty() ? record.rerun + " --debugger gdb" : std::string();
}

}  // namespace report
