// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Hands on each triangle as it came, or as the second one of a strip whose first has no area. Defined by the build as for capture.vert, whose outputs it takes and has.
#version 450
layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;
// 0: alone. In a strip: 1 if the first vertex provokes, 2 if the last does.
layout(constant_id = 0) const uint kStrip = 0;

in gl_PerVertex {
    vec4 gl_Position;
#if CLIP
    float gl_ClipDistance[CLIP];
#endif
#if CULL
    float gl_CullDistance[CULL];
#endif
}
gl_in[];

out gl_PerVertex {
    invariant vec4 gl_Position;
#if CLIP
    float gl_ClipDistance[CLIP];
#endif
#if CULL
    float gl_CullDistance[CULL];
#endif
};

#if LAYER || VIEWPORT
layout(push_constant) uniform Draw {
    layout(offset = 4) uint layer;
    layout(offset = 8) uint viewport_index;
}
draw;
#endif

layout(location = 0) flat in uint in_vertex[];
layout(location = 0) flat out uint out_vertex;
layout(location = 7) flat out uint out_no_primitive;

#if ATTRIBUTES > 0
layout(location = 1) in vec4 in_attribute0[];
layout(location = 1) out vec4 out_attribute0;
#endif
#if ATTRIBUTES > 1
layout(location = 2) in vec4 in_attribute1[];
layout(location = 2) out vec4 out_attribute1;
#endif
#if ATTRIBUTES > 2
layout(location = 3) in vec4 in_attribute2[];
layout(location = 3) out vec4 out_attribute2;
#endif
#if ATTRIBUTES > 3
layout(location = 4) in vec4 in_attribute3[];
layout(location = 4) out vec4 out_attribute3;
#endif

void emit(int k) {
    gl_Position = gl_in[k].gl_Position;
#if CLIP
    for (int d = 0; d < CLIP; ++d) {
        gl_ClipDistance[d] = gl_in[k].gl_ClipDistance[d];
    }
#endif
#if CULL
    for (int d = 0; d < CULL; ++d) {
        gl_CullDistance[d] = gl_in[k].gl_CullDistance[d];
    }
#endif
    out_vertex = in_vertex[k];
    out_no_primitive = 0xfffffffeU;
#if ATTRIBUTES > 0
    out_attribute0 = in_attribute0[k];
#endif
#if ATTRIBUTES > 1
    out_attribute1 = in_attribute1[k];
#endif
#if ATTRIBUTES > 2
    out_attribute2 = in_attribute2[k];
#endif
#if ATTRIBUTES > 3
    out_attribute3 = in_attribute3[k];
#endif
    gl_PrimitiveID = gl_PrimitiveIDIn;
#if LAYER
    gl_Layer = int(draw.layer);
#endif
#if VIEWPORT
    gl_ViewportIndex = int(draw.viewport_index);
#endif
    EmitVertex();
}

// The second triangle of a strip of v0 to v3 is v1, v3, v2.
void main() {
    if (kStrip == 1) {
        emit(0);
        emit(0);
        emit(2);
        emit(1);
    } else if (kStrip == 2) {
        emit(1);
        emit(1);
        emit(0);
        emit(2);
    } else {
        for (int k = 0; k < 3; ++k) {
            emit(k);
        }
    }
    EndPrimitive();
}
