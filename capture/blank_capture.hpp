// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "capture/capture.hpp"

namespace capture {

// The instruments' planes of a case in which nothing was drawn: no hits, no writers, clear values.
// Colour, stencil and resolved planes are empty.
Capture blank_capture(const cases::Case& c);

}  // namespace capture
