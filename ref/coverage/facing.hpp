// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Area signs and facing. Twice the area of (a,b,c) is (b-a) x (c-a): positive for triangles that
// run clockwise on screen (y down). Vulkan's a = -1/2 sum (x_i y_i+1 - x_i+1 y_i) has the opposite
// sign: VK_FRONT_FACE_COUNTER_CLOCKWISE calls positive a, that is negative (b-a) x (c-a), the
// front.
#pragma once

#include <span>

#include "cases/model/case.hpp"
#include "ref/coverage/coverage.hpp"
#include "ref/position/position.hpp"

namespace ref {

// Which signs the area can have, over all choices of positions.
struct AreaSigns {
    bool negative = false, zero = false, positive = false;
    AreaSigns& operator|=(const AreaSigns& other) {
        negative = negative || other.negative;
        zero = zero || other.zero;
        positive = positive || other.positive;
        return *this;
    }
    // +1 or -1 if only that sign is possible, else 0.
    int only() const { return negative || zero ? (positive || zero ? 0 : -1) : (positive ? 1 : 0); }
};

// Finds the signs over all positions in the boxes of a polygon. The answer is exact for three boxes
// (the area is multi-affine, so its extremes lie at corners); of more it may name a sign too many.
AreaSigns area_signs(std::span<const Box> boxes);

// The signs over all triangles that have one grid point of each box as corner. This is exact.
AreaSigns snapped_area_signs(std::span<const Box> boxes, int64_t grid_step);

// Says what may be drawn as front or back face; zero area counts as back.
bool can_face_front(const AreaSigns& signs, cases::FrontFace front_face);
bool can_face_back(const AreaSigns& signs, cases::FrontFace front_face);

}  // namespace ref
