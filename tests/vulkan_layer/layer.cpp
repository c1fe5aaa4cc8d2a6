// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The layer as the loader sees it: instance and device creation hand down the chain, and
// GetProcAddr answers with the layer's commands or the next one's. Source: "Architecture of the
// Vulkan Loader Interfaces", layer interface version 2 (vk_layer.h).
#include "vulkan_layer/layer.hpp"

#include <vulkan/vk_layer.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <shared_mutex>

namespace vulkan_layer {

namespace {

// Both by dispatch key; written when an instance or a device comes and goes, read by every command.
std::shared_mutex mutex;
std::map<void*, Instance> instances;
std::map<void*, std::unique_ptr<Device>> devices;

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
    if (link == nullptr || !is_ready()) {
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
    for (const char* name : needed_instance_commands()) {
        instance.commands[name] = next(*out, name);
    }
    instance.DestroyInstance =
        reinterpret_cast<PFN_vkDestroyInstance>(next(*out, "vkDestroyInstance"));
    const std::unique_lock lock(mutex);
    instances[dispatch_key(*out)] = std::move(instance);
    return VK_SUCCESS;
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
    const auto create =
        reinterpret_cast<PFN_vkCreateDevice>(next_instance(VK_NULL_HANDLE, "vkCreateDevice"));
    const VkResult result = create_next_device(
        instance_of(dispatch_key(physical)), physical, *info,
        [&](const VkDeviceCreateInfo& own) { return create(physical, &own, allocator, out); });
    if (result != VK_SUCCESS) {
        return result;
    }
    std::unique_ptr<Device> device = load_device(*out, next);
    device->GetDeviceProcAddr = next;
    device->DestroyDevice = reinterpret_cast<PFN_vkDestroyDevice>(next(*out, "vkDestroyDevice"));
    const std::unique_lock lock(mutex);
    devices[dispatch_key(*out)] = std::move(device);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
    if (device == VK_NULL_HANDLE) {
        return;
    }
    void* key = dispatch_key(device);
    device_of(key).DestroyDevice(device, allocator);
    const std::unique_lock lock(mutex);
    devices.erase(key);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_proc_addr(VkDevice device, const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc_addr(VkInstance instance,
                                                                const char* name);

PFN_vkVoidFunction own_command(const char* name, bool of_instance) {
    static const OwnCommand kChain[] = {
        VULKAN_LAYER_OWN(GetInstanceProcAddr, get_instance_proc_addr),
        VULKAN_LAYER_OWN(GetDeviceProcAddr, get_device_proc_addr),
        VULKAN_LAYER_OWN(CreateInstance, create_instance),
        VULKAN_LAYER_OWN(DestroyInstance, destroy_instance),
        VULKAN_LAYER_OWN(CreateDevice, create_device),
        VULKAN_LAYER_OWN(DestroyDevice, destroy_device),
    };
    PFN_vkVoidFunction own = find_command(kChain, name);
    if (own == nullptr && of_instance) {
        own = own_instance_command(name);
    }
    return own != nullptr ? own : own_device_command(name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_proc_addr(VkDevice device, const char* name) {
    const PFN_vkVoidFunction theirs =
        device_of(dispatch_key(device)).GetDeviceProcAddr(device, name);
    // A command that the driver lacks is not there, whatever the layer could do to it.
    if (theirs == nullptr || !shows_device_command(device, name)) {
        return nullptr;
    }
    const PFN_vkVoidFunction own = own_command(name, false);
    return own != nullptr ? own : theirs;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc_addr(VkInstance instance,
                                                                const char* name) {
    if (const PFN_vkVoidFunction own = own_command(name, true)) {
        return own;
    }
    return instance == VK_NULL_HANDLE
               ? nullptr
               : instance_of(dispatch_key(instance)).GetInstanceProcAddr(instance, name);
}

}  // namespace

const Instance& instance_of(void* key) {
    const std::shared_lock lock(mutex);
    return instances.at(key);
}

const Device& device_of(void* key) {
    const std::shared_lock lock(mutex);
    return *devices.at(key);
}

VkResult answer_extensions(VkPhysicalDevice physical, const char* layer, uint32_t* count,
                           VkExtensionProperties* out,
                           const std::function<void(std::vector<VkExtensionProperties>&)>& alter) {
    const auto next = next_of<PFN_vkEnumerateDeviceExtensionProperties>(
        physical, "vkEnumerateDeviceExtensionProperties");
    if (layer != nullptr) {
        return next(physical, layer, count, out);
    }
    uint32_t all = 0;
    VkResult result = next(physical, nullptr, &all, nullptr);
    std::vector<VkExtensionProperties> list(all);
    if (result == VK_SUCCESS) {
        result = next(physical, nullptr, &all, list.data());
    }
    if (result != VK_SUCCESS) {
        return result;
    }
    alter(list);
    const auto size = static_cast<uint32_t>(list.size());
    if (out == nullptr) {
        *count = size;
        return VK_SUCCESS;
    }
    *count = std::min(*count, size);
    std::copy_n(list.begin(), *count, out);
    return *count < size ? VK_INCOMPLETE : VK_SUCCESS;
}

VkExtensionProperties extension(const char* name, uint32_t version) {
    VkExtensionProperties properties{};
    std::strncpy(properties.extensionName, name, VK_MAX_EXTENSION_NAME_SIZE - 1);
    properties.specVersion = version;
    return properties;
}

}  // namespace vulkan_layer

extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
    constexpr uint32_t kOurVersion = 2;
    if (version == nullptr || version->sType != LAYER_NEGOTIATE_INTERFACE_STRUCT ||
        version->loaderLayerInterfaceVersion < kOurVersion) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    version->loaderLayerInterfaceVersion = kOurVersion;
    version->pfnGetInstanceProcAddr = vulkan_layer::get_instance_proc_addr;
    version->pfnGetDeviceProcAddr = vulkan_layer::get_device_proc_addr;
    version->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
