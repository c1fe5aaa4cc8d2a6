// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0

#include "capture/blank_capture.hpp"
#include "rasterizers/captures.hpp"
#include "rasterizers/color_plane.hpp"
#include "ref/expectation/expectation.hpp"

namespace rasterizers {

capture::Capture draw_by_algorithm(const cases::Case& c, const Device& device) {
    const std::vector<DrawnSample> drawn = draw(c, device);
    capture::Capture capture = capture::blank_capture(c);
    const size_t n = capture.sample_count();
    for (size_t index = 0; index < n; ++index) {
        const DrawnSample& sample = drawn[index];
        const uint32_t hits = sample.front + sample.back;
        if (hits == 0) {
            continue;
        }
        capture.hits[index] = {static_cast<float>(sample.front), static_cast<float>(sample.back),
                               capture::kHitGuard, capture::kHitGuard + static_cast<float>(hits)};
        capture.writers[index] = {sample.last.draw, sample.last.primitive, sample.last.provoking,
                                  capture::kClearId};
        capture.frag_coord[index] = sample.values.frag_coord;
        capture.depth[index] = sample.values.depth;
        for (uint32_t a = 0; a < capture.attribute_count; ++a) {
            const bool is_written = a < c.draws[sample.last.draw].attributes.size();
            capture.attributes[a][index] =
                is_written ? sample.values.attributes[a] : glm::vec4(capture::kClearValue);
        }
    }
    if (c.target.color) {
        add_color_plane(capture, c, ref::expect(c, ref::Limits{}, cases::Profile::direct3d));
    }
    drop_unattached(capture);
    return capture;
}

}  // namespace rasterizers
