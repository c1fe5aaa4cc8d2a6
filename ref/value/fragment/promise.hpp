// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Says of which values of a triangle anything is promised (docs/precision.md, "Bases").
#pragma once

#include <span>
#include <vector>

#include "ref/value/fragment/quantities.hpp"

namespace ref::value {

struct Promise {
    bool is_number = true;      // false: binary32 may have none for it, no profile asks for it
    bool is_guaranteed = true;  // false: beyond the magnitudes that Vulkan guarantees
};

// Says it of each quantity; the positions must be finite.
std::vector<Promise> promises_of(const Primitive& primitive, std::span<const Quantity> quantities);

}  // namespace ref::value
