// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Triangles that are clipped: a device that interpolates from the clipped piece, re-projected and
// rounded to binary32, passes; wrong values do not.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "value_case.hpp"

namespace {

using value_test::Device;
using value_test::Fault;
using value_test::Simulated;
using value_test::uniform;

// Clip coordinates and two smooth attributes, all binary32, as a clipper carries them.
struct ClipVertex {
    glm::vec4 p;
    std::array<float, 2> f;
};

float distance(const glm::vec4& p, int plane) {
    const float c = p[plane / 2];
    if (plane == 4) {
        return p.z;
    }
    return plane % 2 == 0 ? p.w + c : p.w - c;
}

// Sutherland-Hodgman in binary32, starting each cut from the end point that is nearer to the plane.
std::vector<ClipVertex> clip32(std::vector<ClipVertex> polygon) {
    for (int plane = 0; plane < 6; ++plane) {
        std::vector<ClipVertex> out;
        for (size_t i = 0; i < polygon.size(); ++i) {
            const ClipVertex& a = polygon[i];
            const ClipVertex& b = polygon[(i + 1) % polygon.size()];
            const float da = distance(a.p, plane);
            const float db = distance(b.p, plane);
            if (da >= 0) {
                out.push_back(a);
            }
            if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
                const bool from_a = std::fabs(da) < std::fabs(db);
                const ClipVertex& s = from_a ? a : b;
                const ClipVertex& e = from_a ? b : a;
                const float ds = from_a ? da : db;
                const float de = from_a ? db : da;
                const float t = ds / (ds - de);
                ClipVertex v{};
                for (int k = 0; k < 4; ++k) {
                    v.p[k] = s.p[k] + t * (e.p[k] - s.p[k]);
                }
                for (size_t k = 0; k < 2; ++k) {
                    v.f[k] = s.f[k] + t * (e.f[k] - s.f[k]);
                }
                out.push_back(v);
            }
        }
        polygon = out;
    }
    return polygon;
}

struct Clipped {
    cases::Case c;
    cases::Case piece;  // the fan triangle that holds the pixel, as a case of its own
    cases::SampleId id;
};

// A random triangle that leaves the view volume, and a pixel of its visible part.
Clipped random_clipped(std::mt19937_64& rng, bool behind) {
    const uint32_t size = 256;
    for (;;) {
        std::vector<ClipVertex> v(3);
        std::array<glm::vec4, 3> clip{}, values{};
        for (size_t i = 0; i < 3; ++i) {
            const double w =
                behind && i == 2 ? -uniform(rng, 0.1, 2) : std::exp2(uniform(rng, -3, 3));
            const double reach = 3 * std::fabs(w);
            clip[i] = {static_cast<float>(uniform(rng, -reach, reach)),
                       static_cast<float>(uniform(rng, -reach, reach)),
                       static_cast<float>(uniform(rng, 0.1, 0.9) * w), static_cast<float>(w)};
            values[i] = {static_cast<float>(uniform(rng, 0, 1)),
                         static_cast<float>(uniform(rng, -8, 8)), 0, 0};
            v[i] = {clip[i], {values[i].x, values[i].y}};
        }
        const std::vector<ClipVertex> polygon = clip32(v);
        for (size_t k = 1; k + 1 < polygon.size(); ++k) {
            const std::array<ClipVertex, 3> t = {polygon[0], polygon[k], polygon[k + 1]};
            std::array<double, 3> x{}, y{};
            for (size_t i = 0; i < 3; ++i) {
                x[i] = (static_cast<double>(t[i].p.x / t[i].p.w) + 1) * size / 2;
                y[i] = (static_cast<double>(t[i].p.y / t[i].p.w) + 1) * size / 2;
            }
            const double px = std::floor((x[0] + x[1] + x[2]) / 3) + 0.5;
            const double py = std::floor((y[0] + y[1] + y[2]) / 3) + 0.5;
            const double e0 = value_test::cross(x[0], y[0], x[1], y[1], px, py);
            const double e1 = value_test::cross(x[1], y[1], x[2], y[2], px, py);
            const double e2 = value_test::cross(x[2], y[2], x[0], y[0], px, py);
            if (!((e0 > 0 && e1 > 0 && e2 > 0) || (e0 < 0 && e1 < 0 && e2 < 0))) {
                continue;
            }
            Clipped out{value_test::make_case(size, clip),
                        value_test::make_case(size, {t[0].p, t[1].p, t[2].p}),
                        {static_cast<uint32_t>(px), static_cast<uint32_t>(py), 0}};
            value_test::add_attribute(out.c, cases::Interpolation::smooth, 2, values);
            value_test::add_attribute(
                out.piece, cases::Interpolation::smooth, 2,
                {glm::vec4(t[0].f[0], t[0].f[1], 0, 0), glm::vec4(t[1].f[0], t[1].f[1], 0, 0),
                 glm::vec4(t[2].f[0], t[2].f[1], 0, 0)});
            return out;
        }
    }
}

void expect_pieces_pass(uint64_t seed, bool behind) {
    std::mt19937_64 rng(seed);
    double worst = 0;
    uint64_t wrong_rejected = 0, pieces = 0;
    const int count = 1500;
    for (int n = 0; n < count; ++n) {
        const Clipped s = random_clipped(rng, behind);
        for (const Device device : {Device::origin_plane, Device::brute_barycentric}) {
            const ref::FragmentValues v =
                Simulated(s.piece, device, Fault::none).at(s.id.x, s.id.y);
            for (const cases::Profile profile :
                 {cases::Profile::direct3d, cases::Profile::vulkan}) {
                ref::ValueReference reference(s.c, ref::Limits{}, profile);
                const ref::FragmentVerdict verdict = reference.judge(0, s.id, v);
                ASSERT_TRUE(verdict.ok)
                    << n << " " << to_text(verdict.mismatches[0].quantity) << " "
                    << verdict.mismatches[0].expected << " got " << verdict.mismatches[0].got;
                worst = std::max(worst, verdict.worst_ratio);
                pieces += verdict.basis == ref::BasisKind::clipped_piece ? 1U : 0U;
            }
        }
        ref::FragmentValues off =
            Simulated(s.piece, Device::origin_plane, Fault::affine).at(s.id.x, s.id.y);
        ref::ValueReference reference(s.c, ref::Limits{}, cases::Profile::direct3d);
        const ref::FragmentVerdict affine = reference.judge(0, s.id, off);
        wrong_rejected += affine.ok ? 0U : 1U;
        if (n % 50 == 0) {
            EXPECT_EQ(affine.ok, reference.judge_exact(0, s.id, off).ok);
        }
    }
    std::printf("clipped pieces: K %.3f, explained by the piece only: %llu\n", worst,
                static_cast<unsigned long long>(pieces));
    EXPECT_GT(wrong_rejected * 100, static_cast<uint64_t>(count) * 90);
}

TEST(ExhaustiveValueClipped, PiecesInBinary32Pass) {
    expect_pieces_pass(21, false);
}
TEST(ExhaustiveValueClipped, PiecesOfTrianglesBehindTheEyePass) {
    expect_pieces_pass(22, true);
}

// The determinant of (x, y, w) is 0: the triangle lies in a plane through the eye, so that no
// sample has to be hit, and what is cut from it near w = 0 may be anything between its values
// there. Snapped, the three positions have an area, but a device that cuts the triangle does not
// use them. At profile vulkan 1/w need not be a number there.
TEST(ExhaustiveValueClipped, ThroughTheEyeIsBoundByTheHullAlone) {
    const glm::vec4 v0(-0x1.6f66p+0F, 0x1.6f08p+0F, -0.5F, -1);
    const glm::vec4 v1(-0x1.f25acp+1F, -0x1.8161p+0F, 1.625F, 3.25F);
    const glm::vec4 v2(0x1.ad14ep+2F, -0x1.c69p-1F, -0.875F, -1.75F);
    cases::Case c = value_test::make_case(4, {v0, v1, v2});
    c.target.height = c.draws[0].scissor.height = 11;
    c.draws[0].viewport.height = 11;
    const cases::SampleId id{0, 0, 0};
    for (const cases::Profile profile : cases::kProfiles) {
        ref::ValueReference reference(c, ref::Limits{}, profile);
        ref::FragmentValues v;
        for (const float inv_w : {1.0F, 0x1p20F}) {
            v.frag_coord = {0.5F, 0.5F, 0.5F, inv_w};
            v.depth = 0.5F;
            EXPECT_TRUE(reference.judge(0, id, v).ok)
                << inv_w << " at " << cases::to_string(profile);
        }
        v.frag_coord.w = std::numeric_limits<float>::quiet_NaN();
        EXPECT_EQ(reference.judge(0, id, v).ok, profile == cases::Profile::vulkan)
            << cases::to_string(profile);
    }
}

}  // namespace
