// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes a push constant to one attachment. Defined by the build: KIND (0: to the depth, 1: to a colour of numbers,
// 2: to one of integers, 3: to one of signed ones) and LOCATION of the colour.
#version 450

layout(push_constant) uniform Clear {
    uvec4 bits;
}
clear;

#if KIND == 1
layout(location = LOCATION) out vec4 out_color;
#elif KIND == 2
layout(location = LOCATION) out uvec4 out_color;
#elif KIND == 3
layout(location = LOCATION) out ivec4 out_color;
#endif

void main() {
#if KIND == 0
    gl_FragDepth = uintBitsToFloat(clear.bits.x);
#elif KIND == 1
    out_color = uintBitsToFloat(clear.bits);
#elif KIND == 3
    out_color = ivec4(clear.bits);
#else
    out_color = clear.bits;
#endif
}
