// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The colours of a generated case, and what its draws do with those that are stored.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "cases/format/color_format.hpp"
#include "fuzz/generate/dice.hpp"
#include "fuzz/generate/pose.hpp"

namespace fuzz {

// The formats of poses that are not bare: with others their sequence, of which tests/hunt has a
// record, would be another one. Bare poses draw others, too (features.cpp).
inline constexpr auto kPoseFormats = std::span(cases::kColorFormats).first<12>();

// Four numbers that the pose's format can hold. Operands of a logical operation are codes of the
// format: any other number is rounded first, and where it lies half-way all bits are open.
std::string color_of(const Pose& pose, Dice& dice);

// The value of the key `color` of draw `number` of `draws`, which writes the colour `source`
// ("value = [...]" or "attribute = ..."). Early draws may do without what the last one has, and now
// and then the last one does without what they have. `turn` decides what costs a pipeline.
std::string color_keys_of(const Pose& pose, size_t number, size_t draws, std::string_view source,
                          Dice& turn, Dice& dice);

}  // namespace fuzz
