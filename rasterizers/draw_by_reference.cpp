// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "capture/blank_capture.hpp"
#include "cases/model/sample.hpp"
#include "diff/consistency.hpp"
#include "rasterizers/captures.hpp"
#include "rasterizers/color_plane.hpp"
#include "ref/blit/blit.hpp"
#include "ref/expectation/counted.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/statistics.hpp"
#include "ref/path/path.hpp"
#include "ref/stencil/values.hpp"
#include "ref/value/fragment/shading_rate.hpp"
#include "ref/value/reference.hpp"

namespace rasterizers {

namespace {

// A triangle and what it writes at a sample. The values are kept beside it, since the reference
// takes most of its time for them.
struct Writer {
    uint32_t triangle;
    std::vector<ref::ExpectedValue> values;
};

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

// What became of a sample: a path of its fragments.
struct Event {
    uint32_t front = 0, back = 0;    // hits
    std::optional<Writer> writer;    // nothing if there are no hits
    std::optional<uint32_t> stored;  // the triangle whose depth stays, if that is not the writer's
    uint32_t stencil = 0;
    std::vector<uint32_t> shown;   // triangles, where something is open
    std::vector<uint32_t> passed;  // triangles, as far as queries count them
};

// The one event of a sample of which nothing is open.
Event only_event(const ref::Expectation& expectation, const ref::SampleExpectation& sample,
                 const cases::SampleId& id, ref::ValueReference& values) {
    Event out{sample.hits.front_min, sample.hits.back_min, {}, {}, 0, {}, {}};
    const std::span<const uint32_t> writers = expectation.writers_of(sample);
    if (out.front + out.back > 0 && !writers.empty()) {
        out.writer = {writers.back(), values.expected(writers.back(), id)};
    }
    if (sample.depth_count > 0) {
        out.stored = expectation.depth_writers_of(sample).back();
    }
    for (const ref::path::Fragment& f : expectation.fragments_of(sample)) {
        out.passed.push_back(f.triangle);
    }
    out.stencil = ref::stencil::least_of(stencils_at(expectation, sample, std::nullopt));
    return out;
}

// The path with the fewest hits whose last fragment the reference can draw, of the first triangle
// that may be it; else any path.
Event pick_event(const cases::Case& c, const ref::Expectation& expectation,
                 const ref::SampleExpectation& sample, const cases::SampleId& id,
                 ref::ValueReference& values) {
    if (!sample.is_open || sample.is_free) {
        return only_event(expectation, sample, id, values);
    }
    const ref::path::Question question = question_of(expectation, c, sample);
    const auto event_of = [&](const ref::path::History& path, std::optional<Writer> writer) {
        const auto front = static_cast<uint32_t>(std::ranges::count(path.is_front, true));
        Event out{front,
                  static_cast<uint32_t>(path.shown.size()) - front,
                  std::move(writer),
                  {},
                  path.stencil,
                  {},
                  {}};
        if (path.stored != ref::path::kClearDepth) {
            out.stored = question.fragments[static_cast<size_t>(path.stored)].triangle;
        }
        for (const uint32_t m : path.shown) {
            out.shown.push_back(question.fragments[m].triangle);
        }
        out.passed = out.shown;
        for (const uint32_t m : path.discarded) {
            out.passed.push_back(question.fragments[m].triangle);
            if (question.fragments[m].is_clear) {
                out.shown.push_back(question.fragments[m].triangle);
            }
        }
        std::ranges::sort(out.shown);
        return out;
    };
    std::map<uint32_t, Writer> known;  // by triangle
    for (uint32_t total = sample.hits.total_min; total <= sample.hits.total_max; ++total) {
        ref::path::Observed observed;
        observed.hits = {ref::path::SeenHits::Detail::total, total, 0};
        if (total == 0) {
            if (const auto path = find_path(question, observed)) {
                return event_of(*path, std::nullopt);
            }
            continue;
        }
        for (size_t m = 0; m < question.fragments.size(); ++m) {
            observed.last.assign(question.fragments.size(), false);
            observed.last[m] = true;
            const auto path = find_path(question, observed);
            if (!path) {
                continue;
            }
            const uint32_t t = question.fragments[m].triangle;
            if (!known.contains(t)) {
                known[t] = {t, values.expected(t, id)};
            }
            if (has_nearest(known[t]) &&
                !is_discarded(known[t], c.draws[expectation.triangles[t].draw])) {
                return event_of(*path, known[t]);
            }
        }
    }
    const auto path = find_path(question, {});
    const uint32_t last =
        path && !path->shown.empty() ? question.fragments[path->shown.back()].triangle : 0;
    return !path                 ? only_event(expectation, sample, id, values)
           : path->shown.empty() ? event_of(*path, std::nullopt)
                                 : event_of(*path, Writer{last, values.expected(last, id)});
}

// Counts the fragments that pass, by draw.
class PassedFragments {
  public:
    PassedFragments(const cases::Case& c, const ref::Expectation& expectation)
        : case_(c),
          expectation_(expectation),
          samples_(c.draws.size()),
          pixel_(c.draws.size()),
          invocations_(c.draws.size()) {}

    // Samples come in their order.
    void add(size_t index, const Event& event) {
        std::vector<uint64_t> here(case_.draws.size());
        for (const uint32_t t : event.passed) {
            ++here[expectation_.triangles[t].draw];
        }
        const uint32_t samples = case_.target.samples;
        for (size_t k = 0; k < here.size(); ++k) {
            const bool is_by_sample = ref::value::shading_rate(case_.draws[k], samples) ==
                                      ref::value::ShadingRate::sample;
            samples_[k] += here[k];
            pixel_[k] = is_by_sample ? pixel_[k] + here[k] : std::max(pixel_[k], here[k]);
            if ((index + 1) % samples == 0) {
                invocations_[k] += std::exchange(pixel_[k], 0);
            }
        }
    }

    // What the queries give.
    std::vector<uint64_t> counts() const {
        std::vector<uint64_t> out;
        for (uint32_t k = 0; cases::asks_queries(case_) && k < case_.draws.size(); ++k) {
            switch (case_.draws[k].query) {
                case cases::Query::none:
                    out.push_back(0);
                    break;
                case cases::Query::occlusion:
                    out.push_back(std::min(samples_[k], uint64_t{1}));
                    break;
                case cases::Query::occlusion_precise:
                    out.push_back(samples_[k]);
                    break;
                case cases::Query::fragment_invocations:
                    out.push_back(invocations_[k]);
                    break;
                default:
                    out.push_back(ref::statistic_bounds(case_, k, expectation_, {}).least);
            }
        }
        return out;
    }

  private:
    const cases::Case& case_;
    const ref::Expectation& expectation_;
    std::vector<uint64_t> samples_, pixel_, invocations_;
};

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

    const bool stores_discarded = cases::stores_discarded(c);
    capture::Capture capture = capture::blank_capture(c);
    const size_t n = capture.sample_count();
    PassedFragments passed(c, expectation);
    std::map<size_t, std::vector<uint32_t>> shown;  // of samples of which something is open
    for (size_t index = 0; index < n; ++index) {
        const ref::SampleExpectation& sample = expectation.samples[index];
        const cases::SampleId id = cases::sample_at(c.target, index);
        const Event event = pick_event(c, expectation, sample, id, values);
        if (ref::stencil::is_needed(c)) {
            capture.stencil.push_back(event.stencil);
        }
        passed.add(index, event);
        if (!event.shown.empty()) {
            shown.emplace(index, event.shown);
        }
        const auto leave_older_depth = [&] {
            if (!event.stored) {
                return;
            }
            for (const ref::ExpectedValue& value : values.expected(*event.stored, id)) {
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
        capture.hits[index].x = static_cast<float>(event.front);
        capture.hits[index].y = static_cast<float>(event.back);
        capture.hits[index].w += static_cast<float>(event.front + event.back);
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
    capture.counted = passed.counts();
    add_color_plane(capture, c, expectation, shown);
    drop_unattached(capture);
    diff::vary(capture, c.variation);
    return capture;
}

}  // namespace rasterizers
