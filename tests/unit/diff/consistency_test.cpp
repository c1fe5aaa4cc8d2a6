// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Two renderings bit for bit: what must be the same, what a variation may change, and that every
// single bit counts.
#include "diff/consistency.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <optional>
#include <tuple>

#include "diff/resolve.hpp"
#include "perfect_capture.hpp"

namespace diff {
namespace {

using cases::Derivation;
using cases::RelationKind;

struct Scene {
    cases::Case test = pixel_case(8, 8, {{1, 1}, {7, 1}, {1, 7}});
    capture::Capture base;

    explicit Scene(RelationKind kind = RelationKind::same_twice) {
        add_attribute(test, cases::Interpolation::smooth, {1, 2, 3});
        test.relations = {{kind, {3, 2}}};
        base = perfect_capture(test, ref::expect(test, ref::Limits{8}, cases::Profile::direct3d));
    }
    std::vector<Derivation> derivations() const { return cases::derivations(test); }
};

// A bit of every plane in turn, at a drawn and at a clear sample.
template <class Flip>
void flip_each(capture::Capture& capture, Flip&& check) {
    for (const size_t sample : {size_t{2 * 8 + 2}, size_t{7 * 8 + 7}}) {
        const auto flip = [&](auto& element, uint32_t plane) {
            auto* bytes = reinterpret_cast<unsigned char*>(&element);
            for (size_t byte = 0; byte < sizeof element; ++byte) {
                bytes[byte] ^= 1U;
                check(sample, plane, static_cast<uint32_t>(byte / 4));
                bytes[byte] ^= 1U;
            }
        };
        flip(capture.hits[sample], 0);
        flip(capture.writers[sample], 1);
        flip(capture.frag_coord[sample], 2);
        flip(capture.attributes[0][sample], 3);
        flip(capture.depth[sample], capture::kDepthPlane);
    }
}

// The scene with one door instead of its relation.
std::vector<Derivation> through(Scene& scene, cases::Door door) {
    scene.test.relations = {{RelationKind::door, {}, door}};
    return scene.derivations();
}

// Four samples a pixel, a stencil beside them, and what they are resolved into.
struct ResolvedScene : Scene {
    explicit ResolvedScene(RelationKind kind, cases::Resolve depth = cases::Resolve::min)
        : Scene(kind) {
        test.target.samples = 4;
        test.target.has_stencil = true;
        test.target.color.emplace();
        test.target.color_resolve = cases::Resolve::average;
        test.target.depth_resolve = depth;
        base = perfect_capture(test, ref::expect(test, ref::Limits{8}, cases::Profile::direct3d));
        for (size_t k = 0; k < base.sample_count(); ++k) {
            base.color.push_back({static_cast<uint32_t>(k % 7), 0, 0, 255});
        }
        add_dependent_planes(base);
    }
};

}  // namespace

TEST(Consistency, EveryRelationAcceptsWhatItDemands) {
    for (const RelationKind kind : {RelationKind::same_twice, RelationKind::scissor_tiles,
                                    RelationKind::other_clears, RelationKind::write_masks}) {
        const Scene scene(kind);
        ASSERT_FALSE(scene.derivations().empty());
        for (const Derivation& d : scene.derivations()) {
            capture::Capture derived = scene.base;
            vary(derived, d.variation);
            const Consistency found = compare_bits(scene.test, scene.base, derived, d);
            EXPECT_EQ(found.compared, 64U) << d.name;
            EXPECT_EQ(found.different, 0U) << d.name;
        }
    }
}

TEST(Consistency, EveryBitOfEveryPlaneCounts) {
    for (const RelationKind kind : {RelationKind::same_twice, RelationKind::scissor_tiles,
                                    RelationKind::other_clears, RelationKind::write_masks}) {
        const Scene scene(kind);
        for (const Derivation& d : scene.derivations()) {
            capture::Capture derived = scene.base;
            vary(derived, d.variation);
            flip_each(derived, [&](size_t sample, uint32_t plane, uint32_t word) {
                const Consistency found = compare_bits(scene.test, scene.base, derived, d);
                ASSERT_EQ(found.different, 1U) << d.name << " plane " << plane;
                ASSERT_EQ(found.differences.size(), 1U);
                EXPECT_EQ(found.differences[0].sample, sample);
                EXPECT_EQ(found.differences[0].plane, plane);
                EXPECT_EQ(found.differences[0].word, word);
            });
        }
    }
}

TEST(Consistency, StencilAndResolvedPixelsAreCompared) {
    for (const RelationKind kind : {RelationKind::same_twice, RelationKind::scissor_tiles,
                                    RelationKind::other_clears, RelationKind::write_masks}) {
        const ResolvedScene scene(kind);
        for (const Derivation& d : scene.derivations()) {
            capture::Capture derived = scene.base;
            vary(derived, d.variation);
            const auto different = [&] { return compare_bits(scene.test, scene.base, derived, d); };
            EXPECT_EQ(different().compared, 5U * 64) << d.name;
            EXPECT_EQ(different().different, 0U) << d.name;
            for (const size_t pixel : {size_t{2 * 8 + 2}, size_t{7 * 8 + 7}}) {
                const auto is_seen = [&](auto& word, size_t at, uint32_t plane, uint32_t nth) {
                    auto& bits = reinterpret_cast<uint32_t&>(word);
                    bits ^= 1U;
                    const Consistency found = different();
                    bits ^= 1U;
                    ASSERT_EQ(found.different, 1U) << d.name << " plane " << plane;
                    EXPECT_EQ(found.differences[0].sample, at);
                    EXPECT_EQ(found.differences[0].plane, plane);
                    EXPECT_EQ(found.differences[0].word, nth);
                };
                const size_t sample = 4 * pixel + 3;
                is_seen(derived.color[sample][2], sample, capture::kColorPlane, 2);
                is_seen(derived.stencil[sample], sample, capture::kStencilPlane, 0);
                is_seen(derived.resolved_color[pixel][3], pixel, capture::kResolvedColorPlane, 3);
                is_seen(derived.resolved_depth[pixel], pixel, capture::kResolvedDepthPlane, 0);
            }
        }
    }
}

// The case's hypotenuse cuts pixel (4, 3), of which some samples are drawn and some are clear.
TEST(Consistency, WhatAClearSampleIsResolvedIntoFollowsTheOtherClearValue) {
    const auto expected = [](cases::Resolve mode, size_t pixel) -> std::optional<float> {
        const ResolvedScene scene(RelationKind::other_clears, mode);
        const Derivation d = scene.derivations()[0];
        EXPECT_TRUE(d.variation.other_depth_clear);
        capture::Capture derived = scene.base;
        vary(derived, d.variation);
        std::optional<float> only;
        for (const float tried : {0.5F, 0.625F, 0.75F}) {
            derived.resolved_depth[pixel] = tried;
            if (compare_bits(scene.test, scene.base, derived, d).different == 0) {
                if (only) {
                    return std::nullopt;  // more than one
                }
                only = tried;
            }
        }
        return only;
    };
    constexpr size_t inside = 2 * 8 + 2, edge = 3 * 8 + 4, outside = 7 * 8 + 7;
    static_assert(std::equal_to<>()(capture::kOtherClearDepth, 0.625F));
    for (const cases::Resolve mode : {cases::Resolve::sample_zero, cases::Resolve::min,
                                      cases::Resolve::max, cases::Resolve::average}) {
        EXPECT_EQ(expected(mode, inside), 0.5F);
        EXPECT_EQ(expected(mode, outside), 0.625F);
    }
    EXPECT_EQ(expected(cases::Resolve::min, edge), 0.5F);
    EXPECT_EQ(expected(cases::Resolve::max, edge), 0.625F);
    EXPECT_EQ(expected(cases::Resolve::average, edge), std::nullopt);
}

TEST(Consistency, AResolvedPixelIsToldAtItsPlace) {
    const ResolvedScene scene(RelationKind::same_twice);
    const std::vector<Derivation> d = scene.derivations();
    capture::Capture derived = scene.base;
    derived.resolved_depth[3 * 8 + 5] = 0.25F;
    derived.stencil[4 * (2 * 8 + 1) + 2] = 77;
    const std::vector<Consistency> found = {compare_bits(scene.test, scene.base, derived, d[0]),
                                            Consistency{}};
    Verdict verdict;
    add_differences(scene.test, d, found, verdict);
    ASSERT_EQ(verdict.findings.size(), 2U);
    const Finding& stencil = verdict.findings[0];
    EXPECT_EQ(stencil.quantity, "stencil, same-twice");
    EXPECT_EQ(stencil.got, "77");
    EXPECT_EQ(std::tuple(stencil.x, stencil.y, stencil.sample), std::tuple(1U, 2U, 2U));
    const Finding& depth = verdict.findings[1];
    EXPECT_EQ(depth.quantity, "resolved depth, same-twice");
    EXPECT_EQ(std::tuple(depth.x, depth.y, depth.sample), std::tuple(5U, 3U, 0U));
}

// The average of 0, 1, 2, 3 is 1 or 2, by whatever way; 3 is none.
TEST(Consistency, AnAverageThroughADoorMayBeRoundedOtherwise) {
    ResolvedScene scene(RelationKind::same_twice);
    const auto different = [&](cases::Door door, uint32_t red) {
        const Derivation d = through(scene, door).front();
        capture::Capture base = scene.base;
        for (uint32_t k = 0; k < 4; ++k) {
            base.color[4 * 18 + k][0] = k;
        }
        base.resolved_color[18][0] = 1;
        capture::Capture derived = base;
        derived.resolved_color[18][0] = red;
        return compare_bits(scene.test, base, derived, d).different;
    };
    using cases::Door;
    EXPECT_EQ(different(Door::image_level, 1), 0U);
    EXPECT_EQ(different(Door::image_level, 2), 0U);
    EXPECT_EQ(different(Door::image_level, 3), 1U);
    EXPECT_EQ(different(Door::index_16, 1), 0U);
    EXPECT_EQ(different(Door::index_16, 2), 1U) << "the same pipeline, state and images";
}

TEST(Consistency, UnchangedAttachmentsBreakOtherClearsAndMasks) {
    for (const RelationKind kind : {RelationKind::other_clears, RelationKind::write_masks}) {
        const Scene scene(kind);
        for (const Derivation& d : scene.derivations()) {
            EXPECT_GT(compare_bits(scene.test, scene.base, scene.base, d).different, 0U) << d.name;
        }
    }
}

TEST(Consistency, EachAttachmentIsWrittenInOneOfTheTwoMasks) {
    const Scene scene(RelationKind::write_masks);
    const std::vector<Derivation> two = scene.derivations();
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[0].variation.masked & two[1].variation.masked, 0U);
    EXPECT_EQ(two[0].variation.masked | two[1].variation.masked, 0xffU);
    EXPECT_FALSE(two[0].variation.masks_depth);
    EXPECT_TRUE(two[1].variation.masks_depth);
}

TEST(Consistency, DepthWritesStayWhereOtherDrawsTestDepth) {
    Scene scene(RelationKind::write_masks);
    scene.test.draws[0].depth.compare = cases::CompareOp::less;
    EXPECT_FALSE(scene.derivations()[1].variation.masks_depth);
    scene.test.relations = {{RelationKind::other_clears, {}}};
    EXPECT_FALSE(scene.derivations()[0].variation.other_depth_clear);
}

// Early tests store the depth of a fragment that the shader then discards. Where it has the bits of
// the clear value, the sample looks clear.
TEST(Consistency, ADepthThatIsStoredWithoutAHitMayBeTheClearValue) {
    Scene scene(RelationKind::other_clears);
    const Derivation d = scene.derivations()[0];
    ASSERT_TRUE(d.variation.other_depth_clear);
    constexpr size_t clear = 7 * 8 + 7;
    capture::Capture derived = scene.base;
    vary(derived, d.variation);
    derived.depth[clear] = scene.base.depth[clear];
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 1U);
    scene.test.draws[0].early_tests = true;
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 1U);
    scene.test.draws[0].discard = cases::Discard::odd_columns;
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 0U);
    derived.depth[clear] = 0.5F;
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 1U);
    derived.depth[clear] = scene.base.depth[clear];
    scene.test.draws[0].depth.write = false;
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 1U);
    scene.test.draws[0].depth.write = true;
    scene.test.draws[0].discard = cases::Discard::none;
    scene.test.draws[0].multisample.shader_mask = 1;
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 0U);
}

// What is +0 at every vertex is drawn or not, by how much room there is for attachments.
TEST(Consistency, ComponentsThatNeedNotBeDrawnAreZeroOfEitherSign) {
    Scene scene;
    const Derivation d = scene.derivations()[0];
    capture::Capture derived = scene.base;
    derived.attributes[0][18].z = -0.0F;
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 0U);
    derived.attributes[0][18].z = 0x1p-126F;
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 1U);
    derived.attributes[0][18].z = -0.0F;
    scene.test.draws[0].attributes[0].values[1].z = -0.0F;
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 1U);
}

TEST(Consistency, NaNsAreComparedByTheirBits) {
    Scene scene;
    const Derivation d = scene.derivations()[0];
    scene.base.attributes[0][18].y = std::bit_cast<float>(0x7fc00001U);
    capture::Capture derived = scene.base;
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 0U);
    derived.attributes[0][18].y = std::bit_cast<float>(0x7fc00002U);
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 1U);
    scene.base.attributes[0][18].y = 0.0F;
    derived.attributes[0][18].y = -0.0F;
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 1U);
}

TEST(Consistency, FewerAttributesCompareTheRest) {
    const Scene scene(RelationKind::fewer_attributes);
    const Derivation d = scene.derivations()[0];
    EXPECT_TRUE(cases::derive(scene.test, d).draws[0].attributes.empty());
    capture::Capture derived = scene.base;
    derived.attribute_count = 0;
    derived.attributes[0].clear();
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 0U);
    derived.hits[18].x += 1;
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 1U);
}

TEST(Consistency, CopiesOfAttributesEqualTheirOriginals) {
    const Scene scene(RelationKind::more_attributes);
    const Derivation d = scene.derivations()[0];
    EXPECT_EQ(cases::derive(scene.test, d).draws[0].attributes.size(), 2U);
    capture::Capture derived = scene.base;
    derived.attribute_count = 2;
    derived.attributes[1] = derived.attributes[0];
    EXPECT_EQ(compare_bits(scene.test, scene.base, derived, d).different, 0U);
    derived.attributes[1][18].x = std::nextafter(derived.attributes[1][18].x, 9.0F);
    const Consistency found = compare_bits(scene.test, scene.base, derived, d);
    ASSERT_EQ(found.different, 1U);
    EXPECT_EQ(plane_name(found.differences[0].plane, found.differences[0].word), "attribute 1.x");
}

TEST(Consistency, FindingsNameSampleBitsAndRule) {
    const Scene scene(RelationKind::scissor_tiles);
    const std::vector<Derivation> d = scene.derivations();
    capture::Capture derived = scene.base;
    derived.hits[18].x += 1;
    const std::vector<Consistency> found = {compare_bits(scene.test, scene.base, derived, d[0])};
    Verdict verdict;
    verdict.profile = cases::Profile::vulkan;
    verdict.marks.assign(64, SampleMark::ok);
    add_differences(scene.test, d, found, verdict);
    ASSERT_EQ(verdict.findings.size(), 1U);
    const Finding& f = verdict.findings[0];
    EXPECT_EQ(f.rule, "repeat.scissor");
    EXPECT_EQ(f.level, cases::Profile::vulkan);
    EXPECT_EQ(f.x, 2U);
    EXPECT_EQ(f.y, 2U);
    EXPECT_EQ(f.quantity, "front hits, scissor-tiles 3x2");
    EXPECT_EQ(f.expected, "0x00000000 (0)");
    EXPECT_EQ(f.got, "0x3f800000 (1)");
    EXPECT_EQ(verdict.counts[static_cast<size_t>(FindingKind::value)], 1U);
    EXPECT_EQ(verdict.marks[18], SampleMark::value);
    EXPECT_FALSE(verdict.ok());
}

TEST(Consistency, AllDifferentSamplesAreCountedAndTheFirstOnesKept) {
    const Scene scene;
    const std::vector<Derivation> d = scene.derivations();
    capture::Capture derived = scene.base;
    for (float& depth : derived.depth) {
        depth += 1.0F;
    }
    const std::vector<Consistency> found = {compare_bits(scene.test, scene.base, derived, d[0]),
                                            compare_bits(scene.test, scene.base, scene.base, d[1])};
    EXPECT_EQ(found[0].different, 64U);
    EXPECT_EQ(found[0].differences.size(), kMaxDifferences);
    Verdict verdict;
    verdict.marks.assign(64, SampleMark::ok);
    add_differences(scene.test, d, found, verdict);
    EXPECT_EQ(verdict.counts[static_cast<size_t>(FindingKind::value)], 64U);
    EXPECT_EQ(verdict.count_wrong_samples(), 64U);
    // Of those beyond what is kept it is not known whether they were wrong already.
    std::vector<Consistency> more = found;
    more[0].different = 65;
    add_differences(scene.test, d, more, verdict);
    EXPECT_EQ(verdict.count_wrong_samples(), std::nullopt);
}

TEST(Consistency, OtherShadersAreHeldToItFromPracticeOn) {
    const Scene scene(RelationKind::more_attributes);
    const std::vector<Derivation> d = scene.derivations();
    const std::vector<Consistency> found = {{64, 1, {{18, 3, 0, 1, 2}}, {}, {}}};
    Verdict verdict;
    verdict.profile = cases::Profile::vulkan;
    add_differences(scene.test, d, found, verdict);
    EXPECT_TRUE(verdict.ok());
    verdict.profile = cases::Profile::practice;
    add_differences(scene.test, d, found, verdict);
    EXPECT_FALSE(verdict.ok());
}

TEST(Consistency, ADoorMovesTheNumbersOfVerticesAndNothingElse) {
    Scene scene;
    const Derivation d = through(scene, cases::Door::vertex_offset).front();
    EXPECT_EQ(compare_bits(scene.test, scene.base, scene.base, d).different, 15U);
    capture::Capture moved = scene.base;
    vary(moved, d.variation);
    EXPECT_EQ(compare_bits(scene.test, scene.base, moved, d).different, 0U);
    EXPECT_EQ(moved.writers[2 * 8 + 2].provoking_vertex,
              scene.base.writers[2 * 8 + 2].provoking_vertex + cases::kMovedVertices);
    flip_each(moved, [&](size_t sample, uint32_t plane, uint32_t word) {
        const Consistency found = compare_bits(scene.test, scene.base, moved, d);
        ASSERT_EQ(found.different, 1U) << plane << " " << word;
        EXPECT_EQ(found.differences.front().sample, sample);
    });
    const Derivation plain = through(scene, cases::Door::index_16).front();
    EXPECT_EQ(compare_bits(scene.test, scene.base, scene.base, plain).different, 0U);
    EXPECT_NE(compare_bits(scene.test, scene.base, moved, plain).different, 0U);
}

TEST(Consistency, WhatIsMaskedHoldsItsClearValueInEveryWord) {
    const Scene scene(RelationKind::write_masks);
    capture::Capture masked = scene.base;
    vary(masked, scene.derivations()[1].variation);
    EXPECT_EQ(masked.writers[2 * 8 + 2], capture::Writer{});
    EXPECT_NE(scene.base.writers[2 * 8 + 2], capture::Writer{});
}

TEST(Consistency, PrimitivesOfASplitDrawMayBeginAgainAndNothingElse) {
    Scene scene;
    Derivation d = through(scene, cases::Door::multi_draw).front();
    ASSERT_EQ(d.variation.splits, std::vector<uint32_t>{0});
    d.variation.splits = {2};  // as if the triangle were the fifth
    capture::Capture base = scene.base;
    const size_t at = 2 * 8 + 2;
    base.writers[at].primitive = 4;
    capture::Capture derived = base;
    vary(derived, d.variation);
    const auto different = [&](uint32_t primitive) {
        derived.writers[at].primitive = primitive;
        return compare_bits(scene.test, base, derived, d).different;
    };
    EXPECT_EQ(different(4), 0U);
    EXPECT_EQ(different(2), 0U);
    EXPECT_EQ(different(3), 1U);
    EXPECT_EQ(different(0), 1U);
    base.writers[at].primitive = 1;  // of the first half
    EXPECT_EQ(different(1), 0U);
    EXPECT_EQ(different(0), 1U);
}

TEST(Consistency, WhatNoRulePromisesIsAFindingAtVulkanOnlyIfThePictureIsWrong) {
    Scene scene;
    const auto level = [&](cases::Door door, cases::Profile profile, const std::string& wrong) {
        const std::vector<Derivation> d = through(scene, door);
        const std::vector<Consistency> found = {{64, 1, {{18, 3, 0, 1, 2}}, {}, wrong}};
        Verdict verdict;
        verdict.profile = profile;
        add_differences(scene.test, d, found, verdict);
        return verdict.ok() ? std::string("none")
                            : std::string(cases::to_string(verdict.findings.front().level));
    };
    using cases::Door;
    using cases::Profile;
    EXPECT_EQ(level(Door::index_16, Profile::vulkan, ""), "vulkan");
    EXPECT_EQ(level(Door::index_16, Profile::direct3d, ""), "vulkan");
    EXPECT_EQ(level(Door::interleaved, Profile::vulkan, ""), "none");
    EXPECT_EQ(level(Door::interleaved, Profile::practice, ""), "practice");
    EXPECT_EQ(level(Door::interleaved, Profile::vulkan, "cover.inside at (1, 1): ..."), "vulkan");
}

TEST(Consistency, ADoorIsNamedWithWhatItDoes) {
    Scene scene;
    const std::vector<Derivation> d = through(scene, cases::Door::index_offset);
    const std::vector<Consistency> found = {{64, 1, {{18, 0, 1, 1, 2}}, {}, {}}};
    Verdict verdict;
    add_differences(scene.test, d, found, verdict);
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings.front().rule, "door.buffer");
    EXPECT_EQ(verdict.findings.front().quantity, "back hits, door index-offset");
    EXPECT_NE(verdict.findings.front().why.find("through the door index-offset"),
              std::string::npos);
}

}  // namespace diff
