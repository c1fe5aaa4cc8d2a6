// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "vk_harness/device/features.hpp"

namespace vk_harness {

namespace {

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// Whether options.device means this device.
bool names(const std::string& wanted, const DeviceInfo& info) {
    if (wanted.empty()) {
        return true;
    }
    const bool number =
        std::ranges::all_of(wanted, [](unsigned char c) { return std::isdigit(c) != 0; });
    if (number && wanted.size() < 9) {
        return std::stoul(wanted) == info.index;
    }
    std::string digits = lower(wanted);
    digits.erase(std::remove(digits.begin(), digits.end(), '-'), digits.end());
    return digits == info.uuid || lower(info.name).find(lower(wanted)) != std::string::npos;
}

}  // namespace

bool is_pinned(const Options& options, const DeviceInfo& info) {
    return options.pinned.empty() || info.key == options.pinned;
}

Capabilities choose_device(const Instance& instance, const Options& options) {
    auto devices = instance.physical_devices();
    Failure failure;
    failure.stage = Stage::device;
    for (uint32_t index = 0; index < devices.size(); ++index) {
        Capabilities c = query_capabilities(devices[index], index);
        const std::string label = fmt::format("device {} ({})", index, c.info.name);
        if (!names(options.device, c.info)) {
            failure.reasons.push_back(fmt::format("{}: not the device that was asked for", label));
        } else if (!is_pinned(options, c.info)) {
            failure.reasons.push_back(
                fmt::format("{}: not the device that the run began with", label));
        } else if (!c.info.missing.empty()) {
            failure.reasons.push_back(
                fmt::format("{}: {}", label, fmt::join(c.info.missing, "; ")));
        } else {
            return c;
        }
    }
    if (devices.empty()) {
        failure.message =
            "no Vulkan device was found; install a driver (Debian: mesa-vulkan-drivers) or set "
            "VK_DRIVER_FILES";
    } else if (!options.pinned.empty()) {
        failure.message = fmt::format(
            "the device that the run began with (UUID {}) is not there any more, or cannot be used",
            options.pinned.substr(0, options.pinned.find(':')));
    } else if (options.device.empty()) {
        failure.message = "no Vulkan device can run the cases";
    } else {
        failure.message = fmt::format(
            "no usable Vulkan device is called '{}'; give an index, a part of the name, or a UUID",
            options.device);
    }
    fail(std::move(failure));
}

Result<std::vector<DeviceInfo>> list_devices(const Options& options) {
    return attempt([&] {
        const Instance instance = Instance::create(options);
        std::vector<DeviceInfo> infos;
        for (const VkPhysicalDevice physical : instance.physical_devices()) {
            infos.push_back(query_capabilities(physical, static_cast<uint32_t>(infos.size())).info);
        }
        return infos;
    });
}

Device Device::create(const Capabilities& capabilities) {
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue = Typed{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = capabilities.queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;

    EnabledFeatures features(capabilities);
    std::vector<const char*> extensions = capabilities.core.extensions;
    extensions.insert(extensions.end(), features.extensions.begin(), features.extensions.end());
    if (capabilities.location_counts != 0) {
        extensions.push_back(VK_EXT_SAMPLE_LOCATIONS_EXTENSION_NAME);
    }
    if (capabilities.has_conservative) {
        extensions.push_back(VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME);
    }
    if (capabilities.has_load_none) {
        extensions.push_back(VK_EXT_LOAD_STORE_OP_NONE_EXTENSION_NAME);
    }
    if (capabilities.doors.host_import) {
        extensions.push_back(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
    }

    VkDeviceCreateInfo info = Typed{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &features.chain();
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();

    Device device;
    check(Stage::device, vkCreateDevice(capabilities.physical, &info, nullptr, &device.device_),
          "vkCreateDevice");
    device.table_ = std::make_unique<VolkDeviceTable>();
    volkLoadDeviceTable(device.table_.get(), device.device_);
    use_extension_names(*device.table_);
    device.capabilities_ = std::make_unique<Capabilities>(capabilities);
    if (capabilities.depth_bias.control) {
        device.set_depth_bias2_ = reinterpret_cast<SetDepthBias2>(
            vkGetDeviceProcAddr(device.device_, "vkCmdSetDepthBias2EXT"));
    }
    if (capabilities.doors.shader_objects) {
        const auto load = [&device](auto& call, const char* name) {
            call = reinterpret_cast<std::decay_t<decltype(call)>>(
                vkGetDeviceProcAddr(device.device_, name));
        };
        load(device.shader_objects_.create, "vkCreateShadersEXT");
        load(device.shader_objects_.destroy, "vkDestroyShaderEXT");
        load(device.shader_objects_.bind, "vkCmdBindShadersEXT");
    }
    device.vk().vkGetDeviceQueue(device.device_, capabilities.queue_family, 0, &device.queue_);
    return device;
}

Device::Device(Device&& other) noexcept
    : set_depth_bias2_(other.set_depth_bias2_),
      shader_objects_(other.shader_objects_),
      device_(std::exchange(other.device_, VK_NULL_HANDLE)),
      queue_(other.queue_),
      longest_wait_(other.longest_wait_),
      table_(std::move(other.table_)),
      capabilities_(std::move(other.capabilities_)) {}

Device::~Device() {
    if (device_ != VK_NULL_HANDLE) {
        table_->vkDeviceWaitIdle(device_);
        table_->vkDestroyDevice(device_, nullptr);
    }
}

Handle<VkBuffer> make_buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage,
                             const void* next) {
    VkBufferCreateInfo info = Typed{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.pNext = next;
    info.size = size;
    info.usage = usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    return make(device, Stage::memory, "vkCreateBuffer", device.vk().vkCreateBuffer,
                device.vk().vkDestroyBuffer, info);
}

}  // namespace vk_harness
