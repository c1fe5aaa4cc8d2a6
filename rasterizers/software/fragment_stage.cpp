// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/fragment_stage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/model/texels.hpp"
#include "rasterizers/software/depth.hpp"
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
      samples_(sample_offsets(c.target, device)),
      shader_(draw, first_, c.target, device, samples_) {
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
bool FragmentStage::is_before_scissor(double x, double y) const {
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
    if (device_.fault == "scissor-half-early"_fault && is_before_scissor(x, y)) {
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
    const Place place = shader_.sample_place(at);
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
    if (const std::optional<float> written = shader_.written_depth(at)) {
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
                                   {at.i >> 1, at.j >> 1, at.facet.primitive.number});
    };
    if (!invocation.is_written) {
        end(Ending::masked);
        return;
    }
    for (Place* place : {&invocation.centre, &invocation.sample, &invocation.centroid}) {
        place->x += device_.place_x;
        place->y += device_.place_y;
    }
    const bool discarded = shader_.is_discarded(at);
    const bool is_demoted = draw_.discard_by == cases::DiscardBy::demote;
    const bool is_early = fault == "discard-tests-early"_fault ||
                          (fault == "demote-stores-depth"_fault && is_demoted) ||
                          (draw_.early_tests && fault != "discard-tests-late"_fault);
    if (discarded && !is_early) {
        end(Ending::discarded);
        return;
    }
    const bool is_left_out = shader_.is_left_out_by_alpha(at);
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
        out_.attributes[location][index] = shader_.attribute_value(at, a);
    }
    write_color(index, facet.primitive.number);
}

void FragmentStage::write_color(size_t at, uint32_t primitive) {
    const cases::ColorOutput& output = reaching(out_.target, draw_, device_);
    const glm::vec4 value = output.attribute < 0
                                ? output.value
                                : out_.attributes[static_cast<size_t>(output.attribute)][at];
    attachments_.color.write(
        at, number_, primitive,
        output.from == cases::ColorFrom::texels ? cases::texel_at(value) : value);
}

}  // namespace software
