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
          "Nothing is culled.",
          {.cull_mode = [](VkCullModeFlags& m) { return change(m, VK_CULL_MODE_NONE); }}},
    Fault{"cull-swapped",
          "Front faces are culled for back faces, and the reverse.",
          {.cull_mode = swap_cull}},
    Fault{"cull-back-always",
          "Where nothing is to be culled, back faces are.",
          {.cull_mode = cull<VK_CULL_MODE_NONE, VK_CULL_MODE_BACK_BIT>}},
    Fault{"cull-both-as-front",
          "Of front and back faces only front faces are culled.",
          {.cull_mode = cull<VK_CULL_MODE_FRONT_AND_BACK, VK_CULL_MODE_FRONT_BIT>}},
    Fault{"front-face-swapped",
          "Front faces wind the other way.",
          {.front_face =
               [](VkFrontFace& f) {
                   return change(f, f == VK_FRONT_FACE_CLOCKWISE ? VK_FRONT_FACE_COUNTER_CLOCKWISE
                                                                 : VK_FRONT_FACE_CLOCKWISE);
               }}},
    Fault{
        "front-face-ignored",
        "Front faces are always the counter-clockwise ones.",
        {.front_face = [](VkFrontFace& f) { return change(f, VK_FRONT_FACE_COUNTER_CLOCKWISE); }}},
    Fault{
        "strip-as-list",
        "A triangle strip is drawn as a list.",
        {.topology =
             topology<VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST>}},
    Fault{
        "list-as-strip",
        "A triangle list is drawn as a strip.",
        {.topology =
             topology<VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP>}},
    Fault{"fan-as-strip",
          "A triangle fan is drawn as a strip.",
          {.topology =
               topology<VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP>}},
    Fault{"discard-ignored",
          "Rasterizer discard is off.",
          {.rasterizer_discard = [](VkBool32& d) { return change(d, VK_FALSE); }}},
    Fault{"restart-ignored",
          "Primitive restart is off.",
          {.primitive_restart = [](VkBool32& r) { return change(r, VK_FALSE); }}},
    Fault{"index-16-bits",
          "Indices of 32 bits are read as indices of 16 bits.",
          {.index_type = [](VkIndexType& t) { return change(t, VK_INDEX_TYPE_UINT16); }}},
    Fault{"provoking-first",
          "The first vertex provokes where the last one should.",
          {.pipeline = first_provokes}},
    Fault{"provoking-last",
          "The last vertex provokes where the first one should.",
          {.pipeline = last_provokes}},
    Fault{"position-w-one",
          "The w of positions is read as 1.",
          {.pipeline =
               [](PipelineCopy& p) { return read_fewer(p, true, VK_FORMAT_R32G32B32_SFLOAT); }}},
    Fault{
        "position-z-zero",
        "The z of positions is read as 0, w as 1.",
        {.pipeline = [](PipelineCopy& p) { return read_fewer(p, true, VK_FORMAT_R32G32_SFLOAT); }}},
    Fault{"attributes-w-one",
          "The fourth component of vertex attributes is read as 1.",
          {.pipeline =
               [](PipelineCopy& p) { return read_fewer(p, false, VK_FORMAT_R32G32B32_SFLOAT); }}},
    Fault{"attributes-swapped",
          "The first two vertex attributes are swapped.",
          {.pipeline = swap_first_attributes}},
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
          "The rasterizer discards everything.",
          {.rasterizer_discard = [](VkBool32& d) { return change(d, VK_TRUE); }}},
};

}  // namespace

std::span<const Fault> assembly_faults() {
    return kAssemblyFaults;
}

}  // namespace breaking
