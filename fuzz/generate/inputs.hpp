// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a generated draw has for each vertex beside its position: clip and cull distances,
// attributes. `state` decides what costs a pipeline.
#pragma once

#include <cstddef>
#include <string>

#include "fuzz/generate/dice.hpp"
#include "fuzz/generate/pose.hpp"

namespace fuzz {

// The tables [[draw.clip_distance]] and [[draw.cull_distance]] of a draw with so many vertices.
std::string distances_of(const Pose& pose, size_t vertices, Dice& dice);

// The tables [[draw.attribute]]; "c" is the colour, where it comes from an attribute. `has_sign`:
// some values are negative.
std::string attributes_of(const Pose& pose, size_t vertices, bool has_sign, Dice& state,
                          Dice& dice);

// A draw's text with all clip distances negated: the two share out what they draw.
std::string complement_of(std::string draw);

}  // namespace fuzz
