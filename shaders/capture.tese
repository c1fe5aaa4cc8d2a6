// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The vertices of a patch that was not divided, bits unchanged: at its corners gl_TessCoord is 1 in one component and 0
// in the others. Which corner comes first is the device's choice, so every vertex has what is flat from the one that
// provokes in the draw. Defined by the build: ATTRIBUTES (0..4).
#version 450
layout(triangles, equal_spacing, cw) in;

layout(constant_id = 0) const uint kProvoking = 0u;  // 0 or 2
layout(constant_id = 1) const uint kFlat = 0u;       // bit k: attribute k

in gl_PerVertex {
    vec4 gl_Position;
}
gl_in[];
out gl_PerVertex {
    invariant vec4 gl_Position;
};

layout(location = 0) flat in uint in_vertex[];
layout(location = 0) flat out uint out_vertex;
layout(location = 7) flat out uint out_no_primitive;
#define HAND_ON(k, place)                               \
    layout(location = place) in vec4 in_attribute##k[]; \
    layout(location = place) out vec4 out_attribute##k;
#if ATTRIBUTES > 0
HAND_ON(0, 1)
#endif
#if ATTRIBUTES > 1
HAND_ON(1, 2)
#endif
#if ATTRIBUTES > 2
HAND_ON(2, 3)
#endif
#if ATTRIBUTES > 3
HAND_ON(3, 4)
#endif

void main() {
    const uint corner = gl_TessCoord.x > 0.5 ? 0u : gl_TessCoord.y > 0.5 ? 1u : 2u;
    gl_Position = gl_in[corner].gl_Position;
    out_vertex = in_vertex[kProvoking];
    out_no_primitive = 0xfffffffeU;
#define FROM(k) ((kFlat >> k & 1u) != 0u ? kProvoking : corner)
#if ATTRIBUTES > 0
    out_attribute0 = in_attribute0[FROM(0)];
#endif
#if ATTRIBUTES > 1
    out_attribute1 = in_attribute1[FROM(1)];
#endif
#if ATTRIBUTES > 2
    out_attribute2 = in_attribute2[FROM(2)];
#endif
#if ATTRIBUTES > 3
    out_attribute3 = in_attribute3[FROM(3)];
#endif
}
