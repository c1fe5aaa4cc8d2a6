// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the layers of the tests share: the loader's side. Each layer links layer.cpp and defines
// what is declared under "Defined by each layer".
#pragma once

#include <vulkan/vulkan.h>

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vulkan_layer {

// The next layer's, or the driver's, commands of one instance.
struct Instance {
    PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
    PFN_vkDestroyInstance DestroyInstance = nullptr;
    // Those that the layer needs. They are asked for when the instance is made: later the loader
    // answers with the first layer's.
    std::map<std::string, PFN_vkVoidFunction> commands;

    // A command by its name, with its type.
    template <typename Command>
    Command get(const char* name) const {
        return reinterpret_cast<Command>(commands.at(name));
    }
};

// The same of one device; layers add theirs.
struct Device {
    virtual ~Device() = default;
    PFN_vkGetDeviceProcAddr GetDeviceProcAddr = nullptr;
    PFN_vkDestroyDevice DestroyDevice = nullptr;
};

// Physical devices are keyed as their instance; devices, queues and command buffers of one device
// begin with the same pointer, the loader's dispatch table.
template <typename Handle>
void* dispatch_key(Handle handle) {
    return *reinterpret_cast<void**>(handle);
}
const Instance& instance_of(void* key);
const Device& device_of(void* key);
// The next command of a physical device's instance.
template <typename Command>
Command next_of(VkPhysicalDevice physical, const char* name) {
    return instance_of(dispatch_key(physical)).get<Command>(name);
}

// The types are those of the headers: a signature that is not the command's does not compile.
#define VULKAN_LAYER_OWN(name, function) \
    { "vk" #name, reinterpret_cast<PFN_vkVoidFunction>(static_cast<PFN_vk##name>(function)) }

using OwnCommand = std::pair<const char*, PFN_vkVoidFunction>;

inline PFN_vkVoidFunction find_command(std::span<const OwnCommand> commands,
                                       std::string_view name) {
    for (const auto& [own_name, command] : commands) {
        if (name == own_name) {
            return command;
        }
    }
    return nullptr;
}

// The driver's answer to vkEnumerateDeviceExtensionProperties, altered by `alter`, as that command
// gives it.
VkResult answer_extensions(VkPhysicalDevice physical, const char* layer, uint32_t* count,
                           VkExtensionProperties* out,
                           const std::function<void(std::vector<VkExtensionProperties>&)>& alter);
// One of them, of that name.
VkExtensionProperties extension(const char* name, uint32_t version);

// Defined by each layer.

// Whether an instance may be made.
bool is_ready();
// The instance commands that it gets from an Instance.
std::span<const char* const> needed_instance_commands();
// Makes the next device by `create`, from what was asked or something else.
using CreateNext = std::function<VkResult(const VkDeviceCreateInfo&)>;
VkResult create_next_device(const Instance& instance, VkPhysicalDevice physical,
                            const VkDeviceCreateInfo& asked, const CreateNext& create);
// The layer's object of a device that was made, with the commands that it takes from `next`.
std::unique_ptr<Device> load_device(VkDevice device, PFN_vkGetDeviceProcAddr next);
// The layer's own version of a command; nothing if it has none.
PFN_vkVoidFunction own_instance_command(const char* name);
PFN_vkVoidFunction own_device_command(const char* name);
// Whether the device that the layer shows has a command that the driver has.
bool shows_device_command(VkDevice device, const char* name);

}  // namespace vulkan_layer
