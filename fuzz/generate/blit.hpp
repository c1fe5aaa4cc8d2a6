// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A generated case without draws: vkCmdBlitImage.
#pragma once

#include <cstdint>
#include <string>

#include "fuzz/generate/dice.hpp"
#include "fuzz/generate/pose.hpp"

namespace fuzz {

// The tables [target.color] and [blit] of a case whose target has this size. Nothing of a blit
// costs a pipeline, so all of it is drawn anew for each case but for the filter.
std::string blit_of(const Pose& pose, uint32_t width, uint32_t height, Dice& dice);

}  // namespace fuzz
