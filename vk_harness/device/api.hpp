// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Vulkan as the harness sees it: function pointers of volk, no prototypes, no link to the loader.
#pragma once

#define VK_ENABLE_BETA_EXTENSIONS  // VK_KHR_portability_subset
#include <volk.h>

#include <string>
#include <string_view>
#include <utility>

#include "vk_harness/public/harness.hpp"

namespace vk_harness {

// The enumerator's name, or its number.
std::string result_name(VkResult result);

// "VkResult -4"; empty of VK_SUCCESS.
std::string code_of(VkResult result);

// A failure of one call: "vkCreateDevice failed with VK_ERROR_...".
Failure call_failure(Stage stage, VkResult result, std::string_view call);

// Inside the harness a failure is thrown, as Failure; others see it as a value, by attempt().
[[noreturn]] inline void fail(Failure failure) {
    throw std::move(failure);
}
[[noreturn]] inline void fail(Stage stage, std::string message, VkResult result = VK_SUCCESS) {
    fail(Failure{stage, std::move(message), {}, code_of(result), result == VK_ERROR_DEVICE_LOST});
}

// Throws the failure of the call that returned `result`, unless it succeeded.
void check(Stage stage, VkResult result, std::string_view call);

// What `make` makes, or the failure that it throws.
template <class Make>
auto attempt(const Make& make) -> Result<decltype(make())> {
    try {
        return make();
    } catch (Failure& failure) {
        return tl::unexpected<Failure>(std::move(failure));
    }
}

// Finds the loader and the functions that need no instance. Safe to call often.
void load_vulkan(const Options& options);

// A structure of Vulkan's begins as this: of its type, with zeros.
struct Typed {
    VkStructureType type;
    template <class T>
    operator T() const {  // not explicit: the structure names its C++ type
        T out{};
        out.sType = type;
        return out;
    }
};

// Puts a structure before those that hang on another already.
template <class Base, class T>
void chain(Base& base, T& added) {
    added.pNext = base.pNext;
    base.pNext = &added;
}

// Has the device fill in one structure of properties, or its features.
template <class T>
void get_properties(VkPhysicalDevice physical, T& properties) {
    VkPhysicalDeviceProperties2 all = Typed{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    all.pNext = &properties;
    vkGetPhysicalDeviceProperties2(physical, &all);
}

bool has_device_extension(VkPhysicalDevice physical, const char* name);

// A device object that is destroyed with its owner.
template <class T>
class Handle {
  public:
    using Destroy = void(VKAPI_PTR*)(VkDevice, T, const VkAllocationCallbacks*);

    Handle() = default;
    Handle(VkDevice device, T handle, Destroy destroy)
        : device_(device), handle_(handle), destroy_(destroy) {}
    Handle(Handle&& other) noexcept
        : device_(other.device_),
          handle_(std::exchange(other.handle_, VK_NULL_HANDLE)),
          destroy_(other.destroy_) {}
    Handle& operator=(Handle other) noexcept {  // what was held goes with `other`
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        std::swap(destroy_, other.destroy_);
        return *this;
    }
    ~Handle() {
        if (handle_ != VK_NULL_HANDLE) {
            destroy_(device_, handle_, nullptr);
        }
    }

    T get() const { return handle_; }
    explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

  private:
    VkDevice device_ = VK_NULL_HANDLE;
    T handle_ = VK_NULL_HANDLE;
    Destroy destroy_ = nullptr;
};

}  // namespace vk_harness
