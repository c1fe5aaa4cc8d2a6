// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "capture/capture.hpp"

namespace capture {

// The same planes in memory of their own.
Capture copy_of(const CaptureView& view);

}  // namespace capture
