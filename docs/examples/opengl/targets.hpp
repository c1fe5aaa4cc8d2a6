// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What a case is drawn into, and how it is read back without changing a bit.
//
// Row 0 of a texture is row 0 of a plane. OpenGL calls it the lowest one and Vulkan the uppermost;
// in memory both compute y_f = height/2 * y/w + y_o + height/2, so that nothing is turned around
// here but the words: what is clockwise in a case is counter-clockwise to OpenGL.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "shaders.hpp"

// Codes come back as floats times 2^bits - 1, as halves, or as the 32 bits that they are.
enum class Codes { unorm, half, bits, whole };

struct ColorFormat {
    const char* word;
    GLenum internal;
    Codes codes;
    std::array<GLint, 4> bits;
};

// Null for a format that this program does not know.
inline const ColorFormat* color_format_of(const Json& word) {
    static const std::array<ColorFormat, 12> formats = {
        {{"rgba8-unorm", GL_RGBA8, Codes::unorm, {8, 8, 8, 8}},
         {"bgra8-unorm", GL_RGBA8, Codes::unorm, {8, 8, 8, 8}},  // planes are red first anyway
         {"rgba8-srgb", GL_SRGB8_ALPHA8, Codes::unorm, {8, 8, 8, 8}},
         {"rgb10a2-unorm", GL_RGB10_A2, Codes::unorm, {10, 10, 10, 2}},
         {"r5g6b5-unorm", GL_RGB565, Codes::unorm, {5, 6, 5, 0}},
         {"rgba16-unorm", GL_RGBA16, Codes::unorm, {16, 16, 16, 16}},
         {"rgba16-float", GL_RGBA16F, Codes::half, {16, 16, 16, 16}},
         {"rg16-float", GL_RG16F, Codes::half, {16, 16, 0, 0}},
         {"rgba32-float", GL_RGBA32F, Codes::bits, {32, 32, 32, 32}},
         {"r32-float", GL_R32F, Codes::bits, {32, 0, 0, 0}},
         {"r32-uint", GL_R32UI, Codes::whole, {32, 0, 0, 0}},
         {"rgba8-uint", GL_RGBA8UI, Codes::whole, {8, 8, 8, 8}}}};
    for (const ColorFormat& format : formats) {
        if (word == format.word) {
            return &format;
        }
    }
    return nullptr;
}

// Null without a colour target that is known.
inline const ColorFormat* color_format(const Json& target) {
    return target["color"].is_null() ? nullptr : color_format_of(target["color"]["format"]);
}

// 0 if OpenGL has none.
inline GLenum depth_format(const Json& target) {
    const bool stencil = target["stencil"];
    if (target["depth"].is_null()) {
        return stencil ? GL_DEPTH24_STENCIL8 : 0;
    }
    const std::string format = target["depth"]["format"];
    return format == "d32-float"   ? stencil ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F
           : format == "d24-unorm" ? stencil ? GL_DEPTH24_STENCIL8 : GL_DEPTH_COMPONENT24
           : stencil               ? 0
                                   : GL_DEPTH_COMPONENT16;
}

// A number of a case file, which has words for what JSON lacks.
inline float number(const Json& json) {
    if (!json.is_string()) {
        return json.get<float>();
    }
    return json == "nan" ? NAN : json == "inf" ? INFINITY : -INFINITY;
}

inline bool is_zero(float v) {
    return std::fpclassify(v) == FP_ZERO;
}

class Targets {
  public:
    // `clear`: what the planes of values hold where nothing is drawn.
    Targets(const Context& gl, const Json& target, size_t attributes, GLfloat clear)
        : gl_(gl),
          target_(target),
          width_(target["width"]),
          height_(target["height"]),
          layers_(target["layers"]),
          samples_(target["samples"]),
          color_(color_format(target)),
          color_at_(color_location(attributes)),
          clear_(clear) {
        glGenFramebuffers(1, &framebuffer_);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        for (GLuint k = 0; k < color_at_; ++k) {
            // As floats, which blending counts hits in; numbers of triangles are exact below 2^24.
            attach(GL_COLOR_ATTACHMENT0 + k, GL_RGBA32F);
        }
        if (color_ != nullptr) {
            attach(GL_COLOR_ATTACHMENT0 + color_at_, color_->internal);
        }
        if (const GLenum format = depth_format(target); format != 0) {
            attach(target["stencil"] ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, format);
        }
        std::vector<GLenum> outputs;
        for (GLuint k = 0; k < color_at_ + (color_ != nullptr ? 1U : 0U); ++k) {
            outputs.push_back(GL_COLOR_ATTACHMENT0 + k);
        }
        glDrawBuffers(static_cast<GLsizei>(outputs.size()), outputs.data());
    }
    Targets(const Targets&) = delete;
    Targets& operator=(const Targets&) = delete;
    ~Targets() {
        glDeleteFramebuffers(1, &framebuffer_);
        for (const auto& [attachment, texture] : textures_) {
            glDeleteTextures(1, &texture);
        }
    }

    // Why the case cannot be drawn into what the driver gave; empty if it can.
    std::string refusal() const {
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
            return "the driver does not draw into these formats together";
        }
        if (const GLint samples = Context::number(GL_SAMPLES); std::max(samples, 1) != samples_) {
            return "the driver has " + std::to_string(samples) + " samples instead of " +
                   std::to_string(samples_);
        }
        for (GLint s = 0; s < samples_; ++s) {
            std::array<GLfloat, 2> at = {0.5F, 0.5F};
            if (samples_ > 1) {
                glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(s), at.data());
            }
            const Json& wanted = target_["sample_locations"][static_cast<size_t>(s)];
            if (at[0] != wanted[0] || at[1] != wanted[1]) {
                return "samples lie elsewhere, and OpenGL cannot move them";
            }
        }
        if (color_ != nullptr) {
            const auto texture = textures_.at(GL_COLOR_ATTACHMENT0 + color_at_);
            const std::array<GLenum, 4> names = {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE,
                                                 GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE};
            for (size_t k = 0; k < 4; ++k) {
                if (level_number(texture, names[k]) != color_->bits[k]) {
                    return std::string("the driver stores ") + color_->word + " in another format";
                }
            }
        }
        if (!target_["depth"].is_null()) {
            const std::string format = target_["depth"]["format"];
            const GLint bits = std::stoi(format.substr(1));
            if (level_number(depth_texture(), GL_TEXTURE_DEPTH_SIZE) != bits) {
                return "the driver stores " + format + " in another format";
            }
        }
        return {};
    }

    void clear() const {
        for (GLuint k = 0; k < color_at_; ++k) {
            const GLfloat v = k == kWriter ? -1 : k == kHits ? 0 : clear_;
            const std::array<GLfloat, 4> values = {v, v, v, v};
            glClearBufferfv(GL_COLOR, static_cast<GLint>(k), values.data());
        }
        if (color_ != nullptr) {
            const Json& clear = target_["color"]["clear"];
            const auto at = static_cast<GLint>(color_at_);
            std::array<GLfloat, 4> values{};
            std::array<GLuint, 4> wholes{};
            for (size_t k = 0; k < 4; ++k) {
                values[k] = number(clear[k]);
                wholes[k] = color_->codes == Codes::whole ? clear[k].get<GLuint>() : 0;
            }
            if (color_->codes == Codes::whole) {
                glClearBufferuiv(GL_COLOR, at, wholes.data());
            } else {
                glClearBufferfv(GL_COLOR, at, values.data());
            }
        }
        clear_depth();
    }

    void clear_depth() const {
        const GLfloat depth = target_["depth"].is_null() ? 1 : number(target_["depth"]["clear"]);
        const GLint stencil = target_["stencil_clear"];
        if (target_["stencil"]) {
            glClearBufferfi(GL_DEPTH_STENCIL, 0, depth, stencil);
        } else if (depth_format(target_) != 0) {
            glClearBufferfv(GL_DEPTH, 0, &depth);
        }
    }

    // Four numbers of each sample, in the order of a plane's file.
    std::vector<float> read(GLuint output) const {
        return read_as<float>(textures_.at(GL_COLOR_ATTACHMENT0 + output), GL_RGBA, GL_FLOAT,
                              GL_RGBA32F);
    }
    // Of several samples only a shader reads depths, as binary32. Where a driver multiplies a
    // 24-bit code with 1 / (2^24 - 1) rounded to binary32, the product is two units off (code
    // 6291456 becomes 0.37500006), and the nearest code another one.
    bool reads_depth_exactly() const {
        return samples_ == 1 || target_["depth"]["format"] != "d24-unorm";
    }
    std::vector<float> read_depth() const {
        std::vector<float> depth;
        if (samples_ == 1 && target_["depth"]["format"] == "d24-unorm") {
            // The code in the high bits of 32, which no driver has to compute in binary32.
            for (const uint32_t word : read_as<uint32_t>(depth_texture(), GL_DEPTH_COMPONENT,
                                                         GL_UNSIGNED_INT, GL_RGBA32UI)) {
                depth.push_back(static_cast<float>((word >> 8U) / double{0xffffff}));
            }
            depth.resize(static_cast<size_t>(width_ * height_ * layers_));
            return depth;
        }
        depth = read_as<float>(depth_texture(), samples_ == 1 ? GL_DEPTH_COMPONENT : GL_RGBA,
                               GL_FLOAT, GL_RGBA32F);
        if (samples_ > 1) {  // comes back as a red component
            for (size_t k = 0; k < depth.size() / 4; ++k) {
                depth[k] = depth[4 * k];
            }
        }
        depth.resize(static_cast<size_t>(width_ * height_ * layers_ * samples_));
        return depth;
    }
    std::vector<uint32_t> read_color() const {
        const GLuint texture = textures_.at(GL_COLOR_ATTACHMENT0 + color_at_);
        std::vector<uint32_t> codes;
        if (color_->codes == Codes::whole) {
            codes = read_as<uint32_t>(texture, GL_RGBA_INTEGER, GL_UNSIGNED_INT, GL_RGBA32UI);
        } else if (color_->codes == Codes::half) {
            const auto halves = read_as<uint16_t>(texture, GL_RGBA, GL_HALF_FLOAT, GL_RGBA32F);
            codes.assign(halves.begin(), halves.end());
        } else {
            for (const float v : read_as<float>(texture, GL_RGBA, GL_FLOAT, GL_RGBA32F)) {
                const double most = std::ldexp(1, color_->bits[codes.size() % 4]) - 1;
                codes.push_back(color_->codes == Codes::bits
                                    ? std::bit_cast<uint32_t>(v)
                                    : static_cast<uint32_t>(std::lround(double{v} * most)));
            }
        }
        for (size_t k = 0; k < codes.size(); ++k) {
            codes[k] = color_->bits[k % 4] == 0 ? 0 : codes[k];
        }
        return codes;
    }

  private:
    GLenum kind() const {
        return samples_ > 1 ? GL_TEXTURE_2D_MULTISAMPLE_ARRAY : GL_TEXTURE_2D_ARRAY;
    }

    void attach(GLenum attachment, GLenum format) {
        GLuint texture = 0;
        glGenTextures(1, &texture);
        glBindTexture(kind(), texture);
        if (samples_ > 1) {
            glTexStorage3DMultisample(kind(), samples_, format, width_, height_, layers_, GL_TRUE);
        } else {
            glTexStorage3D(kind(), 1, format, width_, height_, layers_);
        }
        if (layers_ > 1) {
            glFramebufferTexture(GL_FRAMEBUFFER, attachment, texture, 0);
        } else {
            glFramebufferTextureLayer(GL_FRAMEBUFFER, attachment, texture, 0, 0);
        }
        textures_[attachment] = texture;
    }

    GLuint depth_texture() const {
        return textures_.at(target_["stencil"] ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT);
    }

    GLint level_number(GLuint texture, GLenum name) const {
        GLint value = 0;
        glBindTexture(kind(), texture);
        glGetTexLevelParameteriv(kind(), 0, name, &value);
        return value;
    }

    // The texture's numbers as they are stored: of one sample a pixel glGetTexImage has them. Those
    // of several are copied first, a sample after the other, by texelFetch into textures of
    // `copy`'s format: binary32 or 32-bit integers, which hold each of the formats exactly.
    template <class Number>
    std::vector<Number> read_as(GLuint texture, GLenum format, GLenum type, GLenum copy) const {
        const auto entries = static_cast<size_t>(width_ * height_ * layers_);
        std::vector<Number> numbers(4 * entries * static_cast<size_t>(samples_));
        if (samples_ == 1) {
            glBindTexture(kind(), texture);
            glGetTexImage(kind(), 0, format, type, numbers.data());
            return numbers;
        }
        // Of sRGB a shader gets the decoded number, which is another one: a view takes that away.
        GLuint view = texture;
        if (color_ != nullptr && color_->internal == GL_SRGB8_ALPHA8 &&
            texture == textures_.at(GL_COLOR_ATTACHMENT0 + color_at_)) {
            glGenTextures(1, &view);
            glTextureView(view, kind(), texture, GL_RGBA8, 0, 1, 0, static_cast<GLuint>(layers_));
        }
        const GLuint program = copy_program(copy == GL_RGBA32UI);
        GLuint to = 0;
        glGenTextures(1, &to);
        glBindTexture(GL_TEXTURE_2D_ARRAY, to);
        glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, copy, width_, height_, layers_);
        glUseProgram(program);
        glBindTexture(kind(), view);
        glBindImageTexture(0, to, 0, GL_TRUE, 0, GL_WRITE_ONLY, copy);
        for (GLint s = 0; s < samples_; ++s) {
            glUniform1i(glGetUniformLocation(program, "number"), s);
            glDispatchCompute(static_cast<GLuint>(width_), static_cast<GLuint>(height_),
                              static_cast<GLuint>(layers_));
            glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
            glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, format, type,
                          numbers.data() + 4 * entries * static_cast<size_t>(s));
        }
        glDeleteTextures(1, &to);
        if (view != texture) {
            glDeleteTextures(1, &view);
        }
        glDeleteProgram(program);
        return numbers;
    }

    GLuint copy_program(bool is_uint) const {
        const std::string u = is_uint ? "u" : "";
        return link({compile(GL_COMPUTE_SHADER,
                             glsl_header(gl_) + "layout(local_size_x = 1) in;\nuniform " + u +
                                 "sampler2DMSArray from;\nlayout(rgba32" + (is_uint ? "ui" : "f") +
                                 ", binding = 0) writeonly uniform " + u +
                                 "image2DArray to;\nuniform int number;\n"
                                 "void main() {\n"
                                 "ivec3 at = ivec3(gl_GlobalInvocationID);\n"
                                 "imageStore(to, at, texelFetch(from, at, number));\n}\n")});
    }

    const Context& gl_;
    const Json& target_;
    GLint width_, height_, layers_, samples_;
    const ColorFormat* color_;
    GLuint color_at_, framebuffer_ = 0;
    GLfloat clear_;
    std::map<GLenum, GLuint> textures_;
};
