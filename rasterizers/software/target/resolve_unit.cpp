// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/target/resolve_unit.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "rasterizers/software/target/blend_unit.hpp"
#include "rasterizers/software/target/store.hpp"

namespace software {

namespace {

using cases::Resolve;

template <class T>
T select(std::span<const T> samples, Resolve mode, Fault fault) {
    if (fault == "resolve-min-max-exchanged"_fault) {
        mode = mode == Resolve::min ? Resolve::max : mode == Resolve::max ? Resolve::min : mode;
    } else if (fault == "resolve-always-zero"_fault && mode != Resolve::average) {
        mode = Resolve::sample_zero;
    }
    switch (mode) {
        case Resolve::min:
            return *std::ranges::min_element(samples);
        case Resolve::max:
            return *std::ranges::max_element(samples);
        default:
            return fault == "resolve-last-sample"_fault ? samples.back() : samples.front();
    }
}

uint32_t average_whole(std::span<const uint32_t> samples, const Device& device) {
    uint64_t sum = 0;
    for (const uint32_t code : samples) {
        sum += code;
    }
    const uint64_t n = samples.size();
    return static_cast<uint32_t>((sum + (device.resolve_truncates ? 0 : n / 2)) / n);
}

float average_floats(std::span<const float> samples) {
    float sum = 0;
    for (const float v : samples) {
        sum += v;
    }
    return sum * (1.0F / static_cast<float>(samples.size()));
}

// Those samples of a pixel that the device takes for an average.
template <class T>
std::vector<T> averaged(std::span<const T> samples, const T& clear, Fault fault) {
    std::vector<T> out(samples.begin(), samples.end());
    switch (fault) {
        case "resolve-one-sample"_fault:
            out.resize(1);
            break;
        case "resolve-sample-lost"_fault:
            out.pop_back();
            break;
        case "resolve-weights"_fault: {  // each mean with the next sample
            out.assign({samples.back()});
            for (size_t s = 1; s < samples.size(); ++s) {
                out.insert(out.end(), out.size(), samples[samples.size() - 1 - s]);
            }
            break;
        }
        case "resolve-drawn-only"_fault: {  // samples that still hold the clear value do not count
            std::erase(out, clear);
            if (out.empty()) {
                out.push_back(clear);
            }
            break;
        }
        default:
            break;
    }
    return out;
}

uint32_t average_channel(std::span<const uint32_t> codes, Channel channel, const Device& device) {
    if (channel.number == Number::unorm || channel.number == Number::uint) {
        return average_whole(codes, device);
    }
    if (channel.number == Number::srgb && device.srgb_resolved_encoded) {
        return average_whole(codes, device);
    }
    std::vector<float> values;
    for (const uint32_t code : codes) {
        values.push_back(load_channel(code, channel, device));
    }
    return store_channel(average_floats(values), channel, device);
}

// First sample of the pixel that the device reads for a pixel.
size_t source_of(const cases::Target& target, size_t pixel, Fault fault) {
    if (fault == "resolve-shifted"_fault && pixel % target.width + 1 < target.width) {
        ++pixel;
    }
    return pixel * target.samples;
}

bool is_left_out(const cases::Target& target, size_t pixel, Fault fault) {
    if (fault == "resolve-row-lost"_fault) {
        return pixel / target.width % target.height + 1 == target.height;
    }
    if (fault == "resolve-first-layer"_fault) {
        return pixel / target.width >= target.height;
    }
    return fault == "resolve-ignored"_fault;
}

capture::ColorCodes resolve_color(std::span<const capture::ColorCodes> samples,
                                  const capture::ColorCodes& clear, const cases::Target& target,
                                  const Device& device) {
    const FormatLayout layout = layout_of(target.color->format);
    const bool is_average = target.color_resolve == Resolve::average ||
                            device.fault == "resolve-averages-integers"_fault;
    if (!is_average) {
        return select(samples, target.color_resolve, device.fault);
    }
    const std::vector<capture::ColorCodes> taken = averaged(samples, clear, device.fault);
    capture::ColorCodes out{};
    for (size_t k = 0; k < 4; ++k) {
        if (layout.channels[k].bits == 0) {
            continue;
        }
        std::vector<uint32_t> codes;
        for (const capture::ColorCodes& sample : taken) {
            codes.push_back(sample[k]);
        }
        out[k] = average_channel(codes, layout.channels[k], device);
    }
    return out;
}

float resolve_depth(std::span<const float> samples, float clear, const cases::Target& target,
                    const Device& device) {
    if (target.depth_resolve != Resolve::average) {
        return select(samples, target.depth_resolve, device.fault);
    }
    const std::vector<float> taken = averaged(samples, clear, device.fault);
    if (target.depth_format == cases::DepthFormat::d32_float) {
        return average_floats(taken);
    }
    const double steps =
        target.depth_format == cases::DepthFormat::d24_unorm ? 16777215.0 : 65535.0;
    std::vector<uint32_t> codes;
    for (const float z : taken) {
        codes.push_back(static_cast<uint32_t>(std::nearbyint(static_cast<double>(z) * steps)));
    }
    return static_cast<float>(average_whole(codes, device) / steps);
}

}  // namespace

void resolve(capture::Capture& capture, const Device& device) {
    const cases::Target& target = capture.target;
    const size_t pixels = size_t{target.width} * target.rows();
    const bool has_color = capture::resolves_color(target);
    const bool has_depth = capture::resolves_depth(target);
    const bool has_stencil = capture::resolves_stencil(target);
    capture.resolved_color.assign(has_color ? pixels : 0, {});
    capture.resolved_depth.assign(has_depth ? pixels : 0, 0);
    capture.resolved_stencil.assign(has_stencil ? pixels : 0, 0);
    capture::ColorCodes clear{};
    if (has_color) {
        const BlendUnit unit(target.color->format, device);
        clear = unit.read_back(unit.cleared(target.color->clear));
    }
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
        const size_t first = source_of(target, pixel, device.fault);
        if (is_left_out(target, pixel, device.fault)) {
            continue;
        }
        if (has_color) {
            capture.resolved_color[pixel] = resolve_color(
                std::span(capture.color).subspan(first, target.samples), clear, target, device);
        }
        if (has_depth) {
            capture.resolved_depth[pixel] =
                resolve_depth(std::span(capture.depth).subspan(first, target.samples),
                              target.depth_clear, target, device);
        }
        if (has_stencil) {
            const bool is_of_depth = device.fault == "stencil-resolve-of-depth"_fault && has_depth;
            capture.resolved_stencil[pixel] =
                select(std::span<const uint32_t>(capture.stencil).subspan(first, target.samples),
                       is_of_depth ? target.depth_resolve : target.stencil_resolve, device.fault);
        }
    }
}

}  // namespace software
