// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/features.hpp"

#include <algorithm>

#include "vk_harness/limits/required_limits.hpp"

namespace vk_harness {

// Each is chained where the device has what it belongs to.
struct EnabledFeatures::Structures {
    VkPhysicalDeviceFeatures2 all = Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VkPhysicalDeviceVulkan12Features core12 =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceMultiviewFeatures multiview =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES};
    VkPhysicalDevicePortabilitySubsetFeaturesKHR portability =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PORTABILITY_SUBSET_FEATURES_KHR};
    VkPhysicalDeviceDynamicRenderingFeatures rendering =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES};
    VkPhysicalDeviceSynchronization2Features synchronization =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES};
    VkPhysicalDeviceMaintenance4Features maintenance =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES};
    VkPhysicalDeviceExtendedDynamicStateFeaturesEXT state =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_FEATURES_EXT};
    VkPhysicalDeviceExtendedDynamicState2FeaturesEXT state2 =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_2_FEATURES_EXT};
    VkPhysicalDeviceExtendedDynamicState3FeaturesEXT state3 =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_3_FEATURES_EXT};
    VkPhysicalDeviceDepthClipEnableFeaturesEXT depth_clip =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_ENABLE_FEATURES_EXT};
    VkPhysicalDeviceDepthClipControlFeaturesEXT clip_control =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_CONTROL_FEATURES_EXT};
    VkPhysicalDevicePrimitiveTopologyListRestartFeaturesEXT list_restart =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PRIMITIVE_TOPOLOGY_LIST_RESTART_FEATURES_EXT};
    DepthBiasControlFeatures bias;
    VkPhysicalDeviceProvokingVertexFeaturesEXT provoking =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_FEATURES_EXT};
    VkPhysicalDeviceFragmentShaderBarycentricFeaturesKHR barycentric =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADER_BARYCENTRIC_FEATURES_KHR};
    VkPhysicalDeviceFragmentShadingRateFeaturesKHR shading_rate =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADING_RATE_FEATURES_KHR};
    VkPhysicalDeviceShaderDemoteToHelperInvocationFeatures demote =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_DEMOTE_TO_HELPER_INVOCATION_FEATURES};
    VkPhysicalDeviceShaderTerminateInvocationFeatures terminate =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_TERMINATE_INVOCATION_FEATURES};
    VkPhysicalDeviceIndexTypeUint8FeaturesEXT index_8 =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_INDEX_TYPE_UINT8_FEATURES_EXT};
    VkPhysicalDeviceMultiDrawFeaturesEXT multi_draw =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTI_DRAW_FEATURES_EXT};
    VkPhysicalDeviceGraphicsPipelineLibraryFeaturesEXT library =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_GRAPHICS_PIPELINE_LIBRARY_FEATURES_EXT};
    VkPhysicalDeviceTransformFeedbackFeaturesEXT feedback =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TRANSFORM_FEEDBACK_FEATURES_EXT};
    VkPhysicalDeviceVertexAttributeDivisorFeaturesEXT divisor =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VERTEX_ATTRIBUTE_DIVISOR_FEATURES_EXT};
    VkPhysicalDeviceMeshShaderFeaturesEXT mesh =
        Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_FEATURES_EXT};
    ShaderObjectFeatures objects;
};

struct EnabledFeatures::Table {
    // Vulkan's structures begin alike; those that the headers lack, too.
    using Base = VkBaseOutStructure;
    template <class T>
    static Base* base(T& structure) {
        return reinterpret_cast<Base*>(&structure);
    }
    // What Capabilities has is there if all of these features are.
    struct Feature {
        bool* has;
        std::vector<VkBool32*> all;
    };
    static constexpr uint64_t kNever = uint64_t{1} << 32U;  // beyond every version
    struct Row {
        std::vector<Base*> structures;  // none: what VkPhysicalDeviceFeatures has
        std::vector<const char*> extensions;
        std::vector<Feature> features;
        uint64_t core_since = kNever;    // without the extensions
        uint64_t from = 0, to = kNever;  // versions in which they are looked at

        bool is_offered(const Capabilities& c) const {
            return c.api_version >= from && c.api_version < to &&
                   (c.api_version >= core_since ||
                    std::ranges::all_of(extensions, [&](const char* name) {
                        return has_device_extension(c.physical, name);
                    }));
        }
    };

    static std::vector<Row> rows(Capabilities& c, Structures& s) {
        constexpr uint32_t k12 = VK_API_VERSION_1_2;
        constexpr uint32_t k13 = VK_API_VERSION_1_3;
        VkPhysicalDeviceFeatures& f = s.all.features;
        PortabilitySupport& subset = c.portability;
        DoorSupport& doors = c.doors;
        return {
            {{},
             {},
             {{&c.core.independent_blend, {&f.independentBlend}},
              {&c.multi_viewport, {&f.multiViewport}},
              {&c.has_sample_shading, {&f.sampleRateShading}},
              {&c.depth_clamp, {&f.depthClamp}},
              {&c.depth_bias_clamp, {&f.depthBiasClamp}},
              {&c.depth_bounds, {&f.depthBounds}},
              {&c.dual_source, {&f.dualSrcBlend}},
              {&c.alpha_to_one, {&f.alphaToOne}},
              {&c.logic_op, {&f.logicOp}},
              {&c.precise_queries, {&f.occlusionQueryPrecise}},
              {&c.pipeline_statistics, {&f.pipelineStatisticsQuery}},
              {&c.info.has_primitive_id, {&f.geometryShader}},
              {&c.clip.clips, {&f.shaderClipDistance}},
              {&c.clip.culls, {&f.shaderCullDistance}}}},
            {{},
             {},
             {{&doors.multi_indirect, {&f.multiDrawIndirect}},
              {&doors.indirect_first_instance, {&f.drawIndirectFirstInstance}},
              {&doors.tessellation, {&f.tessellationShader}},
              {&doors.fragment_stores, {&f.fragmentStoresAndAtomics}}},
             0,
             k12},
            // Before 1.2 vertex shaders that choose would need another extension and another
            // SPIR-V.
            {{base(s.core12)},
             {},
             {{&c.layer_output, {&s.core12.shaderOutputLayer}},
              {&c.viewport_output, {&s.core12.shaderOutputViewportIndex}},
              {&doors.indirect_count, {&s.core12.drawIndirectCount}}},
             0,
             k12},
            {{base(s.multiview)}, {}, {{&doors.multiview, {&s.multiview.multiview}}}, 0, k12},
            {{base(s.portability)},
             {VK_KHR_PORTABILITY_SUBSET_EXTENSION_NAME},
             {{&subset.is_subset, {}},
              {&subset.triangle_fans, {&s.portability.triangleFans}},
              {&subset.interpolation_functions,
               {&s.portability.shaderSampleRateInterpolationFunctions}},
              {&subset.view_reinterpretation, {&s.portability.imageViewFormatReinterpretation}},
              {&subset.multisampled_arrays, {&s.portability.multisampleArrayImage}},
              {&subset.constant_alpha_factors, {&s.portability.constantAlphaColorBlendFactors}}}},
            {{base(s.rendering)},
             {VK_KHR_DYNAMIC_RENDERING_EXTENSION_NAME},
             {{&c.core.dynamic_rendering, {&s.rendering.dynamicRendering}}},
             k13},
            {{base(s.synchronization)},
             {VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME},
             {{&c.core.synchronization2, {&s.synchronization.synchronization2}}},
             k13},
            {{base(s.maintenance)},  // outputs that the next stage does not read
             {VK_KHR_MAINTENANCE_4_EXTENSION_NAME},
             {{&c.core.maintenance4, {&s.maintenance.maintenance4}}},
             k13},
            {{base(s.state), base(s.state2)},  // in 1.3 core without a feature
             {VK_EXT_EXTENDED_DYNAMIC_STATE_EXTENSION_NAME,
              VK_EXT_EXTENDED_DYNAMIC_STATE_2_EXTENSION_NAME},
             {{&c.core.dynamic_state,
               {&s.state.extendedDynamicState, &s.state2.extendedDynamicState2}}},
             kNever,
             0,
             k13},
            {{base(s.state2), base(s.state3)},
             {VK_EXT_EXTENDED_DYNAMIC_STATE_2_EXTENSION_NAME,
              VK_EXT_EXTENDED_DYNAMIC_STATE_3_EXTENSION_NAME},
             {{&doors.dynamic_outputs,
               {&s.state2.extendedDynamicState2LogicOp,
                &s.state3.extendedDynamicState3ColorBlendEnable,
                &s.state3.extendedDynamicState3ColorBlendEquation,
                &s.state3.extendedDynamicState3ColorWriteMask,
                &s.state3.extendedDynamicState3LogicOpEnable,
                &s.state3.extendedDynamicState3AlphaToOneEnable,
                &s.state3.extendedDynamicState3AlphaToCoverageEnable,
                &s.state3.extendedDynamicState3SampleMask}},
              {&doors.dynamic_rasterization,
               {&s.state3.extendedDynamicState3RasterizationSamples,
                &s.state3.extendedDynamicState3SampleMask,
                &s.state3.extendedDynamicState3PolygonMode,
                &s.state3.extendedDynamicState3DepthClampEnable,
                &s.state3.extendedDynamicState3DepthClipEnable,
                &s.state3.extendedDynamicState3ProvokingVertexMode}}},
             kNever,
             k13},
            {{base(s.depth_clip)},
             {VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME},
             {{&c.depth_clip_enable, {&s.depth_clip.depthClipEnable}}}},
            {{base(s.list_restart)},
             {VK_EXT_PRIMITIVE_TOPOLOGY_LIST_RESTART_EXTENSION_NAME},
             {{&c.list_restart, {&s.list_restart.primitiveTopologyListRestart}}}},
            {{base(s.clip_control)},
             {VK_EXT_DEPTH_CLIP_CONTROL_EXTENSION_NAME},
             {{&c.clip.depth_clip_control, {&s.clip_control.depthClipControl}}}},
            {{base(s.bias)},
             {kDepthBiasControlExtension},
             {{&c.depth_bias.control, {&s.bias.control}},
              {&c.depth_bias.force_unorm, {&s.bias.force_unorm}},
              {&c.depth_bias.floating, {&s.bias.floating}},
              {&c.depth_bias.exact, {&s.bias.exact}}}},
            {{base(s.provoking)},
             {VK_EXT_PROVOKING_VERTEX_EXTENSION_NAME},
             {{&c.clip.last_provoking_vertex, {&s.provoking.provokingVertexLast}},
              {&c.clip.feedback_keeps_order,
               {&s.provoking.provokingVertexLast,
                &s.provoking.transformFeedbackPreservesProvokingVertex}}}},
            {{base(s.barycentric)},
             {VK_KHR_FRAGMENT_SHADER_BARYCENTRIC_EXTENSION_NAME},
             {{&c.barycentrics, {&s.barycentric.fragmentShaderBarycentric}}}},
            // Needs render passes of Vulkan 1.2 or VK_KHR_create_renderpass2, as all here.
            {{base(s.shading_rate)},
             {VK_KHR_FRAGMENT_SHADING_RATE_EXTENSION_NAME},
             {{&c.fragment_sizes.is_supported, {&s.shading_rate.pipelineFragmentShadingRate}}}},
            {{base(s.demote)},
             {VK_EXT_SHADER_DEMOTE_TO_HELPER_INVOCATION_EXTENSION_NAME},
             {{&c.discard.demote, {&s.demote.shaderDemoteToHelperInvocation}}},
             k13},
            {{base(s.terminate)},
             {VK_KHR_SHADER_TERMINATE_INVOCATION_EXTENSION_NAME},
             {{&c.discard.terminate, {&s.terminate.shaderTerminateInvocation}}},
             k13},
            {{base(s.index_8)},
             {VK_EXT_INDEX_TYPE_UINT8_EXTENSION_NAME},
             {{&doors.index_8, {&s.index_8.indexTypeUint8}}},
             kNever,
             k12},
            {{base(s.multi_draw)},
             {VK_EXT_MULTI_DRAW_EXTENSION_NAME},
             {{&doors.multi_draw, {&s.multi_draw.multiDraw}}},
             kNever,
             k12},
            {{base(s.library)},
             {VK_KHR_PIPELINE_LIBRARY_EXTENSION_NAME,
              VK_EXT_GRAPHICS_PIPELINE_LIBRARY_EXTENSION_NAME},
             {{&doors.library, {&s.library.graphicsPipelineLibrary}}},
             kNever,
             k12},
            {{base(s.feedback)},
             {VK_EXT_TRANSFORM_FEEDBACK_EXTENSION_NAME},
             {{&doors.feedback, {&s.feedback.transformFeedback}}},
             kNever,
             k12},
            // Without the first feature a divisor is 1 (VUID-VkVertexInputBindingDivisorDescription
            // -vertexAttributeInstanceRateDivisor-02229), so the second one alone offers nothing.
            // maxVertexAttribDivisor is at least 65535.
            {{base(s.divisor)},
             {doors.divisor_extension},
             {{&doors.divisor, {&s.divisor.vertexAttributeInstanceRateDivisor}},
              {&doors.divisor_zero,
               {&s.divisor.vertexAttributeInstanceRateDivisor,
                &s.divisor.vertexAttributeInstanceRateZeroDivisor}}},
             kNever,
             k12},
            {{base(s.mesh)},
             {VK_EXT_MESH_SHADER_EXTENSION_NAME},
             {{&doors.mesh, {&s.mesh.meshShader}}},
             kNever,
             k12},
            {{base(s.objects)},
             {kShaderObjectExtension},
             {{&doors.shader_objects, {&s.objects.shader_object}}},
             kNever,
             k13}};
    }
};

void query_features(Capabilities& c) {
    EnabledFeatures::Structures asked;
    std::vector<EnabledFeatures::Table::Row> rows = EnabledFeatures::Table::rows(c, asked);
    std::erase_if(rows, [&](const auto& row) { return !row.is_offered(c); });
    for (const auto& row : rows) {
        for (VkBaseOutStructure* structure : row.structures) {
            structure->pNext = static_cast<VkBaseOutStructure*>(asked.all.pNext);
            asked.all.pNext = structure;
        }
    }
    vkGetPhysicalDeviceFeatures2(c.physical, &asked.all);
    for (const auto& row : rows) {
        for (const auto& [has, all] : row.features) {
            *has = std::ranges::all_of(all, [](const VkBool32* one) { return *one == VK_TRUE; });
        }
    }
    c.info.wrong_limits =
        wrong_limits(c.limits, asked.all.features, c.api_version, c.portability.is_subset);
}

EnabledFeatures::EnabledFeatures(const Capabilities& c)
    : structures_(std::make_unique<Structures>()) {
    Capabilities own = c;
    for (const Table::Row& row : Table::rows(own, *structures_)) {
        const auto is_there = [](const Table::Feature& feature) { return *feature.has; };
        if (!row.is_offered(c) || std::ranges::none_of(row.features, is_there)) {
            continue;
        }
        for (const Table::Feature& feature : row.features) {
            for (VkBool32* one : feature.all) {
                *one = *feature.has || *one == VK_TRUE ? VK_TRUE : VK_FALSE;
            }
        }
        for (Table::Base* structure : row.structures) {
            structure->pNext = static_cast<Table::Base*>(structures_->all.pNext);
            structures_->all.pNext = structure;
        }
        if (c.api_version < row.core_since) {
            extensions.insert(extensions.end(), row.extensions.begin(), row.extensions.end());
        }
    }
}

EnabledFeatures::~EnabledFeatures() = default;

const VkPhysicalDeviceFeatures2& EnabledFeatures::chain() const {
    return structures_->all;
}

}  // namespace vk_harness
