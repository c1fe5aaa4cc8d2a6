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

// Signs of the area that some choice of positions has.
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

// Signs over all positions in the boxes of a polygon. Exact for three boxes (the area is
// multi-affine, so its extremes lie at corners); for more it may name a sign too many.
AreaSigns area_signs(std::span<const Box> boxes);

// Signs over all triangles of grid points, one from each box; exact.
AreaSigns snapped_area_signs(std::span<const Box> boxes, int64_t grid_step);

// What may be drawn as front or back face, with zero area counting as back.
bool can_face_front(const AreaSigns& signs, cases::FrontFace front_face);
bool can_face_back(const AreaSigns& signs, cases::FrontFace front_face);

}  // namespace ref
