// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The Vulkan instance and the validation layer's messages.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "vk_harness/device/api.hpp"

namespace vk_harness {

// Collects what the validation layer says; drivers may call it from any thread.
class MessageLog {
  public:
    void add(std::string message);
    // All messages since the last call.
    std::vector<std::string> take();

  private:
    std::mutex mutex_;
    std::vector<std::string> messages_;
};

class Instance {
  public:
    // Loads Vulkan and creates an instance of version 1.3, with the Khronos validation layer if
    // options.validation asks for it.
    static Instance create(const Options& options);
    Instance(Instance&& other) noexcept;
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    Instance& operator=(Instance&&) = delete;
    ~Instance();

    VkInstance get() const { return instance_; }
    MessageLog& messages() const { return *messages_; }
    std::vector<VkPhysicalDevice> physical_devices() const;
    // The version of Vulkan that the validation layer was written for, if there is one.
    std::optional<uint32_t> validation_version() const { return validation_version_; }

  private:
    Instance() = default;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    // Of this instance: volk's global pointer belongs to the instance that was created last.
    PFN_vkDestroyDebugUtilsMessengerEXT destroy_messenger_ = nullptr;
    std::optional<uint32_t> validation_version_;
    std::unique_ptr<MessageLog> messages_ = std::make_unique<MessageLog>();
};

}  // namespace vk_harness
