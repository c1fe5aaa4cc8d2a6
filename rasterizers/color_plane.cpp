// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/color_plane.hpp"

#include <algorithm>

#include "ref/color/color.hpp"

namespace rasterizers {

void add_color_plane(capture::Capture& capture, const cases::Case& c,
                     const ref::Expectation& expectation,
                     const std::map<size_t, std::vector<uint32_t>>& shown) {
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
        const auto hits = static_cast<uint32_t>(capture.hits[index].x + capture.hits[index].y);
        const ref::SampleExpectation& sample = expectation.samples[index];
        const cases::SampleId id = cases::sample_at(c.target, index);
        if (hits == 0) {
            // A clear among the draws leaves a colour without a hit.
            if (std::ranges::any_of(expectation.fragments_of(sample),
                                    &ref::path::Fragment::is_clear)) {
                ref::ColorWitness none;
                none.paths.hits = {ref::path::SeenHits::Detail::total, 0, 0};
                capture.color[index] = reference.codes(index, id, none);
            }
            continue;
        }
        const capture::Writer& writer = capture.writers[index];
        const auto wrote = [&](uint32_t t) {
            const cases::Triangle& triangle = expectation.triangles[t];
            return triangle.draw == writer.draw && triangle.primitive == writer.primitive &&
                   triangle.provoking == writer.provoking_vertex;
        };
        ref::ColorWitness witness;
        witness.paths.hits = {ref::path::SeenHits::Detail::total, hits, 0};
        for (const ref::path::Fragment& f : expectation.fragments_of(sample)) {
            witness.paths.last.push_back(wrote(f.triangle));
        }
        for (size_t a = 0; a < capture.attribute_count; ++a) {
            witness.written.at(a) = &capture.attributes.at(a)[index];
        }
        const bool is_known =
            std::ranges::find(witness.paths.last, true) != witness.paths.last.end();
        if (!is_known) {
            continue;
        }
        const auto path = shown.find(index);
        capture.color[index] = path != shown.end()
                                   ? reference.codes_after(path->second, id, witness)
                                   : reference.codes(index, id, witness);
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
