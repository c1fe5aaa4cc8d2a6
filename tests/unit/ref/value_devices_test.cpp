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
Tally run(Device device, Fault fault, uint64_t seed, int count, int w_exponent) {
    std::mt19937_64 rng(seed);
    Tally tally;
    for (int n = 0; n < count; ++n) {
        const uint32_t size = kSizes[static_cast<size_t>(n) % kSizes.size()];
        const Shape shape = kShapes[static_cast<size_t>(n / 4) % kShapes.size()];
        const Sampled s = value_test::random_case(rng, size, shape, n % 2 == 0 ? 0 : w_exponent);
        const Simulated simulated(s.c, device, fault);
        ref::ValueReference reference(s.c, ref::Limits{}, cases::Profile::direct3d);
        for (const cases::SampleId& id : s.inside) {
            const ref::FragmentVerdict verdict = reference.judge(0, id, simulated.at(id.x, id.y));
            ++tally.fragments;
            tally.worst = std::max(tally.worst, verdict.worst_ratio);
            if (!verdict.ok) {
                ++tally.rejected;
                if (tally.first.empty()) {
                    const ref::ValueMismatch& m = verdict.mismatches.front();
                    tally.first = "triangle " + std::to_string(n) + " " + to_text(m.quantity) +
                                  " " + m.expected + " got " + m.got;
                }
            }
        }
    }
    return tally;
}

TEST(ExhaustiveValueDevices, OriginAnchoredPlanesPass) {
    const Tally t = run(Device::origin_plane, Fault::none, 1, 20000, 12);
    RecordProperty("worst_ratio", std::to_string(t.worst));
    std::printf("origin plane: %llu fragments, K %.3f\n",
                static_cast<unsigned long long>(t.fragments), t.worst);
    EXPECT_EQ(t.rejected, 0U) << t.first;
    EXPECT_GT(t.fragments, 20000U);
}

TEST(ExhaustiveValueDevices, VertexRelativeSnappedPlanesPass) {
    const Tally t = run(Device::relative_snapped, Fault::none, 2, 20000, 12);
    std::printf("relative snapped: %llu fragments, K %.3f\n",
                static_cast<unsigned long long>(t.fragments), t.worst);
    EXPECT_EQ(t.rejected, 0U) << t.first;
}

TEST(ExhaustiveValueDevices, BruteBarycentricsPass) {
    const Tally t = run(Device::brute_barycentric, Fault::none, 3, 20000, 12);
    std::printf("brute barycentric: %llu fragments, K %.3f\n",
                static_cast<unsigned long long>(t.fragments), t.worst);
    EXPECT_EQ(t.rejected, 0U) << t.first;
}

TEST(ExhaustiveValueDevices, DifferenceFormPasses) {
    const Tally t = run(Device::difference_form, Fault::none, 4, 20000, 12);
    std::printf("difference form: %llu fragments, K %.3f\n",
                static_cast<unsigned long long>(t.fragments), t.worst);
    EXPECT_EQ(t.rejected, 0U) << t.first;
}

// A fault must be seen in nearly every triangle where it changes anything worth mentioning.
TEST(ExhaustiveValueDevices, AffineInsteadOfPerspectiveIsRejected) {
    const Tally t = run(Device::origin_plane, Fault::affine, 5, 1000, 4);
    // Half of the triangles have equal w, where affine is right.
    EXPECT_GT(t.rejected * 100, t.fragments * 45);
}

TEST(ExhaustiveValueDevices, HalfPixelShiftIsRejected) {
    const Tally t = run(Device::origin_plane, Fault::half_pixel, 6, 600, 4);
    EXPECT_GT(t.rejected * 100, t.fragments * 98);
}

TEST(ExhaustiveValueDevices, TwelveBitReciprocalIsRejected) {
    std::mt19937_64 rng(7);
    uint64_t rejected = 0, fragments = 0;
    for (int n = 0; n < 500; ++n) {
        const Sampled s = value_test::random_case(rng, 64, Shape::large, 4);
        const Simulated device(s.c, Device::brute_barycentric, Fault::short_reciprocal);
        ref::ValueReference reference(s.c, ref::Limits{}, cases::Profile::direct3d);
        for (const cases::SampleId& id : s.inside) {
            ++fragments;
            rejected += reference.judge(0, id, device.at(id.x, id.y)).ok ? 0U : 1U;
        }
    }
    EXPECT_GT(rejected * 100, fragments * 90);
}

// One basis has to explain all values: half of them from unsnapped, half from snapped positions.
TEST(ExhaustiveValueDevices, MixedBasesAreRejected) {
    std::mt19937_64 rng(8);
    uint64_t rejected = 0, fragments = 0;
    for (int n = 0; n < 300; ++n) {
        const Sampled s = value_test::random_case(rng, 64, Shape::small, 2);
        const Simulated a(s.c, Device::origin_plane, Fault::none);
        const Simulated b(s.c, Device::relative_snapped, Fault::none);
        ref::ValueReference reference(s.c, ref::Limits{}, cases::Profile::direct3d);
        for (const cases::SampleId& id : s.inside) {
            ref::FragmentValues mixed = a.at(id.x, id.y);
            mixed.attributes[1] = b.at(id.x, id.y).attributes[1];
            ++fragments;
            rejected += reference.judge(0, id, mixed).ok ? 0U : 1U;
        }
    }
    // Where a vertex may snap to either of two grid points, the hull of both can hold the mixture.
    EXPECT_GT(rejected * 100, fragments * 50);
}

// Each change below turns a fragment that passes into one that fails.
TEST(ExhaustiveValueDevices, SwappedValuesAreRejected) {
    std::mt19937_64 rng(9);
    for (int n = 0; n < 500; ++n) {
        const Sampled s = value_test::random_case(rng, 64, Shape::large, 4);
        const cases::SampleId id = s.inside.front();
        const ref::FragmentValues good =
            Simulated(s.c, Device::origin_plane, Fault::none).at(id.x, id.y);
        ref::ValueReference reference(s.c, ref::Limits{}, cases::Profile::direct3d);
        ASSERT_TRUE(reference.judge(0, id, good).ok);

        ref::FragmentValues v = good;
        std::swap(v.attributes[0].x, v.attributes[0].y);
        EXPECT_FALSE(reference.judge(0, id, v).ok) << n;
        v = good;
        std::swap(v.attributes[0], v.attributes[1]);
        EXPECT_FALSE(reference.judge(0, id, v).ok) << n;
        v = good;
        v.attributes[2].x = 2.5F;  // the second vertex's value
        const ref::FragmentVerdict flat = reference.judge(0, id, v);
        ASSERT_EQ(flat.mismatches.size(), 1U);
        EXPECT_EQ(flat.mismatches[0].rule, "provoking.first");
        v = good;
        v.attributes[1].y = std::numeric_limits<float>::quiet_NaN();
        const ref::FragmentVerdict nan = reference.judge(0, id, v);
        ASSERT_EQ(nan.mismatches.size(), 1U);
        EXPECT_EQ(nan.mismatches[0].rule, "interp.hull");
        EXPECT_EQ(nan.mismatches[0].level, cases::Profile::vulkan);
        v = good;
        v.frag_coord.y += 0.5F;
        EXPECT_FALSE(reference.judge(0, id, v).ok) << n;
    }
}

// A wrong depth is found in every profile that promises a plane, and the oracle says the same.
TEST(ExhaustiveValueDevices, LevelsAreMonotone) {
    std::mt19937_64 rng(10);
    for (int n = 0; n < 15; ++n) {
        const Sampled s = value_test::random_case(rng, 256, Shape::large, 3);
        const cases::SampleId id = s.inside.front();
        const ref::FragmentValues good =
            Simulated(s.c, Device::brute_barycentric, Fault::none).at(id.x, id.y);
        for (const float off : {0x1p-22F, 0x1p-18F, 0x1p-14F, 0x1p-10F, 0x1p-4F, 2.0F}) {
            ref::FragmentValues v = good;
            v.depth += off;
            bool was_wrong = false;
            for (const cases::Profile profile : cases::kProfiles) {
                ref::ValueReference reference(s.c, ref::Limits{}, profile);
                const ref::FragmentVerdict verdict = reference.judge(0, id, v);
                const ref::FragmentVerdict exact = reference.judge_exact(0, id, v);
                EXPECT_EQ(verdict.ok, exact.ok);
                EXPECT_TRUE(!was_wrong || !verdict.ok) << "wrong at a looser profile only";
                was_wrong = was_wrong || !verdict.ok;
                for (const ref::ValueMismatch& m : verdict.mismatches) {
                    EXPECT_LE(m.level, profile);
                }
            }
            EXPECT_TRUE(was_wrong || off < 1);
        }
    }
}

}  // namespace
