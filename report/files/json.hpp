// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// results.json, a pure function of a Run.
#pragma once

#include <string>

#include "report/record/run.hpp"

namespace report {

// results.json, schema docs/schema/results-1.json. Floats never appear as NaN or infinity.
std::string to_json(const Run& run);

}  // namespace report
