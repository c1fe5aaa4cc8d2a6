// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether one point of a part of the pixel explains several values of a fragment at once.
//
// |f(p) - v| <= r with f = N/D and D > 0 is |N(p) - v D(p)| <= r D(p): with r bounded over the
// region, two half planes for each value. The region is cut by all of them; what is left are the
// points that explain everything. r is taken as the largest that any point of the region could
// allow, so that a device is never blamed for a point that the budget would have let pass.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ref/number/plane_budget.hpp"
#include "ref/value/fragment/quantities.hpp"

namespace ref::value {

// The first of the quantities `which` (indices) that leaves no point of the region, given those
// before it; nothing if one point explains all of them. `factor` is K.
std::optional<size_t> first_unexplained(const Basis<mpq_class>& basis, const mpq_class& factor,
                                        std::vector<Point<mpq_class>> region,
                                        std::span<const Quantity> quantities,
                                        std::span<const size_t> which,
                                        const FragmentValues& device);

}  // namespace ref::value
