// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A distance is linear in clip space, and so are x w, y w (framebuffer position times w) and w. So
// on the triangle's plane d = a X + b Y + c W with X = x_f w, Y = y_f w, W = w, where a, b, c are
// found from the three vertices by Cramer's rule; over w this is d/w = a x_f + b y_f + c.
#include "run/overlay.hpp"

#include <gmpxx.h>

#include <cmath>

#include "ref/number/rational.hpp"

namespace run {

namespace {

using Triple = std::array<mpq_class, 3>;  // a number of each vertex

mpq_class determinant(const Triple& a, const Triple& b, const Triple& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

mpq_class distance_from(ref::ClipPlane plane, const ref::ClipInput& input, size_t vertex) {
    const glm::vec4& p = input.clip.at(vertex);
    const mpq_class w = ref::rational(p.w);
    switch (plane) {
        case ref::ClipPlane::x_low:
            return w + ref::rational(p.x);
        case ref::ClipPlane::x_high:
            return w - ref::rational(p.x);
        case ref::ClipPlane::y_low:
            return w + ref::rational(p.y);
        case ref::ClipPlane::y_high:
            return w - ref::rational(p.y);
        case ref::ClipPlane::z_low:
            return ref::rational(p.z);
        case ref::ClipPlane::z_high:
            return w - ref::rational(p.z);
        case ref::ClipPlane::z_low_symmetric:
            return w + ref::rational(p.z);
        default: {
            const auto k = static_cast<glm::vec4::length_type>(plane) -
                           static_cast<glm::vec4::length_type>(ref::ClipPlane::user_0);
            return ref::rational(input.distance.at(vertex)[k]);
        }
    }
}

// Framebuffer coordinate times w: p/2 c + (o + p/2) w.
mpq_class scaled(float c, float w, float origin, float extent) {
    const mpq_class half = ref::rational(extent) / 2;
    return half * ref::rational(c) + (ref::rational(origin) + half) * ref::rational(w);
}

// In lowest terms on one positive denominator.
std::array<std::string, 4> on_one_denominator(const Triple& abc) {
    mpz_class d = 1;
    for (const mpq_class& q : abc) {
        mpz_lcm(d.get_mpz_t(), d.get_mpz_t(), q.get_den_mpz_t());
    }
    std::array<std::string, 4> out;
    for (size_t k = 0; k < 3; ++k) {
        const mpz_class n = abc.at(k).get_num() * (d / abc.at(k).get_den());
        out.at(k) = n.get_str();
    }
    out[3] = d.get_str();
    return out;
}

}  // namespace

bool is_finite(const ref::ClipInput& input) {
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec4& p = input.clip.at(i);
        for (glm::vec4::length_type c = 0; c < 4; ++c) {
            const bool is_read = c < static_cast<glm::vec4::length_type>(input.distance_count);
            if (!std::isfinite(p[c]) || (is_read && !std::isfinite(input.distance.at(i)[c]))) {
                return false;
            }
        }
    }
    return true;
}

std::vector<report::PlaneCut> cuts_of(const cases::Draw& draw, const cases::Triangle& t) {
    std::vector<report::PlaneCut> cuts;
    const ref::ClipInput input(draw, t.vertex);
    const ref::ClipVolume volume = ref::clip_volume_of(draw);
    if (!is_finite(input) || ref::is_inside(input, volume.all())) {
        return cuts;
    }
    const cases::Viewport& v = draw.viewport;
    Triple x, y, w;
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec4& p = input.clip.at(i);
        x.at(i) = scaled(p.x, p.w, v.x, v.width);
        y.at(i) = scaled(p.y, p.w, v.y, v.height);
        w.at(i) = ref::rational(p.w);
    }
    const mpq_class whole = determinant(x, y, w);
    if (whole == 0) {
        return cuts;
    }
    for (const ref::ClipPlane plane : volume.all()) {
        if (ref::is_inside(input, {&plane, 1})) {
            continue;
        }
        const Triple d{distance_from(plane, input, 0), distance_from(plane, input, 1),
                       distance_from(plane, input, 2)};
        cuts.push_back(
            {static_cast<uint8_t>(plane),
             on_one_denominator({determinant(d, y, w) / whole, determinant(x, d, w) / whole,
                                 determinant(x, y, d) / whole})});
    }
    return cuts;
}

std::array<std::string, 4> corners_of(const cases::Viewport& viewport) {
    const mpq_class x = ref::rational(viewport.x), y = ref::rational(viewport.y);
    const mpq_class x1 = x + ref::rational(viewport.width), y1 = y + ref::rational(viewport.height);
    return {x.get_str(), y.get_str(), x1.get_str(), y1.get_str()};
}

}  // namespace run
