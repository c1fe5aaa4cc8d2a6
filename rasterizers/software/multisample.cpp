// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/multisample.hpp"

#include <algorithm>
#include <cmath>

namespace software {

namespace {

bool is_per_sample(const cases::Draw& draw, const Device& device) {
    if (device.fault == Fault::shading_once) {
        return false;
    }
    return draw.multisample.min_sample_shading.has_value() ||
           std::any_of(draw.attributes.begin(), draw.attributes.end(), [](const auto& a) {
               return a.source == cases::Source::sample_id ||
                      a.source == cases::Source::sample_position;
           });
}

uint32_t state_mask(const cases::Draw& draw, Fault fault, size_t samples) {
    const uint32_t mask = draw.multisample.sample_mask;
    switch (fault) {
        case Fault::mask_ignored:
            return 0xffffffffU;
        case Fault::mask_shifted:
            return mask << 1U;
        case Fault::mask_reversed: {
            uint32_t out = 0;
            for (size_t s = 0; s < samples; ++s) {
                out |= (mask >> s & 1U) << (samples - 1 - s);
            }
            return out;
        }
        default:
            return mask;
    }
}

}  // namespace

Invocation invoke(const cases::Draw& draw, const Device& device,
                  std::span<const SampleOffset> samples, int64_t i, int64_t j, uint32_t s,
                  uint32_t covered) {
    const Fault fault = device.fault;
    const float unit = std::ldexp(1.0F, -device.subpixel_bits);
    const auto in_pixel = [&](uint32_t k) {
        return Place{static_cast<float>(samples[k].x) * unit,
                     static_cast<float>(samples[k].y) * unit};
    };
    const auto at = [&](const Place& p) {
        return Place{static_cast<float>(i) + p.x, static_cast<float>(j) + p.y};
    };
    const auto count = static_cast<uint32_t>(samples.size());
    const uint32_t all = (1U << count) - 1;
    const uint32_t mask = state_mask(draw, fault, count);
    const uint32_t shader = draw.multisample.shader_mask.value_or(0xffffffffU);

    Invocation out;
    const uint32_t alive = covered & mask;
    const bool replaces = fault == Fault::shader_mask_replaces && draw.multisample.shader_mask;
    out.is_written = (((replaces ? covered & shader : alive & shader) >> s) & 1U) != 0;
    if (fault == Fault::shader_mask_ignored) {
        out.is_written = ((alive >> s) & 1U) != 0;
    }
    const bool per_sample = is_per_sample(draw, device);
    out.mask_in = per_sample ? 1U << s : alive;
    if (fault == Fault::mask_in_full) {
        out.mask_in = all;
    }
    out.sample_id = per_sample ? s : 0;
    out.sample_position = in_pixel(out.sample_id);
    const Place centre = at({0.5F, 0.5F});
    out.sample = at(in_pixel(s));
    out.frag_coord = per_sample && fault != Fault::frag_coord_always_centre ? out.sample : centre;
    const bool is_corner = device.corner_inputs && count > 1;
    out.centre = per_sample && device.inputs_follow_samples ? out.sample
                 : is_corner                                ? at({0.0625F, 0.9375F})
                                                            : centre;
    out.centroid = is_corner ? centre : out.centre;
    const bool is_partial = (covered & all) != all;
    if (is_partial && alive != 0 && fault != Fault::centroid_at_centre) {
        switch (device.centroid) {
            case Centroid::first_sample: {
                uint32_t first = 0;
                const uint32_t from = fault == Fault::centroid_of_uncovered ? ~alive & all : alive;
                while (((from >> first) & 1U) == 0) {
                    ++first;
                }
                out.centroid = at(in_pixel(first));
                break;
            }
            case Centroid::mean: {
                float n = 0;
                Place sum;
                for (uint32_t k = 0; k < count; ++k) {
                    if (((alive >> k) & 1U) != 0) {
                        sum = {sum.x + in_pixel(k).x, sum.y + in_pixel(k).y};
                        n += 1;
                    }
                }
                out.centroid = at({sum.x / n, sum.y / n});
                break;
            }
        }
    }
    if (fault == Fault::sample_at_centre) {
        out.sample = centre;
    }
    return out;
}

}  // namespace software
