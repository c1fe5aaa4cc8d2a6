// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Cases for the value tests, built without the loader, and binary32 implementations of
// interpolation that a driver could have.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "cases/model/case.hpp"
#include "ref/value/reference.hpp"

namespace value_test {

inline double uniform(std::mt19937_64& rng, double low, double high) {
    return low + (high - low) * static_cast<double>(rng() >> 11U) * 0x1p-53;
}

// One triangle in one target with the attributes
//   0 smooth, 4 components: two random, one constant 0.1, one of either sign
//   1 noperspective, 2 components
//   2 flat, 1 component
inline cases::Case make_case(uint32_t size, const std::array<glm::vec4, 3>& clip) {
    cases::Case c;
    c.id = "value";
    c.target = {size, size, 1};
    cases::Draw draw;
    draw.positions.assign(clip.begin(), clip.end());
    draw.viewport = {0, 0, static_cast<float>(size), static_cast<float>(size), 0, 1};
    draw.scissor = {0, 0, size, size};
    c.draws.push_back(draw);
    return c;
}

inline void add_attribute(cases::Case& c, cases::Interpolation interpolation, uint32_t components,
                          const std::array<glm::vec4, 3>& values) {
    cases::Attribute a;
    a.name = "a" + std::to_string(c.draws[0].attributes.size());
    a.interpolation = interpolation;
    a.components = components;
    a.values.assign(values.begin(), values.end());
    c.draws[0].attributes.push_back(a);
}

// Clip position of framebuffer position (x,y), depth z, w; rounded to binary32.
inline glm::vec4 clip_of(double x, double y, double z, double w, uint32_t size) {
    const double half = size / 2.0;
    return {static_cast<float>((x - half) / half * w), static_cast<float>((y - half) / half * w),
            static_cast<float>(z * w), static_cast<float>(w)};
}

// Small random numbers of a seed, the same on every machine.
class Random {
  public:
    explicit Random(uint64_t seed) : engine_(seed) {}
    uint64_t bits() { return engine_(); }
    uint32_t below(uint32_t n) { return static_cast<uint32_t>(engine_() % n); }
    bool one_in(uint32_t n) { return below(n) == 0; }
    float eighth() { return static_cast<float>(below(9)) / 8.0F; }  // 0 to 1

  private:
    std::mt19937_64 engine_;
};

// Adds one to three triangles to a draw over a square target, each at one of five depths; their
// vertices lie on corners of pixels or, as often, on 1/units of a pixel.
inline void add_random_triangles(cases::Draw& draw, Random& random, uint32_t size, uint32_t units) {
    const auto place = [&](bool is_coarse) {
        return is_coarse ? random.below(size + 1)
                         : random.below(size * units + 1) / static_cast<double>(units);
    };
    const uint32_t triangles = 1 + random.below(3);
    for (uint32_t t = 0; t < triangles; ++t) {
        const bool is_coarse = random.one_in(2);
        const double z = random.below(5) / 4.0;
        for (int v = 0; v < 3; ++v) {
            const double y = place(is_coarse);  // the order of arguments is the compiler's
            draw.positions.push_back(clip_of(place(is_coarse), y, z, 1, size));
        }
    }
}

// The device that rounds every exact value once.
inline ref::FragmentValues rounded(const std::vector<ref::ExpectedValue>& all) {
    ref::FragmentValues out;
    for (const ref::ExpectedValue& e : all) {
        if (e.part.empty()) {  // the parts are shown beside the others, written by no device
            number_of(out, e.quantity) = static_cast<float>(e.nearest);
        }
    }
    return out;
}

// What a device computes at one sample. All arithmetic in binary32.
enum class Device : uint8_t {
    origin_plane,       // plane a0 + x dadx + y dady anchored at (0,0), unsnapped (as llvmpipe)
    relative_snapped,   // homogeneous, relative to vertex 0, snapped to 1/256 (as SwiftShader)
    brute_barycentric,  // areas at the sample, Brown's eq. 1 and 4, unsnapped
    difference_form,    // z0 + l1 (z1 - z0) + l2 (z2 - z0), unsnapped (Giesen)
};
inline constexpr Device kDevices[] = {Device::origin_plane, Device::relative_snapped,
                                      Device::brute_barycentric, Device::difference_form};

// Deliberate faults.
enum class Fault : uint8_t { none, affine, half_pixel, short_reciprocal };

struct Window {
    float x, y, z, inv_w;
};

inline Window window_of(const glm::vec4& clip, const cases::Viewport& v, bool snapped) {
    const float r = 1.0F / clip.w;
    Window out{clip.x * r * (v.width * 0.5F) + (v.x + v.width * 0.5F),
               clip.y * r * (v.height * 0.5F) + (v.y + v.height * 0.5F),
               clip.z * r * (v.max_depth - v.min_depth) + v.min_depth, r};
    if (snapped) {
        out.x = std::nearbyint(out.x * 256.0F) / 256.0F;
        out.y = std::nearbyint(out.y * 256.0F) / 256.0F;
    }
    return out;
}

// Keeps 12 bits of a reciprocal.
inline float short_reciprocal(float x) {
    const float r = 1.0F / x;
    int exponent = 0;
    const float m = std::frexp(r, &exponent);
    return std::ldexp(std::floor(m * 4096.0F) / 4096.0F, exponent);
}

class Simulated {
  public:
    Simulated(const cases::Case& c, Device device, Fault fault)
        : draw_(c.draws[0]), device_(device), fault_(fault) {
        for (size_t i = 0; i < 3; ++i) {
            v_[i] =
                window_of(draw_.positions[i], draw_.viewport, device == Device::relative_snapped);
        }
    }

    ref::FragmentValues at(uint32_t i, uint32_t j) const {
        ref::FragmentValues out;
        float x = static_cast<float>(i) + 0.5F;
        const float y = static_cast<float>(j) + 0.5F;
        out.frag_coord.x = x;
        out.frag_coord.y = y;
        if (fault_ == Fault::half_pixel) {
            x = static_cast<float>(i);
        }
        const float inv_w = linear({v_[0].inv_w, v_[1].inv_w, v_[2].inv_w}, x, y);
        out.frag_coord.z = linear({v_[0].z, v_[1].z, v_[2].z}, x, y);
        out.depth = out.frag_coord.z;
        out.frag_coord.w = inv_w;
        for (size_t a = 0; a < draw_.attributes.size(); ++a) {
            const cases::Attribute& attribute = draw_.attributes[a];
            for (glm::vec4::length_type c = 0;
                 c < static_cast<glm::vec4::length_type>(attribute.components); ++c) {
                const std::array<float, 3> f = {attribute.values[0][c], attribute.values[1][c],
                                                attribute.values[2][c]};
                float value = f[0];
                if (attribute.interpolation == cases::Interpolation::noperspective ||
                    (attribute.interpolation == cases::Interpolation::smooth &&
                     fault_ == Fault::affine)) {
                    value = linear(f, x, y);
                } else if (attribute.interpolation == cases::Interpolation::smooth) {
                    const float n =
                        linear({f[0] * v_[0].inv_w, f[1] * v_[1].inv_w, f[2] * v_[2].inv_w}, x, y);
                    value =
                        fault_ == Fault::short_reciprocal ? n * short_reciprocal(inv_w) : n / inv_w;
                }
                out.attributes[a][c] = value;
            }
        }
        return out;
    }

  private:
    float linear(const std::array<float, 3>& g, float x, float y) const {
        const Window &a = v_[0], &b = v_[1], &c = v_[2];
        switch (device_) {
            case Device::origin_plane: {
                const float dx01 = a.x - b.x, dy01 = a.y - b.y, dx20 = c.x - a.x, dy20 = c.y - a.y;
                const float r = 1.0F / (dx01 * dy20 - dx20 * dy01);
                const float d01 = g[0] - g[1], d20 = g[2] - g[0];
                const float dadx = d01 * (dy20 * r) - d20 * (dy01 * r);
                const float dady = d20 * (dx01 * r) - d01 * (dx20 * r);
                const float a0 = g[0] - (dadx * (a.x - 0.5F) + dady * (a.y - 0.5F));
                return a0 + dadx * (x - 0.5F) + dady * (y - 0.5F);
            }
            case Device::relative_snapped: {
                const float x1 = b.x - a.x, y1 = b.y - a.y, x2 = c.x - a.x, y2 = c.y - a.y;
                const float r = 1.0F / (x1 * y2 - x2 * y1);
                // Rows of the inverse of (0,0,1), (x1,y1,1), (x2,y2,1).
                const std::array<float, 3> bx = {(y1 - y2) * r, y2 * r, -y1 * r};
                const std::array<float, 3> by = {(x2 - x1) * r, -x2 * r, x1 * r};
                const float A = bx[0] * g[0] + bx[1] * g[1] + bx[2] * g[2];
                const float B = by[0] * g[0] + by[1] * g[1] + by[2] * g[2];
                return g[0] + (x - a.x) * A + (y - a.y) * B;
            }
            case Device::brute_barycentric: {
                const auto area = [&](const Window& p, const Window& q) {
                    return (p.x - x) * (q.y - y) - (q.x - x) * (p.y - y);
                };
                const float a0 = area(b, c), a1 = area(c, a), a2 = area(a, b);
                const float r = 1.0F / (a0 + a1 + a2);
                return a0 * r * g[0] + a1 * r * g[1] + a2 * r * g[2];
            }
            case Device::difference_form: {
                const auto area = [&](const Window& p, const Window& q) {
                    return (p.x - x) * (q.y - y) - (q.x - x) * (p.y - y);
                };
                const float x1 = b.x - a.x, y1 = b.y - a.y, x2 = c.x - a.x, y2 = c.y - a.y;
                const float r = 1.0F / (x1 * y2 - x2 * y1);
                return g[0] + area(c, a) * r * (g[1] - g[0]) + area(a, b) * r * (g[2] - g[0]);
            }
        }
        return 0;
    }

    const cases::Draw& draw_;
    Device device_;
    Fault fault_;
    std::array<Window, 3> v_{};
};

// Random triangles of a class, all inside the target, with a pixel centre inside.
enum class Shape : uint8_t { small, large, sliver };

struct Sampled {
    cases::Case c;
    std::vector<cases::SampleId> inside;  // pixels whose centre is inside (binary64 test)
};

inline double cross(double ax, double ay, double bx, double by, double px, double py) {
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax);
}

inline Sampled random_case(std::mt19937_64& rng, uint32_t size, Shape shape, int w_exponent) {
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(rng() >> 11U) * 0x1p-53;
    };
    const double s = size;
    for (;;) {
        std::array<double, 3> x{}, y{};
        const double cx = uniform(0, s);
        const double cy = uniform(0, s);
        const double angle = uniform(0, 3.14159265358979);
        for (size_t i = 0; i < 3; ++i) {
            switch (shape) {
                case Shape::small:
                    x[i] = cx + uniform(-4, 4);
                    y[i] = cy + uniform(-4, 4);
                    break;
                case Shape::large:
                    x[i] = uniform(0, s);
                    y[i] = uniform(0, s);
                    break;
                case Shape::sliver: {
                    const double along = uniform(-s / 2, s / 2);
                    const double across = uniform(-0.6, 0.6);
                    x[i] = cx + along * std::cos(angle) - across * std::sin(angle);
                    y[i] = cy + along * std::sin(angle) + across * std::cos(angle);
                    break;
                }
            }
            x[i] = std::min(std::max(x[i], 0.01), s - 0.01);
            y[i] = std::min(std::max(y[i], 0.01), s - 0.01);
        }
        // The snapped positions too must have the pixel inside; otherwise no device draws it.
        std::vector<cases::SampleId> inside;
        for (int tries = 0; tries < 64 && inside.size() < 4; ++tries) {
            double b0 = uniform(0, 1);
            double b1 = uniform(0, 1);
            if (b0 + b1 > 1) {
                b0 = 1 - b0;
                b1 = 1 - b1;
            }
            const double px = std::floor(b0 * x[0] + b1 * x[1] + (1 - b0 - b1) * x[2]) + 0.5;
            const double py = std::floor(b0 * y[0] + b1 * y[1] + (1 - b0 - b1) * y[2]) + 0.5;
            const auto is_in = [&](double grid) {
                std::array<double, 3> qx{}, qy{};
                for (size_t i = 0; i < 3; ++i) {
                    qx[i] = grid > 0 ? std::nearbyint(x[i] * grid) / grid : x[i];
                    qy[i] = grid > 0 ? std::nearbyint(y[i] * grid) / grid : y[i];
                }
                const double e0 = cross(qx[0], qy[0], qx[1], qy[1], px, py);
                const double e1 = cross(qx[1], qy[1], qx[2], qy[2], px, py);
                const double e2 = cross(qx[2], qy[2], qx[0], qy[0], px, py);
                return (e0 > 0 && e1 > 0 && e2 > 0) || (e0 < 0 && e1 < 0 && e2 < 0);
            };
            if (is_in(0) && is_in(256)) {
                inside.push_back({static_cast<uint32_t>(px), static_cast<uint32_t>(py), 0});
            }
        }
        if (inside.empty()) {
            continue;
        }
        std::array<glm::vec4, 3> clip{};
        std::array<glm::vec4, 3> smooth{}, linear{};
        const float scale = static_cast<float>(std::exp2(uniform(-6, 6)));
        for (size_t i = 0; i < 3; ++i) {
            const double w = std::exp2(uniform(-w_exponent, w_exponent));
            clip[i] = clip_of(x[i], y[i], uniform(0.01, 0.99), w, size);
            smooth[i] = {scale * static_cast<float>(uniform(0, 1)),
                         static_cast<float>(uniform(0, 1)), 0.1F,
                         scale * static_cast<float>(uniform(-1, 1))};
            linear[i] = {static_cast<float>(uniform(0, 1)), static_cast<float>(uniform(-1, 1)), 0,
                         0};
        }
        Sampled out{make_case(size, clip), std::move(inside)};
        add_attribute(out.c, cases::Interpolation::smooth, 4, smooth);
        add_attribute(out.c, cases::Interpolation::noperspective, 2, linear);
        add_attribute(out.c, cases::Interpolation::flat, 1,
                      {glm::vec4(1.5F), glm::vec4(2.5F), glm::vec4(3.5F)});
        return out;
    }
}

}  // namespace value_test
