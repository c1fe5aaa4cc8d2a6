// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Captures made from the reference itself, to plant faults in.
#pragma once

#include "capture/capture.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

// A case of one draw, list topology, vertices in pixels of a power-of-two target, w = 1, z = 1/2.
inline cases::Case pixel_case(uint32_t width, uint32_t height,
                              const std::vector<std::array<double, 2>>& vertices) {
    cases::Case c;
    c.id = "test/case";
    c.target = {width, height, 1};
    cases::Draw draw;
    for (const auto& v : vertices) {
        draw.positions.emplace_back(static_cast<float>(v[0] * 2 / width - 1),
                                    static_cast<float>(v[1] * 2 / height - 1), 0.5F, 1.0F);
    }
    draw.viewport = {0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1};
    draw.scissor = {0, 0, width, height};
    c.draws.push_back(draw);
    return c;
}

inline void add_attribute(cases::Case& c, cases::Interpolation interpolation,
                          const std::vector<float>& values) {
    cases::Attribute a;
    a.name = "a";
    a.interpolation = interpolation;
    a.components = 1;
    for (const float v : values) {
        a.values.emplace_back(v, 0.0F, 0.0F, 0.0F);
    }
    c.draws[0].attributes.push_back(a);
}

inline void clear_sample(capture::Capture& capture, size_t index) {
    const glm::vec4 clear(capture::kClearValue);
    capture.hits[index] = {0, 0, capture::kHitGuard, capture::kHitGuard};
    capture.writers[index] = capture::Writer{};
    capture.frag_coord[index] = clear;
    capture.depth[index] = capture.target.depth_clear;
    for (uint32_t a = 0; a < capture.attribute_count; ++a) {
        capture.attributes[a][index] = clear;
    }
}

inline void set_hits(capture::Capture& capture, size_t index, float front, float back) {
    capture.hits[index] = {front, back, capture::kHitGuard, capture::kHitGuard + front + back};
}

// What triangle t leaves at a sample: nearest values of the reference.
inline void write_fragment(capture::Capture& capture, const cases::Case& c,
                           const ref::Expectation& e, ref::ValueReference& values, uint32_t t,
                           cases::SampleId id) {
    const size_t index = cases::index_of(c.target, id);
    const cases::Triangle& triangle = e.triangles[t];
    capture.writers[index] = {triangle.draw, triangle.primitive, triangle.provoking,
                              capture::kClearId};
    ref::FragmentValues drawn;
    drawn.frag_coord = {static_cast<float>(id.x) + 0.5F, static_cast<float>(id.y) + 0.5F, 0, 0};
    drawn.depth = capture.depth[index];
    for (const ref::ExpectedValue& v : values.expected(t, id)) {
        if (v.part.empty()) {
            number_of(drawn, v.quantity) = static_cast<float>(v.nearest);
        }
    }
    capture.frag_coord[index] = drawn.frag_coord;
    capture.depth[index] = drawn.depth;
    for (uint32_t a = 0; a < capture.attribute_count; ++a) {
        capture.attributes[a][index] = drawn.attributes[a];
    }
}

// The capture of a device that is right in every sample (where several answers are allowed: the
// least hits).
inline capture::Capture perfect_capture(const cases::Case& c, const ref::Expectation& e) {
    capture::Capture capture;
    capture.target = c.target;
    capture.has_primitive = true;
    capture.attribute_count = static_cast<uint32_t>(c.draws[0].attributes.size());
    const size_t count = capture.sample_count();
    capture.hits.resize(count);
    capture.writers.resize(count);
    capture.frag_coord.resize(count);
    capture.depth.resize(count);
    for (uint32_t a = 0; a < capture.attribute_count; ++a) {
        capture.attributes[a].resize(count);
    }
    ref::ValueReference values(c, e.limits, e.profile);
    for (size_t index = 0; index < count; ++index) {
        const cases::SampleId id = cases::sample_at(c.target, index);
        clear_sample(capture, index);
        const ref::SampleExpectation& s = e.samples[index];
        if (s.hits.total_min > 0) {
            set_hits(capture, index, static_cast<float>(s.hits.front_min),
                     static_cast<float>(s.hits.back_min));
            write_fragment(capture, c, e, values, e.writers[s.writers_begin + s.writers_count - 1],
                           id);
        }
    }
    return capture;
}
