// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/expected/expected_cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "cases/model/door.hpp"
#include "cases/model/rule.hpp"
#include "cases/model/rule_ids.hpp"
#include "cases/select/selector.hpp"

namespace run {

using diff::FindingGroup;
using diff::FindingKind;

namespace {

constexpr std::string_view kUntold = "-";  // the rule of findings that were counted only

auto key_of(const FindingGroup& group) {
    return std::tie(group.kind, group.rule, group.door, group.level);
}

const FindingGroup* find_like(const ExpectedCause& cause, const FindingGroup& group) {
    const auto at =
        std::find_if(cause.groups.begin(), cause.groups.end(),
                     [&](const FindingGroup& other) { return key_of(other) == key_of(group); });
    return at == cause.groups.end() ? nullptr : &*at;
}

void insert(ExpectedCause& cause, const FindingGroup& group) {
    const auto at = std::lower_bound(
        cause.groups.begin(), cause.groups.end(), group,
        [](const FindingGroup& a, const FindingGroup& b) { return key_of(a) < key_of(b); });
    if (at != cause.groups.end() && key_of(*at) == key_of(group)) {
        at->count = std::max(at->count, group.count);
    } else {
        cause.groups.insert(at, {group.kind, group.rule, group.level, group.count, 0, group.door});
    }
}

void sort_bits(std::vector<std::string>& bits) {
    std::sort(bits.begin(), bits.end());
    bits.erase(std::unique(bits.begin(), bits.end()), bits.end());
}

bool knows_bits(const ExpectedCause& cause, const std::string& bits) {
    return std::binary_search(cause.bits.begin(), cause.bits.end(), bits);
}

std::optional<FindingKind> parse_kind(std::string_view word) {
    for (size_t k = 0; k < diff::kFindingKinds; ++k) {
        if (word == diff::to_string(static_cast<FindingKind>(k))) {
            return static_cast<FindingKind>(k);
        }
    }
    return std::nullopt;
}

constexpr std::string_view kBits = "bits=";

// The words "signal=" and "step=", and what they set.
constexpr std::array<std::pair<std::string_view, std::string ExpectedCause::*>, 2> kTexts = {{
    {"signal=", &ExpectedCause::signal},
    {"step=", &ExpectedCause::step},
}};

cases::Expected<void> add_text(std::string& to, std::string_view word, std::string_view value) {
    if (value.empty() || !to.empty()) {
        return cases::failure("'{}' {}", word,
                              value.empty() ? "has no value" : "stands beside another one");
    }
    to = value;
    return {};
}

// "0123456789abcdef,fedcba9876543210" of a word.
cases::Expected<void> add_bits(std::vector<std::string>& to, std::string_view word) {
    std::string_view rest = word.substr(kBits.size());
    do {
        const size_t comma = std::min(rest.find(','), rest.size());
        const std::string_view bits = rest.substr(0, comma);
        if (bits.size() != 16 || bits.find_first_not_of("0123456789abcdef") != bits.npos) {
            return cases::failure(
                "'{}' does not name pictures; write each as 16 digits 0 to 9 and a to f, as "
                "results.json has them in 'bits', with commas between them",
                word);
        }
        to.emplace_back(bits);
        rest.remove_prefix(std::min(comma + 1, rest.size()));
    } while (!rest.empty());
    sort_bits(to);
    return {};
}

// The names that a crash can have (run/process/process.cpp).
std::vector<std::string> signal_names() {
    std::vector<std::string> names;
    for (int signal = 1; signal < NSIG; ++signal) {
        const char* name = ::sigabbrev_np(signal);
        names.push_back(name != nullptr ? "SIG" + std::string(name)
                                        : "signal " + std::to_string(signal));
    }
    return names;
}

bool is_signal_name(const std::string& text) {
    const std::vector<std::string> names = signal_names();
    return std::find(names.begin(), names.end(), text) != names.end();
}

// What is wrong with the door that a group names, or does not name; empty if nothing is.
std::string wrong_door(const FindingGroup& group, bool is_named) {
    const bool is_of_door = group.rule.starts_with("door.");
    if (is_named && !is_of_door) {
        return fmt::format("'{}' is no rule of doors, so that no '=DOOR' follows it", group.rule);
    }
    if (is_of_door && !is_named) {
        return fmt::format("'{}' does not say of which door; write '{}=DOOR'", group.rule,
                           group.rule);
    }
    if (is_named && !cases::find_door(group.door)) {
        return fmt::format(
            "'{}' is no door{}", group.door,
            cases::did_you_mean(group.door, cases::door_words(), "; 'edgecase doors' lists them"));
    }
    if (is_named) {
        const std::string_view rule = cases::row_of(*cases::find_door(group.door)).rule;
        if (rule != group.rule) {
            return fmt::format("'{}' is a door of '{}' and not of '{}'", group.door, rule,
                               group.rule);
        }
    }
    return {};
}

// "vulkan<=9" of a group.
cases::Expected<void> add_bound(ExpectedCause& cause, FindingGroup group, std::string_view bound) {
    const size_t sign = bound.find("<=");
    const std::string_view level = bound.substr(0, sign);
    const auto profile = cases::parse_profile(level);
    if (!profile) {
        return cases::failure("'{}' is no level; write vulkan, practice or direct3d", level);
    }
    group.level = *profile;
    const std::string_view number =
        sign == std::string_view::npos ? std::string_view() : bound.substr(sign + 2);
    const char* const end = number.data() + number.size();
    const auto read = std::from_chars(number.data(), end, group.count);
    if (number.empty() || read.ec != std::errc() || read.ptr != end || group.count == 0) {
        return cases::failure("'{}' does not say how far the cause reaches; write '{}<=COUNT'",
                              bound, level);
    }
    if (find_like(cause, group) != nullptr) {
        return cases::failure("'{}' gives a second count for the same findings", bound);
    }
    insert(cause, group);
    return {};
}

}  // namespace

bool is_of_other_doors(const ExpectedCause& cause, const std::vector<std::string>& drawn_doors) {
    const auto is_drawn = [&](const std::string& door) {
        return std::find(drawn_doors.begin(), drawn_doors.end(), door) != drawn_doors.end();
    };
    return !cause.groups.empty() &&
           std::all_of(cause.groups.begin(), cause.groups.end(), [&](const FindingGroup& group) {
               return !group.door.empty() && !is_drawn(group.door);
           });
}

bool is_cause_word(std::string_view word) {
    return word.find(':') != std::string_view::npos || word.starts_with(kBits) ||
           std::any_of(kTexts.begin(), kTexts.end(),
                       [word](const auto& text) { return word.starts_with(text.first); });
}

cases::Expected<void> add_cause_word(ExpectedCause& cause, std::string_view word) {
    if (word.starts_with(kBits)) {
        return add_bits(cause.bits, word);
    }
    for (const auto& [name, member] : kTexts) {
        if (word.starts_with(name)) {
            if (const std::string value(word.substr(name.size()));
                member == &ExpectedCause::signal && !value.empty() && !is_signal_name(value)) {
                return cases::failure(
                    "'{}' is no signal{}", value,
                    cases::did_you_mean(value, signal_names(), "; write its name, like SIGSEGV"));
            }
            return add_text(cause.*member, word, word.substr(name.size()));
        }
    }
    const size_t colon = word.find(':'), at = std::min(word.find('@', colon), word.size());
    FindingGroup group;
    const auto kind = parse_kind(word.substr(0, colon));
    if (!kind) {
        return cases::failure(
            "'{}' is no kind of finding; write missing, extra, double, value or "
            "order",
            word.substr(0, colon));
    }
    group.kind = *kind;
    std::string_view rule = word.substr(colon + 1, at - colon - 1);
    const size_t equals = rule.find('=');
    if (equals != std::string_view::npos) {
        group.door = rule.substr(equals + 1);
        rule = rule.substr(0, equals);
    }
    group.rule = rule;
    if (group.rule == kUntold) {
        group.rule.clear();
    } else if (cases::find_rule(group.rule) == nullptr) {
        return cases::failure("'{}' is no rule; {}", group.rule,
                              cases::rule_hint(group.rule, '\''));
    }
    if (std::string wrong = wrong_door(group, equals != std::string_view::npos); !wrong.empty()) {
        return cases::failure("{}", wrong);
    }
    std::string_view bounds = word.substr(std::min(at + 1, word.size()));
    do {
        const size_t comma = std::min(bounds.find(','), bounds.size());
        if (auto added = add_bound(cause, group, bounds.substr(0, comma)); !added) {
            return added;
        }
        bounds.remove_prefix(std::min(comma + 1, bounds.size()));
    } while (!bounds.empty());
    return {};
}

std::string to_text(const ExpectedCause& cause) {
    std::string text;
    const FindingGroup* before = nullptr;
    for (const FindingGroup& group : cause.groups) {
        const bool goes_on = before != nullptr && before->kind == group.kind &&
                             before->rule == group.rule && before->door == group.door;
        text += goes_on ? ","
                        : fmt::format("{}{}:{}{}{}@", text.empty() ? "" : " ",
                                      diff::to_string(group.kind),
                                      group.rule.empty() ? kUntold : group.rule,
                                      group.door.empty() ? "" : "=", group.door);
        text += fmt::format("{}<={}", cases::to_string(group.level), group.count);
        before = &group;
    }
    if (!cause.bits.empty()) {
        text += fmt::format("{}{}{}", text.empty() ? "" : " ", kBits, fmt::join(cause.bits, ","));
    }
    for (const auto& [name, member] : kTexts) {
        if (!(cause.*member).empty()) {
            text += fmt::format("{}{}{}", text.empty() ? "" : " ", name, cause.*member);
        }
    }
    return text;
}

ExpectedCause cause_of(const report::CaseRecord& record, bool with_bits) {
    ExpectedCause cause;
    for (const FindingGroup& group : record.outcome.groups) {
        insert(cause, group);
    }
    cause.signal = record.death.signal;
    cause.step = record.death.signal.empty() ? record.death.step : "";
    if (with_bits && !record.drawn.bits.empty()) {
        cause.bits = {record.drawn.bits};
    }
    return cause;
}

void add_up(ExpectedCause& cause, const ExpectedCause& other) {
    for (const FindingGroup& group : other.groups) {
        insert(cause, group);
    }
    cause.bits.insert(cause.bits.end(), other.bits.begin(), other.bits.end());
    sort_bits(cause.bits);
    for (const auto& [name, member] : kTexts) {
        if ((cause.*member).empty()) {
            cause.*member = other.*member;
        }
    }
}

void widen(ExpectedCause& cause, const ExpectedCause& other) {
    if (cause.is_empty()) {
        cause = other;
        return;
    }
    for (const FindingGroup& group : other.groups) {
        insert(cause, group);
    }
    if (cause.bits.empty() || other.bits.empty()) {
        cause.bits.clear();
    } else {
        cause.bits.insert(cause.bits.end(), other.bits.begin(), other.bits.end());
        sort_bits(cause.bits);
    }
    for (const auto& [name, member] : kTexts) {
        if (cause.*member != other.*member) {
            (cause.*member).clear();
        }
    }
}

namespace {

// What a picture does not hold: what is written beside it, and other renderings that are compared
// with it.
bool is_in_picture(const FindingGroup& group) {
    constexpr std::array<std::string_view, 7> kBeside = {
        cases::rule::write_outside,      cases::rule::repeat_same,
        cases::rule::repeat_scissor,     cases::rule::repeat_clears,
        cases::rule::repeat_write_masks, cases::rule::repeat_attachments,
        cases::rule::device_limits};
    return group.door.empty() &&
           std::find(kBeside.begin(), kBeside.end(), group.rule) == kBeside.end();
}

// A line about a flake speaks of other bits if it names findings or bits, or nothing; and of a
// death if it says how.
std::string what_of_flake_is_new(const ExpectedCause& cause, const report::CaseRecord& record) {
    const bool knows_death = !cause.signal.empty() || !cause.step.empty();
    const bool knows_drawing = !cause.groups.empty() || !cause.bits.empty();
    if (!record.death.suspects.empty()) {
        return record.death.suspects.size() > 1
                   ? "a worker died over it and others, so that it may be another case's doing"
               : !knows_death ? "the worker died, which the line does not say"
                              : "";
    }
    return knows_death && !knows_drawing ? "the worker did not die; other bits were drawn" : "";
}

}  // namespace

std::string what_is_new(const ExpectedCause& cause, const report::CaseRecord& record) {
    std::string text;
    const auto say = [&text](std::string sentence) {
        text += (text.empty() ? "" : "; ") + std::move(sentence);
    };
    const auto check = [&](std::string_view what, const std::string& is, const std::string& known) {
        if (!known.empty() && known != is) {
            say(fmt::format("the {} is '{}' and not '{}'", what, is, known));
        }
    };
    const bool is_flake = record.status == report::Status::flake;
    const bool has_died =
        (!is_flake && record.status != report::Status::fail) || !record.death.suspects.empty();
    if (is_flake) {
        if (std::string news = what_of_flake_is_new(cause, record); !news.empty()) {
            say(std::move(news));
        }
    }
    if (has_died) {
        check("signal", record.death.signal, cause.signal);
        check("step", record.death.step, cause.step);
    }
    if (!cause.bits.empty() && !(is_flake && has_died) && !knows_bits(cause, record.drawn.bits)) {
        say(fmt::format("the bits are '{}' and not '{}'", record.drawn.bits,
                        fmt::join(cause.bits, "' or '")));
    }
    for (const FindingGroup& group : record.outcome.groups) {
        if (!cause.bits.empty() && cause.groups.empty() && is_in_picture(group)) {
            continue;  // the bits say all of it
        }
        const FindingGroup* like = find_like(cause, group);
        if (const uint64_t known = like == nullptr ? 0 : like->count; group.count > known) {
            say(fmt::format("{} {} of {}{} [{}] {}", group.count, diff::to_string(group.kind),
                            group.rule.empty() ? "no told rule" : group.rule,
                            group.door.empty() ? "" : " by door " + group.door,
                            cases::to_string(group.level),
                            known == 0 ? std::string(group.count == 1 ? "is new" : "are new")
                                       : fmt::format("where {} are known", known)));
        }
    }
    return text;
}

void mark_known(const ExpectedCause& cause, report::CaseRecord& record) {
    const bool same_bits = knows_bits(cause, record.drawn.bits);
    for (FindingGroup& group : record.outcome.groups) {
        const FindingGroup* like = find_like(cause, group);
        group.known = same_bits && is_in_picture(group) ? group.count
                      : like == nullptr                 ? 0
                                                        : std::min(group.count, like->count);
    }
}

}  // namespace run
