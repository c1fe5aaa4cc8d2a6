// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The layer's versions of device commands: what was asked goes through the chosen fault, then to
// the driver.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <set>
#include <type_traits>

#include "altering.hpp"
#include "memory_map.hpp"
#include "recording.hpp"

namespace breaking {

namespace {

// What a call is to answer instead of asking the driver; nothing to do it as asked.
VkResult answer(Answer (*hook)(uint64_t), uint64_t number) {
    const Answer chosen = hook != nullptr ? hook(number) : Answer::as_asked;
    if (chosen == Answer::as_asked) {
        return VK_SUCCESS;
    }
    count_alteration();
    switch (chosen) {
        case Answer::hang:
            for (;;) {
                ::pause();
            }
        case Answer::crash:
            ::signal(SIGSEGV, SIG_DFL);
            ::raise(SIGSEGV);
            break;
        case Answer::unknown_error:
            return VK_ERROR_UNKNOWN;
        case Answer::no_memory:
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        default:
            break;
    }
    return VK_ERROR_DEVICE_LOST;
}

VKAPI_ATTR VkResult VKAPI_CALL create_shader_module(VkDevice device,
                                                    const VkShaderModuleCreateInfo* info,
                                                    const VkAllocationCallbacks* allocator,
                                                    VkShaderModule* out) {
    ShaderWords words({info->pCode, info->codeSize / sizeof(uint32_t)});
    alter(hooks().shader, words);
    VkShaderModuleCreateInfo own = *info;
    own.pCode = words.words().data();
    own.codeSize = words.words().size() * sizeof(uint32_t);
    const VkResult result =
        driver_of_handle(device).CreateShaderModule(device, &own, allocator, out);
    if (result == VK_SUCCESS) {
        note_shader(*out, words.facts());
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_buffer(VkDevice device, const VkBufferCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkBuffer* out) {
    const VkResult result = driver_of_handle(device).CreateBuffer(device, info, allocator, out);
    if (result == VK_SUCCESS) {
        note_buffer(*out, *info);
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkDeviceMemory* out) {
    static std::atomic<uint64_t> allocations = 0;
    const VkResult result = answer(hooks().allocate, ++allocations);
    for (const auto* s = static_cast<const VkBaseInStructure*>(info->pNext); s != nullptr;
         s = s->pNext) {
        if (s->sType == VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO) {
            note_dedicated(reinterpret_cast<const VkMemoryDedicatedAllocateInfo*>(s)->image);
        }
    }
    return result != VK_SUCCESS
               ? result
               : driver_of_handle(device).AllocateMemory(device, info, allocator, out);
}

VKAPI_ATTR VkResult VKAPI_CALL create_image(VkDevice device, const VkImageCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkImage* out) {
    static std::atomic<uint64_t> images = 0;
    const VkResult refused = answer(hooks().make_image, ++images);
    if (refused != VK_SUCCESS) {
        return refused;
    }
    const VkResult result = driver_of_handle(device).CreateImage(device, info, allocator, out);
    if (result == VK_SUCCESS) {
        note_image(*out, *info);
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_image_view(VkDevice device, const VkImageViewCreateInfo* info,
                                                 const VkAllocationCallbacks* allocator,
                                                 VkImageView* out) {
    VkImageViewCreateInfo own = *info;
    alter(hooks().view, own);
    const VkResult result = driver_of_handle(device).CreateImageView(device, &own, allocator, out);
    if (result == VK_SUCCESS) {
        note_view(*out, info->image);
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL bind_buffer_memory(VkDevice device, VkBuffer buffer,
                                                  VkDeviceMemory memory, VkDeviceSize offset) {
    note_binding(buffer, memory, offset);
    return driver_of_handle(device).BindBufferMemory(device, buffer, memory, offset);
}

VKAPI_ATTR VkResult VKAPI_CALL bind_image_memory(VkDevice device, VkImage image,
                                                 VkDeviceMemory memory, VkDeviceSize offset) {
    note_binding(image, memory, offset);
    return driver_of_handle(device).BindImageMemory(device, image, memory, offset);
}

VKAPI_ATTR void VKAPI_CALL free_memory(VkDevice device, VkDeviceMemory memory,
                                       const VkAllocationCallbacks* allocator) {
    forget_memory(memory);
    driver_of_handle(device).FreeMemory(device, memory, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL map_memory(VkDevice device, VkDeviceMemory memory,
                                          VkDeviceSize offset, VkDeviceSize size,
                                          VkMemoryMapFlags flags, void** data) {
    static std::atomic<uint64_t> maps = 0;
    if (const VkResult refused = answer(hooks().map, ++maps); refused != VK_SUCCESS) {
        return refused;
    }
    const VkResult result =
        driver_of_handle(device).MapMemory(device, memory, offset, size, flags, data);
    if (result == VK_SUCCESS) {
        note_map(memory, offset, *data);
    }
    return result;
}

// Caches that were made of data.
std::set<VkPipelineCache>& caches_of_data() {
    static std::set<VkPipelineCache> caches;
    return caches;
}

VKAPI_ATTR VkResult VKAPI_CALL create_pipeline_cache(VkDevice device,
                                                     const VkPipelineCacheCreateInfo* info,
                                                     const VkAllocationCallbacks* allocator,
                                                     VkPipelineCache* out) {
    const VkResult result =
        driver_of_handle(device).CreatePipelineCache(device, info, allocator, out);
    if (result == VK_SUCCESS && info->initialDataSize > 0) {
        caches_of_data().insert(*out);
    } else if (result == VK_SUCCESS) {
        caches_of_data().erase(*out);
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_graphics_pipelines(VkDevice device, VkPipelineCache cache,
                                                         uint32_t count,
                                                         const VkGraphicsPipelineCreateInfo* infos,
                                                         const VkAllocationCallbacks* allocator,
                                                         VkPipeline* out) {
    static std::atomic<uint64_t> made = 0;
    if (const VkResult result = answer(hooks().make_pipeline, ++made); result != VK_SUCCESS) {
        std::fill_n(out, count, VkPipeline{VK_NULL_HANDLE});
        return result;
    }
    const Driver& driver = driver_of_handle(device);
    const auto make = [&](const VkGraphicsPipelineCreateInfo* asked) {
        const VkResult result =
            driver.CreateGraphicsPipelines(device, cache, count, asked, allocator, out);
        for (uint32_t k = 0; k < count && result == VK_SUCCESS; ++k) {
            // One that is linked has its state from its libraries.
            note_pipeline(out[k],
                          infos[k].pVertexInputState != nullptr && !has_dynamic_state(infos[k]),
                          facts_of(infos[k]));
        }
        return result;
    };
    if (hooks().pipeline == nullptr) {
        return make(infos);
    }
    std::vector<PipelineCopy> copies(infos, infos + count);
    std::vector<VkGraphicsPipelineCreateInfo> own;
    for (PipelineCopy& copy : copies) {
        copy.has_cached_data = caches_of_data().contains(cache);
        alter(hooks().pipeline, copy);
        own.push_back(copy.info());
    }
    return make(own.data());
}

VKAPI_ATTR void VKAPI_CALL update_descriptor_sets(VkDevice device, uint32_t count,
                                                  const VkWriteDescriptorSet* writes,
                                                  uint32_t copy_count,
                                                  const VkCopyDescriptorSet* copies) {
    const auto is_input = [](const VkWriteDescriptorSet& write) {
        return write.descriptorType == VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT &&
               write.descriptorCount == 1;
    };
    std::vector<VkWriteDescriptorSet> own(writes, writes + count);
    std::vector<VkDescriptorBufferInfo> buffers;
    buffers.reserve(count);  // so that no address changes
    for (VkWriteDescriptorSet& write : own) {
        if (write.pBufferInfo != nullptr && write.descriptorCount == 1 &&
            hooks().buffer_read != nullptr) {
            buffers.push_back(*write.pBufferInfo);
            alter(hooks().buffer_read, buffers.back(), write.descriptorType);
            write.pBufferInfo = &buffers.back();
        }
    }
    std::vector<VkImageView> views;
    for (const VkWriteDescriptorSet& write : own) {
        if (is_input(write)) {
            views.push_back(write.pImageInfo->imageView);
        }
    }
    alter(hooks().input_views, std::span(views));
    std::vector<VkDescriptorImageInfo> images;
    images.reserve(views.size());  // so that no address changes
    for (VkWriteDescriptorSet& write : own) {
        if (is_input(write)) {
            images.push_back(*write.pImageInfo);
            images.back().imageView = views[images.size() - 1];
            write.pImageInfo = &images.back();
        }
    }
    driver_of_handle(device).UpdateDescriptorSets(device, count, own.data(), copy_count, copies);
}

VKAPI_ATTR VkResult VKAPI_CALL queue_submit(VkQueue queue, uint32_t count,
                                            const VkSubmitInfo* infos, VkFence fence) {
    static std::atomic<uint64_t> submissions = 0;
    const VkResult result = answer(hooks().submit, ++submissions);
    if (result == VK_SUCCESS && alter(hooks().drop_submission, fence != VK_NULL_HANDLE)) {
        return result;
    }
    if (result != VK_SUCCESS) {
        return result;
    }
    std::vector<VkSubmitInfo> own(infos, infos + count);
    for (VkSubmitInfo& info : own) {
        if (info.commandBufferCount == 1 && ++recording_of(*info.pCommandBuffers).submissions > 1 &&
            alter(hooks().drop_repeated)) {
            info.commandBufferCount = 0;
        }
    }
    return driver_of_handle(queue).QueueSubmit(queue, count, own.data(), fence);
}

VKAPI_ATTR VkResult VKAPI_CALL wait_for_fences(VkDevice device, uint32_t count,
                                               const VkFence* fences, VkBool32 all,
                                               uint64_t timeout) {
    static std::atomic<uint64_t> waits = 0;
    const VkResult result = answer(hooks().wait, ++waits);
    return result != VK_SUCCESS
               ? result
               : driver_of_handle(device).WaitForFences(device, count, fences, all, timeout);
}

VKAPI_ATTR void VKAPI_CALL draw(VkCommandBuffer commands, uint32_t count, uint32_t instances,
                                uint32_t first, uint32_t first_instance) {
    DrawCall call;
    call.count = count;
    call.first = first;
    call.first_instance = first_instance;
    draw_call(commands, call, instances);
}

VKAPI_ATTR void VKAPI_CALL draw_indexed(VkCommandBuffer commands, uint32_t count,
                                        uint32_t instances, uint32_t first, int32_t vertex_offset,
                                        uint32_t first_instance) {
    DrawCall call;
    call.indexed = true;
    call.count = count;
    call.first = first;
    call.vertex_offset = vertex_offset;
    call.first_instance = first_instance;
    draw_call(commands, call, instances);
}

VKAPI_ATTR void VKAPI_CALL begin_rendering(VkCommandBuffer commands, const VkRenderingInfo* info) {
    Rendering own;
    own.info = *info;
    own.colors.assign(info->pColorAttachments,
                      info->pColorAttachments + info->colorAttachmentCount);
    if (info->pDepthAttachment != nullptr) {
        own.depth = *info->pDepthAttachment;
    }
    if (info->pStencilAttachment != nullptr) {
        own.stencil = *info->pStencilAttachment;
    }
    for (const VkRenderingAttachmentInfo& color : own.colors) {
        own.images.push_back(facts_of(color.imageView));
        own.resolved.push_back(facts_of(color.resolveImageView));
    }
    alter(hooks().rendering, own);
    own.info.pColorAttachments = own.colors.data();
    own.info.pDepthAttachment = own.depth ? &*own.depth : nullptr;
    own.info.pStencilAttachment = own.stencil ? &*own.stencil : nullptr;
    recording_of(commands).begin_rendering(hooks().order != nullptr);
    std::vector<VkImageView>& attachments = recording_of(commands).attachments;
    attachments.clear();
    for (const VkRenderingAttachmentInfo& color : own.colors) {
        attachments.push_back(color.imageView);
    }
    if (own.depth) {
        attachments.push_back(own.depth->imageView);
    }
    driver_of_handle(commands).CmdBeginRendering(commands, &own.info);
}

VKAPI_ATTR void VKAPI_CALL end_rendering(VkCommandBuffer commands) {
    recording_of(commands).end_rendering(
        [](std::vector<uint32_t>& order) { alter(hooks().order, order); });
    const Driver& driver = driver_of_handle(commands);
    driver.CmdEndRendering(commands);
    if (hooks().stray_write == nullptr) {
        return;
    }
    for (const VkImageView view : recording_of(commands).attachments) {
        Neighbours neighbours = neighbours_of(view);
        neighbours.rendering = recording_of(commands).rendering;
        if (alter(hooks().stray_write, neighbours)) {
            const auto [buffer, offset] = *neighbours.written;
            driver.CmdFillBuffer(commands, buffer, offset, sizeof(uint32_t), 0x57a7157aU);
        }
    }
    // As what a draw writes, it is there before anything that comes later.
    VkMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    driver.CmdPipelineBarrier2(commands, &info);
}

VKAPI_ATTR void VKAPI_CALL pipeline_barrier(VkCommandBuffer commands,
                                            const VkDependencyInfo* info) {
    const Driver& driver = driver_of_handle(commands);
    if (hooks().sample_locations == nullptr) {
        driver.CmdPipelineBarrier2(commands, info);
        return;
    }
    std::vector<VkImageMemoryBarrier2> barriers(
        info->pImageMemoryBarriers, info->pImageMemoryBarriers + info->imageMemoryBarrierCount);
    std::vector<VkSampleLocationsInfoEXT> infos(barriers.size());
    std::vector<std::vector<VkSampleLocationEXT>> places(barriers.size());
    for (size_t k = 0; k < barriers.size(); ++k) {
        const auto* chained = static_cast<const VkSampleLocationsInfoEXT*>(barriers[k].pNext);
        if (chained != nullptr && chained->sType == VK_STRUCTURE_TYPE_SAMPLE_LOCATIONS_INFO_EXT) {
            infos[k] = *chained;
            places[k].assign(chained->pSampleLocations,
                             chained->pSampleLocations + chained->sampleLocationsCount);
            alter(hooks().sample_locations, std::span(places[k]));
            infos[k].pSampleLocations = places[k].data();
            barriers[k].pNext = &infos[k];
        }
    }
    VkDependencyInfo own = *info;
    own.pImageMemoryBarriers = barriers.data();
    driver.CmdPipelineBarrier2(commands, &own);
}

VKAPI_ATTR void VKAPI_CALL clear_color_image(VkCommandBuffer commands, VkImage image,
                                             VkImageLayout layout, const VkClearColorValue* color,
                                             uint32_t count,
                                             const VkImageSubresourceRange* ranges) {
    if (alter(hooks().drop_clear_color)) {
        return;
    }
    VkClearColorValue own = *color;
    alter(hooks().clear_color, own);
    driver_of_handle(commands).CmdClearColorImage(commands, image, layout, &own, count, ranges);
}

template <typename Region>
std::vector<Region> altered(const Region* regions, uint32_t count, bool (*hook)(Region&)) {
    std::vector<Region> own(regions, regions + count);
    for (Region& region : own) {
        alter(hook, region);
    }
    return own;
}

VKAPI_ATTR void VKAPI_CALL copy_image_to_buffer(VkCommandBuffer commands, VkImage image,
                                                VkImageLayout layout, VkBuffer buffer,
                                                uint32_t count, const VkBufferImageCopy* regions) {
    auto own = altered(regions, count, hooks().image_to_buffer);
    for (VkBufferImageCopy& region : own) {
        ImageCopy copy{region, facts_of(image)};
        alter(hooks().image_copy, copy);
        region = copy.region;
    }
    driver_of_handle(commands).CmdCopyImageToBuffer(commands, image, layout, buffer, count,
                                                    own.data());
}

VKAPI_ATTR void VKAPI_CALL copy_buffer_to_image(VkCommandBuffer commands, VkBuffer buffer,
                                                VkImage image, VkImageLayout layout, uint32_t count,
                                                const VkBufferImageCopy* regions) {
    auto own = altered(regions, count, hooks().buffer_to_image);
    for (VkBufferImageCopy& region : own) {
        ImageCopy copy{region, facts_of(image)};
        alter(hooks().upload, copy);
        region = copy.region;
    }
    driver_of_handle(commands).CmdCopyBufferToImage(commands, buffer, image, layout, count,
                                                    own.data());
}

VKAPI_ATTR void VKAPI_CALL blit_image(VkCommandBuffer commands, VkImage from,
                                      VkImageLayout from_layout, VkImage to,
                                      VkImageLayout to_layout, uint32_t count,
                                      const VkImageBlit* regions, VkFilter filter) {
    std::vector<VkImageBlit> own(regions, regions + count);
    for (VkImageBlit& region : own) {
        alter(hooks().blit, region, filter);
    }
    driver_of_handle(commands).CmdBlitImage(commands, from, from_layout, to, to_layout, count,
                                            own.data(), filter);
}

VKAPI_ATTR void VKAPI_CALL dispatch(VkCommandBuffer commands, uint32_t x, uint32_t y, uint32_t z) {
    alter(hooks().dispatch, x);
    driver_of_handle(commands).CmdDispatch(commands, x, y, z);
}

const OwnCommand kDeviceCommands[] = {
    BREAKING_OWN(CreateShaderModule, create_shader_module),
    BREAKING_OWN(CreateBuffer, create_buffer),
    BREAKING_OWN(AllocateMemory, allocate_memory),
    BREAKING_OWN(CreateImage, create_image),
    BREAKING_OWN(MapMemory, map_memory),
    BREAKING_OWN(CreateImageView, create_image_view),
    BREAKING_OWN(BindBufferMemory, bind_buffer_memory),
    BREAKING_OWN(BindImageMemory, bind_image_memory),
    BREAKING_OWN(FreeMemory, free_memory),
    BREAKING_OWN(CreatePipelineCache, create_pipeline_cache),
    BREAKING_OWN(CreateGraphicsPipelines, create_graphics_pipelines),
    BREAKING_OWN(UpdateDescriptorSets, update_descriptor_sets),
    BREAKING_OWN(QueueSubmit, queue_submit),
    BREAKING_OWN(WaitForFences, wait_for_fences),
    BREAKING_OWN(CmdDraw, draw),
    BREAKING_OWN(CmdDrawIndexed, draw_indexed),
    BREAKING_OWN(CmdBeginRendering, begin_rendering),
    BREAKING_OWN(CmdEndRendering, end_rendering),
    BREAKING_OWN(CmdPipelineBarrier2, pipeline_barrier),
    BREAKING_OWN(CmdClearColorImage, clear_color_image),
    BREAKING_OWN(CmdCopyImageToBuffer, copy_image_to_buffer),
    BREAKING_OWN(CmdCopyBufferToImage, copy_buffer_to_image),
    BREAKING_OWN(CmdBlitImage, blit_image),
    BREAKING_OWN(CmdDispatch, dispatch),
};

// Lines and points need a feature that the application has no reason to enable.
VkResult create_with_lines(const vulkan_layer::Instance& instance, VkPhysicalDevice physical,
                           const VkDeviceCreateInfo& asked,
                           const vulkan_layer::CreateNext& create) {
    VkPhysicalDeviceFeatures offered{};
    instance.get<PFN_vkGetPhysicalDeviceFeatures>("vkGetPhysicalDeviceFeatures")(physical,
                                                                                 &offered);
    VkDeviceCreateInfo own = asked;
    for (auto* s = static_cast<const VkBaseInStructure*>(own.pNext); s != nullptr; s = s->pNext) {
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2) {
            auto* chained =
                reinterpret_cast<VkPhysicalDeviceFeatures2*>(const_cast<VkBaseInStructure*>(s));
            chained->features.fillModeNonSolid = offered.fillModeNonSolid;
            return create(own);
        }
    }
    VkPhysicalDeviceFeatures features =
        own.pEnabledFeatures != nullptr ? *own.pEnabledFeatures : VkPhysicalDeviceFeatures{};
    features.fillModeNonSolid = offered.fillModeNonSolid;
    own.pEnabledFeatures = &features;
    return create(own);
}

}  // namespace

void draw_call(VkCommandBuffer commands, DrawCall call, uint32_t instances) {
    Recording& recording = recording_of(commands);
    call.instances = instances;
    call.topology = recording.topology;
    call.number = recording.draws++;
    call.in_secondary = recording.is_secondary;
    call.may_repeat = recording.may_repeat;
    call.subpass = recording.subpass;
    call.stages = recording.pipeline.stages;
    call.pipeline = recording.pipeline;
    call.has_offsets = recording.has_offsets;
    call.state = recording.dynamic;
    call.is_imported = is_imported(recording.first_buffer);
    call.rendering = recording.rendering;
    call.index_type = recording.index_type;
    call.has_restart = recording.has_restart;
    if (call.indexed && call.index_type == VK_INDEX_TYPE_UINT32) {
        call.first_value =
            word_at(recording.index_buffer, recording.index_offset + call.first * sizeof(uint32_t));
    }
    alter(hooks().draw, call);
    const DynamicState asked = recording.dynamic;
    recording.draw([=] {
        const Driver& driver = driver_of_handle(commands);
        if (call.restart) {
            driver.CmdSetPrimitiveRestartEnable(commands, *call.restart ? VK_TRUE : VK_FALSE);
        }
        change_state(commands, asked, call.state);
        const auto draw = [&](uint32_t first, uint32_t count) {
            if (call.indexed) {
                driver.CmdDrawIndexed(commands, call.count, count, call.first, call.vertex_offset,
                                      first);
            } else {
                driver.CmdDraw(commands, call.count, count, call.first, first);
            }
        };
        for (uint32_t n = 0; n < call.times; ++n) {
            if (!call.is_reversed) {
                draw(call.first_instance, call.instances);
            }
            for (uint32_t i = call.is_reversed ? call.instances : 0; i > 0; --i) {
                draw(call.first_instance + i - 1, 1);
            }
        }
        change_state(commands, call.state, asked);
        if (call.restart) {
            driver.CmdSetPrimitiveRestartEnable(commands, call.has_restart ? VK_TRUE : VK_FALSE);
        }
    });
}

}  // namespace breaking

namespace vulkan_layer {

bool is_ready() {
    return breaking::chosen_fault() != nullptr;
}

std::span<const char* const> needed_instance_commands() {
    static constexpr std::array kNames = {"vkGetPhysicalDeviceFeatures"};
    return kNames;
}

VkResult create_next_device(const Instance& instance, VkPhysicalDevice physical,
                            const VkDeviceCreateInfo& asked, const CreateNext& create) {
    return breaking::chosen_fault()->needs_lines
               ? breaking::create_with_lines(instance, physical, asked, create)
               : create(asked);
}

std::unique_ptr<Device> load_device(VkDevice device, PFN_vkGetDeviceProcAddr next) {
    auto driver = std::make_unique<breaking::Driver>();
#define BREAKING_LOAD(name) driver->name = reinterpret_cast<PFN_vk##name>(next(device, "vk" #name));
    BREAKING_COMMANDS(BREAKING_LOAD)
#undef BREAKING_LOAD
    return driver;
}

PFN_vkVoidFunction own_instance_command(const char* /*name*/) {
    return nullptr;
}

PFN_vkVoidFunction own_device_command(const char* name) {
    for (const auto table : {std::span<const breaking::OwnCommand>(breaking::kDeviceCommands),
                             breaking::state_commands(), breaking::indirect_commands(),
                             breaking::recording_commands(), breaking::query_commands()}) {
        if (const PFN_vkVoidFunction own = find_command(table, name); own != nullptr) {
            return own;
        }
    }
    return nullptr;
}

bool shows_device_command(VkDevice /*device*/, const char* /*name*/) {
    return true;
}

}  // namespace vulkan_layer
