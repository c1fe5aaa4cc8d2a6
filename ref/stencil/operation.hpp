// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The stencil test of one fragment and what it stores. Sources: Vulkan specification, "Stencil
// Test", VkStencilOp, VkCompareOp. The stencil is an unsigned integer of eight bits, and all
// arithmetic on it exact.
#pragma once

#include <bitset>
#include <cstdint>

#include "cases/model/case.hpp"

namespace ref::stencil {

using Values = std::bitset<256>;  // a set of stencil values

// Whether the stencil of a case is more than a count of its hits, by which diff/resolve.hpp judges
// it: some draw tests it or has operations of its own, or stores it of fragments that it discards,
// it is not cleared to 0, or no hits are counted.
bool is_needed(const cases::Case& c);

// Whether a fragment passes the stencil test.
bool passes(const cases::StencilFace& face, uint32_t stored);
// What an operation leaves, its write mask included.
uint32_t updated(cases::StencilOp op, const cases::StencilFace& face, uint32_t stored);

}  // namespace ref::stencil
