// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Doors on a real device: what they draw, and what is said of those that it lacks.
#include <gtest/gtest.h>

#include "hand_case.hpp"
#include "vk_harness/device/door_support.hpp"
#include "vk_harness/target/target_way.hpp"

namespace vk_harness::testing {
namespace {

// Two overlapping triangles, so that order and number of the draws are seen.
cases::Case two_triangles(cases::Door door) {
    cases::Case c = make_case({16, 16, 1}, {{1, 1}, {15, 1}, {1, 15}, {15, 15}, {1, 14}, {14, 1}});
    cases::Attribute a;
    a.name = "a";
    a.components = 4;
    a.values.assign(6, glm::vec4(0.25F, 3, -7, 1));
    c.draws[0].attributes = {a};
    if (door == cases::Door::restart_extra) {
        c.draws[0].topology = cases::Topology::triangle_strip;
    }
    c.variation.door = door;
    return c;
}

bool is_drawn_as(const capture::Capture& plain, const capture::Capture& door) {
    return plain.hits == door.hits && plain.depth == door.depth &&
           plain.attributes[0] == door.attributes[0] && plain.frag_coord == door.frag_coord;
}

TEST(DoorSupport, EveryNeedIsAskedFor) {
    const DoorSupport all{.index_8 = true,
                          .indirect_count = true,
                          .multi_indirect = true,
                          .multi_draw = true,
                          .dynamic_outputs = true,
                          .dynamic_rasterization = true,
                          .library = true,
                          .multiview = true,
                          .geometry = true,
                          .tessellation = true,
                          .feedback = true,
                          .shader_objects = true,
                          .divisor = true,
                          .divisor_zero = true,
                          .mesh = true,
                          .fragment_stores = true,
                          .linear = true,
                          .host_import = true};
    for (const cases::DoorRow& row : cases::all_doors()) {
        const auto missing = missing_door_support(DoorSupport{}, row.door);
        EXPECT_EQ(missing.has_value(), !needs_of(row.door).empty()) << row.word;
        if (missing) {
            EXPECT_EQ(*missing, "the device lacks " + std::string(needs_of(row.door)));
        }
        EXPECT_FALSE(missing_door_support(all, row.door)) << row.word;
    }
}

TEST(DoorSupport, InstancesNeedDivisorsAndFirstInstances) {
    cases::Case test = two_triangles(cases::Door::indirect);
    DoorSupport support;
    EXPECT_EQ(missing_instance_support(support, test), std::nullopt);
    test.draws[0].first_instance = 2;
    EXPECT_EQ(missing_instance_support(support, test),
              "the device lacks drawIndirectFirstInstance");
    support.indirect_first_instance = true;
    EXPECT_EQ(missing_instance_support(support, test), std::nullopt);
    support.indirect_first_instance = false;
    test.variation.door = cases::Door::none;
    EXPECT_EQ(missing_instance_support(support, test), std::nullopt);
    std::optional<uint32_t>& divisor = test.draws[0].attributes.emplace_back().divisor;
    divisor = 1;
    EXPECT_EQ(missing_instance_support(support, test), std::nullopt);
    divisor = 2;
    EXPECT_EQ(missing_instance_support(support, test),
              "the device lacks vertexAttributeInstanceRateDivisor "
              "(VK_EXT_vertex_attribute_divisor)");
    support.divisor = true;
    EXPECT_EQ(missing_instance_support(support, test), std::nullopt);
    divisor = 0;
    EXPECT_EQ(missing_instance_support(support, test),
              "the device lacks vertexAttributeInstanceRateDivisor and "
              "vertexAttributeInstanceRateZeroDivisor (VK_EXT_vertex_attribute_divisor)");
    support.divisor_zero = true;
    support.divisor_first_instance = false;
    EXPECT_EQ(missing_instance_support(support, test),
              "the device has no divisor but 1 where firstInstance is not 0 "
              "(supportsNonZeroFirstInstance)");
    divisor = 1;
    EXPECT_EQ(missing_instance_support(support, test), std::nullopt);
    divisor = 0;
    test.draws[0].first_instance = 0;
    EXPECT_EQ(missing_instance_support(support, test), std::nullopt);
}

TEST(DoorSupport, AMeshShaderNamesSoManyLayers) {
    cases::Case test = two_triangles(cases::Door::mesh_shader);
    test.target.layers = 9;
    DoorSupport support;
    support.mesh_layers = 8;
    test.draws[0].layer = 7;
    EXPECT_EQ(missing_mesh_layers(support, test), std::nullopt);
    test.draws[0].layer = 8;
    EXPECT_EQ(
        missing_mesh_layers(support, test),
        "a mesh shader of the device names 8 layers (maxMeshOutputLayers), and a draw goes to "
        "number 8");
    test.variation.door = cases::Door::geometry;
    EXPECT_EQ(missing_mesh_layers(support, test), std::nullopt);
}

TEST(DoorImages, AViewportThatIsMovedStaysInTheDevicesRange) {
    Capabilities c;
    c.limits.maxImageDimension2D = 4096;
    c.limits.maxImageArrayLayers = 1;
    c.limits.viewportBoundsRange[1] = 16 + cases::kMovedColumns;
    cases::Case test = two_triangles(cases::Door::target_last_tile);
    EXPECT_EQ(missing_images(c, test), std::nullopt);
    test.draws[0].viewport.width += 1;
    EXPECT_EQ(
        missing_images(c, test),
        "a viewport 296 columns and 200 rows further leaves the device's range, which ends at "
        "312 pixels");
}

TEST(DoorImages, ThatAreLargerThanTheDeviceHasAreToldByTheirSize) {
    Capabilities c;
    c.limits.maxImageDimension2D = 64;
    c.limits.maxImageArrayLayers = 3;
    cases::Case test = two_triangles(cases::Door::image_level);
    test.target.width = 31;  // 2 x 31 + 1 texels
    EXPECT_EQ(missing_images(c, test), std::nullopt);
    test.target.width = 32;
    EXPECT_EQ(missing_images(c, test),
              "an image of 65 x 33 texels is more than the device has (maxImageDimension2D 64)");
    test.variation.door = cases::Door::image_layer;
    EXPECT_EQ(missing_images(c, test), std::nullopt);
    test.target.layers = 2;
    EXPECT_EQ(missing_images(c, test),
              "an image of 4 layers is more than the device has (maxImageArrayLayers 3)");
    test = two_triangles(cases::Door::multiview);
    test.target.samples = 4;
    EXPECT_EQ(missing_images(c, test), std::nullopt);
    c.portability.multisampled_arrays = false;
    EXPECT_TRUE(missing_images(c, test).has_value());
    test.variation.door = cases::Door::none;
    EXPECT_EQ(missing_images(c, test), std::nullopt);
}

// A device that resolves into the layer or level of the source, or into the first one, is seen.
TEST(DoorImages, WhatIsResolvedIntoIsAnotherPart) {
    cases::Case test = two_triangles(cases::Door::image_layer);
    EXPECT_EQ(image_way(test).first_layer, 2U);
    EXPECT_EQ(resolved_way(test).first_layer, 1U);
    EXPECT_EQ(resolved_way(test).first_layer + resolved_way(test).more_layers,
              image_way(test).first_layer);
    test.variation.door = cases::Door::image_level;
    EXPECT_EQ(image_way(test).level, 1U);
    test.target.samples = 4;
    EXPECT_EQ(image_way(test).level, 0U);
    EXPECT_EQ(resolved_way(test).level, 1U);
    test.variation.door = cases::Door::target_larger;
    EXPECT_EQ(resolved_way(test), image_way(test));
}

// A door that does not draw the plain picture is one that this test knows: the findings are in
// docs/findings.
TEST(Door, EachDrawsThePlainPicture) {
    for (const cases::DoorRow& row : cases::all_doors()) {
        std::vector<cases::Case> batch = {two_triangles(row.door)};
        cases::Case plain = batch[0];
        plain.variation.door = cases::Door::none;
        batch.push_back(plain);
        const std::vector<Rendered> drawn = renderer().render(batch);
        ASSERT_EQ(drawn[1].status, Rendered::Status::drawn) << drawn[1].reason;
        if (drawn[0].status == Rendered::Status::unsupported) {
            EXPECT_FALSE(needs_of(row.door).empty()) << row.word << ": " << drawn[0].reason;
            continue;
        }
        ASSERT_EQ(drawn[0].status, Rendered::Status::drawn) << row.word << ": " << drawn[0].reason;
        const bool is_lost_by_lavapipe = row.door == cases::Door::multi_draw_empty ||
                                         row.door == cases::Door::indirect_after_count;
        EXPECT_EQ(is_drawn_as(drawn[1].capture, drawn[0].capture), !is_lost_by_lavapipe)
            << row.word;
    }
}

// With depth and stencil, an own bias, a list and a colour that is not blended for nothing there is
// no state left that changes nothing.
TEST(Door, UnusedStateIsToldWhereThereIsNone) {
    cases::Case c = two_triangles(cases::Door::state_unused);
    EXPECT_EQ(renderer().render({{c}})[0].status, Rendered::Status::drawn);
    c.target.has_stencil = true;
    EXPECT_EQ(renderer().render({{c}})[0].status, Rendered::Status::drawn);
    c.draws[0].depth.bias = cases::DepthBias{1, 0, 0};
    const Rendered none = renderer().render({{c}})[0];
    EXPECT_EQ(none.status, Rendered::Status::unsupported);
    EXPECT_EQ(none.reason, "the case leaves no state that is on for nothing");
}

}  // namespace
}  // namespace vk_harness::testing
