// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// How far a document is from simple. Every step of the reducer makes it less, so that it ends.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "fuzz/document/document.hpp"

namespace fuzz {

// Compared from the first entry on: what makes a case hard for a person most stands first.
using Measure = std::array<uint64_t, 9>;

// Draws; triangles; draws with indices and draws of strips or fans; samples; layers; pixels of the
// target and of a blit's source; attributes, clip and cull distances; keys and elements of arrays;
// cost of all numbers and words (cost_of).
Measure measure(const Document& document);

// The number that a value stands for, rounded to binary64: integers, floats and expressions without
// names. Nothing for words, other expressions, NaNs and infinities.
std::optional<double> value_of(const Document& value);

// The format of a colour target that is plainest, which costs less than any other word.
inline constexpr std::string_view kPlainFormat = "rgba8-unorm";

// What a value costs its reader: 0 for 0; for other numbers the bits before the binary point, those
// of them down to the last that is set, and three times the bits after the point, so that rounding
// to fewer of these always costs less; one more for a sign, and for a number that is not written as
// number() would. Expressions and words cost their letters too, NaNs and infinities a constant.
uint64_t cost_of(const Document& value);

}  // namespace fuzz
