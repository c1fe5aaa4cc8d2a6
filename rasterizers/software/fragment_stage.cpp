// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/fragment_stage.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "rasterizers/software/depth.hpp"
#include "rasterizers/software/probes.hpp"
#include "rasterizers/software/snapping.hpp"
#include "rasterizers/software/target/neighbour.hpp"

namespace software {

FragmentStage::FragmentStage(const cases::Draw& draw, const cases::Case& c, uint32_t number,
                             const Device& device, const PixelRect& rect, capture::Capture& out,
                             Attachments& attachments)
    : draw_(draw),
      number_(number),
      first_(c.draws[0]),
      device_(device),
      rect_(rect),
      out_(out),
      attachments_(attachments),
      samples_(sample_offsets(c.target, device)) {
    if (device.fault == "bounds-at-draw-start"_fault) {
        other_depth_ = out.depth;
    } else if (device.fault == "bounds-of-clear"_fault) {
        other_depth_.assign(out.depth.size(), c.target.depth_clear);
    }
}

// With a guard band the viewport's rectangle is a scissor for each sample.
bool FragmentStage::inside_viewport(double x, double y) const {
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
bool FragmentStage::is_distance_clipped(const TrianglePlanes& planes, int64_t i, int64_t j,
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
bool FragmentStage::is_depth_clipped(const Facet& facet, const TrianglePlanes& planes, float x,
                                     float y) const {
    if (!facet.tests_depth) {
        return false;
    }
    const float z = planes.depth(x, y);
    const auto [low, high] = std::minmax(draw_.viewport.min_depth, draw_.viewport.max_depth);
    return !(z >= low && z <= high);
}

// With the fault that the scissor is tested by the sample, half a pixel too early.
bool FragmentStage::is_before_scissor(int64_t i, int64_t j, uint32_t s) const {
    const double unit = std::ldexp(1.0, -device_.subpixel_bits);
    const double x = static_cast<double>(i) + static_cast<double>(samples_[s].x) * unit;
    const double y = static_cast<double>(j) + static_cast<double>(samples_[s].y) * unit;
    return x < draw_.scissor.x - 0.5 || y < draw_.scissor.y - 0.5;
}

bool FragmentStage::is_seen(const Facet& facet, const TrianglePlanes& planes, double x,
                            double y) const {
    return inside_viewport(x, y) &&
           !is_depth_clipped(facet, planes, static_cast<float>(x), static_cast<float>(y));
}

void FragmentStage::cover(const Facet& facet, const TrianglePlanes& planes, int64_t i, int64_t j,
                          uint32_t s) {
    const double unit = std::ldexp(1.0, -device_.subpixel_bits);
    const double x = static_cast<double>(i) + static_cast<double>(samples_[s].x) * unit;
    const double y = static_cast<double>(j) + static_cast<double>(samples_[s].y) * unit;
    if (!is_seen(facet, planes, x, y) || is_distance_clipped(planes, i, j, s)) {
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
        shade({facet, planes, i, j, s, 1U});
    } else {
        covered_[{j, i, &planes}] |= 1U << s;
    }
}

void FragmentStage::shade_pixel(const Facet& facet, const TrianglePlanes& planes, int64_t i,
                                int64_t j, uint32_t covered) {
    for (uint32_t s = 0; s < samples_.size(); ++s) {
        if (((covered >> s) & 1U) != 0) {
            shade({facet, planes, i, j, s, covered});
        }
    }
}

void FragmentStage::shade_covered(const Facet& facet) {
    for (const auto& [where, covered] : covered_) {
        const auto& [j, i, planes] = where;
        shade_pixel(facet, *planes, i, j, covered);
    }
    covered_.clear();
    for (auto& [where, fragment] : coarse_) {
        if (device_.fault == "fragment-covered-whole"_fault) {
            fragment.covered.fill((1U << samples_.size()) - 1);
        }
        shaded_ = &fragment;
        const int64_t x1 = std::min(fragment.x + fragment.width(), rect_.x1);
        const int64_t y1 = std::min(fragment.y + fragment.height(), rect_.y1);
        for (int64_t j = std::max(fragment.y, rect_.y0); j < y1; ++j) {
            for (int64_t i = std::max(fragment.x, rect_.x0); i < x1; ++i) {
                shade_pixel(facet, *std::get<2>(where), i, j, fragment.covered_at(i, j));
            }
        }
        shaded_ = nullptr;
    }
    coarse_.clear();
}

void FragmentStage::shade(Fragment fragment) {
    const uint32_t layers = out_.target.layers;
    const bool is_everywhere = device_.fault == "all-layers-written"_fault;
    fragment.layer = is_everywhere || device_.fault == "layer-ignored"_fault ? 0
                     : device_.fault == "layer-off-by-one"_fault ? (draw_.layer + 1) % layers
                     : device_.fault == "layer-of-viewport"_fault
                         ? std::min(draw_.viewport_index, layers - 1)
                         : draw_.layer;
    for (uint32_t k = 0; k < (is_everywhere ? layers : 1); ++k) {
        shade_in_layer(fragment);
        ++fragment.layer;
    }
}

size_t FragmentStage::index_in(uint32_t layer, const Fragment& at) const {
    const cases::Target& target = out_.target;
    const size_t row = size_t{layer} * target.height + static_cast<size_t>(at.j);
    return (row * target.width + static_cast<size_t>(at.i)) * target.samples + at.s;
}

// What the shader has of attribute a.
glm::vec4 FragmentStage::attribute_value(const Fragment& at, size_t a) const {
    const Invocation& invocation = at.invocation;
    const Fault fault = device_.fault;
    const float corner = fault == "values-at-corner"_fault ? -0.5F : 0.0F;
    const float x = invocation.centre.x + corner;
    const float y = invocation.centre.y + corner;
    const float inverse_w = at.planes.inverse_w(x, y);
    const cases::Attribute& attribute = draw_.attributes[a];
    const bool is_smooth = attribute.interpolation == cases::Interpolation::smooth;
    const bool flat =
        (attribute.interpolation == cases::Interpolation::flat && fault != "flat-smooth"_fault) ||
        (is_smooth && fault == "smooth-flat"_fault);
    const bool is_sample = attribute.auxiliary == cases::Auxiliary::sample;
    const bool is_centroid = attribute.auxiliary == cases::Auxiliary::centroid;
    Place place{x, y};
    if (samples_.size() > 1 && (is_sample || is_centroid)) {
        place = is_sample ? invocation.sample : invocation.centroid;
    }
    glm::vec4 value =
        flat ? at.facet.first.values[a]
             : probe(draw_, device_, at.planes, samples_, a, at.i, at.j, place, invocation);
    if (fault == "one-over-w-cached"_fault && !flat && !interpolates(attribute.probe) &&
        is_smooth) {
        value *= at.planes.inverse_w(place.x, place.y) / inverse_w;
    }
    switch (attribute.source) {
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
bool FragmentStage::is_negative(Fragment at) const {
    const Fault fault = device_.fault;
    const size_t a = fault == "discard-value-of-first"_fault ? 0 : draw_.discard_attribute;
    if (a >= draw_.attributes.size()) {
        return false;
    }
    if (fault == "discard-value-at-centre"_fault) {
        at.invocation.sample = at.invocation.centroid = {static_cast<float>(at.i) + 0.5F,
                                                         static_cast<float>(at.j) + 0.5F};
    }
    const glm::vec4 value = fault == "discard-value-of-vertex"_fault ? at.facet.first.values[a]
                                                                     : attribute_value(at, a);
    const float tested = fault == "discard-value-of-second"_fault ? value.y : value.x;
    return fault == "discard-value-or-zero"_fault ? tested <= 0 : tested < 0;
}

// Whether alpha to coverage leaves the sample out.
bool FragmentStage::is_left_out_by_alpha(const Fragment& at) const {
    const Fault fault = device_.fault;
    const cases::ColorOutput& output = draw_.color;
    const bool is_on = fault == "alpha-to-coverage-of-first-draw"_fault
                           ? first_.color.alpha_to_coverage
                           : output.alpha_to_coverage;
    if (!is_on || !out_.target.color || fault == "alpha-to-coverage-ignored"_fault ||
        (cases::is_integer(out_.target.color->format) &&
         fault != "alpha-to-coverage-of-integers"_fault)) {
        return false;
    }
    const float alpha = fault == "alpha-to-coverage-of-one"_fault && output.alpha_to_one ? 1.0F
                        : output.attribute < 0
                            ? output.value.w
                            : attribute_value(at, static_cast<size_t>(output.attribute)).w;
    const auto count = static_cast<float>(samples_.size());
    // Of four neighbours each has another threshold.
    const float threshold = device_.alpha_mask == AlphaMask::dithered
                                ? 0.125F + 0.25F * static_cast<float>((at.i & 1) * 2 + (at.j & 1))
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
            return static_cast<float>(at.s) < count - kept;
        default:
            return static_cast<float>(at.s) >= kept;
    }
}

// Whether the fragment shader discards the fragment.
bool FragmentStage::is_discarded(const Fragment& at) const {
    const Fault fault = device_.fault;
    if (fault == "discard-fragment-ignored"_fault ||
        (fault == "discard-sample-zero"_fault && at.s != 0)) {
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
    const bool has_odd_x = ((is_quad ? at.i >> 1 : at.i) & 1) != 0;
    const bool has_odd_y = ((is_quad ? at.j >> 1 : at.j) & 1) != 0;
    const bool is_turned = fault == "discard-turned"_fault;
    switch (fault == "discard-of-first-draw"_fault ? first_.discard : draw_.discard) {
        case cases::Discard::odd_columns:
            return has_odd_x != is_turned;
        case cases::Discard::odd_rows:
            return has_odd_y != is_turned;
        case cases::Discard::checker:
            return (has_odd_x != has_odd_y) != is_turned;
        case cases::Discard::front:
            return at.facet.front != is_turned;
        case cases::Discard::back:
            return at.facet.front == is_turned;
        case cases::Discard::negative:
            return is_negative(at) != is_turned;
        case cases::Discard::none:
            break;
    }
    return false;
}

// What the fragment shader writes to gl_FragDepth, if that replaces the fragment's own depth.
std::optional<float> FragmentStage::written_depth(const Fragment& at) const {
    const Fault fault = device_.fault;
    const std::optional<cases::FragDepth>& asked =
        fault == "frag-depth-of-first-draw"_fault ? first_.frag_depth : draw_.frag_depth;
    const bool is_early = draw_.early_tests && fault != "frag-depth-after-early-tests"_fault;
    if (!asked || is_early || fault == "frag-depth-ignored"_fault ||
        (fault == "frag-depth-of-sample-zero"_fault && at.s != 0)) {
        return std::nullopt;
    }
    if (asked->is_coord) {
        const Place place =
            fault == "frag-depth-coord-at-sample"_fault ? sample_place(at) : at.invocation.centre;
        return at.planes.depth(place.x, place.y);
    }
    const bool is_quad = fault == "frag-depth-by-quad"_fault;
    const bool has_odd_x = ((is_quad ? at.i >> 1 : at.i) & 1) != 0;
    const bool has_odd_y = ((is_quad ? at.j >> 1 : at.j) & 1) != 0;
    const bool is_other = (asked->where == cases::Discard::odd_columns && has_odd_x) ||
                          (asked->where == cases::Discard::odd_rows && has_odd_y) ||
                          (asked->where == cases::Discard::checker && has_odd_x != has_odd_y);
    const float z = is_other ? asked->other : asked->value;
    const cases::Viewport& v = draw_.viewport;
    return fault == "frag-depth-in-range"_fault ? v.min_depth + z * (v.max_depth - v.min_depth) : z;
}

// Whether a fragment of depth z passes the depth bounds test against what sample `at` holds.
bool FragmentStage::is_in_bounds(float z, size_t at) const {
    const Fault fault = device_.fault;
    const std::optional<cases::DepthBounds>& bounds =
        fault == "bounds-of-first-draw"_fault ? first_.depth.bounds : draw_.depth.bounds;
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

// Where the sample is evaluated.
Place FragmentStage::sample_place(const Fragment& at) const {
    const float unit = std::ldexp(1.0F, -device_.subpixel_bits);
    return {
        static_cast<float>(at.i) + static_cast<float>(samples_[at.s].x) * unit + device_.place_x,
        static_cast<float>(at.j) + static_cast<float>(samples_[at.s].y) * unit + device_.place_y};
}

// The depth of the triangle's plane there.
float FragmentStage::plane_depth(const Fragment& at) const {
    const Fault fault = device_.fault;
    const auto i = static_cast<float>(at.i);
    const auto j = static_cast<float>(at.j);
    if (fault == "values-at-corner"_fault) {
        return at.planes.depth(i, j);
    }
    if (fault == "depth-at-centre"_fault) {
        return at.planes.depth(i + 0.5F, j + 0.5F);
    }
    if (fault == "fragment-depth-of-centre"_fault && shaded_ != nullptr) {
        return at.planes.depth(at.invocation.centre.x, at.invocation.centre.y);
    }
    if (fault == "depth-samples-mirrored"_fault) {
        const float unit = std::ldexp(1.0F, -device_.subpixel_bits);
        return at.planes.depth(2 * i + 1 - (i + static_cast<float>(samples_[at.s].x) * unit),
                               j + static_cast<float>(samples_[at.s].y) * unit);
    }
    const Place place = sample_place(at);
    return at.planes.depth(place.x, place.y);
}

// Tests bounds, stencil and depth, and stores what passes; returns how the fragment ends.
Ending FragmentStage::test(const Fragment& at, const Depths& depths, bool hidden) {
    const Fault fault = device_.fault;
    const size_t index = index_in(at.layer, at);
    const size_t tested = fault == "layer-depth-of-first"_fault ? index_in(0, at) : index;
    const bool front = at.facet.front;
    if (out_.target.has_depth && !is_in_bounds(depths.z, tested)) {
        if (fault == "bounds-after-stencil"_fault) {
            attachments_.stencil.test(index, number_, front, false);
        } else if (fault == "bounds-fail-writes-depth"_fault && draw_.depth.write) {
            out_.depth[index] = depths.z;
        }
        return Ending::out_of_bounds;
    }
    const bool passes =
        !out_.target.has_depth ||
        passes_depth_test(draw_, fault == "frag-depth-tested-early"_fault ? depths.own : depths.z,
                          out_.depth[tested], device_);
    const bool is_left = attachments_.stencil.test(index, number_, front, passes);
    const bool is_stored = is_left || fault == "stencil-fail-writes-depth"_fault;
    if ((passes && is_stored && (draw_.depth.write || fault == "depth-write-ignored"_fault)) ||
        fault == "depth-write-before-test"_fault) {
        out_.depth[index] = fault == "depth-compared-unrounded"_fault
                                ? stored_depth(depths.z, out_.target.depth_format, device_)
                                : depths.z;
    }
    return !is_left  ? Ending::stencil_failed
           : !passes ? Ending::depth_failed
           : hidden  ? Ending::hidden
                     : Ending::shown;
}

FragmentStage::Depths FragmentStage::depths_of(const Fragment& at) const {
    const Fault fault = device_.fault;
    Depths out;
    const float z = plane_depth(at);
    const float largest =
        fault == "bias-exponent-of-sample"_fault ? std::fabs(z) : at.facet.largest_z;
    const cases::DepthFormat format = out_.target.depth_format;
    out.bias =
        depth_bias(draw_, format, at.planes.depth_dx(), at.planes.depth_dy(), largest, device_);
    out.own = out.z = fragment_depth(z, out.bias, draw_, format, device_);
    if (const std::optional<float> written = written_depth(at)) {
        out.z = fragment_depth(*written, fault == "frag-depth-biased"_fault ? out.bias : 0, draw_,
                               format, device_);
    }
    return out;
}

// Discards, tests, and shows what is left.
void FragmentStage::shade_in_layer(Fragment at) {
    const Fault fault = device_.fault;
    Invocation& invocation = at.invocation;
    invocation = invoke(draw_, device_, samples_, at.i, at.j, at.s, at.covered);
    if (shaded_ != nullptr) {
        coarsen(draw_, device_, samples_, *shaded_, at.i, at.j, invocation);
    }
    const auto end = [&](Ending ending) {
        const bool is_first = (at.covered & ((1U << at.s) - 1)) == 0;
        attachments_.queries.count(number_, ending, is_first,
                                   {at.i >> 1, at.j >> 1, at.facet.primitive.id});
    };
    if (!invocation.is_written) {
        end(Ending::masked);
        return;
    }
    for (Place* place : {&invocation.centre, &invocation.sample, &invocation.centroid}) {
        place->x += device_.place_x;
        place->y += device_.place_y;
    }
    const bool discarded = is_discarded(at);
    const bool is_demoted = draw_.discard_by == cases::DiscardBy::demote;
    const bool is_early = fault == "discard-tests-early"_fault ||
                          (fault == "demote-stores-depth"_fault && is_demoted) ||
                          (draw_.early_tests && fault != "discard-tests-late"_fault);
    if (discarded && !is_early) {
        end(Ending::discarded);
        return;
    }
    const bool is_left_out = is_left_out_by_alpha(at);
    if (is_left_out && fault != "alpha-to-coverage-stores-depth"_fault) {
        end(Ending::masked);
        return;
    }
    const Depths depths = depths_of(at);
    const Ending ending = test(at, depths, discarded || is_left_out);
    end(ending);
    if (ending == Ending::shown) {
        show(at, depths.bias);
    }
}

// Writes what the instruments tell of the fragment, and its colour.
void FragmentStage::show(const Fragment& at, float bias) {
    const Fault fault = device_.fault;
    const size_t index = index_in(at.layer, at);
    const Facet& facet = at.facet;
    out_.hits[index] += facet.front ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 1, 0, 1);
    const bool of_piece = fault == "clip-flat-piece"_fault;
    out_.writers[index] = {number_, facet.id,
                           of_piece ? facet.first.source : facet.primitive.provoking,
                           capture::kClearId};

    const float corner = fault == "values-at-corner"_fault ? -0.5F : 0.0F;
    const float x = at.invocation.centre.x + corner;
    const float y = at.invocation.centre.y + corner;
    const float corner_xy = fault == "frag-coord-corner"_fault ? -0.5F : 0.0F;
    const float inverse_w = at.planes.inverse_w(x, y);
    float coord_z = at.planes.depth(x, y);
    if (fault == "depth-samples-mirrored"_fault) {
        const float unit = std::ldexp(1.0F, -device_.subpixel_bits);
        coord_z =
            at.planes.depth(static_cast<float>(at.i) + 1 - static_cast<float>(samples_[0].x) * unit,
                            static_cast<float>(at.j) + static_cast<float>(samples_[0].y) * unit);
    }
    if (fault == "bias-halved-in-frag-coord"_fault) {
        coord_z += bias / 2;
    }
    const Place& coord = at.invocation.frag_coord;
    out_.frag_coord[index] =
        attachments_.color.beside(number_,
                                  {coord.x + corner_xy, coord.y + corner_xy, coord_z,
                                   fault == "frag-coord-w"_fault ? 1.0F / inverse_w : inverse_w},
                                  out_.frag_coord[index]);

    for (size_t a = 0; a < draw_.attributes.size(); ++a) {
        const size_t location =
            fault == "attributes-swapped"_fault && draw_.attributes.size() > 1 && a < 2 ? 1 - a : a;
        out_.attributes[location][index] = attribute_value(at, a);
    }
    write_color(index, facet.primitive.id);
}

void FragmentStage::write_color(size_t at, uint32_t primitive) {
    const cases::ColorOutput& output = reaching(out_.target, draw_, device_);
    attachments_.color.write(at, number_, primitive,
                             output.attribute < 0
                                 ? output.value
                                 : out_.attributes[static_cast<size_t>(output.attribute)][at]);
}

}  // namespace software
