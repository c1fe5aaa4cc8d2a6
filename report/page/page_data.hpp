// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the script of report.html reads: every case, and as much of the failing ones as a page may
// weigh.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/record/run.hpp"
#include "report/text/causes.hpp"

namespace report {

// Bytes of JSON that pictures, triangles and values may take together. With findings, the list of
// cases and the script a page stays below 8 MB; what does not fit goes to further pages.
inline constexpr size_t kEvidenceBudget = size_t{4} << 20;

// The same of the references of cases that pass, and of the texts of case files.
inline constexpr size_t kReferenceBudget = size_t{2} << 20;
inline constexpr size_t kSourceBudget = size_t{3} << 18;

struct PageData {
    nlohmann::ordered_json json;  // read when the page opens
    std::string on_demand;        // JSON: references and case files, read when a case asks for them
    std::vector<size_t> left_out;  // cases whose pictures do not fit, by their numbers in the run
};

// `part`: 1 for the first page of a run. The page says of what is left out that it stands in the
// next part.
PageData page_data(const Run& run, size_t part);

// A cause as the pages read it; cases are told by their numbers, the one to look at first.
nlohmann::ordered_json cause_json(const Cause& cause,
                                  const std::function<size_t(const CaseRecord&)>& number_of);

}  // namespace report
