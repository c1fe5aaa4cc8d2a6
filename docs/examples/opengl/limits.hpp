// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What OpenGL, or this driver of it, cannot say.
#pragma once

#include <map>
#include <string>

#include "targets.hpp"

inline std::string draw_refusal(const Json& draw, GLint samples) {
    const Json& depth = draw["depth"];
    if (depth["clamp"] == depth["clip"]) {
        return "GL_DEPTH_CLAMP chooses clamping and clipping together";
    }
    // Multisample fragment operations are none where a framebuffer has no sample buffers.
    const Json &mask = draw["multisample"]["sample_mask"],
               &shader_mask = draw["multisample"]["shader_mask"];
    const bool masks = mask.get<unsigned>() % 2 == 0 ||
                       (!shader_mask.is_null() && shader_mask.get<unsigned>() % 2 == 0);
    if (samples == 1 && masks) {
        return "OpenGL ignores sample masks at one sample a pixel";
    }
    return {};
}

// Why the case is left out; empty if it is drawn.
inline std::string refusal(const Context& gl, const Json& c) {
    static const std::map<std::string, std::string> never = {
        {"barycentrics", "OpenGL has no barycentric coordinates"},
        {"clear", "this program clears before all draws alone"},
        {"instances", "this program draws one instance"},
        {"alpha-to-coverage", "this program does not turn it on"},
        {"alpha-to-one", "OpenGL has it with several samples alone"},
        {"conservative-rasterization", "OpenGL has no conservative rasterization"},
        {"fragment-size", "this program has fragments of one pixel"},
        {"dual-source-blend", "this program writes one source of colour"},
        {"depth-bias-control", "OpenGL has no other representation of depth bias"}};
    static const std::map<std::string, std::string> extensions = {
        {"layers", "GL_AMD_vertex_shader_layer"},
        {"viewport-index", "GL_AMD_vertex_shader_viewport_index"},
        {"depth-bounds", "GL_EXT_depth_bounds_test"},
        {"sample-shading", "GL_ARB_sample_shading"},
        {"sample-inputs", "GL_ARB_sample_shading"},
        {"auxiliary", "GL_ARB_gpu_shader5"},
        {"interpolate-at", "GL_ARB_gpu_shader5"},
        {"derivatives", "GL_ARB_derivative_control"},
        {"query-lod", "GL_ARB_texture_query_lod"},
        {"cull-distance", "GL_ARB_cull_distance"},
        {"frag-depth", "GL_ARB_conservative_depth"},
        {"early-tests", "GL_ARB_shader_image_load_store"}};
    for (const std::string need : c["needs"]) {
        if (const auto found = never.find(need); found != never.end()) {
            return found->second;
        }
        const auto found = extensions.find(need);
        if (found != extensions.end() && !gl.has(found->second)) {
            return "the driver lacks " + found->second;
        }
    }
    const Json& target = c["target"];
    const GLint samples = target["samples"];
    if (samples > 1 && !gl.is_45) {
        return "the driver has one sample a pixel";
    }
    if (samples > Context::number(GL_MAX_SAMPLES)) {
        return "the driver has at most " + std::to_string(Context::number(GL_MAX_SAMPLES)) +
               " samples a pixel";
    }
    const Json& blit = c["blit"];
    if ((!target["color"].is_null() && color_format(target) == nullptr) ||
        (!blit.is_null() && color_format_of(blit["source"]["format"]) == nullptr)) {
        return "this program does not know the colour format";
    }
    if (depth_format(target) == 0 && !target["depth"].is_null()) {
        return "OpenGL has no 16-bit depth beside a stencil";
    }
    for (const Json& draw : c["draws"]) {
        if (const std::string reason = draw_refusal(draw, samples); !reason.empty()) {
            return reason;
        }
        const Json& bias = draw["depth"]["bias"];
        if (!bias.is_null() && !is_zero(number(bias["clamp"])) &&
            !gl.has("GL_ARB_polygon_offset_clamp")) {
            return "the driver lacks GL_ARB_polygon_offset_clamp";
        }
    }
    return {};
}
