// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Physical devices, what they can do, and the one logical device that draws.
#pragma once

#include <memory>
#include <vector>

#include "vk_harness/clip_support.hpp"
#include "vk_harness/instance.hpp"

namespace vk_harness {

// What a physical device offers, as far as the harness needs it.
struct Capabilities {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    DeviceInfo info;
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
    uint32_t queue_family = 0;
    uint32_t max_width = 0, max_height = 0;             // of a target
    VkDeviceSize max_allocation = 0, total_memory = 0;  // bytes
    VkSampleCountFlags sample_counts = 0;  // all attachments, drawn and read sample by sample
    // VK_EXT_sample_locations; none of its counts without the extension.
    VkSampleCountFlags location_counts = 0;
    float location_range[2] = {0, 0};     // pixels
    bool has_standard_locations = false;  // standardSampleLocations
    bool has_sample_shading = false;      // sampleRateShading
    bool triangle_fans = true;
    ClipSupport clip;
    bool barycentrics = false;  // VK_KHR_fragment_shader_barycentric
    bool portability_subset = false;
};

Capabilities query_capabilities(VkPhysicalDevice physical, uint32_t index);

// The device that options.device names ("" = the first usable one), or one reason for every device
// that was rejected.
Result<Capabilities> choose_device(const Instance& instance, const Options& options);

class Device {
  public:
    static Result<Device> create(const Capabilities& capabilities);
    Device(Device&& other) noexcept;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    Device& operator=(Device&&) = delete;
    ~Device();

    VkDevice get() const { return device_; }
    VkQueue queue() const { return queue_; }
    const VolkDeviceTable& vk() const { return *table_; }
    const Capabilities& capabilities() const { return *capabilities_; }

  private:
    Device() = default;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::unique_ptr<VolkDeviceTable> table_;  // stable addresses: resources keep a pointer
    std::unique_ptr<Capabilities> capabilities_;
};

// Formats of the attachments (diff/capture.hpp).
inline constexpr VkFormat kColorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
inline constexpr VkFormat kColorBitsFormat = VK_FORMAT_R32G32B32A32_UINT;  // to read bits
inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
// Colour attachments before the attributes: hits, writer, frag_coord.
inline constexpr uint32_t kFixedAttachments = 3;

}  // namespace vk_harness
