// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs of samples that hold what is expected of all of them, found by whole stretches of memory.
#pragma once

#include <cstddef>

#include "capture/capture.hpp"

namespace capture {

// How many samples from `first` on, of `count`, are proven to be SampleState::clear. The next one
// may be clear, too, in another way.
size_t count_clear(const CaptureView& c, size_t first, size_t count);

// How many samples from `first` on, of `count`, are proven to be SampleState::drawn, but for what
// FragCoord and depth hold: hit once, by the face that is asked for, and written by `writer`.
size_t count_hit_once(const CaptureView& c, size_t first, size_t count, bool is_front,
                      const Writer& writer);

// How many samples from `first` on, of `count`, have the colour of the first one.
size_t count_same_color(const CaptureView& c, size_t first, size_t count);

}  // namespace capture
