// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Cases that copy and scale an image instead of drawing triangles: glBlitFramebuffer, whose
// rectangles count rows as they lie in memory, as vkCmdBlitImage does.
#pragma once

#include <bit>
#include <vector>

#include "targets.hpp"

// A texture that holds exactly these codes, red first.
inline GLuint texture_of_codes(const Json& source) {
    const ColorFormat& format = *color_format_of(source["format"]);
    std::vector<GLfloat> floats;
    std::vector<GLushort> halves;
    std::vector<GLuint> wholes;
    for (const Json& texel : source["codes"]) {
        for (size_t k = 0; k < 4; ++k) {
            const auto code = texel[k].get<GLuint>();
            const double most = std::max(std::ldexp(1, format.bits[k]) - 1, 1.0);
            // Of UNORM and sRGB the code as a fraction: to the nearest code it is that one again.
            floats.push_back(format.codes == Codes::bits ? std::bit_cast<GLfloat>(code)
                                                         : static_cast<GLfloat>(code / most));
            halves.push_back(static_cast<GLushort>(code));
            wholes.push_back(code);
        }
    }
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    const GLsizei width = source["width"], height = source["height"];
    glTexStorage2D(GL_TEXTURE_2D, 1, format.internal, width, height);
    const auto put = [&](GLenum layout, GLenum type, const void* texels) {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, layout, type, texels);
    };
    if (format.codes == Codes::whole) {
        put(GL_RGBA_INTEGER, GL_UNSIGNED_INT, wholes.data());
    } else if (format.codes == Codes::half) {
        put(GL_RGBA, GL_HALF_FLOAT, halves.data());
    } else {
        put(GL_RGBA, GL_FLOAT, floats.data());
    }
    return texture;
}

// Into attachment `output` of the bound framebuffer.
inline void draw_blit(const Json& blit, GLuint output) {
    GLuint from = 0, texture = texture_of_codes(blit["source"]);
    glGenFramebuffers(1, &from);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    glFramebufferTexture(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture, 0);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    const GLenum to = GL_COLOR_ATTACHMENT0 + output;
    glDrawBuffers(1, &to);
    const Json &s = blit["source_region"], &d = blit["destination_region"];
    glBlitFramebuffer(s["x0"], s["y0"], s["x1"], s["y1"], d["x0"], d["y0"], d["x1"], d["y1"],
                      GL_COLOR_BUFFER_BIT, blit["filter"] == "nearest" ? GL_NEAREST : GL_LINEAR);
    glDeleteFramebuffers(1, &from);
    glDeleteTextures(1, &texture);
}
