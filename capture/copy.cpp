// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/copy.hpp"

namespace capture {

Capture copy_of(const CaptureView& from) {
    Capture to;
    to.target = from.target;
    to.has_primitive = from.has_primitive;
    to.has_half_hits = from.has_half_hits;
    to.renderings = from.renderings;
    to.attribute_count = from.attribute_count;
    to.counted = from.counted;
    for_each_plane([](const Plane&, const auto& source,
                      auto& plane) { plane.assign(source.begin(), source.end()); },
                   from, from, to);
    return to;
}

}  // namespace capture
