// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Small cases, written in framebuffer coordinates.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "ref/number/fixed_point.hpp"

namespace probe {

// A vertex: where it is in the framebuffer, in pixels, and its depth and w.
struct Corner {
    double x = 0, y = 0;
    double z = 0.5, w = 1;
};

// One draw of a list of triangles.
class Scene {
  public:
    // The viewport is the whole target unless set_viewport() says otherwise. Sides that are powers
    // of two make all positions exact that are multiples of 2^-12 pixel or so: x of clip space is
    // (x - centre) / half the side, one binary32 number, and the viewport transform gives x back.
    Scene(std::string id, uint32_t width, uint32_t height, uint32_t samples = 1);

    void set_viewport(float x, float y, float width, float height);
    void add(const Corner& a, const Corner& b, const Corner& c);
    // An attribute without values yet; add one a vertex.
    cases::Attribute& attribute(const std::string& name, uint32_t components,
                                cases::Interpolation interpolation = cases::Interpolation::smooth);

    cases::Draw& draw() { return case_.draws.front(); }
    cases::Target& target() { return case_.target; }
    const cases::Case& get() const { return case_; }
    cases::Case take() { return std::move(case_); }

  private:
    glm::vec4 clip(const Corner& c) const;
    cases::Case case_;
};

// Two triangles that cover a rectangle at this depth.
void add_rectangle(Scene& scene, double left, double top, double right, double bottom,
                   double z = 0.5);

// Whether a sample was hit by any triangle.
bool is_hit(const capture::Capture& picture, size_t index);
inline bool is_hit(const capture::Capture& picture, uint32_t x, uint32_t y, uint32_t sample = 0) {
    const cases::Target& t = picture.target;
    return is_hit(picture, (size_t{y} * t.width + x) * t.samples + sample);
}

// Squares of 2 x 2 pixels, each with numbers of its own, in a target of 64 x 64.
inline constexpr uint32_t kSquaresAcross = 32, kSquares = kSquaresAcross * kSquaresAcross;
// The index of a pixel of square k.
constexpr size_t pixel_of_square(size_t k) {
    return (2 * (k / kSquaresAcross)) * size_t{2 * kSquaresAcross} + 2 * (k % kSquaresAcross);
}
// Calls visit(k, the index of one of its pixels) for each of `count` squares that was drawn.
template <class Visit>
void for_each_square(const capture::Capture& picture, size_t count, Visit visit) {
    for (size_t k = 0; k < count; ++k) {
        if (const size_t at = pixel_of_square(k); is_hit(picture, at)) {
            visit(k, at);
        }
    }
}
// A scene of squares whose flat attribute 0 has the value of the square; the colour target, if the
// caller makes one, is written with it.
Scene make_squares(const std::string& id, const std::vector<glm::vec4>& values,
                   uint32_t samples = 1);

// A coordinate in S47.16; exact for multiples of 2^-16 pixel.
int64_t fixed(double pixels);

// Which side of a triangle's edges a point is on: 1 inside, -1 outside, 0 on its border. The
// triangle may turn either way; one without area has no inside.
int side(const ref::FixedPoint& a, const ref::FixedPoint& b, const ref::FixedPoint& c,
         const ref::FixedPoint& p);

// Numbers that are the same on every machine.
class Dice {
  public:
    explicit Dice(uint32_t seed) : engine_(seed) {}
    // A whole number from low to high, both included.
    int64_t whole(int64_t low, int64_t high) {
        const auto span = static_cast<uint64_t>(high - low) + 1;
        const uint64_t bits = (uint64_t{engine_()} << 32U) | engine_();
        return low + static_cast<int64_t>(bits % span);
    }
    // A number of [low, high).
    double real(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_()) * 0x1p-32;
    }

  private:
    std::mt19937 engine_;
};

}  // namespace probe
