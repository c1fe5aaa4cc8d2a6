// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "capture/blank_capture.hpp"

#include "cases/model/derive.hpp"
#include "cases/model/sample.hpp"

namespace capture {

Capture blank_capture(const cases::Case& c) {
    Capture out;
    out.target = c.target;
    out.has_primitive = true;
    out.attribute_count = cases::attributes_of(c);
    const size_t count = out.sample_count();
    out.hits.assign(count, {0, 0, kHitGuard, kHitGuard});
    out.writers.assign(count, Writer{});
    out.frag_coord.assign(count, glm::vec4(kClearValue));
    out.depth.assign(count, nearest_depth(c.target.depth_clear, c.target.depth_format));
    if (cases::asks_queries(c)) {
        out.counted.assign(c.draws.size(), 0);
    }
    for (uint32_t a = 0; a < out.attribute_count; ++a) {
        out.attributes.at(a).assign(count, glm::vec4(kClearValue));
    }
    return out;
}

}  // namespace capture
