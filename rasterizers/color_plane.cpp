// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/color_plane.hpp"

#include <algorithm>

#include "ref/color/color.hpp"

namespace rasterizers {

void add_color_plane(capture::Capture& capture, const cases::Case& c,
                     const ref::Expectation& expectation) {
    if (!c.target.color) {
        return;
    }
    const size_t n = capture.sample_count();
    const ref::color::Unit unit{c.target.color->format, expectation.profile};
    capture.color.assign(n, unit.codes_of(unit.cleared(*c.target.color)));
    if (c.blit) {
        return;
    }
    ref::ColorReference reference(c, expectation);
    for (size_t index = 0; index < n; ++index) {
        ref::ColorWitness witness;
        witness.hits = static_cast<uint32_t>(capture.hits[index].x + capture.hits[index].y);
        if (witness.hits == 0) {
            continue;
        }
        const capture::Writer& writer = capture.writers[index];
        const auto wrote = std::find_if(
            expectation.triangles.begin(), expectation.triangles.end(), [&](const auto& t) {
                return t.draw == writer.draw && t.primitive == writer.primitive;
            });
        if (wrote == expectation.triangles.end()) {
            continue;
        }
        witness.writer = static_cast<uint32_t>(wrote - expectation.triangles.begin());
        const int32_t attribute = c.draws[writer.draw].color.attribute;
        if (attribute >= 0) {
            witness.written = &capture.attributes[static_cast<size_t>(attribute)][index];
        }
        capture.color[index] = reference.codes(index, cases::sample_at(c.target, index), witness);
    }
}

void drop_unattached(capture::Capture& capture) {
    capture::for_each_plane(
        [](const capture::Plane& plane, auto& entries) {
            if (plane.entries == 0) {
                entries.clear();
            }
        },
        capture, capture);
}

}  // namespace rasterizers
