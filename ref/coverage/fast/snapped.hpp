// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Scanning what nearly every triangle of a mesh is at profile direct3d: whole, with vertices that
// are snapped to one of a few grid points each, and not far away. The same spans as from the sets
// of half planes (ref/coverage/fast/half_plane.hpp), without building these.
//
// A sample is covered by a candidate, one choice of grid points with an area, if it is inside its
// three edges by the top-left rule; may is the union of the candidates, must their intersection,
// empty if one has no area. So the columns of a row that must be covered are those that every
// candidate covers, and no list of all edges is needed for them: inside its three edges a sample is
// inside the candidate's bounds too, which are all that its columns are cut by besides.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/model/case.hpp"
#include "ref/coverage/fast/fast.hpp"
#include "ref/coverage/setup.hpp"

namespace ref::fast {

// Whether the set-up may be scanned so.
bool is_plain_snapped(const TriangleSetup& setup);

// Does what scan does, for such a set-up.
void scan_snapped(const TriangleSetup& setup, uint32_t triangle, const cases::Target& target,
                  std::vector<Span>& out);

// Does what scan does, for every set-up, by half planes. scan_snapped is tested against it.
void scan_by_sets(const TriangleSetup& setup, uint32_t triangle, const cases::Target& target,
                  std::vector<Span>& out);

}  // namespace ref::fast
