// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a known failure looks like and how far it reaches, so that it never hides another one: the
// rules that are broken, in which way, at which level and how often; or the signal of a crash; or
// every bit of the picture. One cause is a few words of a line of an expectation file:
//   extra:scissor.half-open@vulkan<=9   value:interp.sample@practice<=3,direct3d<=40
//   value:door.state=state-static@vulkan<=36
//   bits=0123456789abcdef,fedcba9876543210   signal=SIGSEGV   step=submit
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/base/error.hpp"
#include "diff/verdict.hpp"
#include "report/record/run.hpp"

namespace run {

struct ExpectedCause {
    // Ordered by kind, rule, door and level; no two are alike but for `count`, which is the most
    // that is expected. The rule of findings beyond those that a record keeps is not known: it is
    // empty, and '-' in a file.
    std::vector<diff::FindingGroup> groups;
    std::vector<std::string> bits;  // each CaseRecord::bits that is known, sorted; empty: any
    std::string signal;             // CaseRecord::signal; empty: any
    std::string step;               // CaseRecord::step; empty: any
    bool is_empty() const {
        return groups.empty() && bits.empty() && signal.empty() && step.empty();
    }
    friend bool operator==(const ExpectedCause&, const ExpectedCause&) = default;
};

// True if the cause speaks of pictures through doors only, and the case was drawn through none of
// these: then it says nothing of the case.
bool is_of_other_doors(const ExpectedCause& cause, const std::vector<std::string>& drawn_doors);

// True for a word that begins as one of a cause does; what else is wrong with it is for
// add_cause_word to say.
bool is_cause_word(std::string_view word);
// Adds what a word says. Errors, one sentence: an unknown kind, rule or level (with the nearest),
// no count, two counts of the same.
cases::Expected<void> add_cause_word(ExpectedCause& cause, std::string_view word);
// The words, with a space between them.
std::string to_text(const ExpectedCause& cause);

// How the case of a record fails: what is wrong with it, and `with_bits` its picture, too.
ExpectedCause cause_of(const report::CaseRecord& record, bool with_bits = false);
// Makes a cause wide enough for the other one, too: it knows the pictures of both. Signals and
// steps that differ are left out, and so are bits if one of the two holds for any picture.
void widen(ExpectedCause& cause, const ExpectedCause& other);
// Makes a cause speak of what either says: two lines about one case.
void add_up(ExpectedCause& cause, const ExpectedCause& other);

// One sentence without a full stop that says what of a failure the cause does not speak of ("1
// double of cover.once [vulkan] is new"); empty if there is nothing.
std::string what_is_new(const ExpectedCause& cause, const report::CaseRecord& record);
// Writes down how many of each group of findings are expected.
void mark_known(const ExpectedCause& cause, report::CaseRecord& record);

}  // namespace run
