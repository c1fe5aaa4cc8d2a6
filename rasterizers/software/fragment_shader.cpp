// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/fragment_shader.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "rasterizers/software/probes.hpp"
#include "rasterizers/software/snapping.hpp"

namespace software {

glm::vec4 FragmentShader::attribute_value(const Fragment& at, size_t a) const {
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

bool FragmentShader::is_negative(Fragment at) const {
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

bool FragmentShader::is_discarded(const Fragment& at) const {
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

std::optional<float> FragmentShader::written_depth(const Fragment& at) const {
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

bool FragmentShader::is_left_out_by_alpha(const Fragment& at) const {
    const Fault fault = device_.fault;
    const cases::ColorOutput& output = draw_.color;
    const bool is_on = fault == "alpha-to-coverage-of-first-draw"_fault
                           ? first_.color.alpha_to_coverage
                           : output.alpha_to_coverage;
    if (!is_on || !target_.color || fault == "alpha-to-coverage-ignored"_fault ||
        (cases::is_integer(target_.color->format) &&
         fault != "alpha-to-coverage-of-integers"_fault)) {
        return false;
    }
    const float alpha = fault == "alpha-to-coverage-of-one"_fault && output.alpha_to_one ? 1.0F
                        : output.from == cases::ColorFrom::texels                        ? 1.0F
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

Place FragmentShader::sample_place(const Fragment& at) const {
    const float unit = std::ldexp(1.0F, -device_.subpixel_bits);
    return {
        static_cast<float>(at.i) + static_cast<float>(samples_[at.s].x) * unit + device_.place_x,
        static_cast<float>(at.j) + static_cast<float>(samples_[at.s].y) * unit + device_.place_y};
}

}  // namespace software
