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

#include "cases/model/profile.hpp"
#include "diff/verdict.hpp"
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

// The device as the worker reported it (all text: driver strings may hold any bytes).
struct Device {
    std::string name, driver_name, driver_info, uuid, type;
    std::string api_version;  // "1.3.230"
    uint32_t vendor_id = 0, device_id = 0, driver_version = 0, driver_id = 0;
    uint32_t subpixel_bits = 0, viewport_subpixel_bits = 0;
    bool has_primitive_id = false;
};

// Pictures of a case, one byte a sample, row by row; empty if none were kept.
struct Pictures {
    uint32_t width = 0, height = 0;      // pixels of the pictures (a window of the target)
    uint32_t left = 0, top = 0;          // where the window lies in the target
    uint32_t layer_height = 0;           // rows of each of several layers, stacked; 0: one layer
    std::vector<uint8_t> expected_hits;  // Verdict::expected_hits
    std::vector<uint8_t> device_hits;    // Verdict::device_hits
    std::vector<uint8_t> marks;          // Verdict::marks
    // Verdict::error_ratios as error_code(); empty if no value was compared.
    std::vector<uint8_t> errors;
    // What a screen would show of the colour target, red plane, green plane, blue plane; empty if
    // there is none.
    std::vector<uint8_t> device_colors;
    std::vector<uint8_t> expected_colors;  // the same of a blit's nominal texels
    // Depth: 1 + 254 (z - depth_low) / (depth_high - depth_low), 0 where it holds the clear value.
    std::vector<uint8_t> device_depths;
    double depth_low = 0, depth_high = 0;
    friend bool operator==(const Pictures&, const Pictures&) = default;
};
// 0: nothing was compared, 1: no error, 2..254: about 2^((code - 128) / 8) budgets, 255: infinite.
uint8_t error_code(float ratio);

struct CaseRecord {
    std::string id, file;
    uint32_t line = 0;
    std::string description;
    std::vector<std::string> rules, links;
    Status status = Status::not_run;
    std::optional<Status> expected;  // of an expectation file
    std::string bug;                 // its bug reference
    std::string expectation;         // where it stands, "FILE:LINE"
    std::string expired;             // the date on which it ended, if that is past
    std::optional<Status> actual;    // what happened before the expectation was looked at
    // Checksums in hexadecimal, to compare runs with: of every bit read back, and of the hits
    // alone.
    std::string bits, hit_bits;
    std::string reason;       // why unsupported, skipped, error, lost, crashed; one sentence
    std::string step;         // last step of the worker before it died ("submit", ...)
    std::string signal;       // "SIGSEGV", ... of a crash
    std::string stderr_text;  // what the driver printed, head and tail, any bytes
    double seconds = 0;
    uint32_t attempts = 0;
    std::vector<std::string> messages;  // validation layer
    // From the verdict:
    std::vector<diff::Finding> findings;
    std::array<uint64_t, diff::kFindingKinds> counts{};
    std::optional<uint64_t> wrong_samples;  // a sample may have several findings
    cases::Profile level = cases::Profile::direct3d;
    uint32_t min_x = 0, min_y = 0, max_x = 0, max_y = 0;  // as in diff::Verdict
    uint64_t must_samples = 0, either_samples = 0, compared_samples = 0, compared_values = 0;
    double worst_ratio = 0;
    std::string worst_quantity;
    Pictures pictures;
    std::string rerun;    // command line that repeats it
    std::string explain;  // command line that explains the first wrong sample; empty if none
    std::string catches;  // which fault would break the case
    Geometry geometry;    // with pictures
    std::vector<SampleEvidence> evidence;  // of wrong samples and some of their neighbours
};

struct Run {
    std::string tool_version;
    std::vector<std::string> arguments;  // argv
    std::vector<std::pair<std::string, std::string>>
        environment;             // VK_*, EDGECASE_*, LP_*, MESA_* ... that were set
    std::string started, ended;  // ISO 8601 UTC; ended empty if the run was cut off
    std::string host;            // operating system and machine
    cases::Profile profile = cases::Profile::direct3d;
    uint64_t seed = 0;
    std::string suite_root;
    std::string suite_hash;        // of the suite's files, hexadecimal; empty in older journals
    std::string expectation_file;  // empty if none applied
    uint32_t shard = 1, shards = 1, jobs = 1;
    bool interrupted = false;
    double seconds = 0;
    Device device;
    std::vector<CaseRecord> cases;  // selection order; those without an end are not_run
};

// What happened to a case whatever was expected of it: pass for xpass, fail for an expected
// failure.
Status actual_status(const CaseRecord& record);

std::array<size_t, kStatuses> totals(const Run& run);
int exit_code(const Run& run);  // from the statuses alone (0, 1, 6, 7 or 130)

}  // namespace report
