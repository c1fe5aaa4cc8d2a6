// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The colour formats, one row each: what case files call it, what its components are and where they
// lie in a texel. Loader, reference, comparison, harness, export and pictures read this table; what
// a stored code means follows from a row (ref/color/component.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cases {

// The number of a row; those that code names. In their order the first rows.
enum class ColorFormat : uint8_t {
    rgba8_unorm,
    bgra8_unorm,
    rgba8_srgb,
    rgb10a2_unorm,
    r5g6b5_unorm,
    rgba16_unorm,
    rgba16_float,
    rg16_float,
    rgba32_float,
    r32_float,
    r32_uint,
    rgba8_uint
};

// `half` has 5 bits of exponent and, of 16 bits, 10 of fraction and a sign; of 11 and 10 bits 6 and
// 5 of fraction and no sign [Khronos Data Format Specification, "Unsigned 11-bit floating-point
// numbers", "Unsigned 10-bit floating-point numbers"].
enum class ComponentKind : uint8_t { unorm, srgb, half, binary32, uint, snorm, sint };

constexpr bool is_floating(ComponentKind kind) {
    return kind == ComponentKind::half || kind == ComponentKind::binary32;
}
constexpr bool is_integer(ComponentKind kind) {
    return kind == ComponentKind::uint || kind == ComponentKind::sint;
}
// Of two's complement.
constexpr bool is_signed(ComponentKind kind) {
    return kind == ComponentKind::snorm || kind == ComponentKind::sint;
}

struct ColorFormatRow {
    std::string_view word;  // in case files
    ComponentKind kind;     // of all components, but the alpha of sRGB is linear
    // How many bits red, green, blue and alpha have, and where they begin. Bit k of a texel is bit
    // k % 8 of its byte k / 8 [Vulkan, "Format Definition": a packed word is little-endian here].
    std::array<uint8_t, 4> bits, first_bit;
    uint32_t vulkan;                     // VkFormat
    ColorFormat format = ColorFormat();  // its own number
};

inline constexpr auto kColorFormats = [] {
    using K = ComponentKind;
    auto rows = std::to_array<ColorFormatRow>({
        {"rgba8-unorm", K::unorm, {8, 8, 8, 8}, {0, 8, 16, 24}, 37},
        {"bgra8-unorm", K::unorm, {8, 8, 8, 8}, {16, 8, 0, 24}, 44},
        {"rgba8-srgb", K::srgb, {8, 8, 8, 8}, {0, 8, 16, 24}, 43},
        {"rgb10a2-unorm", K::unorm, {10, 10, 10, 2}, {0, 10, 20, 30}, 64},
        {"r5g6b5-unorm", K::unorm, {5, 6, 5, 0}, {11, 5, 0, 0}, 4},
        {"rgba16-unorm", K::unorm, {16, 16, 16, 16}, {0, 16, 32, 48}, 91},
        {"rgba16-float", K::half, {16, 16, 16, 16}, {0, 16, 32, 48}, 97},
        {"rg16-float", K::half, {16, 16, 0, 0}, {0, 16, 0, 0}, 83},
        {"rgba32-float", K::binary32, {32, 32, 32, 32}, {0, 32, 64, 96}, 109},
        {"r32-float", K::binary32, {32, 0, 0, 0}, {0, 0, 0, 0}, 100},
        {"r32-uint", K::uint, {32, 0, 0, 0}, {0, 0, 0, 0}, 98},
        {"rgba8-uint", K::uint, {8, 8, 8, 8}, {0, 8, 16, 24}, 41},
        {"r8-unorm", K::unorm, {8, 0, 0, 0}, {0, 0, 0, 0}, 9},
        {"r8-snorm", K::snorm, {8, 0, 0, 0}, {0, 0, 0, 0}, 10},
        {"r8-uint", K::uint, {8, 0, 0, 0}, {0, 0, 0, 0}, 13},
        {"r8-sint", K::sint, {8, 0, 0, 0}, {0, 0, 0, 0}, 14},
        {"rg8-unorm", K::unorm, {8, 8, 0, 0}, {0, 8, 0, 0}, 16},
        {"rg8-snorm", K::snorm, {8, 8, 0, 0}, {0, 8, 0, 0}, 17},
        {"rg8-uint", K::uint, {8, 8, 0, 0}, {0, 8, 0, 0}, 20},
        {"rg8-sint", K::sint, {8, 8, 0, 0}, {0, 8, 0, 0}, 21},
        {"rgba8-snorm", K::snorm, {8, 8, 8, 8}, {0, 8, 16, 24}, 38},
        {"rgba8-sint", K::sint, {8, 8, 8, 8}, {0, 8, 16, 24}, 42},
        {"bgra8-srgb", K::srgb, {8, 8, 8, 8}, {16, 8, 0, 24}, 50},
        {"a8b8g8r8-unorm", K::unorm, {8, 8, 8, 8}, {0, 8, 16, 24}, 51},
        {"a8b8g8r8-snorm", K::snorm, {8, 8, 8, 8}, {0, 8, 16, 24}, 52},
        {"a8b8g8r8-uint", K::uint, {8, 8, 8, 8}, {0, 8, 16, 24}, 55},
        {"a8b8g8r8-sint", K::sint, {8, 8, 8, 8}, {0, 8, 16, 24}, 56},
        {"a8b8g8r8-srgb", K::srgb, {8, 8, 8, 8}, {0, 8, 16, 24}, 57},
        {"r4g4b4a4-unorm", K::unorm, {4, 4, 4, 4}, {12, 8, 4, 0}, 2},
        {"b4g4r4a4-unorm", K::unorm, {4, 4, 4, 4}, {4, 8, 12, 0}, 3},
        {"b5g6r5-unorm", K::unorm, {5, 6, 5, 0}, {0, 5, 11, 0}, 5},
        {"r5g5b5a1-unorm", K::unorm, {5, 5, 5, 1}, {11, 6, 1, 0}, 6},
        {"b5g5r5a1-unorm", K::unorm, {5, 5, 5, 1}, {1, 6, 11, 0}, 7},
        {"a1r5g5b5-unorm", K::unorm, {5, 5, 5, 1}, {10, 5, 0, 15}, 8},
        {"bgr10a2-unorm", K::unorm, {10, 10, 10, 2}, {20, 10, 0, 30}, 58},
        {"bgr10a2-uint", K::uint, {10, 10, 10, 2}, {20, 10, 0, 30}, 62},
        {"rgb10a2-uint", K::uint, {10, 10, 10, 2}, {0, 10, 20, 30}, 68},
        {"r16-unorm", K::unorm, {16, 0, 0, 0}, {0, 0, 0, 0}, 70},
        {"r16-snorm", K::snorm, {16, 0, 0, 0}, {0, 0, 0, 0}, 71},
        {"r16-uint", K::uint, {16, 0, 0, 0}, {0, 0, 0, 0}, 74},
        {"r16-sint", K::sint, {16, 0, 0, 0}, {0, 0, 0, 0}, 75},
        {"r16-float", K::half, {16, 0, 0, 0}, {0, 0, 0, 0}, 76},
        {"rg16-unorm", K::unorm, {16, 16, 0, 0}, {0, 16, 0, 0}, 77},
        {"rg16-snorm", K::snorm, {16, 16, 0, 0}, {0, 16, 0, 0}, 78},
        {"rg16-uint", K::uint, {16, 16, 0, 0}, {0, 16, 0, 0}, 81},
        {"rg16-sint", K::sint, {16, 16, 0, 0}, {0, 16, 0, 0}, 82},
        {"rgba16-snorm", K::snorm, {16, 16, 16, 16}, {0, 16, 32, 48}, 92},
        {"rgba16-uint", K::uint, {16, 16, 16, 16}, {0, 16, 32, 48}, 95},
        {"rgba16-sint", K::sint, {16, 16, 16, 16}, {0, 16, 32, 48}, 96},
        {"r32-sint", K::sint, {32, 0, 0, 0}, {0, 0, 0, 0}, 99},
        {"rg32-uint", K::uint, {32, 32, 0, 0}, {0, 32, 0, 0}, 101},
        {"rg32-sint", K::sint, {32, 32, 0, 0}, {0, 32, 0, 0}, 102},
        {"rg32-float", K::binary32, {32, 32, 0, 0}, {0, 32, 0, 0}, 103},
        {"rgba32-uint", K::uint, {32, 32, 32, 32}, {0, 32, 64, 96}, 107},
        {"rgba32-sint", K::sint, {32, 32, 32, 32}, {0, 32, 64, 96}, 108},
        {"r11g11b10-float", K::half, {11, 11, 10, 0}, {0, 11, 22, 0}, 122},
    });
    for (size_t k = 0; k < rows.size(); ++k) {
        rows[k].format = static_cast<ColorFormat>(k);
    }
    return rows;
}();
inline constexpr auto kLastColorFormat = static_cast<ColorFormat>(kColorFormats.size() - 1);

constexpr const ColorFormatRow& row_of(ColorFormat format) {
    return kColorFormats.at(static_cast<size_t>(format));
}
static_assert(row_of(ColorFormat::rgba8_uint).word == "rgba8-uint");

// The word of a format in case files, as "rgba8-unorm".
constexpr std::string_view name_of(ColorFormat format) {
    return row_of(format).word;
}

// Whether the format holds whole numbers, which are never blended.
constexpr bool is_integer(ColorFormat format) {
    return is_integer(row_of(format).kind);
}

// Whether blits take the format: not one whose numbers `blit_source` does not make.
constexpr bool can_be_blitted(ColorFormat format) {
    const ColorFormatRow& row = row_of(format);
    return !is_signed(row.kind) && (row.kind != ComponentKind::half || row.bits[0] == 16);
}

// The size of a texel in memory; no format here has bits that mean nothing.
constexpr uint32_t bytes_of(ColorFormat format) {
    uint32_t bits = 0;
    for (const uint8_t component : row_of(format).bits) {
        bits += component;
    }
    return bits / 8;
}

// How component k (0: red ... 3: alpha) of a format is stored; bits is 0 if the format lacks it.
struct ComponentFormat {
    ComponentKind kind = ComponentKind::unorm;
    uint32_t bits = 0;
};
constexpr ComponentFormat component_of(ColorFormat format, uint32_t k) {
    const ColorFormatRow& row = row_of(format);
    const bool is_linear = row.kind == ComponentKind::srgb && k == 3;
    return {is_linear ? ComponentKind::unorm : row.kind, row.bits.at(k)};
}

// The number that a code of two's complement means, as of a component of a signed kind.
constexpr int32_t signed_code(uint32_t code, uint32_t bits) {
    const uint32_t unused = 32 - bits;
    return static_cast<int32_t>(code << unused) >> unused;
}
// The smallest and the largest number of component k of integers, of those that binary32 holds
// together with all whole numbers between (magnitudes of up to 2^24). Of a component that the
// format lacks those of red.
struct Whole {
    float least = 0, most = 0;
};
constexpr Whole whole_range(ColorFormat format, uint32_t k) {
    const ColorFormatRow& row = row_of(format);
    const uint32_t own = row.bits.at(k) != 0 ? row.bits.at(k) : row.bits[0];
    const uint32_t bits = own - (is_signed(row.kind) ? 1 : 0);
    const float beyond = bits < 24 ? static_cast<float>(uint32_t{1} << bits) : 0x1p24F;
    return {is_signed(row.kind) ? -beyond : 0, bits < 24 ? beyond - 1 : beyond};
}

// The stored code of each component of a texel, as the colour plane of a capture has it; 0 where
// the format lacks the component.
using TexelCodes = std::array<uint32_t, 4>;

// Read the codes of a texel from its bytes_of(format) bytes, and write them there.
TexelCodes decode_texel(ColorFormat format, const std::byte* texel);
void encode_texel(ColorFormat format, const TexelCodes& codes, std::byte* texel);

}  // namespace cases
