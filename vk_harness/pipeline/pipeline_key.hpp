// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What distinguishes two pipelines. Topology, culling, facing, viewport, scissor and the like
// (DrawState) are dynamic but behind some doors.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cases/model/case.hpp"
#include "shaders/shaders.hpp"
#include "shaders/spirv_variant.hpp"
#include "vk_harness/pipeline/draw_state.hpp"
#include "vk_harness/pipeline/render_pass.hpp"
#include "vk_harness/pipeline/vertex_way.hpp"
#include "vk_harness/target/attachments.hpp"

namespace vk_harness {

// A fragment input and what is written of it; cases::Attribute without its values.
struct AttributeKey {
    cases::Interpolation interpolation = cases::Interpolation::smooth;
    cases::Auxiliary auxiliary = cases::Auxiliary::none;
    cases::Source source = cases::Source::vertex;
    cases::Probe probe = cases::Probe::value;
    friend auto operator<=>(const AttributeKey&, const AttributeKey&) = default;
};

// What a shader writes to an attachment of this format; numbers to all that no row has.
shaders::Output output_of(VkFormat format);

// A colour target and how it is written.
struct ColorKey {
    VkFormat format = VK_FORMAT_UNDEFINED;
    shaders::Output output = shaders::Output::number;
    bool blends = false;
    std::array<uint8_t, 6> equation{};  // source, destination, op of colour, then of alpha
    uint8_t write_mask = 0xf;
    int32_t attribute = -1;  // the input that is written, or -1
    friend auto operator<=>(const ColorKey&, const ColorKey&) = default;
};

// How a pipeline is made, by doors of the group `state`; base: so that others may be derived.
enum class PipelineWay : uint8_t { usual, unoptimized, library, base, derived, cached };
// What stands between vertices and rasterization.
enum class StageWay : uint8_t { vertex, geometry, geometry_strip, tessellation, mesh };

struct PipelineKey {
    uint32_t attribute_count = 0;
    std::array<AttributeKey, cases::kMaxAttributes> attributes{};  // unused ones: as constructed
    uint32_t samples = 1;
    // Vertex stage.
    uint32_t clip_count = 0, cull_count = 0;
    bool matrix = false;  // cases::Draw
    VertexWay way;
    bool layer = false, viewport_index = false;
    uint32_t viewports = 1;            // that are bound; viewport_index: more than one
    bool negative_one_to_one = false;  // depth clip control
    cases::ProvokingVertex provoking = cases::ProvokingVertex::first;
    // Multisampling.
    bool writes_mask = false;  // gl_SampleMask
    bool discards = false, early_tests = false;
    cases::DiscardBy discard_by = cases::DiscardBy::kill;
    bool writes_depth = false;  // gl_FragDepth
    cases::DepthLayout depth_layout = cases::DepthLayout::any;
    uint32_t sample_mask = 0xffffffffU;
    std::optional<uint32_t> min_shading_bits = {};  // of Multisample::min_sample_shading
    std::vector<std::array<uint8_t, 2>> sample_locations = {};  // 1/16 pixel; empty: standard
    // Depth; the test and the bias are dynamic.
    cases::DepthFormat depth_format = cases::DepthFormat::d32_float;
    bool depth_clamp = false;
    std::optional<bool> depth_clip = {};
    cases::Conservative conservative = cases::Conservative::none;
    uint32_t extra_bits = 0;  // of Draw::conservative_extra
    std::array<uint32_t, 2> fragment_size{1, 1};
    bool tests_bounds = false;  // some draw of the case
    bool has_depth = true;
    bool has_stencil = false;
    // Colour output.
    shaders::ColorKind color = shaders::ColorKind::none;
    cases::ColorFrom color_from = cases::ColorFrom::push_constant;
    std::array<uint32_t, 4> constant_bits{};  // the colour, if it is a constant
    bool instruments = true;
    TargetLayout layout;
    // Of cases::Variation.
    uint32_t masked = 0;
    std::optional<DrawState> fixed = {};  // static; nothing: all of it is dynamic
    bool sets_numbers = false;            // what without_numbers() leaves out of `fixed` is dynamic
    PipelineWay made = PipelineWay::usual;
    StageWay stages = StageWay::vertex;
    std::optional<PassKey> pass = {};  // nothing: dynamic rendering
    uint32_t subpass = 0;
    uint32_t view_mask = 0;                 // target_way.hpp
    bool outputs_are_dynamic = false;       // output_state.hpp
    bool rasterization_is_dynamic = false;  // object_state.hpp
    std::vector<ColorKey> colors = {};  // by location, the first behind those of the instruments
    std::optional<cases::LogicOp> logic = {};
    bool alpha_to_one = false;
    bool alpha_to_coverage = false;
    // Tests are on of which there is no attachment; so are those of bounds.
    bool unused_tests = false, unused_bounds = false;
    // Shaders have outputs that nobody reads; of the fragment shader at this location, if any.
    bool unused_interface = false;
    std::optional<uint32_t> unused_color = {};
    friend auto operator<=>(const PipelineKey&, const PipelineKey&) = default;
};

// The key of a draw's pipeline. A draw with fewer attributes than its case gets flat ones that are
// constantly capture::kClearValue: what its fragments leave in those attachments.
// `draw` is one of the case's.
PipelineKey pipeline_key(const cases::Case& c, const cases::Draw& draw, const TargetLayout& layout);

// What the shaders have to be compiled for.
shaders::VertexVariant vertex_variant(const PipelineKey& key);
// The same of the geometry shader, if there is one.
shaders::VertexVariant geometry_variant(const PipelineKey& key);
shaders::FragmentVariant fragment_variant(const PipelineKey& key);
// The vertex shader; empty if none was built.
std::span<const uint32_t> vertex_code(const PipelineKey& key);
// The fragment shader; empty if none was built, or needed (needs_fragments).
std::span<const uint32_t> fragment_code(const PipelineKey& key);
// Whether a fragment shader does anything. A pipeline of depth or stencil alone is without one.
bool needs_fragments(const PipelineKey& key);
// The outputs that its fragment shader keeps of several colours'.
shaders::OutputChange output_change(const PipelineKey& key);
// The execution modes that its fragment shader has besides those it was compiled with.
std::vector<uint32_t> execution_modes(const PipelineKey& key);

}  // namespace vk_harness
