// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Expectation x Capture -> Verdict.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.hpp"
#include "cases/profile.hpp"
#include "diff/capture.hpp"
#include "ref/expectation.hpp"
#include "ref/limits.hpp"
#include "ref/value.hpp"

namespace diff {

enum class FindingKind : uint8_t {
    missing,
    extra,
    double_hit,
    value,
    order
};  // "double" in reports
inline constexpr size_t kFindingKinds = 5;
std::string_view to_string(FindingKind kind);

// One sample (and quantity) that is wrong.
struct Finding {
    FindingKind kind = FindingKind::missing;
    std::string rule;                                 // rule id
    cases::Profile level = cases::Profile::direct3d;  // loosest profile at which it is broken
    uint32_t x = 0, y = 0, sample = 0;
    std::string quantity;  // value findings: "attribute 0.x", "depth", ...; else ""
    std::string expected;
    std::string got;
    std::string why;   // one sentence with the exact arithmetic
    double ratio = 0;  // value findings: error in budgets
};

// What the comparison saw at a sample, for pictures: one byte a sample.
enum class SampleMark : uint8_t { ok, either, missing, extra, double_hit, value, order };

struct Verdict {
    cases::Profile profile = cases::Profile::direct3d;
    std::string
        error;  // not empty: the case or the capture cannot be judged (status error), and why
    std::vector<Finding> findings;                    // the first kMaxFindings, in sample order
    std::array<uint64_t, kFindingKinds> counts{};     // of all, capped or not
    cases::Profile level = cases::Profile::direct3d;  // loosest level among all findings
    uint32_t min_x = 0, min_y = 0, max_x = 0,
             max_y = 0;  // bounding box of the wrong samples, inclusive
    uint64_t must_samples = 0, either_samples = 0, compared_samples = 0, compared_values = 0;
    double worst_ratio = 0;      // largest accepted or rejected error in budgets (K of this case)
    std::string worst_quantity;  // where
    std::vector<uint8_t>
        expected_hits;  // nominal hits a sample, saturated at 254; 255 where several are allowed
    std::vector<uint8_t> device_hits;  // saturated at 255
    std::vector<SampleMark> marks;     // [sample]
    bool ok() const { return error.empty() && counts == std::array<uint64_t, kFindingKinds>{}; }
};
inline constexpr size_t kMaxFindings = 1000;

// Judges a capture. A case without any sample that must be hit is an error, never a pass.
Verdict compare(const cases::Case& c, const ref::Expectation& expectation,
                const CaptureView& capture);

// As compare, but of the values only those selected are judged. Nothing is said of how many
// invocations a fragment had unless all are.
Verdict compare_selected(const cases::Case& c, const ref::Expectation& expectation,
                         const CaptureView& capture, const ref::ValueSelection& selection);

// Checks the hand-drawn picture of a case against the reference (profile direct3d, 8 subpixel
// bits). Empty if it agrees or the case has none; else one sentence with the first pixel that
// differs.
std::string check_expected_hits(const cases::Case& c);

}  // namespace diff
