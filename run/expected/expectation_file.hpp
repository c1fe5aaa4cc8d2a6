// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Expectation files: which cases are known not to pass on a device, one line a case
// (cases/expectations/README.md). Strict: what does not say what it seems to say is an error.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cases/base/error.hpp"
#include "cases/model/profile.hpp"
#include "report/record/run.hpp"
#include "run/expected/expected_cause.hpp"

namespace run {

inline constexpr std::string_view kExpectationsFirstLine = "# edgecase-expectations 2";

// A version bound of the header: ">=22.3".
struct VersionBound {
    enum class Relation { at_least, above, at_most, below, equal } relation = Relation::equal;
    std::vector<uint32_t> version;
    std::string text = {};  // as it is written: ">=22.3"
};

struct ExpectationLine {
    std::string glob;
    report::Status status = report::Status::fail;
    std::string bug;
    ExpectedCause cause;   // what the failure looks like
    std::string until;     // YYYY-MM-DD or empty
    bool is_past = false;  // until is
    std::string note;
    cases::SourceLocation where;
    // Of a file of pictures (seen_pictures.hpp), not of this one: CaseRecord::bits of the case that
    // were seen before.
    bool pictures_are_known = false;
    std::set<std::string> seen;
    bool excuses_seen_only = false;  // --strict
};

struct ExpectationFile {
    std::filesystem::path path;
    std::string device_glob;   // on the device's name
    std::string driver_regex;  // on "driver name driver info"; empty: any
    std::vector<VersionBound> versions;
    std::vector<cases::Profile> profiles;  // empty: all
    std::vector<ExpectationLine> lines;
    // "door=NAME skip": doors that are known to draw something else on the device, and that sets of
    // doors leave out; `glob` is their name.
    std::vector<ExpectationLine> doors;
    bool is_older = false;  // format 1, whose lines name no cause: for an update only
};

// Parses a file's text. `today` (YYYY-MM-DD, UTC) decides whether an until= is past (no error). A
// file of format 1 is an error unless `for_update`.
cases::ExpectedAll<ExpectationFile> parse_expectations(std::string_view text,
                                                       const std::filesystem::path& path,
                                                       const std::string& today,
                                                       bool for_update = false);
cases::ExpectedAll<ExpectationFile> load_expectations(const std::filesystem::path& path);

// The numbers of a version in text ("Mesa 22.3.6 (LLVM 15)" -> 22 3 6), from the first digit at or
// after `begin`; empty if there is none.
std::vector<uint32_t> find_version(std::string_view text, size_t begin);
bool satisfies(const std::vector<uint32_t>& version, const VersionBound& bound);

// Empty if the file speaks of this device and profile; else one sentence why not.
std::string mismatch(const ExpectationFile& file, const capture::DeviceInfo& device,
                     cases::Profile profile);

// What the files say of each id; the causes of lines that agree about an id add up. Errors: two
// lines that disagree about an id; with `whole_suite`, a line that matches no id.
cases::ExpectedAll<std::map<std::string, ExpectationLine>> resolve_expectations(
    const std::vector<ExpectationFile>& files, const std::vector<std::string>& ids,
    bool whole_suite);

// What a case counts as, given what was expected of it (nothing: unchanged). An expectation whose
// date is past excuses nothing, and is news even if the case passes.
report::Status judge_expected(report::Status actual, std::optional<report::Status> expected,
                              bool is_past = false);

// Whether a failure that the line excuses is drawn as nobody has seen it before. Only pictures
// themselves can be asked, not deaths, and not flakes, which have many.
bool has_new_picture(const ExpectationLine& line, const report::CaseRecord& record);

// What the record of a case counts as by a line: judge_expected(), but a failure that is not as the
// line's cause says counts as itself.
report::Status counts_as(const ExpectationLine& line, const report::CaseRecord& record);
// Makes of what happened what it counts as, and writes down what was expected. A line whose day is
// past excuses nothing.
void apply(const ExpectationLine& line, report::CaseRecord& record);
// Whether a case is not to be drawn at all.
bool skips(const ExpectationLine& line);
// One error for each line whose date is past.
cases::Errors past_lines(const ExpectationFile& file);

}  // namespace run
