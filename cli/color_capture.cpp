// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "cli/backend.hpp"
#include "ref/color.hpp"
#include "ref/expectation.hpp"

namespace cli {

void add_color(diff::Capture& capture, const cases::Case& c) {
    if (c.target.color) {
        const ref::Expectation expectation =
            ref::expect(c, ref::Limits{}, cases::Profile::direct3d);
        ref::ColorReference reference(c, expectation);
        const size_t n = capture.sample_count();
        capture.color.resize(n);
        for (size_t index = 0; index < n; ++index) {
            const size_t pixel = index / c.target.samples;
            const ref::SampleId id{static_cast<uint32_t>(pixel % c.target.width),
                                   static_cast<uint32_t>(pixel / c.target.width),
                                   static_cast<uint32_t>(index % c.target.samples)};
            ref::ColorWitness witness;
            witness.hits = static_cast<uint32_t>(capture.hits[index].x + capture.hits[index].y);
            const diff::Writer& writer = capture.writers[index];
            const auto wrote =
                std::find_if(expectation.triangles.begin(), expectation.triangles.end(),
                             [&](const ref::Triangle& t) {
                                 return t.draw == writer.draw && t.primitive == writer.primitive;
                             });
            if (witness.hits > 0 && wrote != expectation.triangles.end()) {
                witness.writer = static_cast<uint32_t>(wrote - expectation.triangles.begin());
                const int32_t attribute = c.draws[writer.draw].color.attribute;
                if (attribute >= 0) {
                    witness.written = &capture.attributes[static_cast<size_t>(attribute)][index];
                }
            }
            capture.color[index] = reference.codes(index, id, witness);
        }
    }
    if (!c.target.has_instruments) {
        capture.hits.clear();
        capture.writers.clear();
        capture.frag_coord.clear();
        for (auto& attribute : capture.attributes) {
            attribute.clear();
        }
    }
    if (!c.target.has_depth) {
        capture.depth.clear();
    }
}

}  // namespace cli
