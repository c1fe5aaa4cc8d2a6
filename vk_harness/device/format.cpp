// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/format.hpp"

namespace vk_harness {

VkFormat to_vulkan(cases::ColorFormat format) {
    switch (format) {
        case cases::ColorFormat::rgba8_unorm:
            return VK_FORMAT_R8G8B8A8_UNORM;
        case cases::ColorFormat::bgra8_unorm:
            return VK_FORMAT_B8G8R8A8_UNORM;
        case cases::ColorFormat::rgba8_srgb:
            return VK_FORMAT_R8G8B8A8_SRGB;
        case cases::ColorFormat::rgb10a2_unorm:
            return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
        case cases::ColorFormat::r5g6b5_unorm:
            return VK_FORMAT_R5G6B5_UNORM_PACK16;
        case cases::ColorFormat::rgba16_unorm:
            return VK_FORMAT_R16G16B16A16_UNORM;
        case cases::ColorFormat::rgba16_float:
            return VK_FORMAT_R16G16B16A16_SFLOAT;
        case cases::ColorFormat::rgba32_float:
            return VK_FORMAT_R32G32B32A32_SFLOAT;
        case cases::ColorFormat::r32_float:
            return VK_FORMAT_R32_SFLOAT;
        case cases::ColorFormat::r32_uint:
            return VK_FORMAT_R32_UINT;
        case cases::ColorFormat::rgba8_uint:
            break;
    }
    return VK_FORMAT_R8G8B8A8_UINT;
}

VkFormat bits_format(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R5G6B5_UNORM_PACK16:
            return VK_FORMAT_R16_UINT;
        case VK_FORMAT_R16G16B16A16_UNORM:
        case VK_FORMAT_R16G16B16A16_SFLOAT:
        case kTwoNumbers:
            return VK_FORMAT_R32G32_UINT;
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return VK_FORMAT_R32G32B32A32_UINT;
        default:
            return VK_FORMAT_R32_UINT;
    }
}

}  // namespace vk_harness
