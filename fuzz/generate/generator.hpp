// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Cases out of everything that the case format can say. A seed and a number make a case, on every
// machine alike.
#pragma once

#include <cstdint>
#include <string>

#include "fuzz/generate/pose.hpp"

namespace fuzz {

// So many geometries are drawn with a pose, as compiling one costs a driver as much as drawing
// them: the cases of pose k have the numbers from k * kGeometries on.
inline constexpr uint64_t kGeometries = 64;

// The text of a case file: `pose` with a geometry of its own for each number. Not every pose is a
// case; the loader says which.
std::string case_text(uint64_t seed, const Pose& pose, uint64_t pose_number, uint64_t number);

// Whether the loader takes the pose's cases.
bool is_case(uint64_t seed, const Pose& pose, uint64_t pose_number);

}  // namespace fuzz
