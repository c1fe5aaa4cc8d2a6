// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The state of one draw, from the words of a case file.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "targets.hpp"

inline void enable(GLenum what, bool on) {
    if (on) {
        glEnable(what);
    } else {
        glDisable(what);
    }
}

inline GLenum compare_op(const Json& word) {
    static const std::map<std::string, GLenum> ops = {{"never", GL_NEVER},
                                                      {"less", GL_LESS},
                                                      {"equal", GL_EQUAL},
                                                      {"less-or-equal", GL_LEQUAL},
                                                      {"greater", GL_GREATER},
                                                      {"not-equal", GL_NOTEQUAL},
                                                      {"greater-or-equal", GL_GEQUAL},
                                                      {"always", GL_ALWAYS}};
    return ops.at(word);
}

inline GLenum stencil_op(const Json& word) {
    static const std::map<std::string, GLenum> ops = {{"keep", GL_KEEP},
                                                      {"zero", GL_ZERO},
                                                      {"replace", GL_REPLACE},
                                                      {"increment-clamp", GL_INCR},
                                                      {"decrement-clamp", GL_DECR},
                                                      {"invert", GL_INVERT},
                                                      {"increment-wrap", GL_INCR_WRAP},
                                                      {"decrement-wrap", GL_DECR_WRAP}};
    return ops.at(word);
}

inline GLenum blend_factor(const Json& word) {
    static const std::map<std::string, GLenum> factors = {
        {"zero", GL_ZERO},
        {"one", GL_ONE},
        {"src-color", GL_SRC_COLOR},
        {"one-minus-src-color", GL_ONE_MINUS_SRC_COLOR},
        {"dst-color", GL_DST_COLOR},
        {"one-minus-dst-color", GL_ONE_MINUS_DST_COLOR},
        {"src-alpha", GL_SRC_ALPHA},
        {"one-minus-src-alpha", GL_ONE_MINUS_SRC_ALPHA},
        {"dst-alpha", GL_DST_ALPHA},
        {"one-minus-dst-alpha", GL_ONE_MINUS_DST_ALPHA},
        {"constant-color", GL_CONSTANT_COLOR},
        {"one-minus-constant-color", GL_ONE_MINUS_CONSTANT_COLOR},
        {"constant-alpha", GL_CONSTANT_ALPHA},
        {"one-minus-constant-alpha", GL_ONE_MINUS_CONSTANT_ALPHA},
        {"src-alpha-saturate", GL_SRC_ALPHA_SATURATE}};
    return factors.at(word);
}

inline GLenum blend_op(const Json& word) {
    static const std::map<std::string, GLenum> ops = {
        {"add", GL_FUNC_ADD},
        {"subtract", GL_FUNC_SUBTRACT},
        {"reverse-subtract", GL_FUNC_REVERSE_SUBTRACT},
        {"min", GL_MIN},
        {"max", GL_MAX}};
    return ops.at(word);
}

inline GLenum logic_op(const Json& word) {
    static const std::map<std::string, GLenum> ops = {{"clear", GL_CLEAR},
                                                      {"and", GL_AND},
                                                      {"and-reverse", GL_AND_REVERSE},
                                                      {"copy", GL_COPY},
                                                      {"and-inverted", GL_AND_INVERTED},
                                                      {"no-op", GL_NOOP},
                                                      {"xor", GL_XOR},
                                                      {"or", GL_OR},
                                                      {"nor", GL_NOR},
                                                      {"equivalent", GL_EQUIV},
                                                      {"invert", GL_INVERT},
                                                      {"or-reverse", GL_OR_REVERSE},
                                                      {"copy-inverted", GL_COPY_INVERTED},
                                                      {"or-inverted", GL_OR_INVERTED},
                                                      {"nand", GL_NAND},
                                                      {"set", GL_SET}};
    return ops.at(word);
}

inline void set_viewport(const Json& draw) {
    const Json &viewport = draw["viewport"], &scissor = draw["scissor"];
    const GLuint index = draw["viewport_index"];
    const float height = number(viewport["height"]);
    const float top = number(viewport["y"]) + std::min(height, 0.0F);
    glViewportIndexedf(index, number(viewport["x"]), top, number(viewport["width"]),
                       std::fabs(height));
    glDepthRangeIndexed(index, static_cast<double>(number(viewport["min_depth"])),
                        static_cast<double>(number(viewport["max_depth"])));
    glEnablei(GL_SCISSOR_TEST, index);
    glScissorIndexed(index, scissor["x"], scissor["y"], scissor["width"], scissor["height"]);
    glClipControl(GL_LOWER_LEFT, draw["depth"]["volume"] == "zero-to-one" ? GL_ZERO_TO_ONE
                                                                          : GL_NEGATIVE_ONE_TO_ONE);
}

inline void set_faces(const Json& draw) {
    // As seen with y upwards (targets.hpp).
    glFrontFace(draw["front_face"] == "clockwise" ? GL_CCW : GL_CW);
    enable(GL_CULL_FACE, draw["cull"] != "none");
    glCullFace(draw["cull"] == "front"  ? GL_FRONT
               : draw["cull"] == "back" ? GL_BACK
                                        : GL_FRONT_AND_BACK);
    glProvokingVertex(draw["provoking_vertex"] == "first" ? GL_FIRST_VERTEX_CONVENTION
                                                          : GL_LAST_VERTEX_CONVENTION);
    enable(GL_RASTERIZER_DISCARD, draw["rasterizer_discard"]);
    for (GLenum k = 0; k < 4; ++k) {
        enable(GL_CLIP_DISTANCE0 + k, k < draw["clip_distances"]["count"]);
    }
}

inline void set_depth_and_stencil(const Context& gl, const Json& draw, bool has_depth) {
    const Json& depth = draw["depth"];
    enable(GL_DEPTH_TEST, has_depth);
    glDepthFunc(compare_op(depth["compare"]));
    glDepthMask(depth["write"] ? GL_TRUE : GL_FALSE);
    enable(GL_DEPTH_CLAMP, depth["clamp"]);  // and no clipping: another choice is left out
    const Json& bias = depth["bias"];
    enable(GL_POLYGON_OFFSET_FILL, !bias.is_null());
    if (!bias.is_null()) {
        const float slope = number(bias["slope"]), constant = number(bias["constant"]);
        if (const float clamp = number(bias["clamp"]); !is_zero(clamp)) {
            extension_function<PFNGLPOLYGONOFFSETCLAMPPROC>("glPolygonOffsetClamp")(slope, constant,
                                                                                    clamp);
        } else {
            glPolygonOffset(slope, constant);
        }
    }
    if (gl.has("GL_EXT_depth_bounds_test")) {
        const Json& bounds = depth["bounds"];
        enable(GL_DEPTH_BOUNDS_TEST_EXT, !bounds.is_null());
        if (!bounds.is_null()) {
            extension_function<PFNGLDEPTHBOUNDSEXTPROC>("glDepthBoundsEXT")(
                static_cast<double>(number(bounds["min"])),
                static_cast<double>(number(bounds["max"])));
        }
    }
    const Json& stencil = draw["stencil"];
    enable(GL_STENCIL_TEST, !stencil.is_null());
    for (const auto& [face, name] :
         std::map<std::string, GLenum>{{"front", GL_FRONT}, {"back", GL_BACK}}) {
        if (!stencil.is_null()) {
            const Json& s = stencil[face];
            glStencilFuncSeparate(name, compare_op(s["compare"]), s["reference"],
                                  s["compare_mask"]);
            glStencilMaskSeparate(name, s["write_mask"]);
            glStencilOpSeparate(name, stencil_op(s["fail"]), stencil_op(s["depth_fail"]),
                                stencil_op(s["pass"]));
        }
    }
}

inline void set_samples(const Json& draw, bool can_shade) {
    const Json& multisample = draw["multisample"];
    glEnable(GL_SAMPLE_MASK);
    glSampleMaski(0, multisample["sample_mask"]);
    if (can_shade) {
        const Json& least = multisample["min_sample_shading"];
        enable(GL_SAMPLE_SHADING, !least.is_null());
        glMinSampleShading(least.is_null() ? 0 : number(least));
    }
}

// Outputs are masked by which of the two passes it is: logical operations switch blending off for
// all attachments, so that the colour of such cases is drawn by itself.
inline void set_outputs(const Json& draw, GLuint color_at, bool has_color, bool instruments,
                        bool color) {
    for (GLuint k = 0; k < color_at; ++k) {
        const GLboolean on = instruments ? GL_TRUE : GL_FALSE;
        glColorMaski(k, on, on, on, on);
        glDisablei(GL_BLEND, k);
    }
    glEnablei(GL_BLEND, kHits);
    glBlendEquationi(kHits, GL_FUNC_ADD);
    glBlendFunci(kHits, GL_ONE, GL_ONE);
    glDisable(GL_COLOR_LOGIC_OP);
    if (!has_color) {
        return;
    }
    const Json& output = draw["color"];
    const unsigned mask = color ? output["write_mask"].get<unsigned>() : 0;
    const auto writes = [mask](unsigned bit) -> GLboolean {
        return (mask >> bit & 1) != 0 ? GL_TRUE : GL_FALSE;
    };
    glColorMaski(color_at, writes(0), writes(1), writes(2), writes(3));
    glDisablei(GL_BLEND, color_at);
    if (const Json& blend = output["blend"]; !blend.is_null()) {
        const Json &rgb = blend["color"], &alpha = blend["alpha"], &c = blend["constants"];
        glEnablei(GL_BLEND, color_at);
        glBlendFuncSeparatei(color_at, blend_factor(rgb["source"]),
                             blend_factor(rgb["destination"]), blend_factor(alpha["source"]),
                             blend_factor(alpha["destination"]));
        glBlendEquationSeparatei(color_at, blend_op(rgb["op"]), blend_op(alpha["op"]));
        glBlendColor(number(c[0]), number(c[1]), number(c[2]), number(c[3]));
    }
    if (const Json& logic = output["logic"]; !logic.is_null() && !instruments) {
        glEnable(GL_COLOR_LOGIC_OP);
        glLogicOp(logic_op(logic));
    }
}

// Everything that an earlier draw may have set and clears obey.
inline void reset_state() {
    for (GLuint k = 0; k < 16; ++k) {
        glDisablei(GL_SCISSOR_TEST, k);
    }
    for (GLuint k = 0; k < 8; ++k) {
        glColorMaski(k, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    glDepthMask(GL_TRUE);
    glStencilMask(0xff);
    glDisable(GL_RASTERIZER_DISCARD);
    glDisable(GL_SAMPLE_MASK);
    // Stored colours are encoded if the format is sRGB, and only then.
    glEnable(GL_FRAMEBUFFER_SRGB);
}
