// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// One run of the suite as the reports see it: rebuilt from the journal, never from anything else.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/renderer.hpp"
#include "cases/model/profile.hpp"
#include "diff/verdict.hpp"
#include "report/record/diagnosis.hpp"
#include "report/record/evidence.hpp"

namespace report {

// Worst wins (docs/design.md, "Running"); `improved` is better than expected but not a pass.
enum class Status : uint8_t {
    pass,
    unsupported,
    skip,
    xfail,
    xpass,
    improved,
    flake,
    fail,
    device_lost,
    timeout,
    crash,
    error,
    not_run,
};
inline constexpr size_t kStatuses = 13;
std::string_view to_string(Status status);
std::optional<Status> parse_status(std::string_view name);
// True for pass, unsupported, skip, xfail: what does not make a run fail.
bool is_expected(Status status);

// Exit codes of every command.
enum ExitCode : int {
    kExitOk = 0,
    kExitUnexpected = 1,
    kExitUsage = 2,
    kExitInvalidFile = 3,
    kExitNothingSelected = 4,
    kExitDevice = 5,
    kExitAllSkipped = 6,
    kExitInternal = 7,
    kExitInterrupted = 130,
};

// Pictures of a case, one byte a sample, row by row; empty if none were kept.
struct Pictures {
    uint32_t width = 0, height = 0;      // pixels of the pictures (a window of the target)
    uint32_t left = 0, top = 0;          // where the window lies in the target
    uint32_t layer_height = 0;           // rows of each of several layers, stacked; 0: one layer
    std::vector<uint8_t> expected_hits;  // Verdict::expected_hits
    std::vector<uint8_t> device_hits;    // Verdict::device_hits
    bool is_uncounted = false;           // they say only where the colour is not the clear one
    std::vector<uint8_t> marks;          // Verdict::marks
    // The same of the plain picture alone, if a picture through a door differs from it elsewhere,
    // too; of whole targets.
    std::vector<uint8_t> plain_marks;
    // Verdict::error_ratios as error_code(); empty if no value was compared.
    std::vector<uint8_t> errors;
    // What a screen would show of the colour target, red plane, green plane, blue plane; empty if
    // there is none.
    std::vector<uint8_t> device_colors;
    std::vector<uint8_t> expected_colors;  // the same of a blit's nominal texels
    // Depth: 1 + 254 (z - depth_low) / (depth_high - depth_low), 0 where it holds the clear value.
    std::vector<uint8_t> device_depths;
    // The same of the reference, 0 where a sample is free or holds the clear value; empty if no
    // finding is about a depth.
    std::vector<uint8_t> expected_depths;
    double depth_low = 0, depth_high = 0;
    // The stencil alike, from stencil_low to stencil_high, if a finding is about it: the device's,
    // and those that the reference wants, 0 where several are right.
    std::vector<uint8_t> device_stencils, expected_stencils;
    uint32_t stencil_low = 0, stencil_high = 0;
    static void fields(auto&& visit, auto&... p) {
        visit("width", p.width...);
        visit("height", p.height...);
        visit("left", p.left...);
        visit("top", p.top...);
        visit({"layer_height", cases::kOlderLackIt}, p.layer_height...);
        visit("expected_hits", p.expected_hits...);
        visit("device_hits", p.device_hits...);
        visit({"uncounted", cases::kLeftOutIfEmpty}, p.is_uncounted...);
        visit("marks", p.marks...);
        visit({"plain_marks", cases::kLeftOutIfEmpty}, p.plain_marks...);
        visit({"errors", cases::kOlderLackIt}, p.errors...);
        visit({"device_colors", cases::kOlderLackIt}, p.device_colors...);
        visit({"expected_colors", cases::kOlderLackIt}, p.expected_colors...);
        visit({"device_depths", cases::kOlderLackIt}, p.device_depths...);
        visit({"expected_depths", cases::kOlderLackIt}, p.expected_depths...);
        visit({"depth_low", cases::kOlderLackIt}, p.depth_low...);
        visit({"depth_high", cases::kOlderLackIt}, p.depth_high...);
        visit({"device_stencils", cases::kOlderLackIt}, p.device_stencils...);
        visit({"expected_stencils", cases::kOlderLackIt}, p.expected_stencils...);
        visit({"stencil_low", cases::kOlderLackIt}, p.stencil_low...);
        visit({"stencil_high", cases::kOlderLackIt}, p.stencil_high...);
    }
    friend bool operator==(const Pictures&, const Pictures&) = default;
};
// What must be seen of a case that passes: the device's picture is the same but where it is free.
struct Reference {
    uint32_t width = 0, height = 0, left = 0, top = 0, layer_height = 0;  // as in Pictures
    std::vector<uint8_t> hits;                                            // Verdict::expected_hits
    static void fields(auto&& visit, auto&... r) {
        visit("width", r.width...);
        visit("height", r.height...);
        visit("left", r.left...);
        visit("top", r.top...);
        visit("layer_height", r.layer_height...);
        visit("hits", r.hits...);
    }
    friend bool operator==(const Reference&, const Reference&) = default;
};
// 0: nothing was compared, 1: no error, 2..254: about 2^((code - 128) / 8) budgets, 255: infinite.
uint8_t error_code(float ratio);

// What is known of a case before it is drawn: where it comes from, what it says of itself.
struct PlannedCase {
    std::string id, file;
    uint32_t line = 0;
    std::string description;
    std::vector<std::string> rules, links;
    std::string rerun;    // command line that repeats it
    std::string catches;  // which fault would break the case
    // Doors (cases/model/door.hpp) that the run asks for beyond those of the file, and those of
    // them that the case cannot take.
    std::vector<std::string> doors, left_out_doors;
    std::string content;  // a hash of all that is drawn of it, hexadecimal; empty in older journals
    static void fields(auto&& visit, auto&... p) {
        visit("id", p.id...);
        visit("file", p.file...);
        visit("line", p.line...);
        visit("description", p.description...);
        visit("rules", p.rules...);
        visit("links", p.links...);
        visit("rerun", p.rerun...);
        visit({"catches", cases::kOlderLackIt}, p.catches...);
        visit({"content", cases::kOlderLackIt}, p.content...);
        visit({"doors", cases::kLeftOutIfEmpty}, p.doors...);
        visit({"left_out_doors", cases::kLeftOutIfEmpty}, p.left_out_doors...);
    }
};

// What an expectation file says of a case that did not pass, and what it leaves unsaid.
struct Known {
    std::optional<Status> expected;
    std::string bug;               // its bug reference
    std::string place;             // where it stands, "FILE:LINE"
    std::string unlike;            // what of the failure it does not speak of; empty: nothing
    bool unseen_picture = false;   // it excuses this failure, and nobody has seen these bits
    std::string expired;           // the date on which it ended, if that is past
    std::optional<Status> actual;  // what happened before the expectation was looked at
};

// The drawing that was judged.
struct Drawn {
    // Checksums in hexadecimal, to compare runs with: of every bit read back, and of the hits
    // alone.
    std::string bits, hit_bits;
    // Planes of a renderer elsewhere were judged, and which of the case's are not there.
    bool is_delivered = false;
    // Of a failure beyond those that are told (run --tell) the symptoms alone are known, and it was
    // not drawn again.
    bool is_brief = false;
    std::vector<std::string> not_judged;
    double seconds = 0;
    uint32_t attempts = 0;
    std::vector<std::string> messages;  // validation layer
    // Doors through which a picture was drawn and compared, the file's among them; and those that
    // the device lacks, with the reason.
    std::vector<std::string> doors;
    std::vector<std::pair<std::string, std::string>> closed_doors;
};

// How the worker ended that drew a case.
struct WorkerEnd {
    std::string step;    // its last one ("submit", ...)
    std::string signal;  // "SIGSEGV", ... of a crash
    // Of a death that no case repeated alone, and that is charged to this one as a flake: the cases
    // that were drawn together, this one among them.
    std::vector<std::string> suspects;
    std::string output;  // what the driver printed, head and tail, any bytes
};

// Commands::no_reproducer, where only doors show the failure and the program would draw without.
inline constexpr char kDoorsAlone[] = "doors alone";

// Command lines that lead further.
struct Commands {
    std::string explain;  // explains the first wrong sample; empty if none
    // Of a failure: the line that writes the case as a program for a bug report; and, if it is
    // empty, what of the case such a program cannot draw ("a blit") or kDoorsAlone, else what may
    // be too much for one ("many values"), which the command finds out.
    std::string reproducer, no_reproducer;
};

// What a reader can check the judgement by.
struct Evidence {
    Pictures pictures;
    Reference reference;                  // of a case that passes and whose pictures were not kept
    Geometry geometry;                    // with pictures or the reference
    std::vector<SampleEvidence> samples;  // wrong ones and some of their neighbours
};

// The errors that a hunt counts by themselves, as it makes cases by chance: a picture without any
// triangle would pass; nobody built a shader for the combination of features.
enum class ErrorKind : uint8_t { other, shows_nothing, not_built };

// A case with its end.
struct CaseRecord : PlannedCase {
    CaseRecord() = default;
    CaseRecord(PlannedCase planned) : PlannedCase(std::move(planned)) {}
    Status status = Status::not_run;
    std::string reason;  // why unsupported, skipped, error, lost, crashed; one sentence
    ErrorKind error_kind = ErrorKind::other;  // of an error; no journal holds it
    Known known;
    Drawn drawn;
    WorkerEnd death;
    diff::Outcome outcome;
    Commands commands;
    Evidence evidence;
    static void fields(auto&& visit, auto&... r) {
        PlannedCase::fields(visit, r...);
        visit("status", r.status...);
        visit("expected", r.known.expected...);
        visit("bug", r.known.bug...);
        visit({"expectation", cases::kOlderLackIt}, r.known.place...);
        visit({"unlike", cases::kOlderLackIt}, r.known.unlike...);
        visit({"unseen_picture", cases::kOlderLackIt}, r.known.unseen_picture...);
        visit({"expired", cases::kOlderLackIt}, r.known.expired...);
        visit({"actual", cases::kOlderLackIt}, r.known.actual...);
        visit({"bits", cases::kOlderLackIt}, r.drawn.bits...);
        visit({"hit_bits", cases::kOlderLackIt}, r.drawn.hit_bits...);
        visit("reason", r.reason...);
        visit({"delivered", cases::kLeftOutIfEmpty}, r.drawn.is_delivered...);
        visit({"not_judged", cases::kLeftOutIfEmpty}, r.drawn.not_judged...);
        visit({"brief", cases::kLeftOutIfEmpty}, r.drawn.is_brief...);
        visit("step", r.death.step...);
        visit("signal", r.death.signal...);
        visit({"suspects", cases::kLeftOutIfEmpty}, r.death.suspects...);
        visit("stderr", r.death.output...);
        visit("seconds", r.drawn.seconds...);
        visit("attempts", r.drawn.attempts...);
        visit("messages", r.drawn.messages...);
        visit({"drawn_doors", cases::kLeftOutIfEmpty}, r.drawn.doors...);
        visit({"closed_doors", cases::kLeftOutIfEmpty}, r.drawn.closed_doors...);
        diff::Outcome::fields(visit, r.outcome...);
        visit("explain", r.commands.explain...);
        visit({"reproducer", cases::kOlderLackIt}, r.commands.reproducer...);
        visit({"no_reproducer", cases::kOlderLackIt}, r.commands.no_reproducer...);
        visit({"evidence", cases::kOlderLackIt}, r.evidence.samples...);
        visit({"pictures", cases::kLeftOutIfEmpty}, r.evidence.pictures...);  // of most: none
        visit({"reference", cases::kLeftOutIfEmpty}, r.evidence.reference...);
        visit({"geometry", cases::kLeftOutIfEmpty}, r.evidence.geometry...);
    }
};

// What is known of a run when it begins.
struct RunHeader {
    std::string tool_version;
    std::vector<std::string> arguments;  // argv
    std::vector<std::pair<std::string, std::string>>
        environment;      // VK_*, EDGECASE_*, LP_*, MESA_* ... that were set
    std::string started;  // ISO 8601 UTC
    std::string host;     // operating system and machine
    cases::Profile profile = cases::Profile::direct3d;
    // The strictest level at which a finding makes the run fail; nothing: the profile.
    std::optional<cases::Profile> fail_at;
    uint64_t seed = 0;
    std::string suite_root;
    std::string suite_hash;        // of the suite's files, hexadecimal; empty in older journals
    std::string expectation_file;  // empty if none applied
    // What else decides what is drawn and what counts as expected, so that parts of different runs
    // are told apart; empty in older journals.
    // Doors that a set of --doors left out because expectation files know them to be broken, and
    // the bugs.
    std::vector<std::pair<std::string, std::string>> skipped_doors;
    std::string selection;         // "49 cases, HASH of their ids", before --shard
    std::string own_hash;          // of the selected case files outside the suite; empty: none
    std::string expectation_hash;  // of the expectation files' bytes; empty: none
    std::string settings;          // "--require-support --repeat 3": options that judge otherwise
    uint32_t shard = 1, shards = 1, jobs = 1;
    std::vector<uint32_t> missing_shards;  // of merged parts: those that were not among them
    std::vector<std::pair<std::string, std::string>> sources;  // the cases' files and their texts
    static void fields(auto&& visit, auto&... h) {
        visit("tool_version", h.tool_version...);
        visit("arguments", h.arguments...);
        visit("environment", h.environment...);
        visit("started", h.started...);
        visit("host", h.host...);
        visit("profile", h.profile...);
        visit({"fail_at", cases::kLeftOutIfEmpty}, h.fail_at...);
        visit("seed", h.seed...);
        visit("suite_root", h.suite_root...);
        visit({"suite_hash", cases::kOlderLackIt}, h.suite_hash...);
        visit("expectation_file", h.expectation_file...);
        visit({"skipped_doors", cases::kLeftOutIfEmpty}, h.skipped_doors...);
        visit({"selection", cases::kOlderLackIt}, h.selection...);
        visit({"own_hash", cases::kOlderLackIt}, h.own_hash...);
        visit({"expectation_hash", cases::kOlderLackIt}, h.expectation_hash...);
        visit({"settings", cases::kOlderLackIt}, h.settings...);
        visit("shard", h.shard...);
        visit("shards", h.shards...);
        visit("jobs", h.jobs...);
        visit({"missing_shards", cases::kLeftOutIfEmpty}, h.missing_shards...);
        visit({"sources", cases::kOlderLackIt}, h.sources...);
    }
};

// How it ended.
struct RunEnd {
    std::string ended;  // ISO 8601 UTC; empty if the run was cut off
    double seconds = 0;
    bool interrupted = false;
    std::vector<Diagnosis> diagnoses;  // what the device does wrong; of most failures first
    static void fields(auto&& visit, auto&... e) {
        visit("ended", e.ended...);
        visit("seconds", e.seconds...);
        visit("interrupted", e.interrupted...);
        visit({"diagnoses", cases::kLeftOutIfEmpty}, e.diagnoses...);
    }
};

struct Run : RunHeader, RunEnd {
    capture::DeviceInfo device;     // its texts may hold any bytes
    std::vector<CaseRecord> cases;  // selection order; those without an end are not_run
    // Of them: whose pictures, numbers of samples and findings beyond the first are in the journal
    // alone, since reports of them all would have no bound (load_for_reports).
    size_t shortened_cases = 0;
};

// What happened to a case whatever was expected of it: pass for xpass, fail for an expected
// failure.
Status actual_status(const CaseRecord& record);

std::array<size_t, kStatuses> totals(const Run& run);
// From the statuses, the levels of what fails (record/levels.hpp) and missing shards alone (0, 1,
// 6, 7 or 130).
int exit_code(const Run& run);

}  // namespace report
