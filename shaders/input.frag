// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes every sample of an input attachment to a buffer, as copy_samples.comp does with images: the bits of its texel, in
// whole words. Which attachment it is, the module is told (shaders/spirv_variant.hpp). Defined by the build: WHOLE (1: it
// holds integers), SAMPLES (1: several a pixel).
#version 450

layout(constant_id = 0) const uint kWords = 1u;  // of a sample
// How a component is stored, numbered as cases::ComponentKind (0 unorm, 3 binary32, 4 uint), how many bits it has
// and where they begin.
layout(constant_id = 1) const uint kKind = 3u;
layout(constant_id = 2) const uint kBits0 = 32u;
layout(constant_id = 3) const uint kBits1 = 0u;
layout(constant_id = 4) const uint kBits2 = 0u;
layout(constant_id = 5) const uint kBits3 = 0u;
layout(constant_id = 6) const uint kFirst0 = 0u;
layout(constant_id = 7) const uint kFirst1 = 0u;
layout(constant_id = 8) const uint kFirst2 = 0u;
layout(constant_id = 9) const uint kFirst3 = 0u;

layout(push_constant) uniform Extent {
    uint width;
    uint samples;
}
extent;

#if WHOLE
#define VALUE uvec4
#if SAMPLES
layout(input_attachment_index = 0, set = 0, binding = 0) uniform usubpassInputMS source;
#else
layout(input_attachment_index = 0, set = 0, binding = 0) uniform usubpassInput source;
#endif
#else
#define VALUE vec4
#if SAMPLES
layout(input_attachment_index = 0, set = 0, binding = 0) uniform subpassInputMS source;
#else
layout(input_attachment_index = 0, set = 0, binding = 0) uniform subpassInput source;
#endif
#endif

layout(set = 0, binding = 1, std430) writeonly buffer Words {
    uint words[];
};

#if WHOLE
uint code_of(uint value, uint bits) {
    return value;
}
#else
uint code_of(float value, uint bits) {
    switch (kKind) {
        case 0u:  // what is read of a code is that code divided by the largest, up to rounding
            return uint(floor(value * float((1u << bits) - 1u) + 0.5));
        default:
            return floatBitsToUint(value);
    }
}
#endif

void put(uint at, VALUE value) {
    uvec4 out_words = uvec4(0u);
    const uint bits[4] = {kBits0, kBits1, kBits2, kBits3};
    const uint first[4] = {kFirst0, kFirst1, kFirst2, kFirst3};
    for (int k = 0; k < 4; ++k) {
        if (bits[k] != 0u) {
            out_words[first[k] / 32u] |= code_of(value[k], bits[k]) << (first[k] % 32u);
        }
    }
    for (uint k = 0u; k < kWords; ++k) {
        words[at + k] = out_words[k];
    }
}

void main() {
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    const uint first = (pixel.y * extent.width + pixel.x) * extent.samples;
#if SAMPLES
    for (uint s = 0u; s < extent.samples; ++s) {
        put((first + s) * kWords, subpassLoad(source, int(s)));
    }
#else
    put(first * kWords, subpassLoad(source));
#endif
}
