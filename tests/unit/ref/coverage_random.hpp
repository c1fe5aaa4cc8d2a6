// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Random cases: everything is a function of the generator's seed.
#pragma once

#include <cmath>
#include <random>

#include "tests/unit/ref/coverage_fixture.hpp"

namespace ref::test {

class RandomCases {
  public:
    explicit RandomCases(uint64_t seed) : engine_(seed) {}

    int64_t integer(int64_t low, int64_t high) {
        return low + static_cast<int64_t>(engine_() % static_cast<uint64_t>(high - low + 1));
    }
    double real(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
    }
    bool flip() { return integer(0, 1) == 1; }

    // One to three triangles of some kind, with random state, on a small target.
    cases::Case triangles() {
        const uint32_t samples[] = {1, 1, 1, 2, 4, 8, 16};
        const auto size = static_cast<uint32_t>(flip() ? 16 : integer(1, 24));
        cases::Case c = blank(size, flip() ? size : static_cast<uint32_t>(integer(1, 24)),
                              samples[integer(0, 6)]);
        const int64_t draws = integer(1, 2);
        for (int64_t k = 0; k < draws; ++k) {
            cases::Draw d = state(c);
            const int64_t count = integer(1, 2);
            for (int64_t t = 0; t < count; ++t) {
                triangle(d);
            }
            c.draws.push_back(d);
        }
        return c;
    }

    // A closed mesh over part of the target, or beyond it.
    cases::Case mesh() {
        cases::Case c = blank(16, 16, flip() ? 1 : 4);
        cases::Draw d = state(c);
        d.cull = cases::CullMode::none;
        const auto n = static_cast<uint32_t>(integer(2, 5));
        const double reach = flip() ? 7 : real(4, 40);
        const int64_t kind = integer(0, 3);
        for (uint32_t y = 0; y <= n; ++y) {
            for (uint32_t x = 0; x <= n; ++x) {
                const bool is_inner = x > 0 && y > 0 && x < n && y < n;
                const double jitter = is_inner && kind > 0 ? reach / n * 0.8 : 0;
                double px = 8 + reach * (2.0 * x / n - 1) + real(-jitter, jitter);
                double py = 8 + reach * (2.0 * y / n - 1) + real(-jitter, jitter);
                if (kind < 3) {
                    const double grid = kind == 2 ? 256 : 2;
                    px = std::nearbyint(px * grid) / grid;
                    py = std::nearbyint(py * grid) / grid;
                }
                const auto w = static_cast<float>(kind == 3 ? real(0.5, 4) : 1);
                d.positions.push_back(at_pixel(d, px, py, w));
            }
        }
        std::vector<uint32_t> indices;
        for (uint32_t y = 0; y < n; ++y) {
            for (uint32_t x = 0; x < n; ++x) {
                const uint32_t a = y * (n + 1) + x;
                const uint32_t b = a + 1;
                const uint32_t e = a + n + 1;
                const uint32_t f = e + 1;
                add(indices, a, b, e);
                add(indices, b, f, e);
            }
        }
        d.indices = indices;
        c.draws.push_back(d);
        return c;
    }

  private:
    void add(std::vector<uint32_t>& indices, uint32_t a, uint32_t b, uint32_t c) {
        if (flip()) {
            indices.insert(indices.end(), {a, b, c});
        } else {
            indices.insert(indices.end(), {c, b, a});
        }
    }

    cases::Draw state(const cases::Case& c) {
        cases::Draw d = whole(c);
        const int64_t kind = integer(0, 9);
        if (kind == 0) {
            d.viewport = {static_cast<float>(real(-4, 4)), static_cast<float>(real(-4, 4)),
                          static_cast<float>(real(3, 20)), static_cast<float>(real(-20, 20))};
        } else if (kind == 1) {
            d.viewport = {static_cast<float>(integer(-4, 4)), static_cast<float>(integer(4, 20)),
                          static_cast<float>(integer(3, 20)), -static_cast<float>(integer(3, 20))};
        }
        if (integer(0, 4) == 0) {
            d.scissor = {static_cast<int32_t>(integer(0, 8)), static_cast<int32_t>(integer(0, 8)),
                         static_cast<uint32_t>(integer(0, 16)),
                         static_cast<uint32_t>(integer(0, 16))};
        }
        d.cull = static_cast<cases::CullMode>(std::max<int64_t>(0, integer(-5, 3)));
        d.front_face = static_cast<cases::FrontFace>(integer(0, 1));
        return d;
    }

    void triangle(cases::Draw& d) {
        const int64_t kind = integer(0, 8);
        const double x = real(-2, 20);
        const double y = real(-2, 20);
        for (int v = 0; v < 3; ++v) {
            switch (kind) {
                case 0:  // on a coarse grid: many ties
                    d.positions.push_back(at_pixel(d, static_cast<double>(integer(0, 32)) / 2,
                                                   static_cast<double>(integer(0, 32)) / 2));
                    break;
                case 1:  // on the grid
                    d.positions.push_back(at_pixel(d, static_cast<double>(integer(0, 4096)) / 256,
                                                   static_cast<double>(integer(0, 4096)) / 256));
                    break;
                case 2:  // off the grid, in perspective
                    d.positions.push_back(
                        at_pixel(d, real(0, 16), real(0, 16), static_cast<float>(real(0.1, 10))));
                    break;
                case 3:  // tiny
                    d.positions.push_back(
                        at_pixel(d, x + real(-0.02, 0.02), y + real(-0.02, 0.02)));
                    break;
                case 4: {  // sliver
                    const double s = real(-20, 20);
                    d.positions.push_back(
                        at_pixel(d, 8.5 + s, 8.5 + s * (x / 20) + real(-0.005, 0.005)));
                    break;
                }
                case 5: {  // huge
                    const double far = std::pow(10.0, real(1, 6));
                    d.positions.push_back(at_pixel(d, real(-far, far), real(-far, far)));
                    break;
                }
                case 6:  // anywhere in clip space, behind the eye too
                    d.positions.emplace_back(real(-2, 2), real(-2, 2), real(-1, 2), real(-1, 2));
                    break;
                case 7:  // near midpoints of the snap grid
                    d.positions.push_back(at_pixel(
                        d, (static_cast<double>(integer(0, 4096)) + 0.5 + real(-0.12, 0.12)) / 256,
                        (static_cast<double>(integer(0, 4096)) + 0.5) / 256));
                    break;
                default:  // barely outside the view volume
                    d.positions.push_back(
                        at_pixel(d, real(-1, 17), real(-1, 17), static_cast<float>(real(0.5, 2))));
                    d.positions.back().z *= static_cast<float>(real(-0.1, 2.2));
                    break;
            }
        }
        if (integer(0, 99) == 0) {
            d.positions.back().x = flip() ? NAN : INFINITY;
        }
    }

    std::mt19937_64 engine_;
};

// The state of a random draw with its profile and bits, for messages.
struct Setting {
    Limits limits;
    cases::Profile profile;
};
inline Setting setting(RandomCases& random) {
    const int bits[] = {4, 8, 8, 10, 16};
    return {{bits[random.integer(0, 4)]}, cases::kProfiles[random.integer(0, 2)]};
}

}  // namespace ref::test
