// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/facing.hpp"

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
        const AreaRange fan = area_range(boxes[0], boxes[i], boxes[i + 1]);
        low += fan.low;
        high += fan.high;
    }
    signs.negative = low < 0;
    signs.positive = high > 0;
    signs.zero = low <= 0 && high >= 0;
    return signs;
}

AreaSigns snapped_area_signs(std::span<const Box> boxes, int64_t grid_step) {
    AreaSigns signs;
    for_each_choice(grid_points(boxes[0], grid_step), grid_points(boxes[1], grid_step),
                    grid_points(boxes[2], grid_step),
                    [&](const auto& a, const auto& b, const auto& c) {
                        const Int128 area = edge_function(a, b, c);
                        signs.negative = signs.negative || area < 0;
                        signs.zero = signs.zero || area == 0;
                        signs.positive = signs.positive || area > 0;
                    });
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
