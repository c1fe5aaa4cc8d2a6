// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Says what a wrong device does: draws its failed cases with each of some 550 errors, and tells
// those that fail in the same samples with the same values, and in no other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "report/record/diagnosis.hpp"
#include "report/record/run.hpp"

namespace diagnosis {

// The run's case with that id, or nothing if it is not at hand.
using CaseOf = std::function<const cases::Case*(const std::string& id)>;

// How much is drawn at most. It is counted in samples and vertices that are drawn and judged, not
// in time, so that the same records have the same diagnosis on every machine. On a core of a server
// of 2020 kWorkPerSecond of them take 0.7 s (scissors and samples, 6.2 million in 1.1 s) to 2.7 s
// (lavapipe's known failures, 9.4 million in 6.3 s).
using Work = uint64_t;
inline constexpr Work kWorkPerSecond = 4'000'000;
inline constexpr size_t kMaxSubjects = 64;
struct Bound {
    Work most = std::numeric_limits<Work>::max();
    size_t subjects = kMaxSubjects;  // failed cases that are looked at, at most
    // Called now and then with how many of the failed cases that errors are tried on are done.
    std::function<void(size_t done, size_t total)> progress = {};
};

// Diagnoses the unexpected failures of a run (status fail), what explains most of them first; what
// no error explains is left out. The answer depends on the records alone, not on time or order:
// at most kMaxSubjects small failed cases are looked at, of as many families as there are, and as
// many that passed. What was found before the bound is reached is told.
std::vector<report::Diagnosis> diagnose(const report::Run& run, const CaseOf& case_of,
                                        const Bound& bound = {});

inline constexpr size_t kMaxOfRules = 24;   // of them: one for each rule that leads
inline constexpr size_t kMaxNearby = 256;   // cases that passed, of the families that fail
inline constexpr size_t kMaxMore = 192;     // failed cases beyond, that may contradict a condition
inline constexpr size_t kMaxSeeds = 24;     // failed cases that all errors are tried on
inline constexpr size_t kMaxFits = 6;       // failed cases whose values sizes are fitted to
inline constexpr size_t kMaxPartSeeds = 6;  // of these, on which conditions are tried
inline constexpr size_t kMaxPartCandidates = 64;  // errors; of more the case says too little
inline constexpr size_t kMaxNamed = 4;  // errors that explain the same; of more none is told

}  // namespace diagnosis
