// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Two or more runs side by side: drivers, versions, renderers. What is compared is what happened,
// not what an expectation file made of it.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "cases/base/error.hpp"
#include "report/record/run.hpp"
#include "report/text/console.hpp"

namespace report {

struct NamedRun {
    std::string folder;
    Run run;
};

// What became of a case between the first run (A) and the others, the most important first.
enum class Change : uint8_t {
    // Worse in a later run (pass < flake < fail < device_lost < timeout < crash), or it fails there
    // in a way or as often as it did not: by another kind, rule or level, or by another signal.
    regression,
    // Judged in the first run, and a later one has no such case, or another one under its id, does
    // not support it or skipped it.
    vanished,
    fix,              // better in a later run, worse in none
    fails_otherwise,  // bad in all, with other findings or other bits
    fails_alike,      // bad in all, bit for bit the same
    other_coverage,   // passes in all, other samples are hit: the reference allows both
    other_values,     // passes in all with the same hits and other bits
    only_in_some,     // not judged in the first run, or not in a later one (not run, error)
    judged_in_none,   // unsupported, skipped, not run or an error wherever it is: not compared
    same,             // passes in all, bit for bit the same
};
inline constexpr size_t kChanges = 10;
std::string_view to_string(Change change);  // "regression", "other coverage", ...

// What makes a comparison fail, besides regressions and cases that vanished.
struct Strictness {
    // Cases that a run lacks, does not support or skips by an expectation are left out, but not
    // what it did not come to.
    bool common = false;
    bool strict = false;  // any difference of bits counts
};

struct ComparedCase {
    std::string id;
    Change change = Change::same;
    std::vector<const CaseRecord*> records;  // one a run; null where the run has no such case
    std::string detail;                      // one line; may be empty
    // Of a later run: it has another case under this id than the first one; none: 0.
    size_t other = 0;
};

struct Comparison {
    std::vector<std::string> letters;  // "A", "B", ...
    std::vector<ComparedCase> cases;   // in the order of the first run, then of the others
    std::array<size_t, kChanges> counts{};
    // Cases that a run began with and that were not run or could not be judged, and shards that it
    // lacks.
    size_t unjudged = 0;
    Strictness strictness;
    std::vector<std::string> remarks;  // what makes the runs less comparable, one sentence each
};

// Error, one sentence: fewer than two runs, or runs of different profiles. The pointers are into
// `runs`.
cases::Expected<Comparison> compare_runs(const std::vector<NamedRun>& runs,
                                         Strictness strictness = {});

// How many cases the first run and a later one judged, so that something is said of them.
size_t compared_cases(const Comparison& comparison);

// 1 with a regression, a case that vanished or, if strict, any difference; else 7 if a run is not
// whole; else 4 if no case was compared; else 0.
int exit_code(const Comparison& comparison);

// Whether pictures show hits of the same samples of the same pixels.
bool show_same_hits(const Pictures& a, const Pictures& b);

// "regressions: 2 cases got worse"
std::string heading(Change change, size_t count);
// What counts, in a few words: "3 cases got worse, 1 vanished, 2 got better"; "No case got worse, 4
// fail in other ways"; "All 12 cases are the same bit for bit".
std::string comparison_headline(const Comparison& comparison);
// "exit 1: regressions", "exit 1: cases vanished"
std::string exit_words(const Comparison& comparison);

// The table for a terminal. style.verbose lists every case that is not the same and draws where the
// kept pictures (--capture all) differ. The last line is `exit`, or, if empty, exit_words.
std::string comparison_text(const std::vector<NamedRun>& runs, const Comparison& comparison,
                            const ConsoleStyle& style, const std::string& exit = {});
// What the table's JSON and the page say alike of run `index`: its letter, folder, device, driver,
// subpixel bits.
nlohmann::ordered_json compared_run(const NamedRun& run, const Comparison& comparison,
                                    size_t index);
// docs/schema/comparison-1.json
std::string comparison_json(const std::vector<NamedRun>& runs, const Comparison& comparison);
// One page that loads nothing: the runs, every case that is not the same, and where kept pictures
// differ, at most some 6 MiB of them. `reports`: the address of each run's report.html as the page
// sees it, to which the cases lead; empty without one.
std::string comparison_html(const std::vector<NamedRun>& runs, const Comparison& comparison,
                            const std::vector<std::string>& reports);

}  // namespace report
