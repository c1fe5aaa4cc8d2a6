// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/counted.hpp"

#include <algorithm>

#include "ref/expectation/narrowing.hpp"

namespace ref {

void add_counted(Expectation& out, const cases::Case& c, std::span<const Hit> hits,
                 std::span<const stencil::Fate> fates, SampleExpectation& sample) {
    if (!asks_queries(c)) {
        return;
    }
    sample.counted_begin = static_cast<uint32_t>(out.counted.size());
    for (size_t k = 0; k < fates.size(); ++k) {
        const stencil::Fate& fate = fates[k];
        if (!fate.passes && !fate.is_discarded) {
            continue;
        }
        const uint32_t draw = out.triangles[hits[k].triangle].draw;
        const bool is_new =
            out.counted.size() == sample.counted_begin || out.counted.back().draw != draw;
        if (is_new) {
            out.counted.push_back({draw});
        }
        CountedDraw& counted = out.counted.back();
        const bool is_sure =
            !fate.fails && !fate.fails_depth && !fate.fails_bounds && !fate.is_absent;
        counted.shown_least += is_sure && !fate.is_discarded ? 1 : 0;
        counted.shown_most += fate.passes ? 1 : 0;
        counted.hidden_least += is_sure && !fate.passes ? 1 : 0;
        counted.hidden_most += fate.is_discarded ? 1 : 0;
    }
    sample.counted_count = static_cast<uint32_t>(out.counted.size()) - sample.counted_begin;
}

CountBounds counted_at(std::span<const CountedDraw> draws, size_t k, uint32_t least, uint32_t most,
                       cases::Profile profile) {
    uint32_t others_least = 0;
    uint32_t others_most = 0;
    for (size_t other = 0; other < draws.size(); ++other) {
        others_least += other == k ? 0 : draws[other].shown_least;
        others_most += other == k ? 0 : draws[other].shown_most;
    }
    const auto beyond = [](uint32_t n, uint32_t taken) { return n > taken ? n - taken : 0; };
    const CountedDraw& d = draws[k];
    const bool is_hidden_sure = profile != cases::Profile::vulkan;
    return {uint64_t{std::max(d.shown_least, beyond(least, others_most))} +
                (is_hidden_sure ? d.hidden_least : 0),
            uint64_t{std::min(d.shown_most, beyond(most, others_least))} + d.hidden_most};
}

std::vector<CountBounds> count_bounds(const Expectation& expectation, size_t draws,
                                      const HitsAt& hits) {
    std::vector<CountBounds> out(draws);
    std::vector<uint64_t> triangles(draws);
    for (const cases::Triangle& triangle : expectation.triangles) {
        ++triangles[triangle.draw];
    }
    for (size_t index = 0; index < expectation.samples.size(); ++index) {
        const SampleExpectation& sample = expectation.samples[index];
        const std::span<const CountedDraw> counted = expectation.counted_of(sample);
        const HitBounds& expected = sample.hits;
        std::optional<uint32_t> shown;
        if (hits) {
            shown = hits(index);
            if (!shown || *shown < expected.total_min || *shown > expected.total_max) {
                const uint64_t most = shown ? std::max(*shown, expected.total_max) : UINT64_MAX;
                for (size_t draw = 0; draw < draws; ++draw) {
                    out[draw].most += std::min(triangles[draw], most);
                }
                for (const CountedDraw& d : counted) {
                    out[d.draw].most += d.hidden_most;
                }
                continue;
            }
        }
        for (size_t k = 0; k < counted.size(); ++k) {
            const CountBounds bounds =
                counted_at(counted, k, shown.value_or(expected.total_min),
                           shown.value_or(expected.total_max), expectation.profile);
            out[counted[k].draw].least += bounds.least;
            out[counted[k].draw].most += bounds.most;
        }
    }
    return out;
}

}  // namespace ref
