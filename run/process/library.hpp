// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "capture/renderer.hpp"

namespace run {

// "the driver library X does not load: " and what dlopen says, asked in a process of its own; empty
// if it loads or its manifest has a problem already.
std::string load_problem(const capture::Driver& driver);

}  // namespace run
