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

enum class ComponentKind : uint8_t { unorm, srgb, half, binary32, uint };

constexpr bool is_floating(ComponentKind kind) {
    return kind == ComponentKind::half || kind == ComponentKind::binary32;
}

struct ColorFormatRow {
    ColorFormat format;
    std::string_view word;  // in case files
    ComponentKind kind;     // of all components, but the alpha of sRGB is linear
    // How many bits red, green, blue and alpha have, and where they begin. Bit k of a texel is bit
    // k % 8 of its byte k / 8 [Vulkan, "Format Definition": a packed word is little-endian here].
    std::array<uint8_t, 4> bits, first_bit;
    uint32_t vulkan;  // VkFormat
};

inline constexpr auto kColorFormats = [] {
    using F = ColorFormat;
    using K = ComponentKind;
    return std::to_array<ColorFormatRow>({
        {F::rgba8_unorm, "rgba8-unorm", K::unorm, {8, 8, 8, 8}, {0, 8, 16, 24}, 37},
        {F::bgra8_unorm, "bgra8-unorm", K::unorm, {8, 8, 8, 8}, {16, 8, 0, 24}, 44},
        {F::rgba8_srgb, "rgba8-srgb", K::srgb, {8, 8, 8, 8}, {0, 8, 16, 24}, 43},
        {F::rgb10a2_unorm, "rgb10a2-unorm", K::unorm, {10, 10, 10, 2}, {0, 10, 20, 30}, 64},
        {F::r5g6b5_unorm, "r5g6b5-unorm", K::unorm, {5, 6, 5, 0}, {11, 5, 0, 0}, 4},
        {F::rgba16_unorm, "rgba16-unorm", K::unorm, {16, 16, 16, 16}, {0, 16, 32, 48}, 91},
        {F::rgba16_float, "rgba16-float", K::half, {16, 16, 16, 16}, {0, 16, 32, 48}, 97},
        {F::rg16_float, "rg16-float", K::half, {16, 16, 0, 0}, {0, 16, 0, 0}, 83},
        {F::rgba32_float, "rgba32-float", K::binary32, {32, 32, 32, 32}, {0, 32, 64, 96}, 109},
        {F::r32_float, "r32-float", K::binary32, {32, 0, 0, 0}, {0, 0, 0, 0}, 100},
        {F::r32_uint, "r32-uint", K::uint, {32, 0, 0, 0}, {0, 0, 0, 0}, 98},
        {F::rgba8_uint, "rgba8-uint", K::uint, {8, 8, 8, 8}, {0, 8, 16, 24}, 41},
    });
}();
inline constexpr auto kLastColorFormat = static_cast<ColorFormat>(kColorFormats.size() - 1);

constexpr const ColorFormatRow& row_of(ColorFormat format) {
    return kColorFormats.at(static_cast<size_t>(format));
}
static_assert(std::ranges::all_of(kColorFormats,
                                  [](const auto& row) { return &row == &row_of(row.format); }));

// The word of a format in case files, as "rgba8-unorm".
constexpr std::string_view name_of(ColorFormat format) {
    return row_of(format).word;
}

// Whether the format holds whole numbers, which are never blended.
constexpr bool is_integer(ColorFormat format) {
    return row_of(format).kind == ComponentKind::uint;
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

// The stored code of each component of a texel, as the colour plane of a capture has it; 0 where
// the format lacks the component.
using TexelCodes = std::array<uint32_t, 4>;

// Read the codes of a texel from its bytes_of(format) bytes, and write them there.
TexelCodes decode_texel(ColorFormat format, const std::byte* texel);
void encode_texel(ColorFormat format, const TexelCodes& codes, std::byte* texel);

}  // namespace cases
