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

#include "ref/value/accept/judge_candidates.hpp"

namespace ref::value {

// Whether one place explains all inputs that are decorated alike, of candidate `index` of a set;
// `blamed`: one that it does not. Each of them alone has been found to fit somewhere; with a single
// one that is enough. Polygons are cut in rationals: unknown of Balls that are no exact set's.
template <class T>
Answer has_one_point(const CandidateSet<T>& set, size_t index, const OnePoint& where,
                     const Asked& asked, size_t& blamed);

}  // namespace ref::value
