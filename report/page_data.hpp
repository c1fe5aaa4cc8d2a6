// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the script of report.html reads: every case, and as much of the failing ones as a page may
// weigh.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "report/run.hpp"

namespace report {

// Bytes of JSON that pictures, triangles and values may take together. With findings, the list of
// cases and the script a page stays below 8 MB; the page says what was left out, results.json holds
// every finding.
inline constexpr size_t kEvidenceBudget = size_t{9} << 19;  // 4.5 MiB

nlohmann::ordered_json page_data(const Run& run);

}  // namespace report
