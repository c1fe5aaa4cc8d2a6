// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A case as one C99 program for a bug report: it needs the Vulkan loader and its headers alone.
#pragma once

#include <string>
#include <string_view>

#include "cases/base/error.hpp"
#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/position/limits.hpp"

namespace cli {

// The part of a case that no such program can draw or judge ("a blit"); empty if there is none.
std::string_view undrawable_part(const cases::Case& c);

// Whether a program may have more ranges of values than are written (kMostRanges): where each
// sample has its own for one triangle. Which they are is known only when all have been judged.
bool may_be_too_large(const cases::Case& c);

// The program's text. It draws the case by the harness's own shaders and holds every sample to the
// reference at the profile: hits, the last writer, and each value to the range of all numbers that
// are right for it. Exit code 0: all are right; 1, with a line for each: some are wrong; 2: it
// could not be drawn. A range knows nothing of other values, so that a device whose values are
// right one by one, but by no set-up together, passes. Error, one sentence: what the case has that
// the program cannot draw.
cases::Expected<std::string> reproducer(const cases::Case& c, const ref::Limits& limits,
                                        cases::Profile profile, std::string_view version);

}  // namespace cli
