// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "cases/model/profile.hpp"
#include "mutants/software.hpp"

namespace mutants {

// Which cases must notice a fault.
struct ExpectedCatch {
    Fault fault = kNoFault;
    cases::Profile profile = cases::Profile::direct3d;  // the loosest at which they must
    std::vector<std::string_view> cases;  // ids; without a matrix part: some leaf of the file
};
// One row for each fault.
std::vector<ExpectedCatch> expected_catches();
// The parts of it that are about colours, resolves and blits, about the stencil, discards, written
// depths and depth bounds, and about devices that take a case for another one.
std::vector<ExpectedCatch> expected_color_catches();
std::vector<ExpectedCatch> expected_fragment_catches();
std::vector<ExpectedCatch> expected_state_catches();

}  // namespace mutants
