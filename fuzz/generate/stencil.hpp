// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The stencil state of a generated draw.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/generate/dice.hpp"
#include "fuzz/generate/pose.hpp"

namespace fuzz {

// What the stencil is cleared to; 0, and no cast of the dice, by default.
uint32_t stencil_clear_of(const Pose& pose, Dice& dice);

// The value of the key `stencil` of draw `number`; empty where it counts. Early draws write what
// later ones are compared with. `turn` decides what costs a pipeline here and there: operations and
// masks.
std::string stencil_of(const Pose& pose, size_t number, uint32_t clear, Dice& turn, Dice& dice);

}  // namespace fuzz
