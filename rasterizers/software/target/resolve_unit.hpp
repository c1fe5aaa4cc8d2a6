// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the device makes of a pixel's samples at the end of rendering.
#pragma once

#include "capture/capture.hpp"
#include "rasterizers/software/choice/device.hpp"

namespace software {

// Fills the resolved planes from the capture's samples.
void resolve(capture::Capture& capture, const Device& device);

}  // namespace software
