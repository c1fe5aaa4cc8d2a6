// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "report/record/run.hpp"

#include <algorithm>
#include <cmath>

#include "report/record/levels.hpp"

namespace report {

namespace {

constexpr std::array<std::string_view, kStatuses> kNames = {
    "pass", "unsupported", "skip",    "xfail", "xpass", "improved", "flake",
    "fail", "device_lost", "timeout", "crash", "error", "not_run",
};

}  // namespace

std::string_view to_string(Status status) {
    return kNames.at(static_cast<size_t>(status));
}

std::optional<Status> parse_status(std::string_view name) {
    const auto it = std::ranges::find(kNames, name);
    if (it == kNames.end()) {
        return std::nullopt;
    }
    return static_cast<Status>(it - kNames.begin());
}

bool is_expected(Status status) {
    return status <= Status::xfail;
}

uint8_t error_code(float ratio) {
    if (!(ratio >= 0)) {
        return 0;
    }
    if (ratio <= 0) {
        return 1;
    }
    return std::isinf(ratio) ? uint8_t{255}
                             : static_cast<uint8_t>(
                                   std::clamp(std::lround(128 + 8 * std::log2(ratio)), 2L, 254L));
}

Status actual_status(const CaseRecord& record) {
    if (record.known.actual) {
        return *record.known.actual;
    }
    switch (record.status) {  // journals that do not tell
        case Status::xpass:
            return Status::pass;
        case Status::xfail:
            return record.known.expected.value_or(Status::fail);
        case Status::improved:
            return Status::fail;
        default:
            return record.status;
    }
}

std::array<size_t, kStatuses> totals(const Run& run) {
    std::array<size_t, kStatuses> count{};
    for (const CaseRecord& record : run.cases) {
        ++count.at(static_cast<size_t>(record.status));
    }
    return count;
}

int exit_code(const Run& run) {
    if (run.interrupted) {
        return kExitInterrupted;
    }
    const auto count = totals(run);
    const auto of = [&](Status status) { return count.at(static_cast<size_t>(status)); };
    if (of(Status::not_run) > 0 || of(Status::error) > 0 || !run.missing_shards.empty()) {
        return kExitInternal;  // something was not judged: worse than a wrong sample
    }
    if (std::ranges::any_of(run.cases,
                            [&](const CaseRecord& record) { return makes_fail(run, record); })) {
        return kExitUnexpected;
    }
    // A run that judged nothing proves nothing, so it never exits 0. What fails here does so at
    // stricter levels than the run was to fail at.
    return of(Status::pass) + of(Status::xfail) + of(Status::fail) == 0 ? kExitAllSkipped : kExitOk;
}

}  // namespace report
