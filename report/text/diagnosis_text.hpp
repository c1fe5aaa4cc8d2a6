// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Diagnoses in words, as the terminal, the page and the CI's summary tell them.
#pragma once

#include <string>

#include "report/record/diagnosis.hpp"

namespace report {

// "The viewport is upside down", or "one of: A; B".
std::string what_it_does(const Diagnosis& diagnosis);

// On what it rests: "repeats 34 of 34 wrong samples and 48 of 48 told values in 5 of the 5 failed
// cases that were tried; 40 cases that passed agree".
std::string evidence_for(const Diagnosis& diagnosis);

}  // namespace report
