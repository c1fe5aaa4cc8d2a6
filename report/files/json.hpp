// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// results.json, a pure function of a Run.
#pragma once

#include <string>

#include "cases/base/output_file.hpp"
#include "report/record/run.hpp"

namespace report {

// results.json, schema docs/schema/results-1.json, piece after piece, since it may be long. Floats
// never appear as NaN or infinity.
void tell_json(const Run& run, const cases::Put& put);
std::string to_json(const Run& run);

}  // namespace report
