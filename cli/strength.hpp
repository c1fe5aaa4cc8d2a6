// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The second half of "lint --strength".
#pragma once

#include "cli/prepare/suite.hpp"

namespace cli {

// Tells of each selected file which faults of the software device (docs/mutants.md) its selected
// cases catch: the level, the rule, what the device does wrong, and how many families of the suite
// catch it, too; the rarest first. Errors: cases with which the device has a finding without any
// fault, so that they say nothing.
cases::Errors tell_strength(const LoadedSuite& suite, const std::vector<size_t>& selected,
                            bool quiet);

}  // namespace cli
