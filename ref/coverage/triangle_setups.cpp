// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/triangle_setups.hpp"

#include <algorithm>
#include <cassert>

namespace ref {

namespace {

// Whether [low, high] contains offset + k pixels for a whole k.
bool has_sample(int64_t low, int64_t high, int64_t offset) {
    const int64_t first = -((offset - low) >> kFixedBits);  // ceil((low - offset) / pixel)
    const int64_t last = (high - offset) >> kFixedBits;     // arithmetic shift: floor
    return first <= last;
}

}  // namespace

TriangleSetups::TriangleSetups(const cases::Case& c, const std::vector<cases::Triangle>& triangles,
                               const Limits& limits, cases::Profile profile, bool is_told,
                               bool has_alpha)
    : case_(c),
      triangles_(triangles),
      limits_(limits),
      profile_(profile),
      is_told_(is_told),
      boxes_(c, limits, profile),
      slot_(triangles.size(), kUnknown) {
    for (const cases::Draw& d : c.draws) {
        Window& window = windows_.emplace_back(window_of(c, d, profile));
        window.alpha = has_alpha ? window.alpha : cases::AlphaCoverage::all;
    }
    for (uint32_t s = 0; s < c.target.samples; ++s) {
        samples_.push_back(sample_position(0, 0, s, c.target));
    }
}

const TriangleSetup& TriangleSetups::operator[](uint32_t t) {
    if (slot_[t] == kUnknown || slot_[t] == kForgotten) {
        const cases::Triangle& triangle = triangles_[t];
        kept_.push_back(
            set_up(case_, triangle, limits_, profile_, boxes_, windows_[triangle.draw], is_told_));
        if (slot_[t] == kUnknown) {
            known_.push_back(t);
        }
        slot_[t] = static_cast<uint32_t>(kept_.size());
    }
    return kept_[slot_[t] - 1];
}

void TriangleSetups::forget_last(uint32_t t) {
    assert(slot_[t] == kept_.size());
    kept_.pop_back();
    slot_[t] = kForgotten;
}

bool TriangleSetups::may_touch_a_sample(uint32_t t) {
    const cases::Triangle& triangle = triangles_[t];
    const cases::Draw& draw = case_.draws[triangle.draw];
    if (draw.distances.clip_count > 0 || draw.conservative == cases::Conservative::overestimate) {
        return true;  // what clip distances cut off is snapped anew
    }
    Box hull;
    for (size_t k = 0; k < 3; ++k) {
        const Box* const box = boxes_.inside_view(triangle.draw, triangle.vertex[k]);
        if (box == nullptr) {
            return true;
        }
        hull = k == 0 ? *box : hull_of(hull, *box);
    }
    return std::any_of(samples_.begin(), samples_.end(), [&](const FixedPoint& s) {
        return has_sample(hull.x0, hull.x1, s.x) && has_sample(hull.y0, hull.y1, s.y);
    });
}

}  // namespace ref
