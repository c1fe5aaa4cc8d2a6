// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Brings an expectation file up to date with what a run has seen, without losing a word that a
// person has written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/record/run.hpp"
#include "run/expected/expectation_file.hpp"

namespace run {

struct UpdateWords {
    std::string bug;     // of new lines; empty: not known
    std::string reason;  // of new lines; empty: what the run says
    std::string until;   // of new lines and of those that ended; empty: none
    // Each case gets a line of its own that knows the bits of its picture, so that no other picture
    // of it is excused. A line that knows bits already learns new ones without this.
    bool bits = false;
};

struct Update {
    std::string text;  // the new file
    // What is different, as a diff: "- old line", "+ new line"; a line that goes is shown whole,
    // with its reason.
    std::vector<std::string> changes;
    std::vector<std::string> notes;  // what a person has to look at, one sentence each
    size_t kept = 0, removed = 0, changed = 0, added = 0;
    std::vector<std::string>
        without_bug;  // ids that need a new line and have no reference to a bug
};

// `text` parsed to `file`; `ids` are those of the whole suite. A line stays as it is while all its
// cases end as it says, or were not drawn; its status or cause is changed if all end otherwise (a
// count only grows: the file may speak of other drivers, too); it goes if all pass; if they differ
// it becomes a few lines. Comments, order and other lines stay byte for byte. Unexpected results
// that no line speaks of become lines at the end, one for cases with the same cause where a glob
// matches them and nothing else.
Update update_expectations(std::string_view text, const ExpectationFile& file,
                           const report::Run& run, const std::vector<std::string>& ids,
                           const UpdateWords& words);

// A file without expectations for the device, driver version and profile of a run.
std::string new_expectation_file(const report::Run& run);

}  // namespace run
