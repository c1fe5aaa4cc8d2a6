// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Bare poses: the plainest pipelines, drawn as applications draw, by a way (cases/model/way.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/generate/dice.hpp"
#include "fuzz/generate/pose.hpp"

namespace fuzz {

// A way, one 8-bit format if it has a colour, a geometry (draws, size, z, w), and at most two other
// features, whatever the candidate is. `number`: among bare poses.
Pose bare_pose(uint64_t seed, uint64_t number, size_t candidate);

// The text of a case of a bare pose, drawn by the pose's way, with other colours at its vertices
// now and then. Empty if the way does not take it.
std::string by_way_of(const Pose& pose, const std::string& text, Dice& dice);

}  // namespace fuzz
