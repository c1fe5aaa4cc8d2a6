// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/blit_source.hpp"

#include <algorithm>
#include <bit>
#include <glm/gtc/packing.hpp>

namespace cases {

namespace {

// A bijection of 32 bits (odd factors and xor-shifts are invertible), so different numbers stay
// different.
uint32_t scramble(uint32_t n, uint32_t seed) {
    n = (n + seed) * 0x9e3779b1U;
    n ^= n >> 15U;
    n *= 0x85ebca6bU;
    n ^= n >> 13U;
    return n;
}

// The bits of a whole number below 2^11: exact in binary16 and binary32.
uint32_t float_bits(uint32_t n, ComponentKind kind) {
    const auto number = static_cast<float>(n);
    return kind == ComponentKind::half ? glm::packHalf1x16(number)
                                       : std::bit_cast<uint32_t>(number);
}

uint32_t max_code(uint32_t bits) {
    return bits == 32 ? 0xffffffffU : (1U << bits) - 1U;
}

// Component k of texel (x, y), number n = y * width + x.
uint32_t unique_code(const Blit& blit, const ComponentFormat& format, uint32_t n, uint32_t k,
                     uint32_t x, uint32_t y) {
    // Formats of 16 bits: an odd factor is a bijection of 16 bits as well.
    const bool is_short = bytes_of(blit.source_format) < 4;
    const uint32_t hash = is_short ? ((n + blit.seed) * 0x9e37U & 0xffffU) : scramble(n, blit.seed);
    if (is_floating(format.kind)) {
        const bool is_alone = component_of(blit.source_format, 1).bits == 0;
        const uint32_t number = n % 2039 + 1;
        const std::array<uint32_t, 4> numbers = {is_alone ? number : x + 1, y + 1, number,
                                                 hash >> 22U};
        return float_bits(numbers[k], format.kind);
    }
    // Each component takes other bits of the hash; together they tell texels apart.
    uint32_t before = 0;
    for (uint32_t other = 0; other < k; ++other) {
        before += component_of(blit.source_format, other).bits;
    }
    return std::rotr(hash, static_cast<int>(before % 32)) & max_code(format.bits);
}

uint32_t ramp_code(const Blit& blit, const ComponentFormat& format, uint32_t k, uint32_t x,
                   uint32_t y) {
    const bool is_float = is_floating(format.kind);
    const uint32_t top = is_float ? 1920U : max_code(format.bits);
    const uint32_t sides = blit.source_width + blit.source_height;
    const uint32_t step = std::max(1U, top / (2 * sides));
    const std::array<uint32_t, 4> numbers = {2 * x + y, x + 2 * y, x + y, sides};
    const uint32_t value =
        static_cast<uint32_t>(std::min<uint64_t>(uint64_t{step} * (numbers[k] + 1), top));
    return is_float ? float_bits(value, format.kind) : value;
}

}  // namespace

std::vector<TexelCodes> blit_source(const Blit& blit) {
    std::vector<TexelCodes> texels;
    texels.reserve(size_t{blit.source_width} * blit.source_height);
    for (uint32_t y = 0; y < blit.source_height; ++y) {
        for (uint32_t x = 0; x < blit.source_width; ++x) {
            TexelCodes codes{};
            for (uint32_t k = 0; k < 4; ++k) {
                const ComponentFormat format = component_of(blit.source_format, k);
                if (format.bits != 0) {
                    codes[k] = blit.pattern == BlitPattern::unique
                                   ? unique_code(blit, format, y * blit.source_width + x, k, x, y)
                                   : ramp_code(blit, format, k, x, y);
                }
            }
            texels.push_back(codes);
        }
    }
    return texels;
}

namespace {

// Clips one axis; the destination's corners are moved into [0, size] and the source's with them.
// All products are below 2^15 * 2^15.
bool clip_axis(int32_t& s0, int32_t& s1, int32_t& d0, int32_t& d1, int32_t size) {
    const int64_t length = int64_t{d1} - d0;
    const int64_t span = int64_t{s1} - s0;
    const auto moved = [&](int32_t& s, int32_t& d, int32_t begin_s, int32_t begin_d) {
        const int32_t inside = std::min(std::max(d, 0), size);
        const int64_t numerator = (int64_t{inside} - begin_d) * span;
        if (numerator % length != 0) {
            return false;
        }
        s = begin_s + static_cast<int32_t>(numerator / length);
        d = inside;
        return true;
    };
    const int32_t begin_s = s0;
    const int32_t begin_d = d0;
    return length != 0 && moved(s0, d0, begin_s, begin_d) && moved(s1, d1, begin_s, begin_d);
}

}  // namespace

ClippedBlit clip_to_destination(const Corners& source, const Corners& destination, uint32_t width,
                                uint32_t height) {
    ClippedBlit clipped{source, destination, {}};
    Corners& s = clipped.source;
    Corners& d = clipped.destination;
    if (!clip_axis(s.x0, s.x1, d.x0, d.x1, static_cast<int32_t>(width)) ||
        !clip_axis(s.y0, s.y1, d.y0, d.y1, static_cast<int32_t>(height))) {
        clipped.error =
            "the clipped region would begin or end inside a texel of the source; scale by a whole "
            "number or move the destination";
    } else if (d.x0 == d.x1 || d.y0 == d.y1) {
        clipped.error = "nothing of the destination region lies in the target; move it";
    }
    return clipped;
}

}  // namespace cases
