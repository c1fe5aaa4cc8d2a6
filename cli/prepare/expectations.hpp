// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The expectation files of a run, and the files of pictures beside them.
#pragma once

#include <map>
#include <string>

#include "cli/options/options.hpp"
#include "cli/prepare/run_plan.hpp"
#include "run/expected/expectation_file.hpp"

namespace cli {

// What the expectation files say of each id, those of --expect or those beside the suite that fit
// the header's device; their names go into the header. Files beside a suite speak of its cases
// alone: a new case of one's own that fails is news, whatever its id.
std::map<std::string, run::ExpectationLine> expectations_of(const RunOptions& options,
                                                            const Selection& selection,
                                                            report::Run& header);

}  // namespace cli
