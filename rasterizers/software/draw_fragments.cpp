// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The part of a draw that works on samples: what is left of them, and what is written.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "rasterizers/software/depth.hpp"
#include "rasterizers/software/draw_command.hpp"
#include "rasterizers/software/multisample.hpp"
#include "rasterizers/software/probes.hpp"
#include "rasterizers/software/snapping.hpp"
#include "rasterizers/software/target/neighbour.hpp"

namespace software {

// With a guard band the viewport's rectangle is a scissor for each sample.
bool DrawCommand::inside_viewport(double x, double y) const {
    if (device_.clip != ClipMethod::guard_band) {
        return true;
    }
    const cases::Viewport& view = draw_.viewport;
    const double left = static_cast<double>(view.x);
    const double right = left + static_cast<double>(view.width);
    double top = static_cast<double>(view.y);
    double bottom = top + static_cast<double>(view.height);
    if (bottom < top) {
        std::swap(top, bottom);
    }
    return x >= left && x < right && y >= top && y < bottom;
}

// With clip distances tested at each sample.
bool DrawCommand::is_distance_clipped(const TrianglePlanes& planes, int64_t i, int64_t j,
                                      uint32_t s) const {
    if (!tests_distances(device_)) {
        return false;
    }
    const float unit = std::ldexp(1.0F, -device_.subpixel_bits);
    const float x = static_cast<float>(i) + static_cast<float>(samples_[s].x) * unit;
    const float y = static_cast<float>(j) + static_cast<float>(samples_[s].y) * unit;
    for (int k = 0; k < static_cast<int>(draw_.distances.clip_count); ++k) {
        const float c = planes.distance(k, x, y);
        if (device_.fault == "distance-plane-never"_fault ? !(c > 0) : !(c >= 0)) {
            return true;
        }
    }
    return false;
}

// With the depth tested at each sample, in the viewport's range.
bool DrawCommand::is_depth_clipped(const TrianglePlanes& planes, float x, float y) const {
    if (!tests_depth_) {
        return false;
    }
    const float z = planes.depth(x, y);
    const auto [low, high] = std::minmax(draw_.viewport.min_depth, draw_.viewport.max_depth);
    return !(z >= low && z <= high);
}

// With the fault that the scissor is tested by the sample, half a pixel too early.
bool DrawCommand::is_before_scissor(int64_t i, int64_t j, uint32_t s) const {
    const double unit = std::ldexp(1.0, -device_.subpixel_bits);
    const double x = static_cast<double>(i) + static_cast<double>(samples_[s].x) * unit;
    const double y = static_cast<double>(j) + static_cast<double>(samples_[s].y) * unit;
    return x < draw_.scissor.x - 0.5 || y < draw_.scissor.y - 0.5;
}

void DrawCommand::cover(const Primitive& primitive, const TrianglePlanes& planes,
                        const WindowVertex& first, bool front, int64_t i, int64_t j, uint32_t s) {
    const double unit = std::ldexp(1.0, -device_.subpixel_bits);
    const double x = static_cast<double>(i) + static_cast<double>(samples_[s].x) * unit;
    const double y = static_cast<double>(j) + static_cast<double>(samples_[s].y) * unit;
    if (!inside_viewport(x, y) || is_distance_clipped(planes, i, j, s) ||
        is_depth_clipped(planes, static_cast<float>(x), static_cast<float>(y))) {
        return;
    }
    if (device_.fault == "scissor-half-early"_fault && is_before_scissor(i, j, s)) {
        return;
    }
    if (draw_.fragment_size[0] > 1 || draw_.fragment_size[1] > 1) {
        const CoarseFragment fragment = coarse_fragment(draw_, device_, i, j, rect_.x0, rect_.y0);
        coarse_.try_emplace({fragment.y, fragment.x, &planes}, fragment)
            .first->second.covered_at(i, j) |= 1U << s;
    } else if (samples_.size() == 1) {
        shade(primitive, planes, first, front, i, j, s, 1U);
    } else {
        covered_[{j, i, &planes}] |= 1U << s;
    }
}

void DrawCommand::shade_covered(const Primitive& primitive, const WindowVertex& first, bool front) {
    for (const auto& [where, covered] : covered_) {
        const auto& [j, i, planes] = where;
        for (uint32_t s = 0; s < samples_.size(); ++s) {
            if (((covered >> s) & 1U) != 0) {
                shade(primitive, *planes, first, front, i, j, s, covered);
            }
        }
    }
    covered_.clear();
    shade_coarse(primitive, first, front);
}

void DrawCommand::shade_coarse(const Primitive& primitive, const WindowVertex& first, bool front) {
    for (auto& [where, fragment] : coarse_) {
        const TrianglePlanes& planes = *std::get<2>(where);
        if (device_.fault == "fragment-covered-whole"_fault) {
            fragment.covered.fill((1U << samples_.size()) - 1);
        }
        shaded_ = &fragment;
        const int64_t x1 = std::min(fragment.x + fragment.width(), rect_.x1);
        const int64_t y1 = std::min(fragment.y + fragment.height(), rect_.y1);
        for (int64_t j = std::max(fragment.y, rect_.y0); j < y1; ++j) {
            for (int64_t i = std::max(fragment.x, rect_.x0); i < x1; ++i) {
                const uint32_t covered = fragment.covered_at(i, j);
                for (uint32_t s = 0; s < samples_.size(); ++s) {
                    if (((covered >> s) & 1U) != 0) {
                        shade(primitive, planes, first, front, i, j, s, covered);
                    }
                }
            }
        }
        shaded_ = nullptr;
    }
    coarse_.clear();
}

void DrawCommand::shade(const Primitive& primitive, const TrianglePlanes& planes,
                        const WindowVertex& first, bool front, int64_t i, int64_t j, uint32_t s,
                        uint32_t covered) {
    const uint32_t layers = out_.target.layers;
    uint32_t layer = draw_.layer;
    switch (device_.fault) {
        case "layer-ignored"_fault:
            layer = 0;
            break;
        case "layer-off-by-one"_fault:
            layer = (layer + 1) % layers;
            break;
        case "layer-of-viewport"_fault:
            layer = std::min(draw_.viewport_index, layers - 1);
            break;
        case "all-layers-written"_fault:
            for (uint32_t k = 0; k < layers; ++k) {
                shade_in(k, primitive, planes, first, front, i, j, s, covered);
            }
            return;
        default:
            break;
    }
    shade_in(layer, primitive, planes, first, front, i, j, s, covered);
}

size_t DrawCommand::index_in(uint32_t layer, int64_t i, int64_t j, uint32_t s) const {
    const cases::Target& target = out_.target;
    const size_t row = size_t{layer} * target.height + static_cast<size_t>(j);
    return (row * target.width + static_cast<size_t>(i)) * target.samples + s;
}

// What the shader has of attribute a.
glm::vec4 DrawCommand::attribute_value(const TrianglePlanes& planes, const WindowVertex& first,
                                       const Invocation& invocation, size_t a, int64_t i,
                                       int64_t j) const {
    const Fault fault = device_.fault;
    const float corner = fault == "values-at-corner"_fault ? -0.5F : 0.0F;
    const float x = invocation.centre.x + corner;
    const float y = invocation.centre.y + corner;
    const float inverse_w = planes.inverse_w(x, y);
    bool flat = draw_.attributes[a].interpolation == cases::Interpolation::flat;
    if (fault == "flat-smooth"_fault) {
        flat = false;
    }
    if (fault == "smooth-flat"_fault &&
        draw_.attributes[a].interpolation == cases::Interpolation::smooth) {
        flat = true;
    }
    const bool is_sample = draw_.attributes[a].auxiliary == cases::Auxiliary::sample;
    const bool is_centroid = draw_.attributes[a].auxiliary == cases::Auxiliary::centroid;
    Place place{x, y};
    if (samples_.size() > 1 && (is_sample || is_centroid)) {
        place = is_sample ? invocation.sample : invocation.centroid;
    }
    glm::vec4 value = flat ? first.values[a]
                           : probe(draw_, device_, planes, samples_, a, i, j, place, invocation);
    if (fault == "one-over-w-cached"_fault && !flat && !interpolates(draw_.attributes[a].probe) &&
        draw_.attributes[a].interpolation == cases::Interpolation::smooth) {
        value *= planes.inverse_w(place.x, place.y) / inverse_w;
    }
    switch (draw_.attributes[a].source) {
        case cases::Source::sample_mask_in:
            value = glm::vec4(static_cast<float>(invocation.mask_in), 0, 0, 0);
            break;
        case cases::Source::sample_id:
            value = glm::vec4(static_cast<float>(invocation.sample_id), 0, 0, 0);
            break;
        case cases::Source::sample_position:
            value = {invocation.sample_position.x, invocation.sample_position.y, 0, 0};
            break;
        case cases::Source::shading_rate:
            value = glm::vec4(static_cast<float>(invocation.rate), 0, 0, 0);
            break;
        case cases::Source::vertex:
        case cases::Source::barycentric:
            break;
    }
    if (fault == "values-clamped"_fault) {
        value = glm::clamp(value, 0.0F, 1.0F);
    }
    if (fault == "components-rotated"_fault) {
        value = {value.y, value.z, value.w, value.x};
    }
    if (fault == "values-half"_fault && !flat) {
        for (int k = 0; k < 4; ++k) {
            value[k] = to_half_precision(value[k]);
        }
    }
    return value;
}

// Whether the shader discards by the sign of an attribute.
bool DrawCommand::is_negative(const TrianglePlanes& planes, const WindowVertex& first,
                              const Invocation& invocation, int64_t i, int64_t j) const {
    const Fault fault = device_.fault;
    const size_t a = fault == "discard-value-of-first"_fault ? 0 : draw_.discard_attribute;
    if (a >= draw_.attributes.size()) {
        return false;
    }
    Invocation seen = invocation;
    if (fault == "discard-value-at-centre"_fault) {
        seen.sample = seen.centroid = {static_cast<float>(i) + 0.5F, static_cast<float>(j) + 0.5F};
    }
    const glm::vec4 value = fault == "discard-value-of-vertex"_fault
                                ? first.values[a]
                                : attribute_value(planes, first, seen, a, i, j);
    const float tested = fault == "discard-value-of-second"_fault ? value.y : value.x;
    return fault == "discard-value-or-zero"_fault ? tested <= 0 : tested < 0;
}

bool DrawCommand::is_left_out_by_alpha(const TrianglePlanes& planes, const WindowVertex& first,
                                       const Invocation& invocation, int64_t i, int64_t j,
                                       uint32_t s) const {
    const Fault fault = device_.fault;
    const cases::ColorOutput& output = draw_.color;
    const bool is_on = fault == "alpha-to-coverage-of-first-draw"_fault ? first_alpha_to_coverage_
                                                                        : output.alpha_to_coverage;
    if (!is_on || !out_.target.color || fault == "alpha-to-coverage-ignored"_fault ||
        (cases::is_integer(out_.target.color->format) &&
         fault != "alpha-to-coverage-of-integers"_fault)) {
        return false;
    }
    const float alpha = fault == "alpha-to-coverage-of-one"_fault && output.alpha_to_one ? 1.0F
                        : output.attribute < 0
                            ? output.value.w
                            : attribute_value(planes, first, invocation,
                                              static_cast<size_t>(output.attribute), i, j)
                                  .w;
    const auto count = static_cast<float>(samples_.size());
    // Of four neighbours each has another threshold.
    const float threshold = device_.alpha_mask == AlphaMask::dithered
                                ? 0.125F + 0.25F * static_cast<float>((i & 1) * 2 + (j & 1))
                                : 0.5F;
    float kept = alpha > 0 ? std::floor(std::min(alpha, 1.0F) * count + threshold) : 0.0F;
    if (fault == "alpha-to-coverage-rounded-up"_fault) {
        kept = std::max(kept, 1.0F);
    } else if (fault == "alpha-to-coverage-never-full"_fault) {
        kept = std::min(kept, count - 1);
    }
    switch (device_.alpha_mask) {
        case AlphaMask::none:
            return true;
        case AlphaMask::all:
            return false;
        case AlphaMask::last:
            return static_cast<float>(s) < count - kept;
        default:
            return static_cast<float>(s) >= kept;
    }
}

// Whether the fragment shader discards the fragment.
bool DrawCommand::is_discarded(const TrianglePlanes& planes, const WindowVertex& first,
                               const Invocation& invocation, int64_t i, int64_t j, uint32_t s,
                               bool front) const {
    const Fault fault = device_.fault;
    if (fault == "discard-fragment-ignored"_fault ||
        (fault == "discard-sample-zero"_fault && s != 0)) {
        return false;
    }
    const bool is_demoted = draw_.discard_by == cases::DiscardBy::demote;
    const bool is_terminated = draw_.discard_by == cases::DiscardBy::terminate;
    if ((fault == "demote-ignored"_fault && is_demoted) ||
        (fault == "terminate-ignored"_fault && is_terminated)) {
        return false;
    }
    const bool is_quad =
        fault == "discard-by-quad"_fault || (fault == "terminate-by-quad"_fault && is_terminated);
    const bool has_odd_x = ((is_quad ? i >> 1 : i) & 1) != 0;
    const bool has_odd_y = ((is_quad ? j >> 1 : j) & 1) != 0;
    const bool is_turned = fault == "discard-turned"_fault;
    switch (fault == "discard-of-first-draw"_fault ? first_discard_ : draw_.discard) {
        case cases::Discard::odd_columns:
            return has_odd_x != is_turned;
        case cases::Discard::odd_rows:
            return has_odd_y != is_turned;
        case cases::Discard::checker:
            return (has_odd_x != has_odd_y) != is_turned;
        case cases::Discard::front:
            return front != is_turned;
        case cases::Discard::back:
            return front == is_turned;
        case cases::Discard::negative:
            return is_negative(planes, first, invocation, i, j) != is_turned;
        case cases::Discard::none:
            break;
    }
    return false;
}

// What the fragment shader writes to gl_FragDepth, if that replaces the fragment's own depth.
std::optional<float> DrawCommand::written_depth(const TrianglePlanes& planes,
                                                const Invocation& invocation, int64_t i, int64_t j,
                                                uint32_t s) const {
    const Fault fault = device_.fault;
    const std::optional<cases::FragDepth>& asked =
        fault == "frag-depth-of-first-draw"_fault ? first_depth_ : draw_.frag_depth;
    const bool is_early = draw_.early_tests && fault != "frag-depth-after-early-tests"_fault;
    if (!asked || is_early || fault == "frag-depth-ignored"_fault ||
        (fault == "frag-depth-of-sample-zero"_fault && s != 0)) {
        return std::nullopt;
    }
    if (asked->is_coord) {
        if (fault == "frag-depth-coord-at-sample"_fault) {
            const float unit = std::ldexp(1.0F, -device_.subpixel_bits);
            return planes.depth(
                static_cast<float>(i) + static_cast<float>(samples_[s].x) * unit + device_.place_x,
                static_cast<float>(j) + static_cast<float>(samples_[s].y) * unit + device_.place_y);
        }
        return planes.depth(invocation.centre.x, invocation.centre.y);
    }
    const bool is_quad = fault == "frag-depth-by-quad"_fault;
    const bool has_odd_x = ((is_quad ? i >> 1 : i) & 1) != 0;
    const bool has_odd_y = ((is_quad ? j >> 1 : j) & 1) != 0;
    const bool is_other = (asked->where == cases::Discard::odd_columns && has_odd_x) ||
                          (asked->where == cases::Discard::odd_rows && has_odd_y) ||
                          (asked->where == cases::Discard::checker && has_odd_x != has_odd_y);
    const float z = is_other ? asked->other : asked->value;
    const cases::Viewport& v = draw_.viewport;
    return fault == "frag-depth-in-range"_fault ? v.min_depth + z * (v.max_depth - v.min_depth) : z;
}

// Whether a fragment of depth z passes the depth bounds test against what sample `at` holds.
bool DrawCommand::is_in_bounds(float z, size_t at) const {
    const Fault fault = device_.fault;
    const std::optional<cases::DepthBounds>& bounds =
        fault == "bounds-of-first-draw"_fault ? first_bounds_ : draw_.depth.bounds;
    if (!bounds || (fault == "bounds-off-with-written-depth"_fault && draw_.frag_depth)) {
        return true;
    }
    if (fault == "bounds-at-draw-start"_fault || fault == "bounds-of-clear"_fault) {
        return lies_within(other_depth_[at], *bounds, device_);
    }
    const size_t tested = fault == "bounds-of-sample-zero"_fault ? at - at % samples_.size() : at;
    return lies_within(fault == "bounds-of-fragment"_fault ? z : out_.depth[tested], *bounds,
                       device_);
}

void DrawCommand::shade_in(uint32_t layer, const Primitive& primitive, const TrianglePlanes& planes,
                           const WindowVertex& first, bool front, int64_t i, int64_t j, uint32_t s,
                           uint32_t covered) {
    const Fault fault = device_.fault;
    Invocation invocation = invoke(draw_, device_, samples_, i, j, s, covered);
    if (shaded_ != nullptr) {
        coarsen(draw_, device_, samples_, *shaded_, i, j, invocation);
    }
    const auto end = [&](Ending ending) {
        const bool is_first = (covered & ((1U << s) - 1)) == 0;
        attachments_.queries.count(number_, ending, is_first, {i >> 1, j >> 1, primitive.id});
    };
    if (!invocation.is_written) {
        end(Ending::masked);
        return;
    }
    for (Place* place : {&invocation.centre, &invocation.sample, &invocation.centroid}) {
        place->x += device_.place_x;
        place->y += device_.place_y;
    }
    const bool discarded = is_discarded(planes, first, invocation, i, j, s, front);
    const bool is_early =
        fault == "discard-tests-early"_fault  ? true
        : fault == "discard-tests-late"_fault ? false
        : fault == "demote-stores-depth"_fault && draw_.discard_by == cases::DiscardBy::demote
            ? true
            : draw_.early_tests;
    if (discarded && !is_early) {
        end(Ending::discarded);
        return;
    }
    const bool is_left_out = is_left_out_by_alpha(planes, first, invocation, i, j, s);
    if (is_left_out && fault != "alpha-to-coverage-stores-depth"_fault) {
        end(Ending::masked);
        return;
    }
    const size_t at = index_in(layer, i, j, s);
    const float unit = std::ldexp(1.0F, -device_.subpixel_bits);
    const float sample_x = static_cast<float>(i) + static_cast<float>(samples_[s].x) * unit;
    const float sample_y = static_cast<float>(j) + static_cast<float>(samples_[s].y) * unit;
    float z = planes.depth(sample_x + device_.place_x, sample_y + device_.place_y);
    if (fault == "values-at-corner"_fault) {
        z = planes.depth(static_cast<float>(i), static_cast<float>(j));
    } else if (fault == "depth-at-centre"_fault) {
        z = planes.depth(static_cast<float>(i) + 0.5F, static_cast<float>(j) + 0.5F);
    } else if (fault == "fragment-depth-of-centre"_fault) {
        z = shaded_ == nullptr ? z : planes.depth(invocation.centre.x, invocation.centre.y);
    } else if (fault == "depth-samples-mirrored"_fault) {
        z = planes.depth(2 * static_cast<float>(i) + 1 - sample_x, sample_y);
    }
    const float largest = fault == "bias-exponent-of-sample"_fault ? std::fabs(z) : largest_z_;
    const cases::DepthFormat format = out_.target.depth_format;
    const float bias =
        depth_bias(draw_, format, planes.depth_dx(), planes.depth_dy(), largest, device_);
    z = fragment_depth(z, bias, draw_, format, device_);
    const float own = z;
    if (const std::optional<float> written = written_depth(planes, invocation, i, j, s)) {
        z = fragment_depth(*written, fault == "frag-depth-biased"_fault ? bias : 0, draw_, format,
                           device_);
    }
    const size_t tested = fault == "layer-depth-of-first"_fault ? index_in(0, i, j, s) : at;
    if (out_.target.has_depth && !is_in_bounds(z, tested)) {
        if (fault == "bounds-after-stencil"_fault) {
            attachments_.stencil.test(at, number_, front, false);
        } else if (fault == "bounds-fail-writes-depth"_fault && draw_.depth.write) {
            out_.depth[at] = z;
        }
        end(Ending::out_of_bounds);
        return;
    }
    const bool passes = !out_.target.has_depth ||
                        passes_depth_test(draw_, fault == "frag-depth-tested-early"_fault ? own : z,
                                          out_.depth[tested], device_);
    const bool is_left = attachments_.stencil.test(at, number_, front, passes);
    const bool is_stored = is_left || fault == "stencil-fail-writes-depth"_fault;
    if ((passes && is_stored && (draw_.depth.write || fault == "depth-write-ignored"_fault)) ||
        fault == "depth-write-before-test"_fault) {
        out_.depth[at] = z;
    }
    const bool hidden = discarded || is_left_out;
    end(!is_left  ? Ending::stencil_failed
        : !passes ? Ending::depth_failed
        : hidden  ? Ending::hidden
                  : Ending::shown);
    if (!passes || !is_left || hidden) {
        return;
    }
    out_.hits[at] += front ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 1, 0, 1);
    const bool of_piece = fault == "clip-flat-piece"_fault;
    const uint32_t id =
        fault == "primitive-id-skips-culled"_fault ? primitive.id - culled_ : primitive.id;
    out_.writers[at] = {number_, id, of_piece ? first.source : primitive.provoking,
                        capture::kClearId};

    const float corner = fault == "values-at-corner"_fault ? -0.5F : 0.0F;
    const float x = invocation.centre.x + corner;
    const float y = invocation.centre.y + corner;
    const float corner_xy = fault == "frag-coord-corner"_fault ? -0.5F : 0.0F;
    const float inverse_w = planes.inverse_w(x, y);
    float coord_z = planes.depth(x, y);
    if (fault == "depth-samples-mirrored"_fault) {
        coord_z = planes.depth(static_cast<float>(i) + 1 - static_cast<float>(samples_[0].x) * unit,
                               static_cast<float>(j) + static_cast<float>(samples_[0].y) * unit);
    }
    if (fault == "bias-halved-in-frag-coord"_fault) {
        coord_z += bias / 2;
    }
    const glm::vec4 older_frag_coord = out_.frag_coord[at];
    out_.frag_coord[at] = {invocation.frag_coord.x + corner_xy, invocation.frag_coord.y + corner_xy,
                           coord_z, fault == "frag-coord-w"_fault ? 1.0F / inverse_w : inverse_w};
    out_.frag_coord[at] = attachments_.color.beside(number_, out_.frag_coord[at], older_frag_coord);

    for (size_t a = 0; a < draw_.attributes.size(); ++a) {
        const glm::vec4 value = attribute_value(planes, first, invocation, a, i, j);
        const size_t location =
            fault == "attributes-swapped"_fault && draw_.attributes.size() > 1 && a < 2 ? 1 - a : a;
        out_.attributes[location][at] = value;
    }
    write_color(at, primitive.id);
}

void DrawCommand::write_color(size_t at, uint32_t primitive) {
    const cases::ColorOutput& output = reaching(out_.target, draw_, device_);
    attachments_.color.write(at, number_, primitive,
                             output.attribute < 0
                                 ? output.value
                                 : out_.attributes[static_cast<size_t>(output.attribute)][at]);
}

}  // namespace software
