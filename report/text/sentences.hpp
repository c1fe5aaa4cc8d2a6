// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What console, JUnit and HTML say in the same words. Everything returned is printable.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/record/levels.hpp"
#include "report/record/run.hpp"

namespace report {

// Text of any bytes, printable and without line breaks and tabs.
std::string one_line(std::string_view bytes);
// "12.4 s", "0.03 s", "0.42 ms"; "?" if not finite.
std::string seconds_text(double seconds);
// At most three significant digits: "0.732", "12.5", "infinity".
std::string ratio_text(double ratio);

// The largest error of a case, and what its run accepts: "1.08 of 2 allowed budgets".
std::string accepted_text(const Run& run, const CaseRecord& record);

// " (judged as 4)" behind the subpixel bits of a device of Vulkan that claims fewer than it must
// have; else empty.
std::string judged_bits_note(const capture::DeviceInfo& device);

// What breaking a profile means: "not conformant", "very suspicious", "differs from top-left
// hardware".
std::string_view meaning(cases::Profile level);

// Its head and its tail where bytes are more than `most`.
std::string head_and_tail(const std::string& bytes, size_t most);

// "(3,4)", or "(3,4) sample 2" if the sample is not 0.
std::string sample_text(const diff::Finding& finding);

// The options by which `explain` tells of where a finding is; empty if it is of the whole case.
std::string sample_options(const diff::Finding& finding, const cases::Target& target);
// "2 missing, 1 wrong value of 64 samples", or "5 of 64 samples wrong (2 missing, 6 values)" where
// some have several findings; empty without any.
std::string counts_text(const CaseRecord& record);
// One line that tells what happened to a case, without its id.
std::string what_happened(const CaseRecord& record);
// "(3,4): depth: expected 0.5, got 0.25; ...", one line.
std::string finding_text(const diff::Finding& finding);
// One line that tells why: the first finding, or the reason, or the driver's last words.
std::string why_it_happened(const CaseRecord& record);

// The finding that a case is known by: the first of the loosest level, so that a broken Vulkan rule
// is never hidden behind a difference in a tie; what no expectation speaks of comes before what is
// known. The record has at least one.
const diff::Finding& leading_finding(const CaseRecord& record);
// Of an unexpected result whose new findings are beyond those that are kept, so that the leading
// finding is one that an expectation speaks of: the new ones of the loosest level. Else nothing.
std::optional<diff::FindingGroup> leading_news(const CaseRecord& record);

// Whether a rule holds between drawings of one case: door.*, repeat.*.
bool is_relation(std::string_view rule);
// The relations between drawings that a case breaks beside its leading
// finding: of a result that is expected none are new.
std::vector<diff::FindingGroup> other_relations(const CaseRecord& record, Of which);
// The same in words, of an unexpected result the new ones: "door.state=state-first [vulkan], 36
// wrong values; repeat.same [vulkan], 2 wrong values"; empty without any.
std::string other_relations_text(const CaseRecord& record);
// "door.state=state-first", as expectation files write it; the rule alone if it is of no door.
std::string rule_and_door(const std::string& rule, const std::string& door);

// "exit 1: unexpected results"; `why` stands in place of what the code means in general.
std::string exit_text(int code, const std::string& why = {});
// The same of a whole run, with what was not judged: "exit 7: 12 cases were not run".
std::string exit_text(const Run& run);
// "shard 2 is" or "shards 2, 5 are", of the shards that a merged run lacks.
std::string missing_shards_text(const Run& run);
// What of how many cases is in the journal alone; empty if nothing is.
std::string shortened_text(const Run& run);
// That they are missing, and what to do.
std::string missing_shards_sentence(const Run& run);

// The case with the largest accepted error in budgets (what findings are off by stands with them);
// null if no case without a finding compared a value.
const CaseRecord* worst_case(const Run& run);

}  // namespace report
