// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What may be stored of a value, answered in binary64. Nothing is approximate here. The numbers of
// a floating-point format are binary64 numbers, and so are their neighbours: comparisons with them
// are exact. For a fixed-point format one product is rounded and compared with a whole number that
// binary64 holds; rounding keeps the order, so that a rounded product on one side of the whole
// number lies there before it is rounded, too. Only equality does not tell.
#pragma once

#include <cstdint>
#include <optional>

#include "ref/color/component.hpp"

namespace ref::color {

// Whether the code may be stored of a value of [low, high] that the shader wrote; nothing where
// only rationals tell. Infinite ends: any code may be.
std::optional<bool> may_store(const Component& component, double low, double high, uint32_t code,
                              cases::Profile profile);

}  // namespace ref::color
