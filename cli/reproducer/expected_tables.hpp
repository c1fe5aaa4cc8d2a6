// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a reproducer holds the device to, as C tables (program/types.c tells what they hold).
#pragma once

#include <cstddef>
#include <string>

#include "cases/base/error.hpp"
#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/position/limits.hpp"

namespace cli {

// Of values in one program: some 10 MB, which a compiler takes in seconds.
inline constexpr size_t kMostRanges = 400'000;

// Bounds of the hits of every sample, which triangles may have written last, and the ranges of
// their values. Error, one sentence: there are more ranges than a C file should hold.
cases::Expected<std::string> expected_tables(const cases::Case& c, const ref::Limits& limits,
                                             cases::Profile profile);

}  // namespace cli
