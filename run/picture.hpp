// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures of a judged case, and the triangles that lie over them.
#pragma once

#include <cstdint>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "diff/verdict.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/position/limits.hpp"
#include "report/record/run.hpp"

namespace run {

// The window of a target that pictures show; its layers are stacked, y is a row of the stack.
class PictureWindow {
  public:
    // Around the wrong samples if the target is larger than a picture.
    PictureWindow(const diff::Verdict& verdict, const cases::Target& target);

    // Pictures of the window, without planes.
    report::Pictures frame() const;
    // Calls with (x, y, s, index) of each sample, as pictures are ordered.
    template <class F>
    void for_each(F f) const {
        for (uint32_t y = top_; y < top_ + height_; ++y) {
            for (uint32_t x = left_; x < left_ + width_; ++x) {
                for (uint32_t s = 0; s < target_.samples; ++s) {
                    f(x, y, s, (size_t{y} * target_.width + x) * target_.samples + s);
                }
            }
        }
    }
    // In 2^-16 pixels, as Shape::points.
    bool meets(int64_t x0, int64_t y0, int64_t x1, int64_t y1) const;

  private:
    const cases::Target& target_;
    uint32_t width_, height_, left_, top_;
};

report::Pictures cut_pictures(const PictureWindow& window, const cases::Case& c,
                              const diff::Verdict& verdict, const capture::CaptureView& capture);

// Of a verdict that has expected_hits.
report::Reference cut_reference(const PictureWindow& window, const diff::Verdict& verdict);

// `expectation` is empty for a blit; `most`: how many triangles are kept.
report::Geometry geometry_of(const PictureWindow& window, const cases::Case& c,
                             const ref::Limits& limits, const ref::Expectation& expectation,
                             size_t most);

}  // namespace run
