// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes its inputs to a buffer by transform feedback, one behind the other. Defined by the build: ATTRIBUTES (0..4).
#version 450

layout(xfb_buffer = 0, xfb_stride = 16 * (1 + ATTRIBUTES)) out;

layout(xfb_buffer = 0, xfb_offset = 0) out gl_PerVertex {
    vec4 gl_Position;
};

layout(location = 0) in vec4 in_position;
#if ATTRIBUTES > 0
layout(location = 1) in vec4 in_attribute0;
layout(location = 1, xfb_buffer = 0, xfb_offset = 16) out vec4 out_attribute0;
#endif
#if ATTRIBUTES > 1
layout(location = 2) in vec4 in_attribute1;
layout(location = 2, xfb_buffer = 0, xfb_offset = 32) out vec4 out_attribute1;
#endif
#if ATTRIBUTES > 2
layout(location = 3) in vec4 in_attribute2;
layout(location = 3, xfb_buffer = 0, xfb_offset = 48) out vec4 out_attribute2;
#endif
#if ATTRIBUTES > 3
layout(location = 4) in vec4 in_attribute3;
layout(location = 4, xfb_buffer = 0, xfb_offset = 64) out vec4 out_attribute3;
#endif

void main() {
    gl_Position = in_position;
#if ATTRIBUTES > 0
    out_attribute0 = in_attribute0;
#endif
#if ATTRIBUTES > 1
    out_attribute1 = in_attribute1;
#endif
#if ATTRIBUTES > 2
    out_attribute2 = in_attribute2;
#endif
#if ATTRIBUTES > 3
    out_attribute3 = in_attribute3;
#endif
}
