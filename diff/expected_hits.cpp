// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Hand-drawn pictures of case files against the reference.
#include <fmt/format.h>

#include "diff/attribution.hpp"
#include "diff/verdict.hpp"

namespace diff {

std::string check_expected_hits(const cases::Case& c) {
    if (!c.claim.expected_hits) {
        return {};
    }
    const ref::Expectation e = ref::expect(c, ref::Limits{8}, cases::Profile::direct3d);
    // Row (layer * samples + s) * height + y is row y of sample s of a layer.
    const std::vector<std::string>& rows = c.claim.expected_hits->rows;
    for (size_t row = 0; row < rows.size(); ++row) {
        const auto picture = static_cast<uint32_t>(row / c.target.height);
        cases::SampleId id{0, static_cast<uint32_t>(row % c.target.height),
                           picture % c.target.samples, picture / c.target.samples};
        for (size_t x = 0; x < c.target.width; ++x) {
            id.x = static_cast<uint32_t>(x);
            const ref::HitBounds& b = e.samples[cases::index_of(c.target, id)].hits;
            const char drawn = rows[row][x];
            const char reference = b.total_min != b.total_max ? '?'
                                   : b.total_min == 0         ? '.'
                                   : b.total_min <= 9         ? static_cast<char>('0' + b.total_min)
                                                              : '#';
            if (drawn != reference) {
                return fmt::format(
                    "the picture has '{}' at {}, the reference says {}", drawn,
                    cases::sample_text(c.target, id),
                    to_text(b) + (b.total_min == 1 && b.total_max == 1 ? " hit" : " hits"));
            }
        }
    }
    return {};
}

}  // namespace diff
