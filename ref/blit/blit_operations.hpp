// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The blits that no single Vulkan command makes, as reference operations [seed 003]: 1:1 copies
// clipped at the destination, optionally masked or blended. Numbers are exact and linear RGB.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <vector>

namespace ref {

// Red, green, blue, alpha, each in [0, 1], linear.
using Rgba = std::array<mpq_class, 4>;

struct Picture {
    int64_t width = 0, height = 0;
    std::vector<Rgba> texels;  // (x, y) at y * width + x
    const Rgba& at(int64_t x, int64_t y) const {
        return texels[static_cast<size_t>(y * width + x)];
    }
    Rgba& at(int64_t x, int64_t y) { return texels[static_cast<size_t>(y * width + x)]; }
    friend bool operator==(const Picture&, const Picture&) = default;
};

// Copies all of `source` so that its texel (0, 0) lands on (x, y); what falls outside is dropped.
void copy_blit(const Picture& source, Picture& destination, int64_t x, int64_t y);

// Copies only texels whose alpha is above the threshold: alpha <= threshold means 'not here'. The
// usual threshold is 0; 1/2 gives other borders.
void masked_blit(const Picture& source, Picture& destination, int64_t x, int64_t y,
                 const mpq_class& threshold);

// final = alpha * source + (1 - alpha) * destination for red, green and blue, in linear RGB; alpha
// itself becomes alpha + (1 - alpha) * destination alpha.
void blended_blit(const Picture& source, Picture& destination, int64_t x, int64_t y);

}  // namespace ref
