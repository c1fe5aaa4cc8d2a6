// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The second part of every reproducer, after its tables: attachments, instance and device.
// A sample's hits start here: a sum in binary32 from 2^23 up is exact, and no fragment writes it.
#define NO_HITS 8388608.0F
#define OTHER_NO_HITS (NO_HITS + 4096.0F)
// Who wrote, hits by front and back faces (added), FragCoord.xy and .zw; then the attributes, the
// colour target, and the depth.
#define WRITER 0
#define HITS 1
#define FRAG_XY 2
#define FRAG_ZW 3
#define FIRST_ATTRIBUTE (4 * HAS_INSTRUMENTS)
// Samples are copied by a shader, through a view of the colours as whole numbers: no bit changes.
#define COPY_USAGE (SAMPLES > 1 ? VK_IMAGE_USAGE_SAMPLED_BIT : VK_IMAGE_USAGE_TRANSFER_SRC_BIT)
#define COLOR_FLAGS (SAMPLES > 1 ? VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT : 0)
#define COLOR_USAGE (VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | COPY_USAGE)
#define DEPTH_USAGE (VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | COPY_USAGE)

static const VkFormat kTwoNumbers = VK_FORMAT_R32G32_SFLOAT;
static const VkFormat kFourNumbers = VK_FORMAT_R32G32B32A32_SFLOAT;

enum Role { INSTRUMENT, ATTRIBUTE, TARGET, DEPTH };

static uint32_t color_plane(const struct Drawing* d) {
    return FIRST_ATTRIBUTE + HAS_INSTRUMENTS * d->attributes;
}
static uint32_t depth_plane(const struct Drawing* d) {
    return color_plane(d) + HAS_COLOR;
}
static uint32_t planes_of(const struct Drawing* d) {
    return depth_plane(d) + HAS_DEPTH;
}
static enum Role role_of(const struct Drawing* d, uint32_t plane) {
    return plane >= depth_plane(d)         ? DEPTH
           : plane >= color_plane(d)       ? TARGET
           : plane + 1 > FIRST_ATTRIBUTE   ? ATTRIBUTE
                                           : INSTRUMENT;
}

// Bytes of a sample as it is copied.
static uint32_t bytes_of(enum Role role) {
    return role == INSTRUMENT  ? 8
           : role == ATTRIBUTE ? 16
           : role == DEPTH     ? 4
           : SAMPLES > 1       ? (COLOR_BYTES > 4 ? COLOR_BYTES : 4)
                               : COLOR_BYTES;
}

static VkFormat format_of(enum Role role) {
    return role == INSTRUMENT  ? kTwoNumbers
           : role == ATTRIBUTE ? kFourNumbers
           : role == TARGET    ? COLOR_FORMAT
                               : DEPTH_FORMAT;
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
    for (k = 0; k < DRAWINGS; ++k) {
        NEED(l->maxColorAttachments >= depth_plane(&kDrawings[k]), "so many colour attachments");
    }
    NEED(l->maxFramebufferLayers >= LAYERS, "this many layers");
    NEED(SAMPLES == 1 || !HAS_STANDARD_PLACES || l->standardSampleLocations,
         "the standard sample locations; write it with --sample-locations for its own");
    if (HAS_INSTRUMENTS) {
        vkGetPhysicalDeviceFormatProperties(physical, kTwoNumbers, &can);
        NEED(can.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT,
             "blending to R32G32_SFLOAT");
    }
    if (COLOR_IS_BLENDED) {
        vkGetPhysicalDeviceFormatProperties(physical, COLOR_FORMAT, &can);
        NEED(can.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT,
             "blending to the colour format");
    }
    for (k = 0; k < depth_plane(&kDrawings[0]); ++k) {
        CHECK(vkGetPhysicalDeviceImageFormatProperties(
            physical, format_of(role_of(&kDrawings[0], k)), VK_IMAGE_TYPE_2D,
            VK_IMAGE_TILING_OPTIMAL, COLOR_USAGE, COLOR_FLAGS, &format));
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

static VkBool32 has_extension(const char* name) {
    static VkExtensionProperties all[1024];
    uint32_t count = 1024, k;
    if (vkEnumerateDeviceExtensionProperties(physical, NULL, &count, all) < 0) {
        stop("vkEnumerateDeviceExtensionProperties", 0);
    }
    for (k = 0; k < count; ++k) {
        if (strcmp(all[k].extensionName, name) == 0) {
            return VK_TRUE;
        }
    }
    return VK_FALSE;
}

static void make_device(void) {
    const VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const float priority = 1;
    const char* extensions[4];
    VkQueueFamilyProperties families[16];
    VkDeviceQueueCreateInfo queues = {0};
    VkPhysicalDeviceVulkan12Features wanted12 = {0};
    VkPhysicalDeviceVulkan13Features wanted13 = {0};
    VkPhysicalDeviceProvokingVertexFeaturesEXT provoking = {0};
    VkPhysicalDeviceDepthClipEnableFeaturesEXT clip = {0};
    VkPhysicalDeviceDepthClipControlFeaturesEXT control = {0};
    VkPhysicalDeviceFragmentShaderBarycentricFeaturesKHR barycentric = {0};
    VkPhysicalDevicePrimitiveTopologyListRestartFeaturesEXT restart = {0};
    VkPhysicalDeviceFeatures has, wanted;
    VkDeviceCreateInfo info = {0};
    uint32_t count = 16, k, needs_last = 0, needs_clip = 0, needs_control = 0, needs_barycentric = 0,
             needs_restart = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    while (queue_family < count && (families[queue_family].queueFlags & needed) != needed) {
        ++queue_family;
    }
    NEED(queue_family < count, "a queue for graphics and compute");
    memset(&wanted, 0, sizeof wanted);
    vkGetPhysicalDeviceFeatures(physical, &has);
    wanted.independentBlend = HAS_INSTRUMENTS;
    for (k = 0; k < DRAWS; ++k) {
        const struct Draw* d = &kDraws[k];
        wanted.depthClamp |= d->depth_clamp;
        wanted.depthBiasClamp |= d->bias[1] != 0;
        wanted.shaderClipDistance |= d->clips > 0;
        wanted.shaderCullDistance |= d->culls > 0;
        wanted.sampleRateShading |= d->has_sample_rate || d->shades_samples;
        wanted12.shaderOutputLayer |= d->layer > 0;
        needs_last |= d->last_provokes;
        needs_clip |= d->depth_clip != 0;
        needs_control |= d->is_symmetric;
        needs_barycentric |= d->has_barycentrics;
        needs_restart |= d->restart && d->topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    }
    NEED(has.independentBlend >= wanted.independentBlend, "independentBlend");
    NEED(has.depthClamp >= wanted.depthClamp, "depthClamp");
    NEED(has.depthBiasClamp >= wanted.depthBiasClamp, "depthBiasClamp");
    NEED(has.shaderClipDistance >= wanted.shaderClipDistance, "shaderClipDistance");
    NEED(has.shaderCullDistance >= wanted.shaderCullDistance, "shaderCullDistance");
    NEED(has.sampleRateShading >= wanted.sampleRateShading, "sampleRateShading");
    wanted13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    wanted13.dynamicRendering = VK_TRUE;
    wanted12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    wanted13.pNext = &wanted12;
    // vkCreateDevice says so if a feature of an extension is missing.
    provoking.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_FEATURES_EXT;
    provoking.provokingVertexLast = VK_TRUE;
    clip.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_ENABLE_FEATURES_EXT;
    clip.depthClipEnable = VK_TRUE;
    control.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_CONTROL_FEATURES_EXT;
    control.depthClipControl = VK_TRUE;
    barycentric.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADER_BARYCENTRIC_FEATURES_KHR;
    barycentric.fragmentShaderBarycentric = VK_TRUE;
    restart.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PRIMITIVE_TOPOLOGY_LIST_RESTART_FEATURES_EXT;
    restart.primitiveTopologyListRestart = VK_TRUE;
#define ENABLE(is_needed, name, features)             \
    if (is_needed) {                                  \
        NEED(has_extension(name), "the extension " name); \
        extensions[info.enabledExtensionCount++] = name;  \
        (features).pNext = wanted13.pNext;            \
        wanted13.pNext = &(features);                 \
    }
    ENABLE(needs_last, VK_EXT_PROVOKING_VERTEX_EXTENSION_NAME, provoking)
    ENABLE(needs_clip, VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME, clip)
    ENABLE(needs_control, VK_EXT_DEPTH_CLIP_CONTROL_EXTENSION_NAME, control)
    ENABLE(needs_restart, VK_EXT_PRIMITIVE_TOPOLOGY_LIST_RESTART_EXTENSION_NAME, restart)
    ENABLE(needs_barycentric, VK_KHR_FRAGMENT_SHADER_BARYCENTRIC_EXTENSION_NAME, barycentric)
    queues.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queues.queueFamilyIndex = queue_family;
    queues.queueCount = 1;
    queues.pQueuePriorities = &priority;
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &wanted13;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queues;
    info.ppEnabledExtensionNames = extensions;
    info.pEnabledFeatures = &wanted;
    CHECK(vkCreateDevice(physical, &info, NULL, &device));
    vkGetDeviceQueue(device, queue_family, 0, &queue);
    vkGetPhysicalDeviceMemoryProperties(physical, &memory_properties);
}
