// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Copies every sample of every layer of a multisampled attachment to a buffer, word
// ((layer * height + j) * width + i) * samples + s. A
// resolve would combine or choose samples in an implementation-dependent way; this reads each one.
// Colour is read through an unsigned view of the float image, so that no bit can change on the way.
// DEPTH (2: of an image of one sample), and of colour the WORDS a sample (1, 2 or 4), are defined by the build; UNORM: of
// rgba8-unorm of one sample, by its own format. Of code c a number within a few 2^-24 of c / 255 is read, and
// packUnorm4x8 rounds 255 times that to the nearest whole number, which is c.
#version 450
#extension GL_EXT_samplerless_texture_functions : require

#if WORDS == 4
#define WORD uvec4
#define TAKE(texel) (texel)
#elif WORDS == 2
#define WORD uvec2
#define TAKE(texel) ((texel).xy)
#else
#define WORD uint
#define TAKE(texel) ((texel).x)
#endif

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform Extent {
    uint width;
    uint height;
    uint samples;
    uint first_column;  // of the image, where what is copied begins
    uint first_row;
}
extent;

#if DEPTH == 2 || UNORM
#define SOURCE texture2DArray
#else
#define SOURCE texture2DMSArray
#endif

#if DEPTH || UNORM
layout(set = 0, binding = 0) uniform SOURCE source;
layout(set = 0, binding = 1, std430) writeonly buffer Words {
    uint words[];
};
#else
layout(set = 0, binding = 0) uniform utexture2DMSArray source;
layout(set = 0, binding = 1, std430) writeonly buffer Words {
    WORD words[];
};
#endif

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= extent.width || pixel.y >= extent.height) {
        return;
    }
    ivec3 texel = ivec3(gl_GlobalInvocationID) + ivec3(extent.first_column, extent.first_row, 0);  // z: layer
    uint row = gl_GlobalInvocationID.z * extent.height + pixel.y;
    uint first = (row * extent.width + pixel.x) * extent.samples;
    for (uint s = 0u; s < extent.samples; ++s) {
#if UNORM
        words[first + s] = packUnorm4x8(texelFetch(source, texel, 0));
#elif DEPTH
        words[first + s] = floatBitsToUint(texelFetch(source, texel, int(s)).r);  // s is 0 where it is a level
#else
        words[first + s] = TAKE(texelFetch(source, texel, int(s)));
#endif
    }
}
