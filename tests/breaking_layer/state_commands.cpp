// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The layer's versions of the commands that set dynamic state and bindings.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

#include "altering.hpp"
#include "recording.hpp"

namespace breaking {

namespace {

// Sets a dynamic state, unless the fault drops the call.
void set_dynamic(VkCommandBuffer commands, Recording::StateKey key, Recording::Command set) {
    Recording& recording = recording_of(commands);
    StateCall call{key.first, !recording.set_since_bind.insert(key).second,
                   recording.follows_static};
    if (!alter(hooks().drop_state, call)) {
        recording.set_state(key, std::move(set));
    }
}

// A command that sets one value: altered, then set. Array arguments are copied, since it may be
// held back.
template <typename Value>
void set_value(VkCommandBuffer commands, const char* key, Value value, bool (*hook)(Value&),
               void(VKAPI_PTR* set)(VkCommandBuffer, Value)) {
    alter(hook, value);
    set_dynamic(commands, {key, 0}, [=] { set(commands, value); });
}

// Notes an array that is set from its element `first` on.
template <typename T>
void put(std::vector<T>& state, uint32_t first, const std::vector<T>& values) {
    state.resize(std::max(state.size(), first + values.size()));
    std::copy(values.begin(), values.end(), state.begin() + first);
}

VKAPI_ATTR void VKAPI_CALL set_viewport(VkCommandBuffer commands, uint32_t first, uint32_t count,
                                        const VkViewport* given) {
    std::vector<VkViewport> own(given, given + count);
    alter(hooks().viewports, std::span(own));
    put(recording_of(commands).dynamic.viewports, first, own);
    set_dynamic(commands, {"viewport", first}, [=] {
        driver_of_handle(commands).CmdSetViewport(commands, first, count, own.data());
    });
}

VKAPI_ATTR void VKAPI_CALL set_scissor(VkCommandBuffer commands, uint32_t first, uint32_t count,
                                       const VkRect2D* given) {
    std::vector<VkRect2D> own(given, given + count);
    alter(hooks().scissors, std::span(own));
    put(recording_of(commands).dynamic.scissors, first, own);
    set_dynamic(commands, {"scissor", first}, [=] {
        driver_of_handle(commands).CmdSetScissor(commands, first, count, own.data());
    });
}

VKAPI_ATTR void VKAPI_CALL set_cull_mode(VkCommandBuffer commands, VkCullModeFlags mode) {
    recording_of(commands).dynamic.cull_mode = mode;
    set_value(commands, "cull mode", mode, hooks().cull_mode,
              driver_of_handle(commands).CmdSetCullMode);
}

VKAPI_ATTR void VKAPI_CALL set_front_face(VkCommandBuffer commands, VkFrontFace face) {
    recording_of(commands).dynamic.front_face = face;
    set_value(commands, "front face", face, hooks().front_face,
              driver_of_handle(commands).CmdSetFrontFace);
}

VKAPI_ATTR void VKAPI_CALL set_topology(VkCommandBuffer commands, VkPrimitiveTopology topology) {
    recording_of(commands).topology = topology;
    recording_of(commands).dynamic.topology = topology;
    set_value(commands, "topology", topology, hooks().topology,
              driver_of_handle(commands).CmdSetPrimitiveTopology);
}

VKAPI_ATTR void VKAPI_CALL set_restart(VkCommandBuffer commands, VkBool32 enable) {
    recording_of(commands).has_restart = enable == VK_TRUE;
    set_value(commands, "restart", enable, hooks().primitive_restart,
              driver_of_handle(commands).CmdSetPrimitiveRestartEnable);
}

VKAPI_ATTR void VKAPI_CALL set_discard(VkCommandBuffer commands, VkBool32 enable) {
    recording_of(commands).dynamic.discards = enable;
    set_value(commands, "rasterizer discard", enable, hooks().rasterizer_discard,
              driver_of_handle(commands).CmdSetRasterizerDiscardEnable);
}

VKAPI_ATTR void VKAPI_CALL set_depth_compare(VkCommandBuffer commands, VkCompareOp op) {
    recording_of(commands).dynamic.depth_compare = op;
    set_value(commands, "depth compare", op, hooks().depth_compare,
              driver_of_handle(commands).CmdSetDepthCompareOp);
}

VKAPI_ATTR void VKAPI_CALL set_depth_write(VkCommandBuffer commands, VkBool32 enable) {
    recording_of(commands).dynamic.depth_write = enable;
    set_value(commands, "depth write", enable, hooks().depth_write,
              driver_of_handle(commands).CmdSetDepthWriteEnable);
}

VKAPI_ATTR void VKAPI_CALL set_depth_bounds_enable(VkCommandBuffer commands, VkBool32 enable) {
    set_value(commands, "depth bounds enable", enable, hooks().depth_bounds_enable,
              driver_of_handle(commands).CmdSetDepthBoundsTestEnable);
}

VKAPI_ATTR void VKAPI_CALL set_depth_bounds(VkCommandBuffer commands, float min, float max) {
    DepthBounds bounds{min, max};
    alter(hooks().depth_bounds, bounds);
    set_dynamic(commands, {"depth bounds", 0}, [=] {
        driver_of_handle(commands).CmdSetDepthBounds(commands, bounds.min, bounds.max);
    });
}

VKAPI_ATTR void VKAPI_CALL set_depth_bias_enable(VkCommandBuffer commands, VkBool32 enable) {
    recording_of(commands).dynamic.has_bias = enable;
    set_value(commands, "depth bias enable", enable, hooks().depth_bias_enable,
              driver_of_handle(commands).CmdSetDepthBiasEnable);
}

VKAPI_ATTR void VKAPI_CALL set_depth_bias(VkCommandBuffer commands, float constant, float clamp,
                                          float slope) {
    DepthBias bias{constant, clamp, slope};
    alter(hooks().depth_bias, bias);
    set_dynamic(commands, {"depth bias", 0}, [=] {
        driver_of_handle(commands).CmdSetDepthBias(commands, bias.constant, bias.clamp, bias.slope);
    });
}

VKAPI_ATTR void VKAPI_CALL set_blend_constants(VkCommandBuffer commands, const float given[4]) {
    std::array<float, 4> own{};
    std::copy_n(given, 4, own.begin());
    alter(hooks().blend_constants, std::span<float, 4>(own));
    set_dynamic(commands, {"blend constants", 0},
                [=] { driver_of_handle(commands).CmdSetBlendConstants(commands, own.data()); });
}

VKAPI_ATTR void VKAPI_CALL set_blend_enables(VkCommandBuffer commands, uint32_t first,
                                             uint32_t count, const VkBool32* given) {
    std::vector<VkBool32> own(given, given + count);
    alter(hooks().blend_enables, std::span(own));
    set_dynamic(commands, {"blend enables", first}, [=] {
        driver_of_handle(commands).CmdSetColorBlendEnableEXT(commands, first, count, own.data());
    });
}

VKAPI_ATTR void VKAPI_CALL set_write_masks(VkCommandBuffer commands, uint32_t first, uint32_t count,
                                           const VkColorComponentFlags* given) {
    std::vector<VkColorComponentFlags> own(given, given + count);
    alter(hooks().write_masks, std::span(own));
    set_dynamic(commands, {"write masks", first}, [=] {
        driver_of_handle(commands).CmdSetColorWriteMaskEXT(commands, first, count, own.data());
    });
}

VKAPI_ATTR void VKAPI_CALL set_sample_mask(VkCommandBuffer commands, VkSampleCountFlagBits samples,
                                           const VkSampleMask* given) {
    VkSampleMask own = *given;
    alter(hooks().sample_mask, own);
    set_dynamic(commands, {"sample mask", 0},
                [=] { driver_of_handle(commands).CmdSetSampleMaskEXT(commands, samples, &own); });
}

VKAPI_ATTR void VKAPI_CALL set_depth_clamp(VkCommandBuffer commands, VkBool32 enable) {
    alter(hooks().depth_clamp, enable);
    set_dynamic(commands, {"depth clamp", 0},
                [=] { driver_of_handle(commands).CmdSetDepthClampEnableEXT(commands, enable); });
}

VKAPI_ATTR void VKAPI_CALL set_provoking_mode(VkCommandBuffer commands,
                                              VkProvokingVertexModeEXT mode) {
    alter(hooks().provoking_mode, mode);
    set_dynamic(commands, {"provoking vertex", 0},
                [=] { driver_of_handle(commands).CmdSetProvokingVertexModeEXT(commands, mode); });
}

VKAPI_ATTR void VKAPI_CALL set_alpha_to_coverage(VkCommandBuffer commands, VkBool32 enable) {
    alter(hooks().alpha_to_coverage, enable);
    set_dynamic(commands, {"alpha to coverage", 0}, [=] {
        driver_of_handle(commands).CmdSetAlphaToCoverageEnableEXT(commands, enable);
    });
}

VKAPI_ATTR void VKAPI_CALL set_stencil_op(VkCommandBuffer commands, VkStencilFaceFlags faces,
                                          VkStencilOp fail, VkStencilOp pass,
                                          VkStencilOp depth_fail, VkCompareOp compare) {
    StencilOps own{faces, fail, pass, depth_fail, compare};
    alter(hooks().stencil_ops, own);
    for (uint32_t k = 0; k < 2; ++k) {
        if ((faces & (VK_STENCIL_FACE_FRONT_BIT << k)) != 0) {
            recording_of(commands).dynamic.stencil.at(k) = {fail, pass, depth_fail, compare};
        }
    }
    if (own.is_dropped) {
        return;
    }
    set_dynamic(commands, {"stencil operation", faces}, [=] {
        driver_of_handle(commands).CmdSetStencilOp(commands, own.faces, own.fail, own.pass,
                                                   own.depth_fail, own.compare);
    });
}

// The same of a mask or the reference.
void set_stencil_value(VkCommandBuffer commands, const char* key, StencilValue own,
                       bool (*hook)(StencilValue&), PFN_vkCmdSetStencilReference set) {
    const VkStencilFaceFlags asked = own.faces;
    own.in_secondary = recording_of(commands).is_secondary;
    alter(hook, own);
    if (!own.is_dropped) {
        set_dynamic(commands, {key, asked}, [=] { set(commands, own.faces, own.value); });
    }
}

VKAPI_ATTR void VKAPI_CALL set_stencil_compare_mask(VkCommandBuffer commands,
                                                    VkStencilFaceFlags faces, uint32_t mask) {
    set_stencil_value(commands, "stencil compare mask", {faces, mask}, hooks().stencil_compare_mask,
                      driver_of_handle(commands).CmdSetStencilCompareMask);
}

VKAPI_ATTR void VKAPI_CALL set_stencil_write_mask(VkCommandBuffer commands,
                                                  VkStencilFaceFlags faces, uint32_t mask) {
    set_stencil_value(commands, "stencil write mask", {faces, mask}, hooks().stencil_write_mask,
                      driver_of_handle(commands).CmdSetStencilWriteMask);
}

VKAPI_ATTR void VKAPI_CALL set_stencil_reference(VkCommandBuffer commands, VkStencilFaceFlags faces,
                                                 uint32_t reference) {
    for (uint32_t k = 0; k < 2; ++k) {
        if ((faces & (VK_STENCIL_FACE_FRONT_BIT << k)) != 0) {
            recording_of(commands).dynamic.stencil_reference.at(k) = reference;
        }
    }
    set_stencil_value(commands, "stencil reference", {faces, reference}, hooks().stencil_reference,
                      driver_of_handle(commands).CmdSetStencilReference);
}

VKAPI_ATTR void VKAPI_CALL bind_shaders(VkCommandBuffer commands, uint32_t count,
                                        const VkShaderStageFlagBits* stages,
                                        const uint64_t* shaders) {
    recording_of(commands).pipeline = {};  // there is none
    recording_of(commands).has_pipeline = true;
    driver_of_handle(commands).CmdBindShadersEXT(commands, count, stages, shaders);
}

VKAPI_ATTR void VKAPI_CALL bind_pipeline(VkCommandBuffer commands, VkPipelineBindPoint point,
                                         VkPipeline pipeline) {
    Recording& recording = recording_of(commands);
    Reset reset;
    const bool has_dynamic = point == VK_PIPELINE_BIND_POINT_GRAPHICS && !is_static(pipeline);
    if (has_dynamic) {
        alter(hooks().bind, reset);
    }
    recording.follows_static = recording.follows_static || is_static(pipeline);
    if (point == VK_PIPELINE_BIND_POINT_GRAPHICS) {
        recording.has_pipeline = true;
        recording.pipeline = facts_of(pipeline);
    }
    recording.set_since_bind.clear();
    recording.set_state({"pipeline", point}, [=] {
        const Driver& driver = driver_of_handle(commands);
        driver.CmdBindPipeline(commands, point, pipeline);
        if (reset.topology) {
            driver.CmdSetPrimitiveTopology(commands, *reset.topology);
        }
        if (reset.cull_mode) {
            driver.CmdSetCullMode(commands, *reset.cull_mode);
        }
        if (reset.scissor) {
            driver.CmdSetScissor(commands, 0, 1, &*reset.scissor);
        }
    });
}

VKAPI_ATTR void VKAPI_CALL bind_descriptor_sets(VkCommandBuffer commands, VkPipelineBindPoint point,
                                                VkPipelineLayout layout, uint32_t first,
                                                uint32_t count, const VkDescriptorSet* sets,
                                                uint32_t offset_count, const uint32_t* offsets) {
    const std::vector<VkDescriptorSet> own(sets, sets + count);
    std::vector<uint32_t> own_offsets(offsets, offsets + offset_count);
    recording_of(commands).has_offsets = offset_count > 0;
    if (offset_count > 0) {
        alter(hooks().dynamic_offsets, std::span(own_offsets));
    }
    recording_of(commands).set_state({"descriptor sets", first}, [=] {
        driver_of_handle(commands).CmdBindDescriptorSets(
            commands, point, layout, first, count, own.data(), offset_count, own_offsets.data());
    });
}

VKAPI_ATTR void VKAPI_CALL push_constants(VkCommandBuffer commands, VkPipelineLayout layout,
                                          VkShaderStageFlags stages, uint32_t offset, uint32_t size,
                                          const void* given) {
    std::vector<std::byte> own(size);
    std::memcpy(own.data(), given, size);
    recording_of(commands).set_state({"push constants", offset}, [=] {
        driver_of_handle(commands).CmdPushConstants(commands, layout, stages, offset, size,
                                                    own.data());
    });
}

void alter_vertex_buffers(VkCommandBuffer commands, VertexBuffers& own) {
    Recording& recording = recording_of(commands);
    if (own.first == 0) {
        recording.first_buffer = own.buffers.front();
        recording.first_stride = own.strides.empty() ? 0 : own.strides.front();
    }
    own.first_buffer = recording.first_buffer;
    own.first_stride = recording.first_stride;
    alter(hooks().vertex_buffers, own);
}

VKAPI_ATTR void VKAPI_CALL bind_vertex_buffers(VkCommandBuffer commands, uint32_t first,
                                               uint32_t count, const VkBuffer* buffers,
                                               const VkDeviceSize* offsets) {
    VertexBuffers own;
    own.first = first;
    own.buffers.assign(buffers, buffers + count);
    own.offsets.assign(offsets, offsets + count);
    alter_vertex_buffers(commands, own);
    recording_of(commands).set_state({"vertex buffers", first}, [=] {
        driver_of_handle(commands).CmdBindVertexBuffers(commands, first, count, own.buffers.data(),
                                                        own.offsets.data());
    });
}

VKAPI_ATTR void VKAPI_CALL bind_vertex_buffers2(VkCommandBuffer commands, uint32_t first,
                                                uint32_t count, const VkBuffer* buffers,
                                                const VkDeviceSize* offsets,
                                                const VkDeviceSize* sizes,
                                                const VkDeviceSize* strides) {
    VertexBuffers own;
    own.first = first;
    own.buffers.assign(buffers, buffers + count);
    own.offsets.assign(offsets, offsets + count);
    if (strides != nullptr) {
        own.strides.assign(strides, strides + count);
    }
    const std::vector<VkDeviceSize> own_sizes =
        sizes != nullptr ? std::vector(sizes, sizes + count) : std::vector<VkDeviceSize>();
    alter_vertex_buffers(commands, own);
    recording_of(commands).set_state({"vertex buffers", first}, [=] {
        driver_of_handle(commands).CmdBindVertexBuffers2(
            commands, first, count, own.buffers.data(), own.offsets.data(),
            own_sizes.empty() ? nullptr : own_sizes.data(),
            own.strides.empty() ? nullptr : own.strides.data());
    });
}

VKAPI_ATTR void VKAPI_CALL bind_index_buffer(VkCommandBuffer commands, VkBuffer buffer,
                                             VkDeviceSize offset, VkIndexType type) {
    alter(hooks().index_type, type);
    Recording& recording = recording_of(commands);
    IndexBuffer own{buffer, offset, type, recording.first_buffer};
    alter(hooks().index_buffer, own);
    recording.index_type = own.type;
    recording.index_buffer = own.buffer;
    recording.index_offset = own.offset;
    recording.set_state({"index buffer", 0}, [=] {
        driver_of_handle(commands).CmdBindIndexBuffer(commands, own.buffer, own.offset, own.type);
    });
}

const OwnCommand kStateCommands[] = {
    BREAKING_OWN(CmdSetViewport, set_viewport),
    BREAKING_OWN(CmdSetScissor, set_scissor),
    BREAKING_OWN(CmdSetCullMode, set_cull_mode),
    BREAKING_OWN(CmdSetFrontFace, set_front_face),
    BREAKING_OWN(CmdSetPrimitiveTopology, set_topology),
    BREAKING_OWN(CmdSetPrimitiveRestartEnable, set_restart),
    BREAKING_OWN(CmdSetRasterizerDiscardEnable, set_discard),
    BREAKING_OWN(CmdSetDepthCompareOp, set_depth_compare),
    BREAKING_OWN(CmdSetDepthWriteEnable, set_depth_write),
    BREAKING_OWN(CmdSetDepthBoundsTestEnable, set_depth_bounds_enable),
    BREAKING_OWN(CmdSetDepthBounds, set_depth_bounds),
    BREAKING_OWN(CmdSetDepthBiasEnable, set_depth_bias_enable),
    BREAKING_OWN(CmdSetDepthBias, set_depth_bias),
    BREAKING_OWN(CmdSetBlendConstants, set_blend_constants),
    BREAKING_OWN(CmdSetColorBlendEnableEXT, set_blend_enables),
    BREAKING_OWN(CmdSetColorWriteMaskEXT, set_write_masks),
    BREAKING_OWN(CmdSetSampleMaskEXT, set_sample_mask),
    BREAKING_OWN(CmdSetDepthClampEnableEXT, set_depth_clamp),
    BREAKING_OWN(CmdSetProvokingVertexModeEXT, set_provoking_mode),
    BREAKING_OWN(CmdSetAlphaToCoverageEnableEXT, set_alpha_to_coverage),
    BREAKING_OWN(CmdSetStencilOp, set_stencil_op),
    BREAKING_OWN(CmdSetStencilCompareMask, set_stencil_compare_mask),
    BREAKING_OWN(CmdSetStencilWriteMask, set_stencil_write_mask),
    BREAKING_OWN(CmdSetStencilReference, set_stencil_reference),
    BREAKING_OWN(CmdBindPipeline, bind_pipeline),
    BREAKING_OWN(CmdBindShadersEXT, bind_shaders),
    BREAKING_OWN(CmdBindDescriptorSets, bind_descriptor_sets),
    BREAKING_OWN(CmdPushConstants, push_constants),
    BREAKING_OWN(CmdBindVertexBuffers, bind_vertex_buffers),
    BREAKING_OWN(CmdBindVertexBuffers2, bind_vertex_buffers2),
    BREAKING_OWN(CmdBindIndexBuffer, bind_index_buffer),
};

}  // namespace

std::span<const OwnCommand> state_commands() {
    return kStateCommands;
}

}  // namespace breaking
