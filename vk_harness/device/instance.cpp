// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/device/instance.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace vk_harness {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

// What the layer of Debian 12 (1.3.239) says of a pipeline library without a fragment shader, and
// of what is linked of it: that it has no depth state. That belongs to the fragment shader's
// library, and every other pipeline here has it.
constexpr const char* kSaidOfLibraries = "VUID-VkGraphicsPipelineCreateInfo-renderPass-06053";

// That an output or an input is used by nobody, which is no error: the door stage_unused
// (cases/model/door.hpp) is about that. The rest of the name depends on the layer's version.
constexpr std::string_view kSaidOfUnused = "OutputNotConsumed";

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                                          VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* user) {
    const std::string_view id = data->pMessageIdName != nullptr ? data->pMessageIdName : "";
    if (id == kSaidOfLibraries || id.find(kSaidOfUnused) != std::string_view::npos) {
        return VK_FALSE;
    }
    static_cast<MessageLog*>(user)->add(data->pMessage != nullptr ? data->pMessage : "");
    return VK_FALSE;
}

// The version of Vulkan that the layer was written for; nothing if it is not installed.
std::optional<uint32_t> layer_version(const char* name) {
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    const auto found = std::ranges::find_if(layers, [name](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, name) == 0;
    });
    return found == layers.end() ? std::nullopt : std::optional(found->specVersion);
}

bool has_extension(const char* layer, const char* name) {
    uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(layer, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data());
    return std::ranges::any_of(extensions, [name](const VkExtensionProperties& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

}  // namespace

void MessageLog::add(std::string message) {
    constexpr size_t kMost = 64;  // more say the same again, and all travel through a pipe
    constexpr size_t kMostBytes = size_t{8} << 10;
    const std::lock_guard lock(mutex_);
    if (messages_.size() < kMost) {
        messages_.push_back(message.substr(0, kMostBytes));
    }
}

std::vector<std::string> MessageLog::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

Instance Instance::create(const Options& options) {
    load_vulkan(options);
    if (volkGetInstanceVersion() < VK_API_VERSION_1_1) {
        fail(Stage::loader, "the Vulkan loader knows Vulkan 1.0 only; install a newer one");
    }
    Instance instance;
    std::vector<const char*> layers;
    std::vector<const char*> extensions;
    VkInstanceCreateFlags flags = 0;
    if (has_extension(nullptr, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
        extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
        flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
    }

    VkDebugUtilsMessengerCreateInfoEXT messenger =
        Typed{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                            VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = on_message;
    messenger.pUserData = instance.messages_.get();
    if (options.validation) {
        instance.validation_version_ = layer_version(kValidationLayer);
        if (!instance.validation_version_ ||
            !has_extension(kValidationLayer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME)) {
            fail(Stage::instance,
                 std::string("the validation layer ") + kValidationLayer +
                     " is not installed (Debian: vulkan-validationlayers)",
                 VK_ERROR_LAYER_NOT_PRESENT);
        }
        layers.push_back(kValidationLayer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }

    VkApplicationInfo application = Typed{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "edgecase";
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info = Typed{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.flags = flags;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = static_cast<uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    const VkResult result = vkCreateInstance(&info, nullptr, &instance.instance_);
    if (result != VK_SUCCESS) {
        Failure failure = call_failure(Stage::instance, result, "vkCreateInstance");
        if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
            const char* chosen = std::getenv("VK_DRIVER_FILES");
            chosen = chosen != nullptr ? chosen : std::getenv("VK_ICD_FILENAMES");
            failure.message += chosen != nullptr
                                   ? ": the loader could not use the driver that was chosen, '" +
                                         std::string(chosen) + "'"
                                   : ": the loader found no Vulkan driver; install one (Debian: "
                                     "mesa-vulkan-drivers) or name its JSON file";
        }
        fail(std::move(failure));
    }
    volkLoadInstanceOnly(instance.instance_);
    if (options.validation) {
        instance.destroy_messenger_ = vkDestroyDebugUtilsMessengerEXT;
        check(Stage::instance,
              vkCreateDebugUtilsMessengerEXT(instance.instance_, &messenger, nullptr,
                                             &instance.messenger_),
              "vkCreateDebugUtilsMessengerEXT");
    }
    return instance;
}

Instance::Instance(Instance&& other) noexcept
    : instance_(std::exchange(other.instance_, VK_NULL_HANDLE)),
      messenger_(std::exchange(other.messenger_, VK_NULL_HANDLE)),
      destroy_messenger_(other.destroy_messenger_),
      validation_version_(other.validation_version_),
      messages_(std::move(other.messages_)) {}

Instance::~Instance() {
    if (messenger_ != VK_NULL_HANDLE) {
        destroy_messenger_(instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) {
        vkDestroyInstance(instance_, nullptr);
    }
}

std::vector<VkPhysicalDevice> Instance::physical_devices() const {
    uint32_t count = 0;
    VkResult result = vkEnumeratePhysicalDevices(instance_, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    if (result == VK_SUCCESS && count > 0) {
        result = vkEnumeratePhysicalDevices(instance_, &count, devices.data());
        devices.resize(count);
    }
    if (result == VK_ERROR_INITIALIZATION_FAILED) {
        return std::vector<VkPhysicalDevice>{};
    }
    if (result != VK_SUCCESS && result != VK_INCOMPLETE) {
        fail(call_failure(Stage::device, result, "vkEnumeratePhysicalDevices"));
    }
    return devices;
}

}  // namespace vk_harness
