// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/sample.hpp"
#include "ref/number/fixed_point.hpp"
#include "ref/position/position.hpp"

namespace ref {

// The window of a draw (docs/design.md, "Words").
struct Window {
    int64_t pixel_x0 = 0, pixel_x1 = 0;  // framebuffer and scissor; half-open
    int64_t pixel_y0 = 0, pixel_y1 = 0;
    // The viewport: nothing is drawn outside `zone`; nothing has to be drawn outside `core`. They
    // differ along a fractional viewport only, by the pixel on either side that rules.md leaves
    // open there.
    FixedRange zone_x, zone_y, core_x, core_y;
    bool is_viewport_ignored = false;    // undefined positions: only scissor and framebuffer hold
    uint32_t sample_mask = 0xffffffffU;  // bit s: sample s passes the sample masks
    cases::AlphaCoverage alpha = cases::AlphaCoverage::all;  // what alpha to coverage leaves

    bool may_write(uint32_t sample) const {
        return ((sample_mask >> sample) & 1U) != 0 && alpha != cases::AlphaCoverage::none;
    }
    // Whether alpha to coverage may take away what is covered.
    bool is_open() const { return alpha == cases::AlphaCoverage::any; }
    bool is_in_scissor(const FixedPoint& p) const;
    bool is_in_zone(const FixedPoint& p) const;
    bool may_touch(const FixedPoint& p) const { return is_in_scissor(p) && is_in_zone(p); }
    bool is_in_core(const FixedPoint& p) const;
    bool must_touch(const FixedPoint& p) const { return !is_open() && is_in_core(p); }
};

Window window_of(const cases::Case& c, const cases::Draw& draw, cases::Profile profile);

}  // namespace ref
