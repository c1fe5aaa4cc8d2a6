// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which case catches which fault.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "mutants/software.hpp"

namespace mutants {

// What is known of one fault after some cases.
struct MatrixRow {
    Fault fault = kNoFault;
    cases::Profile loosest = cases::Profile::direct3d;   // of all findings; meaningful if caught
    std::map<std::string, std::set<std::string>> files;  // case files that caught it, by family
    std::map<std::string, std::string> first_rule;       // of the first finding, by case file
    std::vector<std::string> lines;                      // a finding of each leaf that caught it
    size_t leaves() const { return lines.size(); }
    size_t file_count() const;
};

// Few samples and few triangles: a fault shows in them within a millisecond.
bool is_small(const cases::Case& c);

std::string family_of(const cases::Case& c);
// The id without its matrix part.
std::string file_of(const cases::Case& c);

// The first leaf of each family's first file, then of the second files and so on, then all second
// leaves: what differs most comes first.
std::vector<size_t> leaves_by_turn(std::span<const cases::Case> suite);

// Draws and judges `leaves` at profile direct3d with every fault for which `asks` still holds, on
// all processors. A rendering that has the bits of the faultless device's is not judged: it has
// the same verdict. A leaf on which the faultless device has a finding is an error, told to
// `alarm`.
void measure(std::span<const cases::Case> suite, std::span<const size_t> leaves,
             std::vector<MatrixRow>& rows, const std::function<bool(const MatrixRow&)>& asks,
             const std::function<void(const std::string&)>& alarm);

}  // namespace mutants
