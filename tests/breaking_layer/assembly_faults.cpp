// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// From vertices to faces: topology, restart, indices, vertex formats, facing, culling, polygon
// mode.
#include <algorithm>
#include <array>

#include "fault.hpp"

namespace breaking {

namespace {

template <VkCullModeFlags from, VkCullModeFlags to>
bool cull(VkCullModeFlags& mode) {
    return mode == from && change(mode, to);
}

bool swap_cull(VkCullModeFlags& mode) {
    constexpr VkCullModeFlags kBoth = VK_CULL_MODE_FRONT_AND_BACK;
    return mode != VK_CULL_MODE_NONE && mode != kBoth && change(mode, mode ^ kBoth);
}

template <VkPrimitiveTopology from, VkPrimitiveTopology to>
bool topology(VkPrimitiveTopology& t) {
    return t == from && change(t, to);
}

bool first_provokes(PipelineCopy& p) {
    return p.provoking &&
           change(p.provoking->provokingVertexMode, VK_PROVOKING_VERTEX_MODE_FIRST_VERTEX_EXT);
}

bool last_provokes(PipelineCopy& p) {
    if (!p.provoking) {
        p.provoking.emplace();
        p.provoking->sType =
            VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_PROVOKING_VERTEX_STATE_CREATE_INFO_EXT;
    }
    return change(p.provoking->provokingVertexMode, VK_PROVOKING_VERTEX_MODE_LAST_VERTEX_EXT);
}

// A vertex input of four floats, read as fewer: what is missing becomes 0, 0, 1.
bool read_fewer(PipelineCopy& p, bool position, VkFormat format) {
    bool altered = false;
    for (VkVertexInputAttributeDescription& input : p.inputs) {
        if ((input.location == 0) == position && input.format == VK_FORMAT_R32G32B32A32_SFLOAT) {
            altered = change(input.format, format) || altered;
        }
    }
    return altered;
}

bool swap_first_attributes(PipelineCopy& p) {
    if (p.inputs.size() < 3) {
        return false;
    }
    std::swap(p.inputs[1].binding, p.inputs[2].binding);
    return true;
}

constexpr std::array kAssemblyFaults = {
    Fault{"cull-off",
          "cull-none"_fault,
          {.cull_mode = [](VkCullModeFlags& m) { return change(m, VK_CULL_MODE_NONE); }}},
    Fault{"cull-swapped", "cull-inverted"_fault, {.cull_mode = swap_cull}},
    Fault{"cull-back-always",
          "cull-back-always"_fault,
          {.cull_mode = cull<VK_CULL_MODE_NONE, VK_CULL_MODE_BACK_BIT>}},
    Fault{"cull-both-as-front",
          "cull-both-as-front"_fault,
          {.cull_mode = cull<VK_CULL_MODE_FRONT_AND_BACK, VK_CULL_MODE_FRONT_BIT>}},
    Fault{"front-face-swapped",
          "front-face-inverted"_fault,
          {.front_face =
               [](VkFrontFace& f) {
                   return change(f, f == VK_FRONT_FACE_CLOCKWISE ? VK_FRONT_FACE_COUNTER_CLOCKWISE
                                                                 : VK_FRONT_FACE_CLOCKWISE);
               }}},
    Fault{
        "front-face-ignored",
        "front-always-counter-clockwise"_fault,
        {.front_face = [](VkFrontFace& f) { return change(f, VK_FRONT_FACE_COUNTER_CLOCKWISE); }}},
    Fault{
        "strip-as-list",
        "strip-as-list"_fault,
        {.topology =
             topology<VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST>}},
    Fault{
        "list-as-strip",
        "list-as-strip"_fault,
        {.topology =
             topology<VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP>}},
    Fault{"fan-as-strip",
          "fan-as-strip"_fault,
          {.topology =
               topology<VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP>}},
    Fault{"discard-ignored",
          "discard-ignored"_fault,
          {.rasterizer_discard = [](VkBool32& d) { return change(d, VK_FALSE); }}},
    Fault{"restart-ignored",
          "restart-ignored"_fault,
          {.primitive_restart = [](VkBool32& r) { return change(r, VK_FALSE); }}},
    Fault{"index-16-bits",
          "index-16-bits"_fault,
          {.index_type = [](VkIndexType& t) { return change(t, VK_INDEX_TYPE_UINT16); }}},
    Fault{"provoking-first", "provoking-mode-ignored"_fault, {.pipeline = first_provokes}},
    Fault{"provoking-last", "provoking-last"_fault, {.pipeline = last_provokes}},
    Fault{"position-w-one",
          "position-w-one"_fault,
          {.pipeline =
               [](PipelineCopy& p) { return read_fewer(p, true, VK_FORMAT_R32G32B32_SFLOAT); }}},
    Fault{
        "position-z-zero",
        "position-z-zero"_fault,
        {.pipeline = [](PipelineCopy& p) { return read_fewer(p, true, VK_FORMAT_R32G32_SFLOAT); }}},
    Fault{"attributes-w-one",
          "attribute-w-one"_fault,
          {.pipeline =
               [](PipelineCopy& p) { return read_fewer(p, false, VK_FORMAT_R32G32B32_SFLOAT); }}},
    Fault{"attributes-swapped", "attributes-swapped"_fault, {.pipeline = swap_first_attributes}},
    Fault{"polygon-lines",
          "Polygons are drawn as their outlines.",
          {.pipeline =
               [](PipelineCopy& p) {
                   return change(p.rasterization.polygonMode, VK_POLYGON_MODE_LINE);
               }},
          true},
    Fault{"polygon-points",
          "Polygons are drawn as their vertices.",
          {.pipeline =
               [](PipelineCopy& p) {
                   return change(p.rasterization.polygonMode, VK_POLYGON_MODE_POINT);
               }},
          true},
    Fault{"discard-all",
          "draw-nothing"_fault,
          {.rasterizer_discard = [](VkBool32& d) { return change(d, VK_TRUE); }}},
};

}  // namespace

std::span<const Fault> assembly_faults() {
    return kAssemblyFaults;
}

}  // namespace breaking
