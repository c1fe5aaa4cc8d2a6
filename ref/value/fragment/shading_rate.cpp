// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/value/fragment/shading_rate.hpp"

#include <algorithm>
#include <cmath>

namespace ref::value {

uint32_t least_invocations(const cases::Draw& draw, uint32_t samples) {
    const bool uses_sample =
        std::any_of(draw.attributes.begin(), draw.attributes.end(), [](const cases::Attribute& a) {
            return a.source == cases::Source::sample_id ||
                   a.source == cases::Source::sample_position;
        });
    if (uses_sample) {
        return samples;  // "sample shading is enabled and a value of 1.0 is used"
    }
    // max(ceil(minSampleShading x rasterizationSamples), 1); the product is exact.
    const double least = static_cast<double>(draw.multisample.min_sample_shading.value_or(0)) *
                         static_cast<double>(samples);
    return std::max(static_cast<uint32_t>(std::ceil(least)), 1U);
}

ShadingRate shading_rate(const cases::Draw& draw, uint32_t samples) {
    if (samples == 1) {
        return ShadingRate::fragment;
    }
    if (least_invocations(draw, samples) == samples) {
        return ShadingRate::sample;
    }
    if (draw.multisample.min_sample_shading) {
        return ShadingRate::some;
    }
    const bool has_sample = std::any_of(
        draw.attributes.begin(), draw.attributes.end(),
        [](const cases::Attribute& a) { return a.auxiliary == cases::Auxiliary::sample; });
    return has_sample ? ShadingRate::may_split : ShadingRate::fragment;
}

bool has_centroid(const cases::Draw& draw) {
    return std::any_of(draw.attributes.begin(), draw.attributes.end(),
                       [](const cases::Attribute& a) {
                           return a.auxiliary == cases::Auxiliary::centroid ||
                                  a.probe == cases::Probe::at_centroid;
                       });
}

}  // namespace ref::value
