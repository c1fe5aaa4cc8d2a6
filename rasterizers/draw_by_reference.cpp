// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "capture/blank_capture.hpp"
#include "cases/model/sample.hpp"
#include "diff/consistency.hpp"
#include "rasterizers/captures.hpp"
#include "rasterizers/color_plane.hpp"
#include "ref/blit/blit.hpp"
#include "ref/color/color.hpp"
#include "ref/expectation/counted.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/statistics.hpp"
#include "ref/value/fragment/shading_rate.hpp"
#include "ref/value/reference.hpp"

namespace rasterizers {

namespace {

using Hits = std::pair<uint32_t, uint32_t>;  // by front and back faces

// The pairs of hits that a sample may have, fewest first.
std::vector<Hits> allowed_hits(const ref::Expectation& expectation,
                               const ref::SampleExpectation& sample) {
    std::vector<Hits> out;
    for (const ref::stencil::Outcome& outcome : expectation.stencils_of(sample)) {
        out.emplace_back(outcome.front, outcome.back);
    }
    const ref::HitBounds& bounds = sample.hits;
    for (uint32_t total = bounds.total_min; out.empty() && total <= bounds.total_max; ++total) {
        for (uint32_t front = 0; front <= total; ++front) {
            if (bounds.allows(front, total - front)) {
                out.emplace_back(front, total - front);
            }
        }
    }
    return out;
}

// A triangle and what it writes at a sample. The values are kept beside it, since the reference
// takes most of its time for them.
struct Writer {
    uint32_t triangle;
    std::vector<ref::ExpectedValue> values;
};

// The least stencil that goes with these hits.
uint32_t pick_stencil(const ref::Expectation& expectation, const ref::SampleExpectation& sample,
                      const Hits& hits) {
    const ref::stencil::Values values = stencils_at(expectation, sample, hits);
    uint32_t value = 0;
    while (!values[value]) {
        ++value;
    }
    return value;
}

// Whether the reference knows a nearest value; of a triangle without area it knows bounds only, and
// need not draw it.
bool has_nearest(const Writer& writer) {
    return std::ranges::any_of(writer.values, [](const ref::ExpectedValue& value) {
        return value.part.empty() && value.quantity == ref::QuantityId::of_frag_coord(2);
    });
}

// Whether the shader discards the nearest value, as it may where the value's sign is open.
bool is_discarded(const Writer& writer, const cases::Draw& draw) {
    const auto by = ref::QuantityId::of_attribute(draw.discard_attribute, 0);
    return cases::takes_away_by_value(draw) &&
           std::ranges::any_of(writer.values, [&](const ref::ExpectedValue& value) {
               return value.part.empty() && value.quantity == by && value.nearest < 0;
           });
}

// What became of a sample: its hits, and whose fragment was the last one.
struct Event {
    Hits hits{0, 0};
    std::optional<Writer> writer;  // nothing if there are no hits
};

// One event for a sample that may happen as a whole: a writer that is open is one hit more than
// those that are certain. `colors`: knows which go together, if the target has a colour.
Event pick_event(const cases::Case& c, const ref::Expectation& expectation,
                 const ref::SampleExpectation& sample, size_t index, const cases::SampleId& id,
                 ref::ValueReference& values, const ref::ColorReference* colors) {
    const std::span<const uint32_t> writers = expectation.writers_of(sample);
    const std::vector<Hits> all = allowed_hits(expectation, sample);
    std::vector<Writer> known;  // of `writers`, as far as they were asked for
    for (const Hits& hits : all) {
        if (hits.first + hits.second == 0 || writers.empty()) {
            return {hits, std::nullopt};
        }
        // The first writer goes with the fewest hits: all that must hit the sample, and no more.
        for (size_t k = 0; k < writers.size(); ++k) {
            if (colors != nullptr &&
                !colors->may_have_left(index, hits.first + hits.second, writers[k])) {
                continue;
            }
            while (known.size() <= k) {
                const uint32_t t = writers[known.size()];
                known.push_back({t, values.expected(t, id)});
            }
            const cases::Draw& draw = c.draws[expectation.triangles[writers[k]].draw];
            if (has_nearest(known[k]) && !is_discarded(known[k], draw)) {
                return {hits, std::move(known[k])};
            }
        }
    }
    return {all.front(), Writer{writers.back(), values.expected(writers.back(), id)}};
}

// What the queries counted where the capture's hits were drawn: of the draws that may have drawn
// them the first.
std::vector<uint64_t> counts_of(const cases::Case& c, const ref::Expectation& expectation,
                                const capture::Capture& capture) {
    if (!cases::asks_queries(c)) {
        return {};
    }
    std::vector<uint64_t> out(c.draws.size(), 0);
    const auto hits = [&](size_t index) -> std::optional<uint32_t> {
        return static_cast<uint32_t>(capture.hits[index].x + capture.hits[index].y);
    };
    for (size_t index = 0; index < capture.hits.size(); ++index) {
        const auto draws = expectation.counted_of(expectation.samples[index]);
        auto left = static_cast<uint32_t>(capture.hits[index].x + capture.hits[index].y);
        for (const ref::CountedDraw& draw : draws) {
            left -= draw.shown_least;
        }
        for (const ref::CountedDraw& draw : draws) {
            const uint32_t more = std::min(left, draw.shown_most - draw.shown_least);
            const uint32_t either = std::min(left - more, draw.either_most);
            left -= more + either;
            out[draw.draw] +=
                draw.shown_least + more + draw.hidden_least + std::max(either, draw.either_least);
        }
    }
    for (size_t k = 0; k < out.size(); ++k) {
        const cases::Query query = c.draws[k].query;
        if (cases::is_statistic(query)) {
            out[k] = ref::statistic_bounds(c, k, expectation, hits).least;
            continue;
        }
        const uint64_t most = query == cases::Query::none        ? 0
                              : query == cases::Query::occlusion ? 1
                                                                 : UINT64_MAX;
        out[k] = std::min(out[k], most);
    }
    return out;
}

capture::Capture blit_by_reference(const cases::Case& c) {
    const ref::BlitReference reference(c);
    capture::Capture capture;
    capture.target = c.target;
    for (uint32_t y = 0; y < c.target.height; ++y) {
        for (uint32_t x = 0; x < c.target.width; ++x) {
            capture.color.push_back(reference.nominal(x, y));
        }
    }
    return capture;
}

}  // namespace

capture::Capture draw_by_reference(const cases::Case& c) {
    if (c.blit) {
        return blit_by_reference(c);
    }
    const ref::Limits limits;
    const ref::Expectation expectation = ref::expect(c, limits, cases::Profile::direct3d);
    ref::ValueReference values(c, limits, cases::Profile::direct3d);

    std::optional<ref::ColorReference> colors;
    if (c.target.color) {
        colors.emplace(c, expectation);
    }

    const bool stores_discarded = cases::stores_discarded(c);
    capture::Capture capture = capture::blank_capture(c);
    const size_t n = capture.sample_count();
    for (size_t index = 0; index < n; ++index) {
        const ref::SampleExpectation& sample = expectation.samples[index];
        const cases::SampleId id = cases::sample_at(c.target, index);
        const Event event =
            pick_event(c, expectation, sample, index, id, values, colors ? &*colors : nullptr);
        const auto [front, back] = event.hits;
        if (ref::stencil::is_needed(c)) {
            capture.stencil.push_back(pick_stencil(expectation, sample, event.hits));
        }
        const auto leave_older_depth = [&] {
            if (sample.depth_count == 0) {
                return;
            }
            const uint32_t last =
                expectation.depth_writers[sample.depth_begin + sample.depth_count - 1];
            for (const ref::ExpectedValue& value : values.expected(last, id)) {
                if (value.quantity.is_depth()) {
                    capture.depth[index] = static_cast<float>(value.nearest);
                }
            }
        };
        if (!event.writer) {
            if (stores_discarded) {
                leave_older_depth();
            }
            continue;
        }
        capture.hits[index].x = static_cast<float>(front);
        capture.hits[index].y = static_cast<float>(back);
        capture.hits[index].w += static_cast<float>(front + back);
        const Writer& writer = *event.writer;
        const cases::Triangle& triangle = expectation.triangles[writer.triangle];
        capture.writers[index] = {triangle.draw, triangle.primitive, triangle.provoking,
                                  capture::kClearId};
        const bool writes_depth = c.draws[triangle.draw].depth.write && !stores_discarded;
        ref::FragmentValues drawn;
        const cases::PixelBlock block = cases::fragment_block(c.draws[triangle.draw], id.x, id.y);
        drawn.frag_coord = glm::vec4(
            static_cast<float>(block.x) + static_cast<float>(block.width) / 2.0F,
            static_cast<float>(block.y) + static_cast<float>(block.height) / 2.0F, 0.0F, 1.0F);
        drawn.depth = capture.depth[index];
        // Of a place behind the eye no value is the nearest one; a vertex's is among those allowed.
        for (size_t a = 0; a < c.draws[triangle.draw].attributes.size(); ++a) {
            const cases::Attribute& attribute = c.draws[triangle.draw].attributes[a];
            if (attribute.source == cases::Source::vertex &&
                attribute.probe == cases::Probe::value) {
                drawn.attributes[a] = attribute.values[triangle.vertex[0]];
            }
        }
        for (const ref::ExpectedValue& value : writer.values) {
            if (value.part.empty() && (writes_depth || !value.quantity.is_depth())) {
                number_of(drawn, value.quantity) = static_cast<float>(value.nearest);
            }
        }
        if (ref::value::shading_rate(c.draws[triangle.draw], c.target.samples) ==
            ref::value::ShadingRate::some) {
            // One invocation a sample is never too few.
            const auto& at = cases::sample_locations(c.target)[id.sample];
            drawn.frag_coord.x = static_cast<float>(id.x) + static_cast<float>(at[0]) / 16.0F;
            drawn.frag_coord.y = static_cast<float>(id.y) + static_cast<float>(at[1]) / 16.0F;
        }
        capture.frag_coord[index] = drawn.frag_coord;
        capture.depth[index] = drawn.depth;
        for (size_t a = 0; a < c.draws[triangle.draw].attributes.size(); ++a) {
            capture.attributes[a][index] = drawn.attributes[a];
        }
        if (!writes_depth) {
            leave_older_depth();
        }
    }
    capture.counted = counts_of(c, expectation, capture);
    add_color_plane(capture, c, expectation);
    drop_unattached(capture);
    diff::vary(capture, c.variation);
    return capture;
}

}  // namespace rasterizers
