// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The depth formats, one row each, and the binary32 numbers that stand for UNORM depth.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cases {

enum class DepthFormat : uint8_t { d32_float, d24_unorm, d16_unorm };

struct DepthFormatRow {
    std::string_view word;  // in case files
    uint32_t vulkan;        // VkFormat
    std::string_view vulkan_name;
    uint32_t bytes;         // of a copied texel
    double steps;           // the code that means 1; 0: floating point
    uint32_t with_stencil;  // VkFormat of the same depth with 8 bits of stencil in one image
    std::string_view with_stencil_name;
};

inline constexpr std::array<DepthFormatRow, 3> kDepthFormats = {{
    {"d32-float", 126, "D32_SFLOAT", 4, 0.0, 130, "D32_SFLOAT_S8_UINT"},
    {"d24-unorm", 125, "X8_D24_UNORM_PACK32", 4, 16777215.0, 129, "D24_UNORM_S8_UINT"},
    {"d16-unorm", 124, "D16_UNORM", 2, 65535.0, 128, "D16_UNORM_S8_UINT"},
}};

constexpr const DepthFormatRow& row_of(DepthFormat format) {
    return kDepthFormats.at(static_cast<size_t>(format));
}

// UNORM depth in a capture is the binary32 nearest to code / (2^n - 1). Below 2^24 these are all
// different, and code = depth * (2^n - 1) rounded to nearest: the error of the quotient is at most
// 2^-25, which times 2^24 - 1 is less than a half.
constexpr double depth_steps(DepthFormat format) {
    return row_of(format).steps;
}
inline float depth_of_code(uint32_t code, DepthFormat format) {
    return static_cast<float>(code / depth_steps(format));
}
// The depth of the format that is nearest to z in [0, 1].
inline float nearest_depth(float z, DepthFormat format) {
    const double steps = depth_steps(format);
    return steps > 0
               ? depth_of_code(static_cast<uint32_t>(static_cast<double>(z) * steps + 0.5), format)
               : z;
}
// A depth that a shader read: converting a code to binary32 is off by a few parts in 2^24, far less
// than half a step of D16. Anything that is no code stays what it is.
inline float nearest_depth_code(float read, DepthFormat format) {
    const double steps = depth_steps(format);
    const double scaled = static_cast<double>(read) * steps;
    if (!(steps > 0 && scaled >= 0 && scaled <= steps)) {
        return read;
    }
    const auto code = static_cast<uint32_t>(scaled + 0.5);
    return std::abs(scaled - code) < 0.25 ? depth_of_code(code, format) : read;
}

}  // namespace cases
