// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Binary32 implementations of interpolation: right ones stay within K budgets, wrong ones do not.
#include <gtest/gtest.h>

#include <limits>

#include "value_case.hpp"

namespace {

using value_test::Device;
using value_test::Fault;
using value_test::Sampled;
using value_test::Shape;
using value_test::Simulated;

constexpr std::array<uint32_t, 4> kSizes = {64, 512, 2048, 8192};
constexpr std::array<Shape, 3> kShapes = {Shape::small, Shape::large, Shape::sliver};

struct Tally {
    uint64_t fragments = 0, rejected = 0;
    double worst = 0;
    std::string first;
};

// Judges `count` random triangles as drawn by a device.
Tally run(Device device, Fault fault, uint64_t seed, int count, int w_exponent,
          bool skip_constants = false) {
    std::mt19937_64 rng(seed);
    Tally tally;
    for (int n = 0; n < count; ++n) {
        const uint32_t size = kSizes[static_cast<size_t>(n) % kSizes.size()];
        const Shape shape = kShapes[static_cast<size_t>(n / 4) % kShapes.size()];
        Sampled s = value_test::random_case(rng, size, shape, n % 2 == 0 ? 0 : w_exponent);
        if (skip_constants) {
            for (glm::vec4& v : s.c.draws[0].attributes[0].values) {
                v.z = v.y;
            }
        }
        const Simulated simulated(s.c, device, fault);
        ref::ValueReference reference(s.c, ref::Limits{}, cases::Profile::direct3d);
        for (const ref::SampleId& id : s.inside) {
            const ref::FragmentVerdict verdict = reference.judge(0, id, simulated.at(id.x, id.y));
            ++tally.fragments;
            tally.worst = std::max(tally.worst, verdict.worst_ratio);
            if (!verdict.ok) {
                ++tally.rejected;
                if (tally.first.empty()) {
                    const ref::ValueMismatch& m = verdict.mismatches.front();
                    tally.first = "triangle " + std::to_string(n) + " " + m.quantity + " " +
                                  m.expected + " got " + m.got;
                }
            }
        }
    }
    return tally;
}

TEST(ValueDevices, OriginAnchoredPlanesPass) {
    const Tally t = run(Device::origin_plane, Fault::none, 1, 20000, 12);
    RecordProperty("worst_ratio", std::to_string(t.worst));
    std::printf("origin plane: %llu fragments, K %.3f\n",
                static_cast<unsigned long long>(t.fragments), t.worst);
    EXPECT_EQ(t.rejected, 0U) << t.first;
    EXPECT_GT(t.fragments, 20000U);
}

TEST(ValueDevices, VertexRelativeSnappedPlanesPass) {
    const Tally t = run(Device::relative_snapped, Fault::none, 2, 20000, 12);
    std::printf("relative snapped: %llu fragments, K %.3f\n",
                static_cast<unsigned long long>(t.fragments), t.worst);
    EXPECT_EQ(t.rejected, 0U) << t.first;
}

TEST(ValueDevices, BruteBarycentricsPass) {
    const Tally t = run(Device::brute_barycentric, Fault::none, 3, 20000, 12);
    std::printf("brute barycentric: %llu fragments, K %.3f\n",
                static_cast<unsigned long long>(t.fragments), t.worst);
    EXPECT_EQ(t.rejected, 0U) << t.first;
}

TEST(ValueDevices, DifferenceFormPasses) {
    const Tally t = run(Device::difference_form, Fault::none, 4, 20000, 12);
    std::printf("difference form: %llu fragments, K %.3f\n",
                static_cast<unsigned long long>(t.fragments), t.worst);
    EXPECT_EQ(t.rejected, 0U) << t.first;
}

}  // namespace
