// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Cases for the coverage tests, built without the loader.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "ref/expectation/expectation.hpp"

namespace ref::test {

using Point = std::array<double, 2>;

// An empty case on a target.
inline cases::Case blank(uint32_t width, uint32_t height, uint32_t samples = 1) {
    cases::Case c;
    c.id = "test";
    c.target = {width, height, samples};
    return c;
}

// A draw over the whole target without vertices.
inline cases::Draw whole(const cases::Case& c) {
    cases::Draw d;
    d.viewport = {0, 0, static_cast<float>(c.target.width), static_cast<float>(c.target.height)};
    d.scissor = {0, 0, c.target.width, c.target.height};
    return d;
}

// The clip-space position of a framebuffer position; exact for power-of-two viewports at the
// origin.
inline glm::vec4 at_pixel(const cases::Draw& d, double x, double y, float w = 1) {
    const double half_x = static_cast<double>(d.viewport.width) / 2;
    const double half_y = static_cast<double>(d.viewport.height) / 2;
    const double wide = static_cast<double>(w);
    return {static_cast<float>((x - static_cast<double>(d.viewport.x) - half_x) / half_x * wide),
            static_cast<float>((y - static_cast<double>(d.viewport.y) - half_y) / half_y * wide),
            w / 2, w};
}

// One triangle list of framebuffer positions, w = 1.
inline cases::Case pixels(uint32_t width, uint32_t height, const std::vector<Point>& points,
                          uint32_t samples = 1) {
    cases::Case c = blank(width, height, samples);
    cases::Draw d = whole(c);
    for (const Point& p : points) {
        d.positions.push_back(at_pixel(d, p[0], p[1]));
    }
    c.draws.push_back(d);
    return c;
}

// How many samples must be hit exactly n times; samples left open count in `open`.
struct Count {
    uint64_t none = 0, once = 0, twice = 0, more = 0, open = 0;
    friend bool operator==(const Count&, const Count&) = default;
};
inline Count count_hits(const Expectation& e) {
    Count out;
    for (size_t k = 0; k < e.samples.size(); ++k) {
        const HitBounds& b = e.samples[k].hits;
        if (b.total_min != b.total_max) {
            ++out.open;
        } else if (b.total_min == 0) {
            ++out.none;
        } else if (b.total_min == 1) {
            ++out.once;
        } else if (b.total_min == 2) {
            ++out.twice;
        } else {
            ++out.more;
        }
    }
    return out;
}

inline const HitBounds& hits_at(const Expectation& e, uint32_t i, uint32_t j, uint32_t s = 0,
                                uint32_t layer = 0) {
    return e.samples[index_of(e.target, {i, j, s, layer})].hits;
}

}  // namespace ref::test
