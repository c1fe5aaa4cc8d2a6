// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Passes clip-space positions through, bits unchanged. Defined by the build: ATTRIBUTES (0..4), CLIP and
// CULL (0..4: sizes of gl_ClipDistance and gl_CullDistance), LAYER and VIEWPORT (0 or 1: gl_Layer,
// gl_ViewportIndex), PULLED (1: no inputs, but a storage buffer), INSTANCED (1: of several instances number 7 alone is
// drawn; 2: each is moved by its offset and has vertices of its own numbers), MATRIX (1: positions are multiplied by one). Interpolation is decided by the fragment stage's qualifiers alone
// (Vulkan, "Interface Matching").
#version 450
#if LAYER || VIEWPORT
#extension GL_ARB_shader_viewport_layer_array : require
#endif

// Only what is written: the number of clip and cull planes is the size of the declared arrays.
out gl_PerVertex {
    invariant vec4 gl_Position;
#if CLIP
    float gl_ClipDistance[CLIP];
#endif
#if CULL
    float gl_CullDistance[CULL];
#endif
};

#if LAYER || VIEWPORT || INSTANCED == 2
layout(push_constant) uniform Draw {
    layout(offset = 4) uint layer;
    layout(offset = 8) uint viewport_index;
    layout(offset = 12) uint instance_vertices;
    layout(offset = 108) uint first_instance;
}
draw;
#endif

#if MATRIX
layout(push_constant) uniform Transform {
    mat4 matrix;
}
transform;
#endif

#if PULLED
layout(set = 1, binding = 0, std430) readonly buffer Vertices {
    uint begin[8];  // by location, in vec4
    vec4 values[];
}
vertices;
vec4 pulled(uint location) {
    return vertices.values[vertices.begin[location] + uint(gl_VertexIndex)];
}
#define in_position pulled(0U)
#define in_attribute0 pulled(1U)
#define in_attribute1 pulled(2U)
#define in_attribute2 pulled(3U)
#define in_attribute3 pulled(4U)
#define in_clip pulled(5U)
#define in_cull pulled(6U)
#else
layout(location = 0) in vec4 in_position;
#if ATTRIBUTES > 0
layout(location = 1) in vec4 in_attribute0;
#endif
#if ATTRIBUTES > 1
layout(location = 2) in vec4 in_attribute1;
#endif
#if ATTRIBUTES > 2
layout(location = 3) in vec4 in_attribute2;
#endif
#if ATTRIBUTES > 3
layout(location = 4) in vec4 in_attribute3;
#endif
#if CLIP
layout(location = 5) in vec4 in_clip;
#endif
#if CULL
layout(location = 6) in vec4 in_cull;
#endif
#if INSTANCED == 2
layout(location = 7) in vec4 in_offset;
#endif
#endif

layout(location = 0) flat out uint out_vertex;
// Takes the place of gl_PrimitiveID on devices that have none.
layout(location = 7) flat out uint out_no_primitive;

#if ATTRIBUTES > 0
layout(location = 1) out vec4 out_attribute0;
#endif
#if ATTRIBUTES > 1
layout(location = 2) out vec4 out_attribute1;
#endif
#if ATTRIBUTES > 2
layout(location = 3) out vec4 out_attribute2;
#endif
#if ATTRIBUTES > 3
layout(location = 4) out vec4 out_attribute3;
#endif

void main() {
#if INSTANCED == 2
    gl_Position = in_position + in_offset;
#elif INSTANCED
    // All others lie beside the view volume; 7: shaders.hpp.
    gl_Position = gl_InstanceIndex == 7 ? in_position : vec4(2.0, 2.0, 0.5, 1.0);
#elif MATRIX
    gl_Position = transform.matrix * in_position;
#else
    gl_Position = in_position;
#endif
    out_vertex = uint(gl_VertexIndex);
#if INSTANCED == 2
    out_vertex += (uint(gl_InstanceIndex) - draw.first_instance) * draw.instance_vertices;
#endif
    out_no_primitive = 0xfffffffeU;
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
#if CLIP > 0
    gl_ClipDistance[0] = in_clip.x;
#endif
#if CLIP > 1
    gl_ClipDistance[1] = in_clip.y;
#endif
#if CLIP > 2
    gl_ClipDistance[2] = in_clip.z;
#endif
#if CLIP > 3
    gl_ClipDistance[3] = in_clip.w;
#endif
#if CULL > 0
    gl_CullDistance[0] = in_cull.x;
#endif
#if CULL > 1
    gl_CullDistance[1] = in_cull.y;
#endif
#if CULL > 2
    gl_CullDistance[2] = in_cull.z;
#endif
#if CULL > 3
    gl_CullDistance[3] = in_cull.w;
#endif
#if LAYER
    gl_Layer = int(draw.layer);
#endif
#if VIEWPORT
    gl_ViewportIndex = int(draw.viewport_index);
#endif
}
