// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The second part of every reproducer, after its tables: instance, device, buffers and images.
// A sample's hits start here: a sum in binary32 from 2^23 up is exact, and no fragment writes it.
#define NO_HITS 8388608.0F
// Who wrote, hits by front and back faces (added), FragCoord.xy and .zw; then the attributes.
#define WRITER 0
#define HITS 1
#define FRAG_XY 2
#define FRAG_ZW 3
#define FIRST_ATTRIBUTE 4
#define COLORS (FIRST_ATTRIBUTE + ATTRIBUTES)
#define PLANES (COLORS + HAS_DEPTH)
// Samples are copied by a shader, through a view of the colours as whole numbers: no bit changes.
#define COPY_USAGE (SAMPLES > 1 ? VK_IMAGE_USAGE_SAMPLED_BIT : VK_IMAGE_USAGE_TRANSFER_SRC_BIT)
#define COLOR_FLAGS (SAMPLES > 1 ? VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT : 0)
#define COLOR_USAGE (VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | COPY_USAGE)
#define DEPTH_USAGE (VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | COPY_USAGE)

static const VkFormat kTwoNumbers = VK_FORMAT_R32G32_SFLOAT;
static const VkFormat kFourNumbers = VK_FORMAT_R32G32B32A32_SFLOAT;

static uint32_t words_of(uint32_t plane) {
    return plane < FIRST_ATTRIBUTE ? 2 : plane < COLORS ? 4 : 1;
}

static VkFormat color_format(uint32_t plane) {
    return words_of(plane) == 2 ? kTwoNumbers : kFourNumbers;
}

static void stop(const char* what, int code) {
    fprintf(stderr, "set-up failed: %s (%d)\n", what, code);
    exit(2);
}
#define CHECK(call)               \
    do {                          \
        VkResult r_ = (call);     \
        if (r_ != VK_SUCCESS)     \
            stop(#call, (int)r_); \
    } while (0)
#define NEED(condition, what)                  \
    do {                                       \
        if (!(condition))                      \
            stop("the device lacks " what, 0); \
    } while (0)

static VkPhysicalDevice physical;
static VkPhysicalDeviceProperties properties;
static VkDevice device;
static VkQueue queue;
static uint32_t queue_family;
static VkPhysicalDeviceMemoryProperties memory_properties;

/* The first device whose name contains the words; any if they are empty. */
static void choose_device(const char* words) {
    VkApplicationInfo application = {
        VK_STRUCTURE_TYPE_APPLICATION_INFO, NULL, "reproducer", 0, NULL, 0, VK_API_VERSION_1_3};
    VkInstanceCreateInfo info = {0};
    VkInstance instance;
    VkPhysicalDevice list[16];
    uint32_t count = 16, k;
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    CHECK(vkCreateInstance(&info, NULL, &instance));
    if (vkEnumeratePhysicalDevices(instance, &count, list) < 0) {
        stop("vkEnumeratePhysicalDevices", 0);
    }
    for (k = 0; k < count; ++k) {
        vkGetPhysicalDeviceProperties(list[k], &properties);
        if (strstr(properties.deviceName, words) != NULL) {
            physical = list[k];
            return;
        }
    }
    stop("there is no such Vulkan device", 0);
}

static void check_limits(void) {
    const VkPhysicalDeviceLimits* l = &properties.limits;
    VkImageFormatProperties format;
    VkFormatProperties can;
    uint32_t k;
    NEED(properties.apiVersion >= VK_API_VERSION_1_3, "Vulkan 1.3");
    if (l->subPixelPrecisionBits != SUBPIXEL_BITS) {
        fprintf(
            stderr,
            "set-up failed: the device has %u subpixel bits and this program was written for %d; "
            "write it with --subpixel-bits %u\n",
            l->subPixelPrecisionBits, SUBPIXEL_BITS, l->subPixelPrecisionBits);
        exit(2);
    }
    NEED(l->maxFramebufferWidth >= WIDTH && l->maxFramebufferHeight >= HEIGHT,
         "targets of this size");
    NEED(l->maxColorAttachments >= COLORS, "so many colour attachments");
    NEED(SAMPLES == 1 || l->standardSampleLocations, "the standard sample locations");
    vkGetPhysicalDeviceFormatProperties(physical, kTwoNumbers, &can);
    NEED(can.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT,
         "blending to R32G32_SFLOAT");
    for (k = 0; k < COLORS; ++k) {
        CHECK(vkGetPhysicalDeviceImageFormatProperties(physical, color_format(k), VK_IMAGE_TYPE_2D,
                                                       VK_IMAGE_TILING_OPTIMAL, COLOR_USAGE,
                                                       COLOR_FLAGS, &format));
        NEED(format.sampleCounts & SAMPLES, "this many samples of a colour format");
    }
    if (HAS_DEPTH) {
        CHECK(vkGetPhysicalDeviceImageFormatProperties(physical, DEPTH_FORMAT, VK_IMAGE_TYPE_2D,
                                                       VK_IMAGE_TILING_OPTIMAL, DEPTH_USAGE, 0,
                                                       &format));
        NEED(format.sampleCounts & SAMPLES, "this many samples of the depth format");
    }
    for (k = 0; k < DRAWS; ++k) {
        const VkViewport* v = &kDraws[k].viewport;
        const float low = l->viewportBoundsRange[0], high = l->viewportBoundsRange[1],
                    bottom = v->y + v->height;
        NEED(v->width <= (float)l->maxViewportDimensions[0] &&
                 v->height <= (float)l->maxViewportDimensions[1] &&
                 -v->height <= (float)l->maxViewportDimensions[1],
             "viewports of this size");
        NEED(v->x >= low && v->x + v->width <= high && v->y >= low && v->y <= high &&
                 bottom >= low && bottom <= high,
             "viewports at this place");
        NEED(kDraws[k].clips <= l->maxClipDistances && kDraws[k].culls <= l->maxCullDistances &&
                 kDraws[k].clips + kDraws[k].culls <= l->maxCombinedClipAndCullDistances,
             "this many clip or cull distances");
    }
}

static void make_device(void) {
    const VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const float priority = 1;
    VkQueueFamilyProperties families[16];
    VkDeviceQueueCreateInfo queues = {0};
    VkPhysicalDeviceVulkan13Features wanted13 = {0};
    VkPhysicalDeviceFeatures has, wanted;
    VkDeviceCreateInfo info = {0};
    uint32_t count = 16, k;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    while (queue_family < count && (families[queue_family].queueFlags & needed) != needed) {
        ++queue_family;
    }
    NEED(queue_family < count, "a queue for graphics and compute");
    memset(&wanted, 0, sizeof wanted);
    vkGetPhysicalDeviceFeatures(physical, &has);
    wanted.independentBlend = VK_TRUE;
    NEED(has.independentBlend, "independentBlend");
    for (k = 0; k < DRAWS; ++k) {
        const struct Draw* d = &kDraws[k];
        wanted.depthClamp |= d->depth_clamp;
        wanted.depthBiasClamp |= d->bias[1] != 0;
        wanted.shaderClipDistance |= d->clips > 0;
        wanted.shaderCullDistance |= d->culls > 0;
    }
    NEED(has.depthClamp >= wanted.depthClamp, "depthClamp");
    NEED(has.depthBiasClamp >= wanted.depthBiasClamp, "depthBiasClamp");
    NEED(has.shaderClipDistance >= wanted.shaderClipDistance, "shaderClipDistance");
    NEED(has.shaderCullDistance >= wanted.shaderCullDistance, "shaderCullDistance");
    wanted13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    wanted13.dynamicRendering = VK_TRUE;
    queues.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queues.queueFamilyIndex = queue_family;
    queues.queueCount = 1;
    queues.pQueuePriorities = &priority;
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &wanted13;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queues;
    info.pEnabledFeatures = &wanted;
    CHECK(vkCreateDevice(physical, &info, NULL, &device));
    vkGetDeviceQueue(device, queue_family, 0, &queue);
    vkGetPhysicalDeviceMemoryProperties(physical, &memory_properties);
}

static VkDeviceMemory allocate(VkMemoryRequirements need, VkMemoryPropertyFlags flags) {
    VkMemoryAllocateInfo info = {0};
    VkDeviceMemory memory;
    uint32_t k = 0;
    while (k < memory_properties.memoryTypeCount &&
           (!(need.memoryTypeBits >> k & 1) ||
            (memory_properties.memoryTypes[k].propertyFlags & flags) != flags)) {
        ++k;
    }
    NEED(k < memory_properties.memoryTypeCount, "memory of the needed type");
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = need.size;
    info.memoryTypeIndex = k;
    CHECK(vkAllocateMemory(device, &info, NULL, &memory));
    return memory;
}

/* A buffer that the CPU sees, and where. */
static VkBuffer make_buffer(VkDeviceSize size, VkBufferUsageFlags usage, void** mapped) {
    VkBufferCreateInfo info = {0};
    VkMemoryRequirements need;
    VkDeviceMemory memory;
    VkBuffer buffer;
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage;
    CHECK(vkCreateBuffer(device, &info, NULL, &buffer));
    vkGetBufferMemoryRequirements(device, buffer, &need);
    memory =
        allocate(need, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    CHECK(vkBindBufferMemory(device, buffer, memory, 0));
    CHECK(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, mapped));
    return buffer;
}

static VkImageView make_view(VkImage image, VkFormat format, VkImageAspectFlags aspect,
                             VkImageUsageFlags usage) {
    VkImageViewUsageCreateInfo used = {VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO, NULL, usage};
    VkImageViewCreateInfo info = {0};
    VkImageView view;
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.pNext = &used;
    info.image = image;
    info.viewType = SAMPLES > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange.aspectMask = aspect;
    info.subresourceRange.levelCount = 1;
    info.subresourceRange.layerCount = 1;
    CHECK(vkCreateImageView(device, &info, NULL, &view));
    return view;
}

static VkImage make_image(VkFormat format, VkImageUsageFlags usage, VkImageCreateFlags flags) {
    VkImageCreateInfo info = {0};
    VkMemoryRequirements need;
    VkImage image;
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.flags = flags;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent.width = WIDTH;
    info.extent.height = HEIGHT;
    info.extent.depth = 1;
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = (VkSampleCountFlagBits)SAMPLES;
    info.usage = usage;
    CHECK(vkCreateImage(device, &info, NULL, &image));
    vkGetImageMemoryRequirements(device, image, &need);
    CHECK(vkBindImageMemory(device, image, allocate(need, 0), 0));
    return image;
}

static VkShaderModule make_module(const struct Code* code) {
    VkShaderModuleCreateInfo info = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, NULL, 0,
                                     code->size, code->words};
    VkShaderModule module;
    CHECK(vkCreateShaderModule(device, &info, NULL, &module));
    return module;
}

static VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, VkShaderModule module) {
    VkPipelineShaderStageCreateInfo info = {0};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = bit;
    info.module = module;
    info.pName = "main";
    return info;
}

static VkPipelineLayout make_layout(VkShaderStageFlags stages, uint32_t bytes,
                                    const VkDescriptorSetLayout* set) {
    VkPushConstantRange range = {stages, 0, bytes};
    VkPipelineLayoutCreateInfo info = {0};
    VkPipelineLayout layout;
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = set != NULL;
    info.pSetLayouts = set;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    CHECK(vkCreatePipelineLayout(device, &info, NULL, &layout));
    return layout;
}
