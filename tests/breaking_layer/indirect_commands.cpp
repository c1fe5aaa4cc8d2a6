// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The layer's versions of indirect draws and of several draws in a command. Where the chosen fault
// is about them, the parameters are read from the application's mapped memory, as a driver that
// does so itself would do, and drawn directly.
#include <algorithm>
#include <vector>

#include "altering.hpp"
#include "memory_map.hpp"
#include "recording.hpp"

namespace breaking {

namespace {

bool is_about_indirect() {
    return hooks().indirect != nullptr || hooks().indirect_draw != nullptr;
}

void draw_directly(VkCommandBuffer commands, const IndirectDraw& from) {
    DrawCall call;
    call.indexed = from.indexed;
    call.count = from.count;
    call.first = from.first;
    call.vertex_offset = from.vertex_offset;
    call.first_instance = from.first_instance;
    draw_call(commands, call, from.instances);
}

// The draws that a call finds in its buffer, one by one, if the fault alters some of it. Else
// nothing is drawn: the driver's own command is another one, with defects of its own.
bool draw_altered(VkCommandBuffer commands, VkBuffer buffer, IndirectCall call,
                  VkBuffer count_buffer = VK_NULL_HANDLE) {
    bool is_altered = alter(hooks().indirect, call);
    uint32_t count = call.count;
    if (call.count_offset) {
        count = std::min(count, word_at(count_buffer, *call.count_offset).value_or(0));
    }
    std::vector<IndirectDraw> draws;
    for (uint32_t k = 0; k < count; ++k) {
        const VkDeviceSize at = call.offset + VkDeviceSize{k} * call.stride;
        const auto word = [&](uint32_t n) { return word_at(buffer, at + 4 * n).value_or(0); };
        IndirectDraw draw;
        draw.indexed = call.indexed;
        draw.count = word(0);
        draw.instances = word(1);
        draw.first = word(2);
        draw.vertex_offset = call.indexed ? static_cast<int32_t>(word(3)) : 0;
        draw.first_instance = word(call.indexed ? 4 : 3);
        is_altered = alter(hooks().indirect_draw, draw) || is_altered;
        draws.push_back(draw);
    }
    for (const IndirectDraw& draw : draws) {
        if (is_altered) {
            draw_directly(commands, draw);
        }
    }
    return is_altered;
}

VKAPI_ATTR void VKAPI_CALL draw_indirect(VkCommandBuffer commands, VkBuffer buffer,
                                         VkDeviceSize offset, uint32_t count, uint32_t stride) {
    if (is_about_indirect() &&
        draw_altered(commands, buffer, {false, offset, count, stride, std::nullopt})) {
        return;
    }
    recording_of(commands).draw([=] {
        driver_of_handle(commands).CmdDrawIndirect(commands, buffer, offset, count, stride);
    });
}

VKAPI_ATTR void VKAPI_CALL draw_indexed_indirect(VkCommandBuffer commands, VkBuffer buffer,
                                                 VkDeviceSize offset, uint32_t count,
                                                 uint32_t stride) {
    if (is_about_indirect() &&
        draw_altered(commands, buffer, {true, offset, count, stride, std::nullopt})) {
        return;
    }
    recording_of(commands).draw([=] {
        driver_of_handle(commands).CmdDrawIndexedIndirect(commands, buffer, offset, count, stride);
    });
}

VKAPI_ATTR void VKAPI_CALL draw_indirect_count(VkCommandBuffer commands, VkBuffer buffer,
                                               VkDeviceSize offset, VkBuffer count_buffer,
                                               VkDeviceSize count_offset, uint32_t most,
                                               uint32_t stride) {
    if (is_about_indirect() &&
        draw_altered(commands, buffer, {false, offset, most, stride, count_offset}, count_buffer)) {
        return;
    }
    recording_of(commands).draw([=] {
        driver_of_handle(commands).CmdDrawIndirectCount(commands, buffer, offset, count_buffer,
                                                        count_offset, most, stride);
    });
}

VKAPI_ATTR void VKAPI_CALL draw_indexed_indirect_count(VkCommandBuffer commands, VkBuffer buffer,
                                                       VkDeviceSize offset, VkBuffer count_buffer,
                                                       VkDeviceSize count_offset, uint32_t most,
                                                       uint32_t stride) {
    if (is_about_indirect() &&
        draw_altered(commands, buffer, {true, offset, most, stride, count_offset}, count_buffer)) {
        return;
    }
    recording_of(commands).draw([=] {
        driver_of_handle(commands).CmdDrawIndexedIndirectCount(
            commands, buffer, offset, count_buffer, count_offset, most, stride);
    });
}

void draw_several(VkCommandBuffer commands, MultiDraw multi) {
    alter(hooks().multi_draw, multi);
    for (const IndirectDraw& draw : multi.draws) {
        draw_directly(commands, draw);
    }
}

template <typename Info>
const Info& info_at(const Info* infos, uint32_t k, uint32_t stride) {
    return *reinterpret_cast<const Info*>(reinterpret_cast<const char*>(infos) + k * stride);
}

VKAPI_ATTR void VKAPI_CALL draw_multi(VkCommandBuffer commands, uint32_t count,
                                      const VkMultiDrawInfoEXT* infos, uint32_t instances,
                                      uint32_t first_instance, uint32_t stride) {
    if (hooks().multi_draw == nullptr) {
        driver_of_handle(commands).CmdDrawMultiEXT(commands, count, infos, instances,
                                                   first_instance, stride);
        return;
    }
    MultiDraw multi;
    for (uint32_t k = 0; k < count; ++k) {
        const VkMultiDrawInfoEXT& info = info_at(infos, k, stride);
        multi.draws.push_back(
            {false, info.vertexCount, instances, info.firstVertex, first_instance, 0});
    }
    draw_several(commands, multi);
}

VKAPI_ATTR void VKAPI_CALL draw_multi_indexed(VkCommandBuffer commands, uint32_t count,
                                              const VkMultiDrawIndexedInfoEXT* infos,
                                              uint32_t instances, uint32_t first_instance,
                                              uint32_t stride, const int32_t* vertex_offset) {
    if (hooks().multi_draw == nullptr) {
        driver_of_handle(commands).CmdDrawMultiIndexedEXT(commands, count, infos, instances,
                                                          first_instance, stride, vertex_offset);
        return;
    }
    MultiDraw multi;
    multi.indexed = true;
    for (uint32_t k = 0; k < count; ++k) {
        const VkMultiDrawIndexedInfoEXT& info = info_at(infos, k, stride);
        multi.draws.push_back({true, info.indexCount, instances, info.firstIndex, first_instance,
                               vertex_offset != nullptr ? *vertex_offset : info.vertexOffset});
    }
    draw_several(commands, multi);
}

VKAPI_ATTR void VKAPI_CALL draw_mesh_tasks(VkCommandBuffer commands, uint32_t x, uint32_t y,
                                           uint32_t z) {
    alter(hooks().mesh_groups, x);
    driver_of_handle(commands).CmdDrawMeshTasksEXT(commands, x, y, z);
}

const OwnCommand kIndirectCommands[] = {
    BREAKING_OWN(CmdDrawMeshTasksEXT, draw_mesh_tasks),
    BREAKING_OWN(CmdDrawIndirect, draw_indirect),
    BREAKING_OWN(CmdDrawIndexedIndirect, draw_indexed_indirect),
    BREAKING_OWN(CmdDrawIndirectCount, draw_indirect_count),
    BREAKING_OWN(CmdDrawIndexedIndirectCount, draw_indexed_indirect_count),
    BREAKING_OWN(CmdDrawMultiEXT, draw_multi),
    BREAKING_OWN(CmdDrawMultiIndexedEXT, draw_multi_indexed),
};

}  // namespace

std::span<const OwnCommand> indirect_commands() {
    return kIndirectCommands;
}

}  // namespace breaking
