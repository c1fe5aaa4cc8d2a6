// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/depth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace software {

namespace {

double steps_of(cases::DepthFormat format) {
    return format == cases::DepthFormat::d24_unorm ? 16777215.0 : 65535.0;
}

float unit(const cases::DepthBias& bias, cases::DepthFormat format, float largest_z,
           const Device& device) {
    using Representation = cases::DepthBiasRepresentation;
    if (bias.representation == Representation::floating) {
        return 1;
    }
    const float scale = device.fault == "bias-unit-doubled"_fault ? 4 : 1;
    if (format == cases::DepthFormat::d16_unorm) {
        return scale * 0x1p-16F;
    }
    if (format == cases::DepthFormat::d24_unorm ||
        bias.representation == Representation::force_unorm) {
        return scale * 0x1p-24F;
    }
    const int exponent = largest_z > 0 ? std::max(std::ilogb(largest_z), -126) : -126;
    const int bits = device.fault == "bias-exponent"_fault ? 24 : 23;
    return std::ldexp(1.0F, exponent - bits);
}

}  // namespace

float depth_bias(const cases::Draw& draw, cases::DepthFormat format, float dzdx, float dzdy,
                 float largest_z, const Device& device) {
    if (!draw.depth.bias || device.fault == "bias-ignored"_fault) {
        return 0;
    }
    const cases::DepthBias& bias = *draw.depth.bias;
    float slope = std::max(std::fabs(dzdx), std::fabs(dzdy));
    if (device.fault == "bias-slope-x-only"_fault) {
        slope = std::fabs(dzdx);
    } else if (device.fault == "bias-slope-signed"_fault) {
        slope = std::fabs(dzdx) > std::fabs(dzdy) ? dzdx : dzdy;
    } else if (device.fault == "bias-slope-sum"_fault) {
        slope = std::fabs(dzdx) + std::fabs(dzdy);
    }
    float o = slope * bias.slope + unit(bias, format, largest_z, device) * bias.constant;
    if (device.fault == "bias-sign"_fault) {
        o = -o;
    }
    if (device.fault == "bias-clamp-ignored"_fault) {
        return o;
    }
    if (device.fault == "bias-clamp-both-ends"_fault && std::fabs(bias.clamp) > 0) {
        return std::clamp(o, -std::fabs(bias.clamp), std::fabs(bias.clamp));
    }
    return bias.clamp > 0 ? std::min(o, bias.clamp) : bias.clamp < 0 ? std::max(o, bias.clamp) : o;
}

float stored_depth(float z, cases::DepthFormat format, const Device& device) {
    if (format == cases::DepthFormat::d32_float) {
        return z;
    }
    const double steps = steps_of(format);
    const double scale = device.fault == "depth-store-scale"_fault ? steps + 1 : steps;
    const double code = std::clamp(std::nearbyint(static_cast<double>(z) * scale), 0.0, steps);
    return static_cast<float>(code / steps);
}

float fragment_depth(float z, float bias, const cases::Draw& draw, cases::DepthFormat format,
                     const Device& device) {
    float low = std::min(draw.viewport.min_depth, draw.viewport.max_depth);
    float high = std::max(draw.viewport.min_depth, draw.viewport.max_depth);
    if (device.fault == "depth-clamp-unit"_fault) {
        low = 0;
        high = 1;
    } else if (device.fault == "depth-clamp-unordered"_fault) {
        low = draw.viewport.min_depth;
        high = draw.viewport.max_depth;
    }
    const auto clamp = [&](float v) { return std::min(std::max(v, low), high); };
    if (device.fault == "depth-clamp-before-bias"_fault && draw.depth.clamp) {
        z = clamp(z) + bias;
    } else {
        z += bias;
        if (draw.depth.clamp && device.fault != "depth-clamp-ignored"_fault) {
            z = clamp(z);
        }
    }
    return device.fault == "depth-compared-unrounded"_fault ? z : stored_depth(z, format, device);
}

// A depth in 11 bits: binary16, but for its subnormal numbers.
static float as_half(float z) {
    int exponent = 0;
    const float fraction = std::frexp(z, &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(fraction, 11)), exponent - 11);
}

bool lies_within(float z, const cases::DepthBounds& bounds, const Device& device) {
    switch (device.fault) {
        case "bounds-ignored"_fault:
            return true;
        case "bounds-exclusive"_fault:
            return z > bounds.min && z < bounds.max;
        case "bounds-max-exclusive"_fault:
            return z >= bounds.min && z < bounds.max;
        case "bounds-inverted"_fault:
            return z < bounds.min || z > bounds.max;
        case "bounds-as-half"_fault:
            return z >= as_half(bounds.min) && z <= as_half(bounds.max);
        case "bounds-without-min"_fault:
            return z <= bounds.max;
        case "bounds-without-max"_fault:
            return z >= bounds.min;
        case "bounds-halved"_fault:
            return z * 2 >= bounds.min && z * 2 <= bounds.max;
        default:
            return z >= bounds.min && z <= bounds.max;
    }
}

bool passes_depth_test(const cases::Draw& draw, float z, float stored, const Device& device) {
    using cases::CompareOp;
    if (device.fault == "depth-test-ignored"_fault) {
        return true;
    }
    if (device.fault == "depth-operands-swapped"_fault) {
        std::swap(z, stored);
    }
    switch (draw.depth.compare) {
        case CompareOp::never:
            return false;
        case CompareOp::less:
            return device.fault == "depth-less-or-equal"_fault ? z <= stored : z < stored;
        case CompareOp::equal:
            return z >= stored && z <= stored;
        case CompareOp::less_or_equal:
            return z <= stored;
        case CompareOp::greater:
            return z > stored;
        case CompareOp::not_equal:
            return z < stored || z > stored;
        case CompareOp::greater_or_equal:
            return z >= stored;
        case CompareOp::always:
            break;
    }
    return true;
}

}  // namespace software
