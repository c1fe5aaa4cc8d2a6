// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "run/picture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cases/format/color_format.hpp"
#include "ref/blit/blit.hpp"
#include "ref/color/component.hpp"
#include "ref/number/fixed_point.hpp"
#include "ref/position/clip.hpp"
#include "ref/position/position.hpp"
#include "run/overlay.hpp"

namespace run {

using report::Geometry;
using report::Pictures;
using report::Shape;

namespace {

constexpr uint32_t kPictureSide = 128;  // pixels of a kept picture, each way

// Where a window of at most kPictureSide pixels begins that shows the middle of [lo, hi] of `size`
// pixels.
uint32_t window_begin(uint32_t lo, uint32_t hi, uint32_t size) {
    if (size <= kPictureSide) {
        return 0;
    }
    const uint32_t middle = lo + (hi - lo) / 2;
    const uint32_t begin = middle > kPictureSide / 2 ? middle - kPictureSide / 2 : 0;
    return std::min(begin, size - kPictureSide);
}

// What a screen shows of a stored component: [0, 1] as 0..255, whole numbers up to 255 as they are.
uint8_t shown(uint32_t code, cases::ComponentFormat format) {
    if (is_integer(format.kind)) {
        return static_cast<uint8_t>(
            std::clamp(ref::color::Component(format).number(code), 0.0, 255.0));
    }
    // A screen takes sRGB as it is stored.
    const bool is_srgb = format.kind == cases::ComponentKind::srgb;
    const double value = is_srgb ? code / 255.0 : ref::color::Component(format).number(code);
    return static_cast<uint8_t>(std::lround(255 * (value > 0 ? std::min(value, 1.0) : 0.0)));
}

// Outline of what clipping leaves of a triangle, for the eye alone.
std::vector<double> clipped_piece(const cases::Draw& draw, const cases::Triangle& t,
                                  cases::Profile profile) {
    std::vector<double> piece;
    const ref::ClipVolume volume = ref::clip_volume_of(draw);
    for (const ref::ClippedVertex& v :
         ref::clip_triangle(ref::ClipInput(draw, t.vertex), draw.viewport, profile, volume.all())) {
        if (v.clip[3] > 0) {
            piece.push_back(v.position.x.get_d());
            piece.push_back(v.position.y.get_d());
        }
    }
    return piece;
}

Shape shape_of(const cases::Draw& draw, const cases::Triangle& t, const ref::Limits& limits,
               cases::Profile profile) {
    Shape shape;
    shape.draw = t.draw;
    shape.primitive = t.primitive;
    shape.layer = layer_of(draw, t);
    shape.vertex = t.vertex;
    shape.has_points = true;
    shape.is_exact = true;
    for (size_t k = 0; k < 3; ++k) {
        const glm::vec4& clip = draw.positions[t.vertex.at(k)];
        if (!ref::is_projectable(clip)) {
            shape.has_points = shape.is_exact = false;
            continue;
        }
        if (const auto box = ref::position_box(clip, draw.viewport, limits, profile)) {
            shape.boxes.push_back({box->x0, box->y0, box->x1, box->y1});
            shape.is_exact = shape.is_exact && box->is_point();
        } else {
            shape.is_exact = false;
        }
        const auto snapped = ref::snap_nearest(clip, draw.viewport, limits);
        shape.has_points = shape.has_points && snapped.has_value();
        if (snapped) {
            shape.points.at(2 * k) = snapped->x;
            shape.points.at(2 * k + 1) = snapped->y;
        }
    }
    const ref::ClipVolume volume = ref::clip_volume_of(draw);
    const ref::ClipInput input(draw, t.vertex);
    shape.is_clipped = !ref::is_inside(input, volume.all());
    shape.cuts = cuts_of(draw, t);
    if (shape.is_exact || shape.boxes.size() < 3) {
        shape.boxes.clear();
    }
    if (shape.is_clipped && is_finite(input)) {
        shape.piece = clipped_piece(draw, t, profile);
    }
    return shape;
}

}  // namespace

PictureWindow::PictureWindow(const diff::Verdict& verdict, const cases::Target& target)
    : target_(target),
      width_(std::min(target.width, kPictureSide)),
      height_(std::min(target.rows(), kPictureSide)),
      left_(window_begin(verdict.min_x, verdict.max_x, target.width)),
      top_(window_begin(verdict.min_y, verdict.max_y, target.rows())) {}

Pictures PictureWindow::frame() const {
    Pictures p;
    p.width = width_;
    p.height = height_;
    p.left = left_;
    p.top = top_;
    p.layer_height = target_.layers > 1 ? target_.height : 0;
    return p;
}

bool PictureWindow::meets(int64_t x0, int64_t y0, int64_t x1, int64_t y1) const {
    constexpr int64_t kOne = ref::kFixedOne;
    return x1 >= int64_t{left_} * kOne && x0 <= (int64_t{left_} + width_) * kOne &&
           y1 >= int64_t{top_} * kOne && y0 <= (int64_t{top_} + height_) * kOne;
}

Pictures cut_pictures(const PictureWindow& window, const cases::Case& c,
                      const diff::Verdict& verdict, const capture::CaptureView& capture) {
    Pictures p = window.frame();
    p.is_uncounted = !verdict.has_counted && !c.blit;
    const bool has_errors = std::any_of(verdict.error_ratios.begin(), verdict.error_ratios.end(),
                                        [](float ratio) { return ratio >= 0; });
    const auto put = [](std::vector<uint8_t>& to, const auto& from, size_t k) {
        if (k < from.size()) {
            to.push_back(static_cast<uint8_t>(from[k]));
        }
    };
    window.for_each([&](uint32_t, uint32_t, uint32_t, size_t k) {
        put(p.expected_hits, verdict.expected_hits, k);
        put(p.device_hits, verdict.device_hits, k);
        put(p.marks, verdict.marks, k);
        if (has_errors) {
            p.errors.push_back(report::error_code(verdict.error_ratios[k]));
        }
    });
    if (c.target.color && !capture.color.empty() && !p.marks.empty()) {
        const std::optional<ref::BlitReference> blit =
            c.blit ? std::optional<ref::BlitReference>(c) : std::nullopt;
        for (uint32_t k = 0; k < 3; ++k) {
            const cases::ComponentFormat format = cases::component_of(c.target.color->format, k);
            window.for_each([&](uint32_t x, uint32_t y, uint32_t, size_t index) {
                const uint32_t code = capture.color[index][k];
                p.device_colors.push_back(format.bits == 0 ? uint8_t{0} : shown(code, format));
                if (blit) {
                    const cases::TexelCodes nominal =
                        blit->is_inside(x, y) ? blit->nominal(x, y) : blit->clear_codes();
                    p.expected_colors.push_back(format.bits == 0 ? uint8_t{0}
                                                                 : shown(nominal.at(k), format));
                }
            });
        }
    }
    return p;
}

report::Reference cut_reference(const PictureWindow& window, const diff::Verdict& verdict) {
    const Pictures frame = window.frame();
    report::Reference r{.width = frame.width,
                        .height = frame.height,
                        .left = frame.left,
                        .top = frame.top,
                        .layer_height = frame.layer_height,
                        .hits = {}};
    window.for_each([&](uint32_t, uint32_t, uint32_t, size_t k) {
        r.hits.push_back(verdict.expected_hits[k]);
    });
    return r;
}

Geometry geometry_of(const PictureWindow& window, const cases::Case& c, const ref::Limits& limits,
                     const ref::Expectation& expectation, size_t most) {
    Geometry g;
    g.width = c.target.width;
    g.height = c.target.rows();
    g.samples = c.target.samples;
    for (const auto& at : cases::sample_locations(c.target)) {
        g.sample_locations.push_back(at);
    }
    if (c.blit) {
        for (const cases::Corners& r : {c.blit->source, c.blit->destination}) {
            g.blit_regions.push_back({r.x0, r.y0, r.x1, r.y1});
        }
        return g;
    }
    const auto add_limits_of = [&g](const cases::Draw& draw) {
        g.scissors.push_back(
            {draw.scissor.x, draw.scissor.y, draw.scissor.width, draw.scissor.height});
        g.viewports.push_back(corners_of(draw.viewport));
    };
    g.triangle_total = expectation.triangles.size();
    for (const cases::Triangle& t : expectation.triangles) {
        if (g.triangles.size() == most) {
            break;
        }
        if (c.draws[t.draw].clear) {
            continue;  // it has no outline
        }
        Shape shape = shape_of(c.draws[t.draw], t, limits, expectation.profile);
        const int64_t down = int64_t{shape.layer} * c.target.height * ref::kFixedOne;
        const auto& p = shape.points;
        const bool shows =
            shape.has_points
                ? window.meets(std::min({p[0], p[2], p[4]}), std::min({p[1], p[3], p[5]}) + down,
                               std::max({p[0], p[2], p[4]}), std::max({p[1], p[3], p[5]}) + down)
                : !shape.piece.empty();
        if (shows) {
            g.triangles.push_back(std::move(shape));
        }
    }
    // Of the draws that are shown; of two, so that the page tells which of several it is.
    size_t draws = std::min<size_t>(c.draws.size(), 2);
    for (const Shape& shape : g.triangles) {
        draws = std::max<size_t>(draws, shape.draw + 1);
    }
    std::for_each_n(c.draws.begin(), draws, add_limits_of);
    return g;
}

}  // namespace run
