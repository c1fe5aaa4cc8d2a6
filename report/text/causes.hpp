// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Unexpected results in groups that probably have one cause: 300 failures are rarely 300 faults.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/record/run.hpp"

namespace report {

// Cases with the same status that break one rule in one way at one level. A case stands in the
// cause of its leading finding, and in one for every other relation between drawings that it
// breaks: a door that is broken does not hide another. Each door has a cause of its own for the
// cases that only doors show; where the plain picture is wrong, too, the doors of a rule share one.
// Deaths have the same signal or step.
struct Cause {
    Status status = Status::fail;
    std::string rule;  // of the leading finding; empty if there is none
    std::string kind;  // "missing", ...; of a death: "SIGSEGV during submit"
    std::string door;  // of a door's rule: which one (cases/model/door.hpp); else empty
    // Of what leads: the loosest of the findings that are new (of known_causes: of all). Nothing if
    // there is none: the cases could not be judged, or their findings are all expected.
    std::optional<cases::Profile> level;
    bool is_known = false;            // all their findings are expected, and there are some
    std::optional<size_t> diagnosis;  // the number of the one that says the same (Repeated::of)
    std::vector<const CaseRecord*> cases;  // in the order of the run; at least one
};

// All causes of a run's unexpected results, the worst first: what could not be judged and deaths,
// then failures by profile, then the rest. Among equals the causes of the rule that leads in the
// most families come first, then of the rule that leads in the most cases, then of the rule that
// stands first in cases::all_rules(): what one fault breaks everywhere before what follows from it
// here and there. The pointers are into `run`.
std::vector<Cause> causes(const Run& run);

// The causes of known failures (xfail) alone, in the same order.
std::vector<Cause> known_causes(const Run& run);

// Both, with the cases of each family by themselves and without diagnoses.
std::vector<Cause> causes_by_family(const Run& run);

// The case that shows the cause with the fewest samples, and among those with the fewest findings.
const CaseRecord& smallest_case(const Cause& cause);

// What that case shows of this cause, one line: it may have findings of several.
std::string why_it_happened(const Cause& cause);

// "fail: tie.top-left missing in ties, 12 cases", "fail: door.state=state-static value in ties,
// clip, depth and 4 more, 90 cases"; printable, one line.
std::string cause_title(const Cause& cause);
// "vulkan"; "all expected" of findings; or nothing, if no level can be told.
std::string cause_level(const Cause& cause);

// "ties", "ties, clip, depth and 4 more": the families of the cases, those of most cases first.
std::string families_text(const std::vector<const CaseRecord*>& of);
// The first part of a case's id; of an id of one part the folder of its file, "mine/".
std::string family_of(const CaseRecord& record);

}  // namespace report
