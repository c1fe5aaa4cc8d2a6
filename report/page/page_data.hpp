// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the script of report.html reads: every case, and as much of the failing ones as a page may
// weigh.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "report/record/run.hpp"

namespace report {

// Bytes of JSON that pictures, triangles and values may take together. With findings, the list of
// cases and the script a page stays below 8 MB; what does not fit goes to further pages.
inline constexpr size_t kEvidenceBudget = size_t{4} << 20;

// `part`: 1 for the first page of a run. Cases whose pictures do not fit go into `left_out`, by
// their numbers in the run; the page says that they stand in the next part.
nlohmann::ordered_json page_data(const Run& run, size_t part, std::vector<size_t>& left_out);

}  // namespace report
