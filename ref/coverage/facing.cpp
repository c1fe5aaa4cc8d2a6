// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/facing.hpp"

#include <algorithm>

#include "ref/coverage/setup.hpp"
#include "ref/number/edge_function.hpp"

namespace ref {

AreaSigns area_signs(std::span<const Box> boxes) {
    AreaSigns signs;
    if (boxes.size() < 3) {
        signs.zero = true;
        return signs;
    }
    // A fan around vertex 0: the sum of the extremes bounds the extremes of the sum.
    Int128 low = 0;
    Int128 high = 0;
    for (size_t i = 1; i + 1 < boxes.size(); ++i) {
        bool is_first = true;
        Int128 fan_low = 0;
        Int128 fan_high = 0;
        for (const FixedPoint& a : BoxCorners(boxes[0])) {
            for (const FixedPoint& b : BoxCorners(boxes[i])) {
                for (const FixedPoint& c : BoxCorners(boxes[i + 1])) {
                    const Int128 area = edge_function(a, b, c);
                    fan_low = is_first ? area : std::min(fan_low, area);
                    fan_high = is_first ? area : std::max(fan_high, area);
                    is_first = false;
                }
            }
        }
        low += fan_low;
        high += fan_high;
    }
    signs.negative = low < 0;
    signs.positive = high > 0;
    signs.zero = low <= 0 && high >= 0;
    return signs;
}

AreaSigns snapped_area_signs(std::span<const Box> boxes, int64_t grid_step) {
    AreaSigns signs;
    const auto first = grid_points(boxes[0], grid_step);
    const auto second = grid_points(boxes[1], grid_step);
    const auto third = grid_points(boxes[2], grid_step);
    for (const FixedPoint& a : first) {
        for (const FixedPoint& b : second) {
            for (const FixedPoint& c : third) {
                const Int128 area = edge_function(a, b, c);
                signs.negative = signs.negative || area < 0;
                signs.zero = signs.zero || area == 0;
                signs.positive = signs.positive || area > 0;
            }
        }
    }
    return signs;
}

bool can_face_front(const AreaSigns& signs, cases::FrontFace front_face) {
    return front_face == cases::FrontFace::counter_clockwise ? signs.negative : signs.positive;
}

bool can_face_back(const AreaSigns& signs, cases::FrontFace front_face) {
    return signs.zero ||
           (front_face == cases::FrontFace::counter_clockwise ? signs.positive : signs.negative);
}

}  // namespace ref
