// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The formats that vertices are read in, one row each, and which numbers they hold exactly.
// Sources, all Vulkan specification: "Conversion From Normalized Fixed-Point to Floating-Point"
// (the largest code is 1, its negative -1, the code 0 is 0; what lies between is rounded), "Format
// Definition" (a scaled integer is that number as a float, a packed word is little-endian here),
// "Vertex Input Extraction" (components that a format lacks are 0, 0 and 1).
//
// No format here has a vertex of less than 4 bytes: some devices demand strides of whole words
// (minVertexInputBindingStrideAlignment). Formats of 64 bits are for inputs of that type, which no
// shader here has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

namespace cases {

enum class VertexFormat : uint8_t {
    rgba32_float,  // the usual one
    rgb32_float,
    rg32_float,
    r32_float,
    rgba16_float,
    rg16_float,
    rgba16_unorm,
    rg16_unorm,
    rgba16_snorm,
    rg16_snorm,
    rgba8_unorm,
    bgra8_unorm,
    rgba8_snorm,
    rgb10a2_unorm,
    rgba16_sscaled,
    rg16_sscaled,
    rgba8_uscaled,
    rgba8_sscaled,
};

enum class VertexKind : uint8_t { binary32, half, unorm, snorm, uscaled, sscaled };

struct VertexFormatRow {
    VertexFormat format;
    VertexKind kind;
    std::array<uint8_t, 4> bits, first_bit;  // as in ColorFormatRow
    uint32_t vulkan;                         // VkFormat
};

inline constexpr auto kVertexFormats = [] {
    using F = VertexFormat;
    using K = VertexKind;
    return std::to_array<VertexFormatRow>({
        {F::rgba32_float, K::binary32, {32, 32, 32, 32}, {0, 32, 64, 96}, 109},
        {F::rgb32_float, K::binary32, {32, 32, 32, 0}, {0, 32, 64, 0}, 106},
        {F::rg32_float, K::binary32, {32, 32, 0, 0}, {0, 32, 0, 0}, 103},
        {F::r32_float, K::binary32, {32, 0, 0, 0}, {0, 0, 0, 0}, 100},
        {F::rgba16_float, K::half, {16, 16, 16, 16}, {0, 16, 32, 48}, 97},
        {F::rg16_float, K::half, {16, 16, 0, 0}, {0, 16, 0, 0}, 83},
        {F::rgba16_unorm, K::unorm, {16, 16, 16, 16}, {0, 16, 32, 48}, 91},
        {F::rg16_unorm, K::unorm, {16, 16, 0, 0}, {0, 16, 0, 0}, 77},
        {F::rgba16_snorm, K::snorm, {16, 16, 16, 16}, {0, 16, 32, 48}, 92},
        {F::rg16_snorm, K::snorm, {16, 16, 0, 0}, {0, 16, 0, 0}, 78},
        {F::rgba8_unorm, K::unorm, {8, 8, 8, 8}, {0, 8, 16, 24}, 37},
        {F::bgra8_unorm, K::unorm, {8, 8, 8, 8}, {16, 8, 0, 24}, 44},
        {F::rgba8_snorm, K::snorm, {8, 8, 8, 8}, {0, 8, 16, 24}, 38},
        {F::rgb10a2_unorm, K::unorm, {10, 10, 10, 2}, {0, 10, 20, 30}, 64},
        {F::rgba16_sscaled, K::sscaled, {16, 16, 16, 16}, {0, 16, 32, 48}, 94},
        {F::rg16_sscaled, K::sscaled, {16, 16, 0, 0}, {0, 16, 0, 0}, 80},
        {F::rgba8_uscaled, K::uscaled, {8, 8, 8, 8}, {0, 8, 16, 24}, 39},
        {F::rgba8_sscaled, K::sscaled, {8, 8, 8, 8}, {0, 8, 16, 24}, 40},
    });
}();

constexpr const VertexFormatRow& row_of(VertexFormat format) {
    return kVertexFormats.at(static_cast<size_t>(format));
}
constexpr bool are_vertex_rows_in_order() {
    for (size_t k = 0; k < kVertexFormats.size(); ++k) {
        if (kVertexFormats.at(k).format != static_cast<VertexFormat>(k)) {
            return false;
        }
    }
    return true;
}
static_assert(are_vertex_rows_in_order());

// Sets of formats, a bit each.
constexpr uint32_t bit_of(VertexFormat format) {
    return 1U << static_cast<uint32_t>(format);
}
inline constexpr uint32_t kAllVertexFormats = (1U << kVertexFormats.size()) - 1;

constexpr uint32_t bytes_of(VertexFormat format) {
    uint32_t bits = 0;
    for (const uint8_t component : row_of(format).bits) {
        bits += component;
    }
    return bits / 8;
}

// The code of a component that is read as this number, bit for bit; nothing if there is none.
std::optional<uint32_t> vertex_code(VertexKind kind, uint32_t bits, float number);

// Whether each of the vertices is read as it is.
bool holds(VertexFormat format, std::span<const glm::vec4> values);

// One of the formats in `offered` but the usual one that hold the vertices, number `salt` of them
// round and round; the usual one if none does, or there are no vertices.
VertexFormat other_vertex_format(std::span<const glm::vec4> values, uint32_t offered, size_t salt);

// Writes a vertex that the format holds to its bytes_of(format) bytes.
void encode_vertex(VertexFormat format, const glm::vec4& value, std::byte* to);

}  // namespace cases
