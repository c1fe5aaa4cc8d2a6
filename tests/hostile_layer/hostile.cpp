// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The layer's versions of commands, in which the chosen behaviour hides.
#include <atomic>
#include <cstring>

#include "behaviour.hpp"
#include "vulkan_layer/layer.hpp"

namespace hostile {

namespace {

using vulkan_layer::next_of;
using vulkan_layer::OwnCommand;

struct Driver : vulkan_layer::Device {
    PFN_vkAllocateMemory AllocateMemory = nullptr;
    PFN_vkMapMemory MapMemory = nullptr;
    PFN_vkQueueSubmit QueueSubmit = nullptr;
    PFN_vkWaitForFences WaitForFences = nullptr;
    PFN_vkCreateGraphicsPipelines CreateGraphicsPipelines = nullptr;
};

template <typename Handle>
const Driver& driver_of(Handle handle) {
    return static_cast<const Driver&>(vulkan_layer::device_of(vulkan_layer::dispatch_key(handle)));
}

void alter(VkPhysicalDeviceProperties& properties) {
    static std::atomic<uint32_t> calls = 0;
    if (is_on("other-name")) {
        std::strcpy(properties.deviceName, "another device \x1b[31m");
    } else if (is_on("other-version")) {
        properties.driverVersion += 1;
    } else if (is_on("changing-limits")) {
        properties.limits.subPixelPrecisionBits = 4 + calls++ % 5;
        properties.limits.maxFramebufferWidth = 4096U << (calls % 3);
    } else if (is_on("no-limits")) {
        std::memset(&properties.limits, 0, sizeof properties.limits);
    }
}

VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice physical,
                                          VkPhysicalDeviceProperties* out) {
    next_of<PFN_vkGetPhysicalDeviceProperties>(physical, "vkGetPhysicalDeviceProperties")(physical,
                                                                                          out);
    reach(Point::properties);
    alter(*out);
}

VKAPI_ATTR void VKAPI_CALL get_properties2(VkPhysicalDevice physical,
                                           VkPhysicalDeviceProperties2* out) {
    next_of<PFN_vkGetPhysicalDeviceProperties2>(physical, "vkGetPhysicalDeviceProperties2")(
        physical, out);
    reach(Point::properties);
    alter(out->properties);
    for (auto* s = static_cast<VkBaseOutStructure*>(out->pNext); s != nullptr; s = s->pNext) {
        if (is_on("other-uuid") && s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES) {
            reinterpret_cast<VkPhysicalDeviceIDProperties*>(s)->deviceUUID[0] ^= 0xff;
        } else if (is_on("other-uuid") &&
                   s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES) {
            reinterpret_cast<VkPhysicalDeviceVulkan11Properties*>(s)->deviceUUID[0] ^= 0xff;
        }
    }
}

VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                        const VkAllocationCallbacks* allocator,
                                        VkDeviceMemory* out) {
    const VkResult result = reach(Point::allocate);
    return result != VK_SUCCESS ? result
                                : driver_of(device).AllocateMemory(device, info, allocator, out);
}

VKAPI_ATTR VkResult VKAPI_CALL map(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                                   VkDeviceSize size, VkMemoryMapFlags flags, void** out) {
    VkResult result = reach(Point::map);
    if (result == VK_SUCCESS) {
        result = driver_of(device).MapMemory(device, memory, offset, size, flags, out);
    }
    if (is_on("map-nowhere")) {
        *out = reinterpret_cast<void*>(uintptr_t{0x1000});
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, uint32_t count, const VkSubmitInfo* infos,
                                      VkFence fence) {
    const VkResult result = reach(Point::submit);
    if (result != VK_SUCCESS || is_on("submit-nothing")) {
        return result != VK_SUCCESS ? result
                                    : driver_of(queue).QueueSubmit(queue, 0, nullptr, fence);
    }
    return driver_of(queue).QueueSubmit(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL wait(VkDevice device, uint32_t count, const VkFence* fences,
                                    VkBool32 all, uint64_t timeout) {
    const VkResult result = reach(Point::wait);
    return result != VK_SUCCESS
               ? result
               : driver_of(device).WaitForFences(device, count, fences, all, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL create_pipelines(VkDevice device, VkPipelineCache cache,
                                                uint32_t count,
                                                const VkGraphicsPipelineCreateInfo* infos,
                                                const VkAllocationCallbacks* allocator,
                                                VkPipeline* out) {
    const VkResult result = reach(Point::pipeline);
    return result != VK_SUCCESS ? result
                                : driver_of(device).CreateGraphicsPipelines(device, cache, count,
                                                                            infos, allocator, out);
}

template <typename Command>
void take(Command& command, VkDevice device, PFN_vkGetDeviceProcAddr next, const char* name) {
    command = reinterpret_cast<Command>(next(device, name));
}

}  // namespace

}  // namespace hostile

namespace vulkan_layer {

bool is_ready() {
    return hostile::reach(hostile::Point::instance) == VK_SUCCESS;
}

std::span<const char* const> needed_instance_commands() {
    static constexpr const char* kNames[] = {"vkGetPhysicalDeviceProperties",
                                             "vkGetPhysicalDeviceProperties2"};
    return kNames;
}

VkResult create_next_device(const Instance& /*instance*/, VkPhysicalDevice /*physical*/,
                            const VkDeviceCreateInfo& asked, const CreateNext& create) {
    const VkResult result = hostile::reach(hostile::Point::device);
    return result != VK_SUCCESS ? result : create(asked);
}

std::unique_ptr<Device> load_device(VkDevice device, PFN_vkGetDeviceProcAddr next) {
    using hostile::take;
    auto driver = std::make_unique<hostile::Driver>();
    take(driver->AllocateMemory, device, next, "vkAllocateMemory");
    take(driver->MapMemory, device, next, "vkMapMemory");
    take(driver->QueueSubmit, device, next, "vkQueueSubmit");
    take(driver->WaitForFences, device, next, "vkWaitForFences");
    take(driver->CreateGraphicsPipelines, device, next, "vkCreateGraphicsPipelines");
    return driver;
}

PFN_vkVoidFunction own_instance_command(const char* name) {
    static const OwnCommand kCommands[] = {
        VULKAN_LAYER_OWN(GetPhysicalDeviceProperties, hostile::get_properties),
        VULKAN_LAYER_OWN(GetPhysicalDeviceProperties2, hostile::get_properties2),
    };
    return find_command(kCommands, name);
}

PFN_vkVoidFunction own_device_command(const char* name) {
    static const OwnCommand kCommands[] = {
        VULKAN_LAYER_OWN(AllocateMemory, hostile::allocate),
        VULKAN_LAYER_OWN(MapMemory, hostile::map),
        VULKAN_LAYER_OWN(QueueSubmit, hostile::submit),
        VULKAN_LAYER_OWN(WaitForFences, hostile::wait),
        VULKAN_LAYER_OWN(CreateGraphicsPipelines, hostile::create_pipelines),
    };
    return find_command(kCommands, name);
}

bool shows_device_command(VkDevice /*device*/, const char* /*name*/) {
    return true;
}

}  // namespace vulkan_layer
