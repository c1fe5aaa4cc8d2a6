// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/format.hpp"

#include <algorithm>

namespace vk_harness {

namespace {

constexpr VkFormat unsigned_of(uint32_t bytes) {
    switch (bytes) {
        case 1:
            return VK_FORMAT_R8_UINT;
        case 2:
            return VK_FORMAT_R16_UINT;
        case 4:
            return VK_FORMAT_R32_UINT;
        case 8:
            return VK_FORMAT_R32G32_UINT;
        case 16:
            return VK_FORMAT_R32G32B32A32_UINT;
        default:
            return VK_FORMAT_UNDEFINED;
    }
}
static_assert(std::ranges::all_of(cases::kColorFormats, [](const auto& row) {
    return unsigned_of(bytes_of(row.format)) != VK_FORMAT_UNDEFINED;
}));

}  // namespace

VkFormat bits_format(VkFormat format) {
    const auto row = std::ranges::find_if(
        cases::kColorFormats, [format](const auto& r) { return to_vulkan(r.format) == format; });
    // kTwoNumbers alone is attached and need not be a format of cases.
    static_assert(cases::row_of(cases::ColorFormat::rgba16_float).vulkan == kColorHalves);
    static_assert(cases::row_of(cases::ColorFormat::rg16_float).vulkan == kTwoHalves);
    return unsigned_of(row == cases::kColorFormats.end() ? 8 : bytes_of(row->format));
}

}  // namespace vk_harness
