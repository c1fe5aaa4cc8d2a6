// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which planes of a picture were delivered: those that are judged. Nothing is filled in for the
// others.
#pragma once

#include "capture/capture.hpp"
#include "capture/delivered.hpp"
#include "cases/model/case.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/value/reference.hpp"

namespace diff {

struct Delivery {
    // The planes of a device with instruments, whose guards and clear values are judged, too.
    bool has_instruments = true;
    capture::HitDetail hits = capture::HitDetail::faces;
    bool has_writers = true;
    ref::ValueSelection values;  // depth is one of them
    bool has_color = false, has_stencil = false;
    bool is_of_planes = false;  // of single planes (capture_of): what is missing says nothing

    // Whether values or the writer tell of a sample's last fragment.
    bool has_fragments() const { return has_writers || has_values() || values.depth; }
    // Whether values of a fragment were delivered besides its depth.
    bool has_values() const;
    // Whether all of a fragment was.
    bool has_all_fragments() const { return has_writers && values.is_all(); }
    bool has_color_alone() const {
        return has_color && !has_stencil && !tells_hits() && !values.depth;
    }
    // Whether a plane tells by itself what was hit.
    bool tells_hits() const {
        return hits != capture::HitDetail::none || has_writers || has_values() ||
               (values.depth && !has_color);
    }
};

// All planes that the case's target has.
Delivery delivery_of(const cases::Case& c);
Delivery delivery_of(const cases::Case& c, const capture::Delivered& planes);

// The delivered planes as a capture; those that are missing hold what is cleared.
capture::Capture capture_of(const cases::Case& c, const ref::Expectation& expectation,
                            const capture::Delivered& planes);

// Judges the planes of a capture that were delivered.
Verdict compare_planes(const cases::Case& c, const ref::Expectation& expectation,
                       const capture::CaptureView& capture, const Delivery& delivery,
                       Wanted wanted);

}  // namespace diff
