// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Passes clip-space positions through, bits unchanged. ATTRIBUTES (0..4) is defined by the build.
// Interpolation is decided by the fragment stage's qualifiers alone (Vulkan, "Interface Matching").
#version 450

invariant gl_Position;

layout(location = 0) in vec4 in_position;
layout(location = 0) flat out uint out_vertex;

#if ATTRIBUTES > 0
layout(location = 1) in vec4 in_attribute0;
layout(location = 1) out vec4 out_attribute0;
#endif
#if ATTRIBUTES > 1
layout(location = 2) in vec4 in_attribute1;
layout(location = 2) out vec4 out_attribute1;
#endif
#if ATTRIBUTES > 2
layout(location = 3) in vec4 in_attribute2;
layout(location = 3) out vec4 out_attribute2;
#endif
#if ATTRIBUTES > 3
layout(location = 4) in vec4 in_attribute3;
layout(location = 4) out vec4 out_attribute3;
#endif

void main() {
    gl_Position = in_position;
    out_vertex = uint(gl_VertexIndex);
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
