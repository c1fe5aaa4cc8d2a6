// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "ref/coverage/exact/exact.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/coverage/triangle_setups.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/narrowing.hpp"
#include "ref/path/exact.hpp"

namespace ref::exact {

Expectation expect(const cases::Case& c, const Limits& limits, cases::Profile profile) {
    Expectation out;
    out.limits = limits;
    out.profile = profile;
    out.target = c.target;
    out.triangles = assemble(c);
    out.samples = SampleExpectations(size_t{c.target.width} * c.target.rows() * c.target.samples);
    size_t index = 0;
    TriangleSetups setups(c, out.triangles, limits, profile);
    std::optional<DepthTest> depth;
    if (DepthTest::is_needed(c)) {
        depth.emplace(c, out.triangles, limits, profile, true);
    }
    ValueDiscards discards(c, limits, profile, true);
    Narrowing narrowing(c, profile, out.triangles, setups,
                        {is_in_hull, winding, is_inside_whole, path::exact::resolve},
                        depth ? &*depth : nullptr, discards);
    for (uint32_t row = 0; row < c.target.rows(); ++row) {
        const uint32_t j = row % c.target.height;
        const uint32_t layer = row / c.target.height;
        for (uint32_t i = 0; i < c.target.width; ++i) {
            for (uint32_t s = 0; s < c.target.samples; ++s) {
                const FixedPoint p = sample_position(i, j, s, c.target);
                std::vector<Hit> hits;
                for (uint32_t t = 0; t < out.triangles.size(); ++t) {
                    const cases::Draw& draw = c.draws[out.triangles[t].draw];
                    if (layer_of(draw, out.triangles[t]) != layer ||
                        !setups[t].window.may_write(s) || takes_away_pixel(draw, i, j)) {
                        continue;
                    }
                    const Decision decision = decide(setups[t], p, false);
                    if (decision.coverage == Coverage::must_not) {
                        continue;
                    }
                    const Sign sign = takes_away_by_value(draw) ? discards.at(t, {i, j, s, layer})
                                                                : Sign::not_negative;
                    if (sign != Sign::negative) {
                        const Hit hit{t, decision.coverage};
                        hits.push_back(sign == Sign::open ? but_for_value(hit) : hit);
                        hits.insert(hits.end(), decision.further, {t, Coverage::either});
                    }
                }
                SampleExpectation sample = narrowing.judge(p, s, hits, out);
                out.must_samples += sample.hits.total_min > 0 ? 1U : 0U;
                out.either_samples += sample.hits.is_decided() ? 0U : 1U;
                out.samples.set(index++, 1, 1, out.samples.add(sample));
            }
        }
    }
    return out;
}

}  // namespace ref::exact
