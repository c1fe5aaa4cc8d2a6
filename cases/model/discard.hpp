// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Fragments that the fragment shader discards. Source: Vulkan specification, "Fragment Shading" and
// "Early Fragment Test Mode"; SPIR-V specification, OpKill and EarlyFragmentTests; docs/rules.md.
//
// A discarded fragment has no effect on any attachment. Which are discarded is exact: by the pixel,
// whose integer coordinates the shader takes from gl_FragCoord, or by the face. So where the tests
// come after the shader, or nothing is tested, the draw covers fewer samples. With early tests such
// a fragment covers its sample, and is tested and stored like any other; no hit and no value shows
// it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "cases/model/case.hpp"

namespace cases {

inline bool discards_pixel(Discard discard, uint32_t x, uint32_t y) {
    switch (discard) {
        case Discard::odd_columns:
            return x % 2 == 1;
        case Discard::odd_rows:
            return y % 2 == 1;
        case Discard::checker:
            return (x + y) % 2 == 1;
        default:
            return false;
    }
}

inline bool discards_face(Discard discard, bool front) {
    return discard == (front ? Discard::front : Discard::back);
}

// Whether what a draw discards has been tested and stored before.
inline bool stores_discarded(const Draw& draw) {
    return draw.early_tests && draw.discard != Discard::none;
}
inline bool stores_discarded(const Case& c) {
    return std::ranges::any_of(c.draws, [](const Draw& draw) { return stores_discarded(draw); });
}

// Whether a fragment is as if it had never been.
inline bool takes_away_pixel(const Draw& draw, uint32_t x, uint32_t y) {
    return !draw.early_tests && discards_pixel(draw.discard, x, y);
}
inline bool takes_away_face(const Draw& draw, bool front) {
    return !draw.early_tests && discards_face(draw.discard, front);
}
// Whether some fragments of some draw are taken away by their pixel.
inline bool takes_away_pixels(const Case& c) {
    return std::ranges::any_of(c.draws, [](const Draw& draw) {
        return takes_away_pixel(draw, 1, 0) || takes_away_pixel(draw, 0, 1);
    });
}

}  // namespace cases
