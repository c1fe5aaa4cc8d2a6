// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "capture/blank_capture.hpp"
#include "rasterizers/color_planes.hpp"
#include "ref/expectation/expectation.hpp"
#include "run/worker/backend.hpp"

namespace cli {

diff::Capture draw_by_algorithm(const cases::Case& c, const ref::algorithms::Device& device) {
    const std::vector<ref::algorithms::DrawnSample> drawn = ref::algorithms::draw(c, device);
    diff::Capture capture = diff::blank_capture(c);
    const size_t n = capture.sample_count();
    for (size_t index = 0; index < n; ++index) {
        const ref::algorithms::DrawnSample& sample = drawn[index];
        const uint32_t hits = sample.front + sample.back;
        if (hits == 0) {
            continue;
        }
        capture.hits[index] = {static_cast<float>(sample.front), static_cast<float>(sample.back),
                               diff::kHitGuard, diff::kHitGuard + static_cast<float>(hits)};
        capture.writers[index] = {sample.last.draw, sample.last.primitive, sample.last.provoking,
                                  diff::kClearId};
        capture.frag_coord[index] = sample.values.frag_coord;
        capture.depth[index] = sample.values.depth;
        for (uint32_t a = 0; a < capture.attribute_count; ++a) {
            const bool is_written = a < c.draws[sample.last.draw].attributes.size();
            capture.attributes[a][index] =
                is_written ? sample.values.attributes[a] : glm::vec4(diff::kClearValue);
        }
    }
    if (c.target.color) {
        diff::add_color_plane(capture, c, ref::expect(c, ref::Limits{}, cases::Profile::direct3d));
    }
    diff::drop_unattached(capture, c);
    return capture;
}

}  // namespace cli
