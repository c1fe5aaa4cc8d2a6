// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Physical devices, what they can do, and the one logical device that draws.
#pragma once

#include <memory>
#include <vector>

#include "vk_harness/device/capabilities.hpp"
#include "vk_harness/device/instance.hpp"
#include "vk_harness/device/shader_object.hpp"

namespace vk_harness {

// Whether it is the device that a run is pinned to, if it is.
bool is_pinned(const Options& options, const DeviceInfo& info);

// The device that options.device names ("" = the first usable one), or one reason for every device
// that was rejected.
Capabilities choose_device(const Instance& instance, const Options& options);

class Device {
  public:
    static Device create(const Capabilities& capabilities);
    Device(Device&& other) noexcept;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    Device& operator=(Device&&) = delete;
    ~Device();

    VkDevice get() const { return device_; }
    VkQueue queue() const { return queue_; }
    const VolkDeviceTable& vk() const { return *table_; }
    const Capabilities& capabilities() const { return *capabilities_; }
    // What it has answered, or why it has not.
    void set_sample_locations(std::vector<cases::SampleLocations> told, std::string error = {}) {
        capabilities_->info.sample_locations = cases::to_text(told);
        capabilities_->told_locations = std::move(told);
        capabilities_->info.sample_locations_error = std::move(error);
    }
    // Nanoseconds that a wait for the device lasts at most; UINT64_MAX: without end.
    uint64_t longest_wait() const { return longest_wait_; }
    void set_longest_wait(uint64_t nanoseconds) { longest_wait_ = nanoseconds; }

    // Null unless the device has depthBiasControl.
    SetDepthBias2 set_depth_bias2() const { return set_depth_bias2_; }
    const ShaderObjectCalls& shader_objects() const { return shader_objects_; }

  private:
    Device() = default;
    SetDepthBias2 set_depth_bias2_ = nullptr;
    ShaderObjectCalls shader_objects_;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    uint64_t longest_wait_ = UINT64_MAX;
    std::unique_ptr<VolkDeviceTable> table_;  // stable addresses: resources keep a pointer
    std::unique_ptr<Capabilities> capabilities_;
};

// A new object of the device, made by the call that `name` names.
template <class Info, class T>
Handle<T> make(const Device& device, Stage stage, std::string_view name,
               VkResult(VKAPI_PTR* create)(VkDevice, const Info*, const VkAllocationCallbacks*, T*),
               typename Handle<T>::Destroy destroy, const Info& info) {
    T handle = VK_NULL_HANDLE;
    check(stage, create(device.get(), &info, nullptr, &handle), name);
    return Handle<T>(device.get(), handle, destroy);
}

// A buffer of the device, not bound to memory yet. `next` extends the structure that it is made
// from.
Handle<VkBuffer> make_buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage,
                             const void* next = nullptr);

}  // namespace vk_harness
