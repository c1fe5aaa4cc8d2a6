// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Diagnoses in words, as the terminal, the page and the CI's summary tell them, and what of the run
// they repeat.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "report/record/diagnosis.hpp"
#include "report/record/run.hpp"
#include "report/text/causes.hpp"

namespace report {

// "The viewport is upside down", or "one of: A; B".
std::string what_it_does(const Diagnosis& diagnosis);

// On what it rests: "repeats 34 of 34 wrong samples and 48 of 48 told values in 5 of the 5 failed
// cases that were tried; 40 cases that passed agree".
std::string evidence_for(const Diagnosis& diagnosis);

// What a partial one does not: "explains 4 of 64 failed cases tried only".
std::string limits_of(const Diagnosis& diagnosis);

// Which cases and causes say the same as a diagnosis of the run.
class Repeated {
  public:
    explicit Repeated(const Run& run);
    // The number of the diagnosis that repeats this case, where it was tried.
    std::optional<size_t> by(const std::string& id) const;
    // The number of the one that says the same as each of these causes, which are of one family
    // each. It repeats all cases of the cause that were tried; where none was, three quarters of
    // those that were tried of the causes with that rule, kind and level. Of a rule of doors, where
    // the plain pictures are wrong, too, it is the one that says the same of these pictures. A
    // partial one has no causes.
    std::vector<std::optional<size_t>> of(const std::vector<Cause>& list) const;
    // Whether a diagnosis says too little to stand at the head: it explains less than half of the
    // failed cases tried, and either all diagnoses together do so, or it alone explains no cause.
    bool is_partial(size_t number) const;

  private:
    // How many cases of a cause were tried, and how many each diagnosis repeats.
    struct Tried {
        size_t cases = 0;
        std::vector<size_t> repeated;
    };
    void add(Tried& tried, const Cause& cause) const;
    // The first one that repeats so many quarters of them, if any was tried.
    std::optional<size_t> of_most(const Tried& tried, size_t quarters) const;
    std::vector<std::set<std::string>> explained_;  // by diagnosis
    std::set<std::string> tried_;                   // failed cases
    std::vector<bool> is_partial_;                  // by diagnosis
};

}  // namespace report
