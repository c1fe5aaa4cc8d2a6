// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/counted.hpp"

#include <algorithm>

#include "ref/expectation/narrowing.hpp"

namespace ref {

void add_counted(Expectation& out, const cases::Case& c, std::span<const Hit> hits,
                 std::span<const stencil::Fate> fates, SampleExpectation& sample) {
    if (!counts_fragments(c)) {
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
        const bool is_either = fate.passes && fate.is_discarded;
        uint32_t& least = is_either     ? counted.either_least
                          : fate.passes ? counted.shown_least
                                        : counted.hidden_least;
        uint32_t& most = is_either     ? counted.either_most
                         : fate.passes ? counted.shown_most
                                       : counted.hidden_most;
        least += is_sure ? 1 : 0;
        most += 1;
    }
    sample.counted_count = static_cast<uint32_t>(out.counted.size()) - sample.counted_begin;
}

namespace {

uint32_t beyond(uint32_t n, uint32_t taken) {
    return n > taken ? n - taken : 0;
}

// How many fragments of the k-th draw show at least, and at most, where those of all draws are
// between `least` and `most`.
CountBounds shown_at(std::span<const CountedDraw> draws, size_t k, uint32_t least, uint32_t most) {
    uint32_t others_least = 0;
    uint32_t others_most = 0;
    for (size_t other = 0; other < draws.size(); ++other) {
        const CountedDraw& d = draws[other];
        others_least += other == k ? 0 : d.shown_least;
        others_most += other == k ? 0 : d.shown_most + d.either_most;
    }
    const CountedDraw& d = draws[k];
    return {std::max(d.shown_least, beyond(least, others_most)),
            std::min(d.shown_most + d.either_most, beyond(most, others_least))};
}

}  // namespace

CountBounds counted_at(std::span<const CountedDraw> draws, size_t k, uint32_t least, uint32_t most,
                       cases::Profile profile) {
    const CountBounds shown = shown_at(draws, k, least, most);
    const CountedDraw& d = draws[k];
    return {profile == cases::Profile::vulkan ? shown.least : passed_least(draws, k, least, most),
            std::min(uint64_t{d.shown_most}, shown.most) + d.either_most + d.hidden_most};
}

uint64_t passed_least(std::span<const CountedDraw> draws, size_t k, uint32_t least, uint32_t most) {
    const uint64_t shown = shown_at(draws, k, least, most).least;
    const CountedDraw& d = draws[k];
    // Of those that show some may be fragments that could have been discarded.
    const uint64_t others = shown > d.either_most ? shown - d.either_most : 0;
    return std::max(shown, std::max(uint64_t{d.shown_least}, others) + d.either_least) +
           d.hidden_least;
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
