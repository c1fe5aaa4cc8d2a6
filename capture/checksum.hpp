// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Checksums of captures, to compare runs with.
#pragma once

#include <cstdint>

#include "capture/capture.hpp"

namespace capture {

// A hash of every bit of a capture.
uint64_t capture_bits(const CaptureView& capture);
// A hash of the hits alone.
uint64_t hit_bits(const CaptureView& capture);

// Bytes that a case's capture takes.
uint64_t capture_bytes(const cases::Case& c);

}  // namespace capture
