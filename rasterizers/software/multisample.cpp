// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/multisample.hpp"

#include <algorithm>
#include <cmath>

namespace software {

namespace {

bool is_per_sample(const cases::Draw& draw, const Device& device) {
    if (device.fault == "shading-once"_fault) {
        return false;
    }
    return draw.multisample.min_sample_shading.has_value() ||
           std::ranges::any_of(draw.attributes, [](const auto& a) {
               return a.source == cases::Source::sample_id ||
                      a.source == cases::Source::sample_position;
           });
}

uint32_t state_mask(const cases::Draw& draw, Fault fault, size_t samples) {
    const uint32_t mask = draw.multisample.sample_mask;
    switch (fault) {
        case "mask-ignored"_fault:
            return 0xffffffffU;
        case "mask-shifted"_fault:
            return mask << 1U;
        case "mask-reversed"_fault: {
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
    const bool replaces = fault == "shader-mask-replaces"_fault && draw.multisample.shader_mask;
    out.is_written = (((replaces ? covered & shader : alive & shader) >> s) & 1U) != 0;
    if (fault == "shader-mask-ignored"_fault) {
        out.is_written = ((alive >> s) & 1U) != 0;
    }
    const bool per_sample = is_per_sample(draw, device);
    out.mask_in = per_sample ? 1U << s : alive;
    if (fault == "mask-in-full"_fault) {
        out.mask_in = all;
    }
    out.sample_id = per_sample ? s : 0;
    out.sample_position = in_pixel(out.sample_id);
    const Place centre = at({0.5F, 0.5F});
    out.sample = at(in_pixel(s));
    out.frag_coord = per_sample && fault != "frag-coord-always-centre"_fault ? out.sample : centre;
    const bool is_corner = device.corner_inputs && count > 1;
    out.centre = per_sample && device.inputs_follow_samples ? out.sample
                 : is_corner                                ? at({0.0625F, 0.9375F})
                                                            : centre;
    out.centroid = is_corner ? centre : out.centre;
    const bool is_partial = (covered & all) != all;
    if (is_partial && alive != 0 && fault != "centroid-at-centre"_fault) {
        switch (device.centroid) {
            case Centroid::first_sample: {
                uint32_t first = 0;
                const uint32_t from = fault == "centroid-of-uncovered"_fault ? ~alive & all : alive;
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
    if (fault == "sample-at-centre"_fault) {
        out.sample = centre;
    }
    return out;
}

CoarseFragment coarse_fragment(const cases::Draw& draw, const Device& device, int64_t i, int64_t j,
                               int64_t left, int64_t top) {
    CoarseFragment out;
    while ((1U << out.log_width) < draw.fragment_size[0]) {
        ++out.log_width;
    }
    while ((1U << out.log_height) < draw.fragment_size[1]) {
        ++out.log_height;
    }
    int64_t from_x = 0;
    int64_t from_y = 0;
    if (device.fault == "fragment-grid-at-scissor"_fault) {
        from_x = left;
        from_y = top;
    } else if (device.fault == "fragment-grid-at-viewport"_fault) {
        from_x = static_cast<int64_t>(std::floor(draw.viewport.x));
        from_y = static_cast<int64_t>(
            std::floor(std::min(draw.viewport.y, draw.viewport.y + draw.viewport.height)));
    }
    // The bits below the size are those of the pixel in its fragment.
    out.x = from_x + (((i - from_x) >> out.log_width) << out.log_width);
    out.y = from_y + (((j - from_y) >> out.log_height) << out.log_height);
    return out;
}

void coarsen(const cases::Draw& draw, const Device& device, std::span<const SampleOffset> samples,
             const CoarseFragment& fragment, int64_t i, int64_t j, Invocation& out) {
    const Fault fault = device.fault;
    const float unit = std::ldexp(1.0F, -device.subpixel_bits);
    const auto count = static_cast<uint32_t>(samples.size());
    const uint32_t pixels = fragment.width() * fragment.height();
    const uint32_t mask = state_mask(draw, fault, count);
    out.rate = fragment.log_width << 2U | fragment.log_height;
    if (fault == "fragment-rate-exchanged"_fault) {
        out.rate = fragment.log_height << 2U | fragment.log_width;
    } else if (fault == "fragment-rate-unknown"_fault) {
        out.rate = 0;
    }
    const auto first_x = static_cast<float>(fragment.x);
    const auto first_y = static_cast<float>(fragment.y);
    const Place own{static_cast<float>(i) + 0.5F, static_cast<float>(j) + 0.5F};
    Place centre{first_x + static_cast<float>(fragment.width()) * 0.5F,
                 first_y + static_cast<float>(fragment.height()) * 0.5F};
    if (fault == "fragment-at-first-pixel"_fault) {
        centre = {first_x + 0.5F, first_y + 0.5F};
    }
    // The last pixel's samples are the mask's first.
    out.mask_in = 0;
    bool is_partial = false;
    Place first = centre;
    Place sum;
    float alive_count = 0;
    for (uint32_t k = 0; k < pixels; ++k) {
        const uint32_t pixel = pixels - 1 - k;
        const uint32_t alive = fragment.covered.at(pixel) & mask;
        const uint32_t from = fault == "fragment-mask-forwards"_fault ? pixel : k;
        out.mask_in |= from * count < 32 ? alive << (from * count) : 0U;
        for (uint32_t s = 0; s < count; ++s) {
            is_partial = is_partial || (fragment.covered.at(pixel) >> s & 1U) == 0;
            if ((alive >> s & 1U) == 0) {
                continue;
            }
            const Place at{first_x + static_cast<float>(pixel & (fragment.width() - 1)) +
                               static_cast<float>(samples[s].x) * unit,
                           first_y + static_cast<float>(pixel >> fragment.log_width) +
                               static_cast<float>(samples[s].y) * unit};
            first = alive_count > 0 ? first : at;
            sum = {sum.x + at.x, sum.y + at.y};
            alive_count += 1;
        }
    }
    out.frag_coord = fault == "fragment-coord-of-pixel"_fault ? own : centre;
    out.centre = fault == "fragment-inputs-of-pixel"_fault ? own
                 : device.coarse_inputs_at_sample          ? first
                                                           : centre;
    out.centroid = out.centre;
    if (is_partial && alive_count > 0 && fault != "centroid-at-centre"_fault) {
        out.centroid = device.centroid == Centroid::first_sample
                           ? first
                           : Place{sum.x / alive_count, sum.y / alive_count};
    }
}

}  // namespace software
