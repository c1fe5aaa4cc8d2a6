// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which cases may reach a driver, by made-up capabilities; no device.
#include "vk_harness/case_check.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "hand_case.hpp"

namespace vk_harness::testing {
namespace {

Capabilities made_up() {
    Capabilities c;
    c.core.dynamic_rendering = c.core.dynamic_state = c.core.depth_resolve = true;
    c.info.max_color_attachments = 4;
    c.max_width = 4096;
    c.max_height = 2048;
    c.sample_counts = VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT;
    c.has_standard_locations = true;
    c.max_allocation = VkDeviceSize{1} << 26;
    c.total_memory = VkDeviceSize{1} << 28;
    c.limits.maxStorageBufferRange = 1U << 20;
    c.limits.maxViewportDimensions[0] = 4096;
    c.limits.maxViewportDimensions[1] = 4096;
    c.limits.viewportBoundsRange[0] = -8192;
    c.limits.viewportBoundsRange[1] = 8191;
    c.limits.maxImageDimension2D = 4096;
    c.max_layers = 256;
    c.layer_output = c.viewport_output = true;
    return c;
}

cases::Case good() {
    return make_case({64, 64, 1}, half_square());
}

cases::Attribute attribute(size_t values) {
    cases::Attribute a;
    a.name = "color";
    a.values.resize(values);
    return a;
}

void expect_rejected(const Capabilities& capabilities, const cases::Case& c,
                     Rendered::Status status, const std::string& reason) {
    const auto rejection = check_case(capabilities, c);
    ASSERT_TRUE(rejection.has_value()) << "expected: " << reason;
    EXPECT_EQ(rejection->status, status) << rejection->reason;
    EXPECT_EQ(rejection->reason, reason);
}

// The harness's own pipelines of some doors have the first vertex as the provoking one.
TEST(CaseCheck, ProvokingVerticesAreMixedOnlyWhereTheyMayBe) {
    Capabilities m = made_up();
    m.clip.last_provoking_vertex = true;
    m.doors.feedback = true;
    m.limits.maxImageArrayLayers = 256;
    cases::Case c = good();
    c.draws[0].provoking = cases::ProvokingVertex::last;
    EXPECT_FALSE(check_case(m, c).has_value());
    for (const cases::Door door : {cases::Door::clear_draw, cases::Door::transform_feedback}) {
        c.variation.door = door;
        m.clip.provoking_per_pipeline = false;
        expect_rejected(m, c, Rendered::Status::unsupported,
                        "the device has one provoking vertex mode for all draws (not "
                        "provokingVertexModePerPipeline)");
        m.clip.provoking_per_pipeline = true;
        EXPECT_FALSE(check_case(m, c).has_value());
    }
}

TEST(CaseCheck, FragmentSizesAreThoseOfTheDevice) {
    Capabilities m = made_up();
    cases::Case c = good();
    c.draws[0].fragment_size = {2, 2};
    expect_rejected(m, c, Rendered::Status::unsupported,
                    "the device lacks the feature pipelineFragmentShadingRate "
                    "(VK_KHR_fragment_shading_rate)");
    m.fragment_sizes.is_supported = true;
    expect_rejected(m, c, Rendered::Status::unsupported,
                    "the device has no fragments of 2 x 2 pixels at sample count 1");
    m.fragment_sizes.sizes = {{2, 2, VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT},
                              {2, 1, VK_SAMPLE_COUNT_1_BIT}};
    EXPECT_FALSE(check_case(m, c).has_value());
    c.draws[0].fragment_size = {1, 2};
    EXPECT_TRUE(check_case(m, c).has_value());
    c.draws[0].fragment_size = {2, 1};
    EXPECT_FALSE(check_case(m, c).has_value());
    c.target.samples = 4;
    expect_rejected(m, c, Rendered::Status::unsupported,
                    "the device has no fragments of 2 x 1 pixels at sample count 4");
    c.draws[0].fragment_size = {2, 2};
    c.draws[0].multisample.sample_mask = 7;
    expect_rejected(m, c, Rendered::Status::unsupported,
                    "the device has fragments of one pixel where a sample mask is used "
                    "(fragmentShadingRateWithSampleMask)");
    m.fragment_sizes.with_sample_mask = true;
    EXPECT_FALSE(check_case(m, c).has_value());
    c.draws[0].multisample.sample_mask = 0xfffffff0U | 15U;
    m.fragment_sizes.with_sample_mask = false;
    EXPECT_FALSE(check_case(m, c).has_value());
    cases::Attribute mask;
    mask.source = cases::Source::sample_mask_in;
    c.draws[0].attributes = {mask};
    expect_rejected(m, c, Rendered::Status::unsupported,
                    "the device has fragments of one pixel where the shader reads gl_SampleMaskIn "
                    "(fragmentShadingRateWithShaderSampleMask)");
    m.fragment_sizes.with_shader_mask = true;
    EXPECT_FALSE(check_case(m, c).has_value());
    // A rate is read of fragments of one pixel, too.
    c.draws[0].fragment_size = {1, 1};
    c.draws[0].attributes[0].source = cases::Source::shading_rate;
    EXPECT_FALSE(check_case(m, c).has_value());
    m.fragment_sizes.is_supported = false;
    EXPECT_TRUE(check_case(m, c).has_value());
}

TEST(CaseCheck, GoodCasesPass) {
    cases::Case c = good();
    EXPECT_FALSE(check_case(made_up(), c).has_value());
    c.draws[0].viewport = {0, 64, 64, -64, 1, 0};
    c.draws[0].attributes = {attribute(3)};
    c.draws[0].indices = {{2, 1, 0}};
    EXPECT_FALSE(check_case(made_up(), c).has_value());
}

TEST(CaseCheck, SampleLocations) {
    using enum Rendered::Status;
    Capabilities m = made_up();
    cases::Case c = good();
    c.target = {64, 64, 4};
    m.has_standard_locations = false;
    const std::string untold =
        "the device does not promise the standard sample locations, and does not tell its own at "
        "sample count 4 by gl_SamplePosition, in sixteenths of a pixel, alike in every pixel";
    expect_rejected(m, c, unsupported, untold);
    m.told_locations = {{{4, 4}, {12, 12}}};
    expect_rejected(m, c, unsupported, untold);
    m.info.sample_locations_error = "the device cannot be asked where its samples are: submit";
    expect_rejected(m, c, error, m.info.sample_locations_error);
    c.target.samples = 1;
    EXPECT_FALSE(check_case(m, c).has_value());
    c.target.samples = 4;
    m.told_locations.push_back({{1, 5}, {9, 2}, {13, 11}, {4, 14}});
    EXPECT_FALSE(check_case(m, c).has_value());
    c.target.sample_locations = {{0, 0}, {15, 0}, {0, 15}};
    expect_rejected(m, c, error, "the target has 3 sample locations for 4 samples");
    c.target.sample_locations.push_back({8, 8});
    expect_rejected(m, c, unsupported,
                    "the device does not take sample locations at sample count 4 "
                    "(VK_EXT_sample_locations)");
    m.location_counts = VK_SAMPLE_COUNT_4_BIT;
    m.location_range[1] = 0.9375F;
    EXPECT_FALSE(check_case(m, c).has_value());
    m.location_range[1] = 0.875F;
    expect_rejected(m, c, unsupported,
                    "the sample location 15/16 is outside the device's range of 0 to 0.875 pixels");
}

TEST(CaseCheck, LoadOperationNoneIsOfAnExtension) {
    cases::Case c = good();
    c.target.depth_load = cases::LoadOp::none;
    Capabilities m = made_up();
    expect_rejected(
        m, c, Rendered::Status::unsupported,
        "the device lacks VK_EXT_load_store_op_none, which the load operation none needs");
    m.has_load_none = true;
    EXPECT_FALSE(check_case(m, c).has_value());
    // Of any colour: what is asked of its format needs a device.
    for (const bool is_beside : {false, true}) {
        cases::Target target;
        target.color = cases::ColorTarget{};
        target.other_colors = {cases::ColorTarget{}};
        EXPECT_FALSE(target.loads_nothing());
        (is_beside ? target.other_colors[0] : *target.color).load = cases::LoadOp::none;
        EXPECT_TRUE(target.loads_nothing()) << is_beside;
    }
}

TEST(CaseCheck, Layers) {
    using enum Rendered::Status;
    Capabilities m = made_up();
    cases::Case c = good();
    c.target.layers = 256;
    c.draws[0].layer = 255;
    EXPECT_FALSE(check_case(m, c).has_value());
    m.layer_output = false;
    expect_rejected(m, c, unsupported,
                    "the device lacks the feature shaderOutputLayer, by which a vertex shader "
                    "chooses the layer");
    m.doors.geometry = true;  // by which a geometry shader does
    EXPECT_FALSE(check_case(m, c).has_value());
    m.limits.maxImageArrayLayers = 256;
    m.doors.shader_objects = true;
    c.variation.door = cases::Door::shader_objects;
    expect_rejected(m, c, unsupported,
                    "the device renders the case by a render pass object or a geometry shader, and "
                    "this door by neither");
    c.variation.door = cases::Door::geometry;
    expect_rejected(m, c, unsupported,
                    "the device has a geometry shader name layers and viewports without the door, "
                    "too");
    c.variation.door = cases::Door::none;
    m.doors.geometry = false;
    c.draws[0].layer = 0;  // no shader has to choose
    EXPECT_FALSE(check_case(m, c).has_value());
    m = made_up();
    m.max_layers = 1;
    expect_rejected(m, c, unsupported,
                    "the target has 256 layers, the device allows 1 (maxFramebufferLayers)");
    c.target.layers = 2;
    c.draws[0].layer = 2;
    expect_rejected(made_up(), c, error, "a draw goes to layer 2 of 2");
    c.target.layers = 0;
    expect_rejected(made_up(), c, error, "a draw goes to layer 2 of 0");
    c = good();
    c.target.layers = 0;
    expect_rejected(made_up(), c, error, "a draw goes to layer 0 of 0");
    c = good();
    c.target.samples = 4;
    c.target.layers = 100;  // 64 x 64 x 4 x 100 samples
    expect_rejected(made_up(), c, unsupported,
                    "reading 1638400 samples singly exceeds the device's storage buffer range of "
                    "1048576 bytes");
}

TEST(CaseCheck, SampleShading) {
    using enum Rendered::Status;
    Capabilities m = made_up();
    cases::Case c = good();
    c.draws[0].multisample.min_sample_shading = 0.0F;
    expect_rejected(m, c, unsupported, "the device lacks the feature sampleRateShading");
    m.has_sample_shading = true;
    EXPECT_FALSE(check_case(m, c).has_value());
    c.draws[0].multisample.min_sample_shading = 2.0F;
    expect_rejected(m, c, error,
                    "the fraction of samples that is shaded at least must lie in [0, 1]");
}

TEST(CaseCheck, Conservative) {
    using enum Rendered::Status;
    Capabilities m = made_up();
    cases::Case c = good();
    c.draws[0].conservative = cases::Conservative::underestimate;
    expect_rejected(m, c, unsupported, "the device lacks VK_EXT_conservative_rasterization");
    m.has_conservative = true;
    expect_rejected(m, c, unsupported,
                    "the device does not underestimate (primitiveUnderestimation)");
    m.has_underestimation = true;
    EXPECT_FALSE(check_case(m, c).has_value());
    c.draws[0].conservative = cases::Conservative::overestimate;
    EXPECT_FALSE(check_case(m, c).has_value());
    c.draws[0].conservative_extra = 0.5F;
    m.most_overestimation = 0.25F;
    expect_rejected(m, c, unsupported,
                    "the draw enlarges its triangles by 0.5 pixels, the device allows 0.25 "
                    "(maxExtraPrimitiveOverestimationSize)");
    m.most_overestimation = 0.5F;
    EXPECT_FALSE(check_case(m, c).has_value());
}

TEST(CaseCheck, HitsThatShareANumber) {
    using enum Rendered::Status;
    Capabilities m = made_up();
    cases::Case c = good();
    c.draws[0].positions.resize(size_t{3} * 2047);
    EXPECT_FALSE(check_case(m, c).has_value());
    c.draws.push_back(good().draws[0]);
    expect_rejected(m, c, unsupported,
                    "the case may hit a sample 2048 times, and the device counts hits up to 2047; "
                    "leave out an attribute or the colour target");
    m.narrow_sample_counts = VK_SAMPLE_COUNT_1_BIT;
    m.info.max_color_attachments = 8;
    EXPECT_FALSE(check_case(m, c).has_value());
}

TEST(CaseCheck, HitsInHalves) {
    using enum Rendered::Status;
    Capabilities m = made_up();
    m.blends_wide = false;
    m.blends_narrow = false;
    cases::Case c = good();
    c.draws[0].positions.resize(size_t{3} * 31);
    EXPECT_FALSE(check_case(m, c).has_value());
    c.draws.push_back(good().draws[0]);
    expect_rejected(m, c, unsupported,
                    "the case may hit a sample 32 times, and the device blends 16-bit floats only, "
                    "in which hits are counted up to 31; leave out an attribute or the colour "
                    "target");
    m.narrow_sample_counts = VK_SAMPLE_COUNT_1_BIT;
    c.draws[0].positions.resize(size_t{3} * 1022);
    EXPECT_FALSE(check_case(m, c).has_value());
    c.draws[0].positions.resize(size_t{3} * 1023);
    EXPECT_TRUE(check_case(m, c).has_value());
    // Ids that share an attachment with hits.
    m.narrow_sample_counts = 0;
    c = good();
    c.draws[0].indices = std::vector<uint32_t>{0, 1, 2};
    c.draws[0].positions.resize(2049);
    expect_rejected(m, c, unsupported,
                    "a draw has 2049 vertices, and the device blends 16-bit floats only, which "
                    "tell 2048 apart");
}

TEST(CaseCheck, PortabilitySubset) {
    using enum Rendered::Status;
    Capabilities m = made_up();
    m.has_sample_shading = true;
    m.portability.is_subset = true;
    m.portability.interpolation_functions = false;
    m.portability.multisampled_arrays = false;
    cases::Case c = good();
    c.draws[0].attributes = {attribute(3)};
    EXPECT_FALSE(check_case(m, c).has_value());
    c.draws[0].attributes[0].probe = cases::Probe::dx;
    expect_rejected(m, c, unsupported,
                    "the device lacks the feature shaderSampleRateInterpolationFunctions "
                    "(VK_KHR_portability_subset)");
    c = good();
    c.target.samples = 4;
    EXPECT_FALSE(check_case(m, c).has_value());
    c.target.layers = 2;
    expect_rejected(
        m, c, unsupported,
        "the device lacks the feature multisampleArrayImage (VK_KHR_portability_subset)");
}

TEST(CaseCheck, Target) {
    using enum Rendered::Status;
    const Capabilities m = made_up();
    cases::Case c = good();
    c.target = {4097, 64, 1};
    expect_rejected(m, c, unsupported,
                    "the target has 4097 x 64 pixels, the device allows 4096 x 2048");
    c.target = {64, 0, 1};
    expect_rejected(m, c, error, "the target has no pixels");
    c.target = {64, 64, 2};
    expect_rejected(m, c, unsupported, "the device does not draw 2 samples a pixel");
    c.target = {64, 64, 3};
    expect_rejected(m, c, error, "3 samples a pixel is not a power of two up to 64");
    c.target = {256, 256, 4};
    expect_rejected(m, c, unsupported,
                    "reading 262144 samples singly exceeds the device's storage buffer range of "
                    "1048576 bytes");
    c.target = {4096, 2048, 1};
    expect_rejected(m, c, unsupported,
                    "an attachment of 134217728 bytes exceeds the device's largest allocation of "
                    "67108864");
    Capabilities small = m;
    small.total_memory = VkDeviceSize{1} << 27;
    c.target = {2048, 2048, 1};  // 4 Mi samples of 2 * 16 + 4 bytes
    EXPECT_FALSE(check_case(m, c).has_value());
    expect_rejected(small, c, unsupported,
                    "the attachments take 150994944 bytes, the device has 134217728");
    c = good();
    c.draws[0].attributes = {attribute(3), attribute(3), attribute(3)};
    expect_rejected(m, c, unsupported, "the case needs 5 colour attachments, the device has 4");
}

TEST(CaseCheck, Viewport) {
    using enum Rendered::Status;
    const Capabilities m = made_up();
    cases::Case c = good();
    cases::Viewport& v = c.draws[0].viewport;
    v = {0, 0, std::numeric_limits<float>::infinity(), 64, 0, 1};
    expect_rejected(m, c, error, "the viewport has a number that is not finite");
    v = {0, 0, 0, 64, 0, 1};
    expect_rejected(m, c, error,
                    "the viewport's width must be positive and its depths lie in [0, 1]");
    v = {0, 0, 64, 64, 0, 1.5F};
    expect_rejected(m, c, error,
                    "the viewport's width must be positive and its depths lie in [0, 1]");
    v = {0, 0, 64, -5000, 0, 1};
    expect_rejected(m, c, unsupported,
                    "the viewport has 64 x 5000 pixels, the device allows 4096 x 4096");
    v = {0, -8000, 64, -500, 0, 1};
    expect_rejected(m, c, unsupported,
                    "the viewport leaves the device's range of -8192 to 8191 pixels");
}

TEST(CaseCheck, Draw) {
    using enum Rendered::Status;
    Capabilities m = made_up();
    cases::Case c = good();
    c.draws[0].scissor = {-1, 0, 8, 8};
    expect_rejected(m, c, error, "the scissor must begin at 0 or later and end below 2^31");
    c.draws[0].scissor = {1, 0, 0x7fffffffU, 8};
    expect_rejected(m, c, error, "the scissor must begin at 0 or later and end below 2^31");
    c = good();
    c.draws[0].attributes = {attribute(2)};
    expect_rejected(m, c, error, "attribute 'color' has 2 values for 3 vertices");
    c.draws[0].attributes.assign(5, attribute(3));
    expect_rejected(m, c, error, "a draw has 5 attributes, at most 4 are allowed");
    c = good();
    c.draws[0].indices = {{0, 1, cases::kRestartIndex}};
    expect_rejected(m, c, error, "index 4294967295 is beyond the 3 vertices of its draw");
    c.draws[0].primitive_restart = true;
    expect_rejected(m, c, unsupported,
                    "the device lacks the feature primitiveTopologyListRestart "
                    "(VK_EXT_primitive_topology_list_restart)");
    m.list_restart = true;
    EXPECT_FALSE(check_case(m, c).has_value());
    c.draws[0].topology = cases::Topology::triangle_fan;
    EXPECT_FALSE(check_case(m, c).has_value());
    m.portability.triangle_fans = false;
    expect_rejected(m, c, unsupported, "the device lacks the feature triangleFans");
}

TEST(CaseCheck, DoorsOfDynamicRenderingAndState) {
    using enum Rendered::Status;
    Capabilities m = made_up();
    cases::Case c = good();
    m.limits.maxImageArrayLayers = 256;
    const std::string rendering =
        "the device renders the case by a render pass object, and this door by dynamic rendering "
        "alone";
    for (const cases::Door door : {cases::Door::pass_split, cases::Door::secondary}) {
        c.variation.door = door;
        m.core.dynamic_rendering = true;
        EXPECT_FALSE(check_case(m, c).has_value());
        m.core.dynamic_rendering = false;
        expect_rejected(m, c, unsupported, rendering);
    }
    c.variation.door = cases::Door::render_pass;
    expect_rejected(m, c, unsupported,
                    "the device renders the case by a render pass object without the door, too");
    c.variation.door = cases::Door::subpasses;
    EXPECT_FALSE(check_case(m, c).has_value());
    c.variation.door = cases::Door::stride_dynamic;
    EXPECT_FALSE(check_case(m, c).has_value());
    m.core.dynamic_state = false;
    expect_rejected(m, c, unsupported,
                    "the device lacks extendedDynamicState, which this door needs");
}

TEST(CaseCheck, Queries) {
    using enum Rendered::Status;
    Capabilities m = made_up();
    cases::Case c = good();
    c.draws[0].query = cases::Query::occlusion;
    EXPECT_FALSE(check_case(m, c).has_value());
    c.draws[0].query = cases::Query::occlusion_precise;
    expect_rejected(m, c, unsupported, "the device lacks the feature occlusionQueryPrecise");
    m.precise_queries = true;
    EXPECT_FALSE(check_case(m, c).has_value());
    for (const cases::Query query :
         {cases::Query::input_vertices, cases::Query::fragment_invocations}) {
        c.draws[0].query = query;
        expect_rejected(m, c, unsupported, "the device lacks the feature pipelineStatisticsQuery");
    }
    m.pipeline_statistics = true;
    EXPECT_FALSE(check_case(m, c).has_value());
}

TEST(CaseCheck, Attribute) {
    using enum Rendered::Status;
    Capabilities m = made_up();
    cases::Case c = good();
    cases::Attribute bary;
    bary.source = cases::Source::barycentric;
    c.draws[0].attributes = {bary};
    expect_rejected(m, c, unsupported,
                    "the device lacks the feature fragmentShaderBarycentric "
                    "(VK_KHR_fragment_shader_barycentric)");
    m.barycentrics = true;
    EXPECT_FALSE(check_case(m, c).has_value());

    using cases::Probe;
    for (const Probe probe : {Probe::at_centroid, Probe::at_sample, Probe::at_offset, Probe::dx,
                              Probe::width_coarse, Probe::lod}) {
        m.has_sample_shading = false;
        c.draws[0].attributes = {attribute(3)};
        c.draws[0].attributes[0].probe = probe;
        expect_rejected(m, c, unsupported, "the device lacks the feature sampleRateShading");
        m.has_sample_shading = true;
        EXPECT_FALSE(check_case(m, c).has_value());
    }
    m.has_sample_shading = false;
    c.draws[0].attributes = {attribute(3)};
    c.draws[0].attributes[0].auxiliary = cases::Auxiliary::sample;
    expect_rejected(m, c, unsupported, "the device lacks the feature sampleRateShading");
    m.has_sample_shading = true;
    c.draws[0].attributes[0].probe = Probe::at_offset;
    c.draws[0].attributes[0].probe_offset = {0.25F, -0.5F};
    m.limits.maxInterpolationOffset = 0.4375F;
    expect_rejected(m, c, unsupported,
                    "interpolateAtOffset by -0.5 pixels leaves the device's range of 0 to 0.4375");
    c.draws[0].attributes[0].probe = Probe::lod;
    c.draws[0].attributes[0].texture_size = {4096, 16};
    m.limits.maxImageDimension2D = 2048;
    expect_rejected(m, c, unsupported, "a texture of 4096 texels a side exceeds the device's 2048");
    // Sample built-ins with derivatives: no shader was built for it.
    m.limits.maxImageDimension2D = 4096;
    c.draws[0].attributes.push_back(cases::Attribute{});
    c.draws[0].attributes[1].source = cases::Source::sample_id;
    expect_rejected(m, c, Rendered::Status::not_built,
                    "a draw asks for a combination of shader features that no shader was built "
                    "for; put them into different draws");
}

}  // namespace
}  // namespace vk_harness::testing
