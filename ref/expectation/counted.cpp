// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/expectation/counted.hpp"

#include <algorithm>

namespace ref {

CountBounds passed_at(const Expectation& e, const cases::Case& c, size_t index, uint32_t draw,
                      const ShownSample& shown, bool with_discarded) {
    const SampleExpectation& s = e.samples[index];
    std::vector<bool> of;
    for (const path::Fragment& f : e.fragments_of(s)) {
        const bool is_counted = s.is_open || with_discarded || !f.is_discarded_front;
        of.push_back(is_counted && e.triangles[f.triangle].draw == draw);
    }
    const auto most = static_cast<uint64_t>(std::ranges::count(of, true));
    if (!s.is_open) {
        return {most, most};
    }
    if (s.is_free || most == 0) {
        return {0, most};
    }
    const path::Question question = question_of(e, c, s);
    path::Observed observed = shown.paths;
    auto& counting = observed.counting.emplace(std::move(of), with_discarded);
    const auto counted = path::counted_by(question, observed);
    if (!counted) {
        return {0, most};
    }
    CountBounds out{counted->least, counted->most};
    // The ends of what the other planes allow may be colours that the sample has not.
    const auto may_be = [&](uint64_t number) {
        counting.number = static_cast<uint32_t>(number);
        return !shown.has_color ||
               (path::counted_by(question, observed) && shown.has_color(observed));
    };
    while (out.least < out.most && !may_be(out.least)) {
        ++out.least;
    }
    while (out.least < out.most && !may_be(out.most)) {
        --out.most;
    }
    return out;
}

CountBounds counted_at(const Expectation& e, const cases::Case& c, size_t index, uint32_t draw,
                       const ShownSample& shown) {
    CountBounds out = passed_at(e, c, index, draw, shown, true);
    // "Fragment shading may be performed before" the counting.
    if (e.profile == cases::Profile::vulkan && stores_discarded(c.draws[draw])) {
        out.least = passed_at(e, c, index, draw, shown, false).least;
    }
    return out;
}

std::vector<CountBounds> count_bounds(const Expectation& expectation, const cases::Case& c,
                                      const ShownAt& shown) {
    std::vector<CountBounds> out(c.draws.size());
    if (!counts_fragments(c)) {
        return out;
    }
    std::vector<uint64_t> triangles(c.draws.size());
    for (const cases::Triangle& triangle : expectation.triangles) {
        ++triangles[triangle.draw];
    }
    for (size_t index = 0; index < expectation.samples.size(); ++index) {
        const SampleExpectation& sample = expectation.samples[index];
        const ShownSample here = shown ? shown(index) : ShownSample{};
        for (uint32_t draw = 0; draw < c.draws.size(); ++draw) {
            if (!counts_fragments(c.draws[draw].query)) {
                continue;
            }
            if (here.is_right) {
                const CountBounds bounds = counted_at(expectation, c, index, draw, here);
                out[draw].least += bounds.least;
                out[draw].most += bounds.most;
                continue;
            }
            const uint64_t most =
                here.hits ? std::max(*here.hits, sample.hits.total_max) : UINT64_MAX;
            out[draw].most += std::min(triangles[draw], most);
            // And what is discarded once it has passed.
            out[draw].most += stores_discarded(c.draws[draw])
                                  ? passed_at(expectation, c, index, draw, {}, true).most
                                  : 0;
        }
    }
    return out;
}

}  // namespace ref
