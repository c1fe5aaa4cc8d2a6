// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// vkCmdBlitImage as drivers do it: coordinates and filter in binary32, weights of 8 bits.
#pragma once

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

// The colour plane of a case with a blit; there are no other planes.
capture::Capture blit(const cases::Case& c, const Device& device);

}  // namespace software
