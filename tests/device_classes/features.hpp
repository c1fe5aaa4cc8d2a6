// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The features that the program asks for or could use, by the structures that they stand in.
#pragma once

#include "device_class.hpp"

namespace device_classes {

// VkPhysicalDeviceDepthBiasControlFeaturesEXT, which Debian 12's headers lack.
struct DepthBiasControl {
    VkStructureType type;
    void* next;
    VkBool32 depthBiasControl, leastRepresentableValueForceUnormRepresentation, floatRepresentation,
        depthBiasExact;
};
inline constexpr auto kDepthBiasControlType = static_cast<VkStructureType>(1000283000);

// Calls visit(name, value) for each feature of the structure that the program may know; whether the
// structure is known.
template <typename Visit>
bool each_feature(void* structure, Visit&& visit) {
#define DEVICE_CLASSES_FEATURE(name) visit(#name, s.name);
    switch (static_cast<int>(static_cast<const VkBaseInStructure*>(structure)->sType)) {
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2: {
            VkPhysicalDeviceFeatures& s =
                static_cast<VkPhysicalDeviceFeatures2*>(structure)->features;
            DEVICE_CLASSES_FEATURE(independentBlend)
            DEVICE_CLASSES_FEATURE(geometryShader)
            DEVICE_CLASSES_FEATURE(tessellationShader)
            DEVICE_CLASSES_FEATURE(sampleRateShading)
            DEVICE_CLASSES_FEATURE(dualSrcBlend)
            DEVICE_CLASSES_FEATURE(logicOp)
            DEVICE_CLASSES_FEATURE(alphaToOne)
            DEVICE_CLASSES_FEATURE(pipelineStatisticsQuery)
            DEVICE_CLASSES_FEATURE(multiDrawIndirect)
            DEVICE_CLASSES_FEATURE(depthClamp)
            DEVICE_CLASSES_FEATURE(depthBiasClamp)
            DEVICE_CLASSES_FEATURE(fillModeNonSolid)
            DEVICE_CLASSES_FEATURE(depthBounds)
            DEVICE_CLASSES_FEATURE(wideLines)
            DEVICE_CLASSES_FEATURE(multiViewport)
            DEVICE_CLASSES_FEATURE(shaderClipDistance)
            DEVICE_CLASSES_FEATURE(shaderCullDistance)
            DEVICE_CLASSES_FEATURE(shaderStorageImageMultisample)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES: {
            auto& s = *static_cast<VkPhysicalDeviceVulkan12Features*>(structure);
            DEVICE_CLASSES_FEATURE(shaderOutputViewportIndex)
            DEVICE_CLASSES_FEATURE(shaderOutputLayer)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES: {
            auto& s = *static_cast<VkPhysicalDeviceVulkan13Features*>(structure);
            DEVICE_CLASSES_FEATURE(dynamicRendering)
            DEVICE_CLASSES_FEATURE(synchronization2)
            DEVICE_CLASSES_FEATURE(maintenance4)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES: {
            auto& s = *static_cast<VkPhysicalDeviceDynamicRenderingFeatures*>(structure);
            DEVICE_CLASSES_FEATURE(dynamicRendering)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES: {
            auto& s = *static_cast<VkPhysicalDeviceSynchronization2Features*>(structure);
            DEVICE_CLASSES_FEATURE(synchronization2)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES: {
            auto& s = *static_cast<VkPhysicalDeviceMaintenance4Features*>(structure);
            DEVICE_CLASSES_FEATURE(maintenance4)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_FEATURES_EXT: {
            auto& s = *static_cast<VkPhysicalDeviceExtendedDynamicStateFeaturesEXT*>(structure);
            DEVICE_CLASSES_FEATURE(extendedDynamicState)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTENDED_DYNAMIC_STATE_2_FEATURES_EXT: {
            auto& s = *static_cast<VkPhysicalDeviceExtendedDynamicState2FeaturesEXT*>(structure);
            DEVICE_CLASSES_FEATURE(extendedDynamicState2)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_DEMOTE_TO_HELPER_INVOCATION_FEATURES: {
            auto& s =
                *static_cast<VkPhysicalDeviceShaderDemoteToHelperInvocationFeatures*>(structure);
            DEVICE_CLASSES_FEATURE(shaderDemoteToHelperInvocation)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_TERMINATE_INVOCATION_FEATURES: {
            auto& s = *static_cast<VkPhysicalDeviceShaderTerminateInvocationFeatures*>(structure);
            DEVICE_CLASSES_FEATURE(shaderTerminateInvocation)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PORTABILITY_SUBSET_FEATURES_KHR: {
            auto& s = *static_cast<VkPhysicalDevicePortabilitySubsetFeaturesKHR*>(structure);
            DEVICE_CLASSES_FEATURE(constantAlphaColorBlendFactors)
            DEVICE_CLASSES_FEATURE(events)
            DEVICE_CLASSES_FEATURE(imageViewFormatReinterpretation)
            DEVICE_CLASSES_FEATURE(imageViewFormatSwizzle)
            DEVICE_CLASSES_FEATURE(imageView2DOn3DImage)
            DEVICE_CLASSES_FEATURE(multisampleArrayImage)
            DEVICE_CLASSES_FEATURE(mutableComparisonSamplers)
            DEVICE_CLASSES_FEATURE(pointPolygons)
            DEVICE_CLASSES_FEATURE(samplerMipLodBias)
            DEVICE_CLASSES_FEATURE(separateStencilMaskRef)
            DEVICE_CLASSES_FEATURE(shaderSampleRateInterpolationFunctions)
            DEVICE_CLASSES_FEATURE(tessellationIsolines)
            DEVICE_CLASSES_FEATURE(tessellationPointMode)
            DEVICE_CLASSES_FEATURE(triangleFans)
            DEVICE_CLASSES_FEATURE(vertexAttributeAccessBeyondStride)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADER_BARYCENTRIC_FEATURES_KHR: {
            auto& s =
                *static_cast<VkPhysicalDeviceFragmentShaderBarycentricFeaturesKHR*>(structure);
            DEVICE_CLASSES_FEATURE(fragmentShaderBarycentric)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_ENABLE_FEATURES_EXT: {
            auto& s = *static_cast<VkPhysicalDeviceDepthClipEnableFeaturesEXT*>(structure);
            DEVICE_CLASSES_FEATURE(depthClipEnable)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PRIMITIVE_TOPOLOGY_LIST_RESTART_FEATURES_EXT: {
            auto& s =
                *static_cast<VkPhysicalDevicePrimitiveTopologyListRestartFeaturesEXT*>(structure);
            DEVICE_CLASSES_FEATURE(primitiveTopologyListRestart)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_CONTROL_FEATURES_EXT: {
            auto& s = *static_cast<VkPhysicalDeviceDepthClipControlFeaturesEXT*>(structure);
            DEVICE_CLASSES_FEATURE(depthClipControl)
            return true;
        }
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_FEATURES_EXT: {
            auto& s = *static_cast<VkPhysicalDeviceProvokingVertexFeaturesEXT*>(structure);
            DEVICE_CLASSES_FEATURE(provokingVertexLast)
            return true;
        }
        case kDepthBiasControlType: {
            auto& s = *static_cast<DepthBiasControl*>(structure);
            DEVICE_CLASSES_FEATURE(depthBiasControl)
            DEVICE_CLASSES_FEATURE(leastRepresentableValueForceUnormRepresentation)
            DEVICE_CLASSES_FEATURE(floatRepresentation)
            DEVICE_CLASSES_FEATURE(depthBiasExact)
            return true;
        }
        default:
            return false;
    }
#undef DEVICE_CLASSES_FEATURE
}

}  // namespace device_classes
