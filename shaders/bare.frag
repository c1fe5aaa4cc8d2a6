// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A fragment shader as applications have them: it writes one colour that it reads, and nothing else. Defined by the
// build: FROM, 1 to 5 as cases::ColorFrom: 1 specialization constants, 2 a uniform buffer, 3 the same with a dynamic
// offset, 4 a storage buffer, 5 a texture, 6 a mask, of which what is transparent is discarded. The layouts are those of
// PipelineLayouts::colored.
#version 450

layout(location = 0) out vec4 out_color;

#if FROM == 1
layout(constant_id = 0) const float kRed = 0.0;
layout(constant_id = 1) const float kGreen = 0.0;
layout(constant_id = 2) const float kBlue = 0.0;
layout(constant_id = 3) const float kAlpha = 0.0;
#define COLOR vec4(kRed, kGreen, kBlue, kAlpha)
#elif FROM == 2 || FROM == 3
layout(set = 0, binding = 0, std140) uniform Draw {
    vec4 color;
}
draw;
#define COLOR draw.color
#elif FROM == 4
layout(set = 0, binding = 0, std430) readonly buffer Draw {
    vec4 color;
}
draw;
#define COLOR draw.color
#else
layout(location = 1) in vec4 in_coordinates;
layout(set = 0, binding = 0) uniform sampler2D image;
#if FROM == 5
#define COLOR texture(image, in_coordinates.xy)
#else
#define COLOR texture(image, in_coordinates.xy + 0.5)
#endif
#endif

void main() {
    out_color = COLOR;
#if FROM == 6
    if (out_color.a < 0.5) {
        discard;
    }
#endif
}
