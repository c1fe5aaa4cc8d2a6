// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the attachments of one sample say of it where they contradict each other.
#pragma once

#include <cstddef>
#include <string>

#include "capture/capture.hpp"

namespace diff {

// "hits 193 front, 0 back; writer: nothing drawn": the hit counter, then the planes that disagree
// with it. The sample's state is `inconsistent`.
std::string contradiction_text(const capture::CaptureView& capture, size_t index);

}  // namespace diff
