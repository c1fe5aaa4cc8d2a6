// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Diagnoses in words, as the terminal, the page and the CI's summary tell them, and what of the run
// they repeat.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "report/record/diagnosis.hpp"
#include "report/record/run.hpp"
#include "report/text/causes.hpp"

namespace report {

// "The viewport is upside down", or "one of: A; B".
std::string what_it_does(const Diagnosis& diagnosis);

// On what it rests: "repeats 34 of 34 wrong samples and 48 of 48 told values in 5 of the 5 failed
// cases that were tried; 40 cases that passed agree".
std::string evidence_for(const Diagnosis& diagnosis);

// Which cases and causes say the same as a diagnosis of the run.
class Repeated {
  public:
    explicit Repeated(const Run& run);
    // The number of the diagnosis that repeats this case, where it was tried.
    std::optional<size_t> by(const std::string& id) const;
    // The number of the one that repeats the most of the cause's cases, if every case that was
    // tried is repeated by some, and at least one was tried.
    std::optional<size_t> by(const Cause& cause) const;

  private:
    std::map<std::string, size_t> diagnosis_of_;
    std::set<std::string> others_;  // what was tried, and no diagnosis repeats
};

}  // namespace report
