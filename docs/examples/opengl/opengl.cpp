// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws exported cases with OpenGL, for 'edgecase diff'.
//
//     c++ -std=c++20 -O2 -o opengl opengl.cpp -lEGL -lOpenGL
//     usage: opengl EXPORT CAPTURES [--no-primitive-id] [--half-pixel]
//
// (Debian: libegl-dev, libopengl-dev, nlohmann-json3-dev; to run it libegl-mesa0 and
// libgl1-mesa-dri.) It needs no window and no screen. A case goes into a framebuffer object with
// one attachment for each question that 'edgecase diff' asks (shaders.hpp), of which each file is
// one plane:
//     hits        by front and by back faces, counted by blending
//     writer      number of the draw and gl_PrimitiveID
//     attribute0  ... what the fragment shader got of each attribute
//     fragcoord   gl_FragCoord
//     depth       the depth attachment
//     color       the colour attachment, as it is stored
// Nothing of a drawn case is left out but 24-bit depths of several samples (targets.hpp) and what
// the exchange has no plane for: stencils, and what samples are resolved to. --no-primitive-id is
// for drivers whose gl_PrimitiveID is broken: triangles are numbered by their provoking vertices
// instead, and cases where two have the same one come without the plane writer. --half-pixel moves
// all viewports by half a pixel, so that something is wrong. The last lines tell how many cases
// were drawn, and for which reasons others were not.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "blit.hpp"
#include "context.hpp"
#include "limits.hpp"
#include "shaders.hpp"
#include "state.hpp"
#include "targets.hpp"

static_assert(std::endian::native == std::endian::little, "raw planes are little endian");
namespace fs = std::filesystem;

Json read_json(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) {
        fail("'" + file.string() + "' cannot be read; name a folder that 'edgecase export' wrote");
    }
    return Json::parse(stream);
}

template <class T>
void write_plane(const fs::path& file, const std::vector<T>& plane) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(plane.data()),
               static_cast<std::streamsize>(plane.size() * sizeof(T)));
}

// The first `channels` of the four numbers of each sample.
std::vector<float> first_channels(const std::vector<float>& from, size_t channels) {
    std::vector<float> to;
    for (size_t k = 0; k < from.size(); ++k) {
        if (k % 4 < channels) {
            to.push_back(from[k]);
        }
    }
    return to;
}

// Draws and provoking vertices -> draws and triangles; empty if two triangles of a draw share one.
std::vector<float> triangles_of(const Json& c, std::vector<float> writers) {
    std::vector<std::map<size_t, size_t>> triangles;
    for (const Json& draw : c["draws"]) {
        const std::vector<size_t> provoking = draw["provoking_vertices"];
        triangles.emplace_back();
        for (size_t k = 0; k < provoking.size(); ++k) {
            if (!triangles.back().emplace(provoking[k], k).second) {
                return {};
            }
        }
    }
    for (size_t k = 0; k < writers.size(); k += 2) {
        if (writers[k] >= 0) {
            // Of a vertex that is none of these, a number that no triangle has.
            const auto& of_draw = triangles.at(static_cast<size_t>(writers[k]));
            const auto found = of_draw.find(static_cast<size_t>(writers[k + 1]));
            writers[k + 1] = found == of_draw.end() ? 0xffffff : static_cast<float>(found->second);
        }
    }
    return writers;
}

// Vertex input `location`: one vector a vertex.
GLuint vertex_input(GLuint location, const Json& vectors) {
    std::vector<GLfloat> values;
    for (const Json& vector : vectors) {
        for (size_t k = 0; k < 4; ++k) {
            values.push_back(k < vector.size() ? number(vector[k]) : 0);
        }
    }
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size() * sizeof(GLfloat)),
                 values.data(), GL_STATIC_DRAW);
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
    return buffer;
}

// A texture of which only the size counts: textureQueryLod asks for no texel.
GLuint lod_texture(GLuint unit, const Json& size) {
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, texture);
    const GLsizei width = size[0], height = size[1];
    glTexStorage2D(
        GL_TEXTURE_2D,
        static_cast<GLsizei>(std::bit_width(static_cast<unsigned>(std::max(width, height)))), GL_R8,
        width, height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glActiveTexture(GL_TEXTURE0);
    return texture;
}

void set_uniforms(GLuint program, const Json& draw, size_t draw_number, bool is_uint,
                  std::vector<GLuint>& textures) {
    const auto at = [program](const std::string& name) {
        return glGetUniformLocation(program, name.c_str());
    };
    glUniform1f(at("draw_number"), static_cast<GLfloat>(draw_number));
    for (size_t a = 0; a < draw["attributes"].size(); ++a) {
        const Json& attribute = draw["attributes"][a];
        const std::string k = std::to_string(a);
        if (attribute.contains("probe_sample")) {
            glUniform1i(at("probe_sample" + k), attribute["probe_sample"]);
        }
        if (attribute.contains("probe_offset")) {
            const Json& offset = attribute["probe_offset"];
            glUniform2f(at("probe_offset" + k), number(offset[0]), number(offset[1]));
        }
        if (attribute.contains("texture_size")) {
            textures.push_back(lod_texture(static_cast<GLuint>(1 + a), attribute["texture_size"]));
            glUniform1i(at("lod_texture" + k), static_cast<GLint>(1 + a));
        }
    }
    if (const Json& color = draw["color"]; !color.is_null()) {
        const Json& v = color["value"];
        if (is_uint) {
            glUniform4ui(at("color_value"), v[0], v[1], v[2], v[3]);
        } else {
            glUniform4f(at("color_value"), number(v[0]), number(v[1]), number(v[2]), number(v[3]));
        }
    }
    if (const Json& depth = draw["frag_depth"]; !depth.is_null()) {
        glUniform1f(at("depth_value"), number(depth["value"]));
        glUniform1f(at("other_depth"), number(depth["other"]));
    }
    if (const Json& mask = draw["multisample"]["shader_mask"]; !mask.is_null()) {
        glUniform1i(at("shader_mask"), static_cast<GLint>(mask.get<GLuint>()));
    }
}

struct Options {
    bool primitive_id = true, half_pixel = false;
};

void draw_one(const Context& gl, const Json& c, size_t draw_number, size_t attributes,
              bool instruments, bool color, const Options& options) {
    const Json &draw = c["draws"][draw_number], &target = c["target"];
    const ColorFormat* format = color_format(target);
    const bool is_uint = format != nullptr && format->codes == Codes::whole;
    set_viewport(draw);
    set_faces(draw);
    set_depth_and_stencil(gl, draw, !target["depth"].is_null());
    set_samples(draw, gl.has("GL_ARB_sample_shading"));
    set_outputs(draw, color_location(attributes), format != nullptr, instruments, color);
    const std::string id = options.primitive_id ? "gl_PrimitiveID" : "vertex";
    const GLuint program =
        link({compile(GL_VERTEX_SHADER, vertex_shader(gl, draw)),
              compile(GL_FRAGMENT_SHADER,
                      fragment_shader(gl, draw, attributes, format != nullptr, is_uint, id))});
    glUseProgram(program);
    std::vector<GLuint> textures;
    set_uniforms(program, draw, draw_number, is_uint, textures);
    GLuint vertices = 0;
    glGenVertexArrays(1, &vertices);
    glBindVertexArray(vertices);
    std::vector<GLuint> buffers = {vertex_input(0, draw["positions"])};
    for (size_t a = 0; a < draw["attributes"].size(); ++a) {
        if (draw["attributes"][a].contains("values")) {
            buffers.push_back(
                vertex_input(static_cast<GLuint>(1 + a), draw["attributes"][a]["values"]));
        }
    }
    if (draw["clip_distances"]["count"] > 0) {
        buffers.push_back(vertex_input(5, draw["clip_distances"]["values"]));
    }
    if (draw["cull_distances"]["count"] > 0) {
        buffers.push_back(vertex_input(6, draw["cull_distances"]["values"]));
    }
    const GLenum topology = draw["topology"] == "triangle-list"    ? GL_TRIANGLES
                            : draw["topology"] == "triangle-strip" ? GL_TRIANGLE_STRIP
                                                                   : GL_TRIANGLE_FAN;
    enable(GL_PRIMITIVE_RESTART, draw["primitive_restart"]);
    glPrimitiveRestartIndex(0xffffffffU);
    if (draw["indices"].is_null()) {
        glDrawArrays(topology, 0, static_cast<GLsizei>(draw["positions"].size()));
    } else {
        const std::vector<GLuint> indices = draw["indices"];
        GLuint buffer = 0;
        glGenBuffers(1, &buffer);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                     static_cast<GLsizeiptr>(indices.size() * sizeof(GLuint)), indices.data(),
                     GL_STATIC_DRAW);
        glDrawElements(topology, static_cast<GLsizei>(indices.size()), GL_UNSIGNED_INT, nullptr);
        buffers.push_back(buffer);
    }
    glDeleteVertexArrays(1, &vertices);
    glDeleteBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
    glDeleteTextures(static_cast<GLsizei>(textures.size()), textures.data());
    glDeleteProgram(program);
}

// Writes the planes; or why it does not, which is returned.
std::string draw_case(const Context& gl, Json c, const fs::path& folder, const Options& options) {
    std::map<std::string, size_t> channels;
    size_t attributes = 0;
    GLfloat clear = 0;
    for (const Json& plane : c["captures"]["planes"]) {
        const std::string name = plane["name"];
        channels[name] = plane["channels"].size();
        attributes += name.starts_with("attribute") ? 1U : 0U;
        clear = name == "fragcoord" ? number(plane["clear"]) : clear;
    }
    const Json& target = c["target"];
    const Targets targets(gl, target, attributes, clear);
    if (std::string reason = targets.refusal(); !reason.empty()) {
        return reason;
    }
    if (!c["blit"].is_null()) {
        reset_state();
        targets.clear();
        draw_blit(c["blit"], color_location(attributes));
        write_plane(folder / "color.u32", targets.read_color());
        return {};
    }
    bool has_logic = false;
    for (Json& draw : c["draws"]) {
        has_logic = has_logic || (!draw["color"].is_null() && !draw["color"]["logic"].is_null());
        if (options.half_pixel) {
            draw["viewport"]["x"] = number(draw["viewport"]["x"]) + 0.5F;
        }
    }
    const auto pass = [&](bool instruments, bool color) {
        for (size_t k = 0; k < c["draws"].size(); ++k) {
            draw_one(gl, c, k, attributes, instruments, color, options);
        }
    };
    reset_state();
    targets.clear();
    pass(true, !has_logic);
    if (has_logic) {
        // Depth and stencil begin anew, so that the same fragments pass.
        reset_state();
        targets.clear_depth();
        pass(false, true);
    }
    reset_state();
    write_plane(folder / "hits.f32", first_channels(targets.read(kHits), 2));
    std::vector<float> writers = first_channels(targets.read(kWriter), 2);
    if (!options.primitive_id) {
        writers = triangles_of(c, std::move(writers));
    }
    if (!writers.empty()) {
        write_plane(folder / "writer.f32", writers);
    }
    write_plane(folder / "fragcoord.f32", targets.read(kFragCoord));
    for (size_t a = 0; a < attributes; ++a) {
        const std::string name = "attribute" + std::to_string(a);
        write_plane(
            folder / (name + ".f32"),
            first_channels(targets.read(kAttributes + static_cast<GLuint>(a)), channels.at(name)));
    }
    if (channels.contains("depth") && targets.reads_depth_exactly()) {
        write_plane(folder / "depth.f32", targets.read_depth());
    }
    if (channels.contains("color")) {
        write_plane(folder / "color.u32", targets.read_color());
    }
    return {};
}

int run(const fs::path& from, const fs::path& to, const Options& options) {
    const Json index = read_json(from / "index.json");
    const Context gl;
    std::printf("%s, OpenGL %s\n", gl.renderer.c_str(), gl.version.c_str());
    size_t drawn = 0, failed = 0;
    std::map<std::string, size_t> left_out;
    for (const Json& entry : index["cases"]) {
        const fs::path folder = to / entry["folder"].get<std::string>();
        fs::create_directories(folder);
        std::string reason, error;
        try {
            const Json c = read_json(from / entry["file"].get<std::string>());
            reason = refusal(gl, c);
            reason = reason.empty() ? draw_case(gl, c, folder, options) : reason;
        } catch (const std::exception& thrown) {
            error = thrown.what();
        }
        if (const GLenum code = glGetError(); error.empty() && code != GL_NO_ERROR) {
            error = "OpenGL reports error " + std::to_string(code);
        }
        if (!error.empty()) {  // without planes the case is 'not run', never a pass
            std::fprintf(stderr, "error: %s: %s\n", entry["id"].get<std::string>().c_str(),
                         error.c_str());
            fs::remove_all(folder);
            ++failed;
        } else if (!reason.empty()) {
            std::ofstream(folder / "unsupported.txt") << reason << "\n";
            ++left_out[reason];
        } else {
            ++drawn;
        }
    }
    std::printf("%zu cases drawn\n", drawn);
    for (const auto& [reason, count] : left_out) {
        std::printf("%zu left out: %s\n", count, reason.c_str());
    }
    return failed == 0 ? 0 : 1;
}

int main(int argc, char** argv) {
    Options options;
    std::vector<std::string> folders;
    bool is_usage = false;
    for (int k = 1; k < argc; ++k) {
        const std::string word = argv[k];
        options.primitive_id = options.primitive_id && word != "--no-primitive-id";
        options.half_pixel = options.half_pixel || word == "--half-pixel";
        if (!word.starts_with("--")) {
            folders.push_back(word);
        } else if (word != "--no-primitive-id" && word != "--half-pixel") {
            is_usage = true;
        }
    }
    if (is_usage || folders.size() != 2) {
        std::fputs("usage: opengl EXPORT CAPTURES [--no-primitive-id] [--half-pixel]\n", stderr);
        return 2;
    }
    try {
        return run(folders[0], folders[1], options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
}
