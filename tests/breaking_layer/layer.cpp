// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The layer as the loader sees it: instance and device creation hand down the chain, and
// GetProcAddr answers with the layer's commands or the next one's. Source: "Architecture of the
// Vulkan Loader Interfaces", layer interface version 2 (vk_layer.h).
#include <vulkan/vk_layer.h>

#include <cstring>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <vector>

#include "driver.hpp"
#include "fault_table.hpp"

namespace breaking {

namespace {

struct Instance {
    PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
    PFN_vkDestroyInstance DestroyInstance = nullptr;
    PFN_vkGetPhysicalDeviceFeatures GetPhysicalDeviceFeatures = nullptr;
};

// Both by dispatch key; written when an instance or a device comes and goes, read by every command.
std::shared_mutex mutex;
std::map<void*, Instance> instances;
std::map<void*, std::unique_ptr<Driver>> drivers;

// The structure that the loader chained for the next layer.
template <typename LayerInfo, VkStructureType type>
LayerInfo* chain_info(const void* next) {
    for (auto* s = static_cast<const VkBaseInStructure*>(next); s != nullptr; s = s->pNext) {
        if (s->sType == type) {
            auto* info = reinterpret_cast<LayerInfo*>(const_cast<VkBaseInStructure*>(s));
            if (info->function == VK_LAYER_LINK_INFO) {
                return info;
            }
        }
    }
    return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkInstance* out) {
    auto* link =
        chain_info<VkLayerInstanceCreateInfo, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO>(
            info->pNext);
    if (link == nullptr || chosen_fault() == nullptr) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    const PFN_vkGetInstanceProcAddr next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;  // for the layer below
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(next(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, allocator, out);
    if (result != VK_SUCCESS) {
        return result;
    }
    Instance instance;
    instance.GetInstanceProcAddr = next;
    instance.DestroyInstance =
        reinterpret_cast<PFN_vkDestroyInstance>(next(*out, "vkDestroyInstance"));
    instance.GetPhysicalDeviceFeatures = reinterpret_cast<PFN_vkGetPhysicalDeviceFeatures>(
        next(*out, "vkGetPhysicalDeviceFeatures"));
    const std::unique_lock lock(mutex);
    instances[dispatch_key(*out)] = instance;
    return VK_SUCCESS;
}

Instance instance_of(void* key) {
    const std::shared_lock lock(mutex);
    return instances.at(key);
}

VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance instance,
                                            const VkAllocationCallbacks* allocator) {
    if (instance == VK_NULL_HANDLE) {
        return;
    }
    void* key = dispatch_key(instance);
    instance_of(key).DestroyInstance(instance, allocator);
    const std::unique_lock lock(mutex);
    instances.erase(key);
}

// Lines and points need a feature that the application has no reason to enable.
void enable_lines(VkPhysicalDevice physical, const Instance& instance, VkDeviceCreateInfo& info,
                  VkPhysicalDeviceFeatures& features) {
    VkPhysicalDeviceFeatures offered{};
    instance.GetPhysicalDeviceFeatures(physical, &offered);
    for (auto* s = static_cast<const VkBaseInStructure*>(info.pNext); s != nullptr; s = s->pNext) {
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2) {
            auto* chained =
                reinterpret_cast<VkPhysicalDeviceFeatures2*>(const_cast<VkBaseInStructure*>(s));
            chained->features.fillModeNonSolid = offered.fillModeNonSolid;
            return;
        }
    }
    features =
        info.pEnabledFeatures != nullptr ? *info.pEnabledFeatures : VkPhysicalDeviceFeatures{};
    features.fillModeNonSolid = offered.fillModeNonSolid;
    info.pEnabledFeatures = &features;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical,
                                             const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkDevice* out) {
    auto* link = chain_info<VkLayerDeviceCreateInfo, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO>(
        info->pNext);
    if (link == nullptr) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    const PFN_vkGetInstanceProcAddr next_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    const PFN_vkGetDeviceProcAddr next = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    VkDeviceCreateInfo own = *info;
    VkPhysicalDeviceFeatures features{};
    if (chosen_fault()->needs_lines) {
        enable_lines(physical, instance_of(dispatch_key(physical)), own, features);
    }
    const auto create =
        reinterpret_cast<PFN_vkCreateDevice>(next_instance(VK_NULL_HANDLE, "vkCreateDevice"));
    const VkResult result = create(physical, &own, allocator, out);
    if (result != VK_SUCCESS) {
        return result;
    }
    auto driver = std::make_unique<Driver>();
    driver->GetDeviceProcAddr = next;
    driver->DestroyDevice = reinterpret_cast<PFN_vkDestroyDevice>(next(*out, "vkDestroyDevice"));
#define BREAKING_LOAD(name) driver->name = reinterpret_cast<PFN_vk##name>(next(*out, "vk" #name));
    BREAKING_COMMANDS(BREAKING_LOAD)
#undef BREAKING_LOAD
    add_driver(dispatch_key(*out), std::move(driver));
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
    if (device == VK_NULL_HANDLE) {
        return;
    }
    void* key = dispatch_key(device);
    driver_of(key).DestroyDevice(device, allocator);
    remove_driver(key);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_proc_addr(VkDevice device, const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc_addr(VkInstance instance,
                                                                const char* name);

PFN_vkVoidFunction own_command(const char* name) {
    const std::pair<const char*, PFN_vkVoidFunction> commands[] = {
        {"vkGetInstanceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(get_instance_proc_addr)},
        {"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(get_device_proc_addr)},
        {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(create_instance)},
        {"vkDestroyInstance", reinterpret_cast<PFN_vkVoidFunction>(destroy_instance)},
        {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(create_device)},
        {"vkDestroyDevice", reinterpret_cast<PFN_vkVoidFunction>(destroy_device)},
    };
    for (const auto& [own_name, command] : commands) {
        if (std::strcmp(own_name, name) == 0) {
            return command;
        }
    }
    return own_device_command(name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_proc_addr(VkDevice device, const char* name) {
    const PFN_vkVoidFunction theirs = driver_of_handle(device).GetDeviceProcAddr(device, name);
    // A command that the driver lacks is not there, whatever the layer could do to it.
    const PFN_vkVoidFunction own = own_command(name);
    return theirs != nullptr && own != nullptr ? own : theirs;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc_addr(VkInstance instance,
                                                                const char* name) {
    if (const PFN_vkVoidFunction own = own_command(name)) {
        return own;
    }
    return instance == VK_NULL_HANDLE
               ? nullptr
               : instance_of(dispatch_key(instance)).GetInstanceProcAddr(instance, name);
}

}  // namespace

void add_driver(void* key, std::unique_ptr<Driver> driver) {
    const std::unique_lock lock(mutex);
    drivers[key] = std::move(driver);
}

void remove_driver(void* key) {
    const std::unique_lock lock(mutex);
    drivers.erase(key);
}

const Driver& driver_of(void* key) {
    const std::shared_lock lock(mutex);
    return *drivers.at(key);
}

}  // namespace breaking

extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
    constexpr uint32_t kOurVersion = 2;
    if (version == nullptr || version->sType != LAYER_NEGOTIATE_INTERFACE_STRUCT ||
        version->loaderLayerInterfaceVersion < kOurVersion) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    version->loaderLayerInterfaceVersion = kOurVersion;
    version->pfnGetInstanceProcAddr = breaking::get_instance_proc_addr;
    version->pfnGetDeviceProcAddr = breaking::get_device_proc_addr;
    version->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
