// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Positions of the kinds that hurt rasterizers, mixed within one draw: one odd triangle may spoil
// its neighbours.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "fuzz/generate/dice.hpp"

namespace fuzz {

// Framebuffer pixels, multiples of 1/4096 of magnitude below 2^20: exact in binary64.
struct Position {
    double x = 0, y = 0;
};

struct Shape {
    std::vector<Position> vertices;
    std::vector<int64_t> indices;  // empty: none; -1: primitive restart
};

enum class Connection : uint8_t { list, strip, fan };

// The vertices of a draw on a target of `width` x `height` pixels. `with_indices` shares vertices,
// `with_restart` (strips and fans) begins anew now and then.
Shape make_shape(Dice& dice, Connection connection, bool with_indices, bool with_restart,
                 uint32_t width, uint32_t height);

// A rectangle that a viewport is.
struct Frame {
    int64_t x = 0, y = 0, width = 1, height = 1;  // pixels; a negative height flips
};
// A viewport beside a target of `width` x `height` pixels or across its border, "around" it, or
// "far" around it. The target's corner, a border and viewports' limits are met now and then.
Frame placed(std::string_view place, int64_t width, int64_t height, Dice& dice);

// Few triangles, as applications have them: rectangles, full-screen triangles, and what is nearly
// degenerate. Some of them fill the frame or lie at its borders.
Shape make_bare_shape(Dice& dice, Connection connection, bool with_indices, uint32_t width,
                      uint32_t height, const Frame& frame);

}  // namespace fuzz
