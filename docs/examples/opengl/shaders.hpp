// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// GLSL of one draw. The vertex shader hands on what the case says, without arithmetic; the fragment
// shader writes what 'edgecase diff' asks about each fragment. No store and no atomic: OpenGL may
// run a shader for helper and repeated fragments, and only what blending and tests let through
// counts.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "context.hpp"

using Json = nlohmann::json;

// Numbers of the attachments, which are the locations of the fragment shader's outputs.
constexpr GLuint kWriter = 0, kHits = 1, kFragCoord = 2, kAttributes = 3;
inline GLuint color_location(size_t attributes) {
    return kAttributes + static_cast<GLuint>(attributes);
}

inline std::string glsl_header(const Context& gl) {
    std::string text = gl.is_45 ? "#version 450 core\n" : "#version 330 core\n";
    // Unknown ones are warnings; a case that needs one has been left out then (limits.hpp).
    for (const char* extension :
         {"ARB_explicit_attrib_location", "ARB_gpu_shader5", "ARB_sample_shading",
          "ARB_cull_distance", "ARB_texture_query_lod", "ARB_derivative_control",
          "ARB_conservative_depth", "ARB_shader_image_load_store", "AMD_vertex_shader_layer",
          "AMD_vertex_shader_viewport_index"}) {
        if (gl.has(std::string("GL_") + extension)) {
            text += std::string("#extension GL_") + extension + " : enable\n";
        }
    }
    return text + "#if __VERSION__ < 400\n#define textureQueryLod textureQueryLOD\n#endif\n";
}

// "smooth centroid", "flat", ...: of an attribute that comes from vertices.
inline std::string qualifiers(const Json& attribute) {
    const std::string auxiliary = attribute["auxiliary"];
    return attribute["interpolation"].get<std::string>() +
           (auxiliary == "none" ? "" : " " + auxiliary);
}

inline std::string vertex_shader(const Context& gl, const Json& draw) {
    std::string head = glsl_header(gl) +
                       "layout(location = 0) in vec4 position;\nflat out int vertex;\n",
                body = "vertex = gl_VertexID;\n";
    // A viewport of negative height turns y around; OpenGL's has none.
    body += draw["viewport"]["height"] < 0
                ? "gl_Position = vec4(position.x, -position.y, position.zw);\n"
                : "gl_Position = position;\n";
    for (size_t a = 0; a < draw["attributes"].size(); ++a) {
        const std::string k = std::to_string(a);
        head += "layout(location = " + std::to_string(1 + a) + ") in vec4 value" + k + ";\n" +
                qualifiers(draw["attributes"][a]) + " out vec4 attribute" + k + ";\n";
        body += "attribute" + k + " = value" + k + ";\n";
    }
    GLuint location = 5;
    for (const auto& [member, built_in] : std::map<std::string, std::string>{
             {"clip_distances", "gl_ClipDistance"}, {"cull_distances", "gl_CullDistance"}}) {
        const size_t count = draw[member]["count"];
        if (count > 0) {
            head += "layout(location = " + std::to_string(location) + ") in vec4 " + member +
                    ";\nout float " + built_in + "[" + std::to_string(count) + "];\n";
        }
        for (size_t k = 0; k < count; ++k) {
            const std::string at = "[" + std::to_string(k) + "]";
            body += built_in + at + " = " + member + at + ";\n";
        }
        ++location;
    }
    if (draw["layer"] > 0) {
        body += "gl_Layer = " + draw["layer"].dump() + ";\n";
    }
    if (draw["viewport_index"] > 0) {
        body += "gl_ViewportIndex = " + draw["viewport_index"].dump() + ";\n";
    }
    return head + "void main() {\n" + body + "}\n";
}

// The expression that goes into the plane of attribute `k`.
inline std::string probe(const Json& attribute, const std::string& k) {
    const std::string source = attribute["source"], probe = attribute["probe"];
    const std::string in = "attribute" + k;
    if (source != "vertex") {
        const std::map<std::string, std::string> built_in = {
            {"sample-mask-in", "vec4(float(gl_SampleMaskIn[0]), 0, 0, 0)"},
            {"sample-id", "vec4(float(gl_SampleID), 0, 0, 0)"},
            {"sample-position", "vec4(gl_SamplePosition, 0, 0)"}};
        return built_in.at(source);
    }
    const std::map<std::string, std::string> functions = {
        {"at-centroid", "interpolateAtCentroid(" + in + ")"},
        {"at-sample", "interpolateAtSample(" + in + ", probe_sample" + k + ")"},
        {"at-offset", "interpolateAtOffset(" + in + ", probe_offset" + k + ")"},
        {"dfdx", "dFdx(" + in + ")"},
        {"dfdy", "dFdy(" + in + ")"},
        {"dfdx-fine", "dFdxFine(" + in + ")"},
        {"dfdy-fine", "dFdyFine(" + in + ")"},
        {"dfdx-coarse", "dFdxCoarse(" + in + ")"},
        {"dfdy-coarse", "dFdyCoarse(" + in + ")"},
        {"fwidth", "fwidth(" + in + ")"},
        {"fwidth-fine", "fwidthFine(" + in + ")"},
        {"fwidth-coarse", "fwidthCoarse(" + in + ")"},
        {"query-lod", "vec4(textureQueryLod(lod_texture" + k + ", " + in + ".xy), 0, 0)"}};
    const auto found = functions.find(probe);
    return found == functions.end() ? in : found->second;
}

// Which fragments "discard" and "frag_depth" mean.
inline std::string picked(const std::string& which) {
    const std::map<std::string, std::string> conditions = {
        {"none", "false"},
        {"odd-columns", "pixel.x % 2 == 1"},
        {"odd-rows", "pixel.y % 2 == 1"},
        {"checker", "(pixel.x + pixel.y) % 2 == 1"},
        {"front", "gl_FrontFacing"},
        {"back", "!gl_FrontFacing"}};
    return conditions.at(which);
}

// `id` is what numbers the triangle: gl_PrimitiveID, or "vertex", the number of its provoking
// vertex.
inline std::string fragment_shader(const Context& gl, const Json& draw, size_t attributes,
                                   bool has_color, bool is_uint, const std::string& id) {
    std::string head = glsl_header(gl), body = "ivec2 pixel = ivec2(gl_FragCoord.xy);\n";
    const auto output = [&](GLuint location, const std::string& name, const char* type = "vec4") {
        head +=
            "layout(location = " + std::to_string(location) + ") out " + type + " " + name + ";\n";
    };
    if (draw["early_tests"]) {
        head += "layout(early_fragment_tests) in;\n";
    }
    head += "uniform float draw_number;\nflat in int vertex;\n";
    output(kWriter, "writer");
    body += "writer = vec4(draw_number, float(" + id + "), 0, 0);\n";
    output(kHits, "hits");
    body += "hits = gl_FrontFacing ? vec4(1, 0, 0, 0) : vec4(0, 1, 0, 0);\n";
    output(kFragCoord, "fragcoord");
    body += "fragcoord = gl_FragCoord;\n";
    for (size_t a = 0; a < draw["attributes"].size(); ++a) {
        const Json& attribute = draw["attributes"][a];
        const std::string k = std::to_string(a);
        head += qualifiers(attribute) + " in vec4 attribute" + k + ";\nuniform int probe_sample" +
                k + ";\nuniform vec2 probe_offset" + k + ";\nuniform sampler2D lod_texture" + k +
                ";\n";
        output(kAttributes + static_cast<GLuint>(a), "result" + k);
        body += "result" + k + " = " + probe(attribute, k) + ";\n";
    }
    if (has_color) {
        const char* type = is_uint ? "uvec4" : "vec4";
        head += std::string("uniform ") + type + " color_value;\n";
        output(color_location(attributes), "color", type);
        const Json& from = draw["color"]["attribute"];
        body += from.is_null()
                    ? std::string("color = color_value;\n")
                    : std::string("color = ") + type + "(attribute" + from.dump() + ");\n";
    }
    if (const Json& depth = draw["frag_depth"]; !depth.is_null()) {
        head += "uniform float depth_value, other_depth;\nlayout(depth_" +
                depth["layout"].get<std::string>() + ") out float gl_FragDepth;\n";
        body += depth["coord"] ? std::string("gl_FragDepth = gl_FragCoord.z;\n")
                               : "gl_FragDepth = " + picked(depth["where"]) +
                                     " ? other_depth : depth_value;\n";
    }
    if (const Json& mask = draw["multisample"]["shader_mask"]; !mask.is_null()) {
        head += "uniform int shader_mask;\n";
        body += "gl_SampleMask[0] = shader_mask;\n";
    }
    if (draw["discard"] != "none") {  // at the end, so that derivatives see every fragment
        const std::string value = "attribute" + draw["discard_attribute"].dump() + ".x";
        body += "if (" +
                (draw["discard"] == "negative" ? value + " < 0.0" : picked(draw["discard"])) +
                ") discard;\n";
    }
    return head + "void main() {\n" + body + "}\n";
}

inline GLuint compile(GLenum kind, const std::string& text) {
    const GLuint shader = glCreateShader(kind);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint done = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done == 0) {
        char log[1000];
        glGetShaderInfoLog(shader, sizeof(log), nullptr, log);
        fail("the driver does not compile a shader: " + std::string(log) + "\n" + text);
    }
    return shader;
}

inline GLuint link(std::initializer_list<GLuint> shaders) {
    const GLuint program = glCreateProgram();
    for (const GLuint shader : shaders) {
        glAttachShader(program, shader);
        glDeleteShader(shader);  // when the program is
    }
    glLinkProgram(program);
    GLint done = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &done);
    if (done == 0) {
        char log[1000];
        glGetProgramInfoLog(program, sizeof(log), nullptr, log);
        fail("the driver does not link a program: " + std::string(log));
    }
    return program;
}
