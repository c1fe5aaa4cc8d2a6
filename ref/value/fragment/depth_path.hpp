// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What becomes of an interpolated depth before it is compared and stored: depth bias, depth clamp
// and the attachment's format. Written once for exact and for filtered numbers (ball.hpp).
//
// Bias (Vulkan specification, "Depth Bias Computation"): o = dbclamp(m slope + r constant), where
// m = sqrt(zx^2 + zy^2), which "may be approximated" by max(|zx|, |zy|); zx and zy are the
// gradients of the plane. r is 2^(e-23) with a floating-point depth attachment, e the exponent of
// the largest z of the primitive (clipped or not: not said), and at most 2 2^-n with n bits of
// fixed point, more than 0 because planes r apart have to stay distinct. Direct3D 11.3, 15.10: m =
// max(|zx|, |zy|). Its r of one step is reported and not judged: drivers that take two are many,
// and Vulkan allows it. With VK_EXT_depth_bias_control r is 1 (representation float), as with fixed
// point of 24 bits (forced UNORM on binary32: "mantissa bits plus one"), and 2^-n (depthBiasExact).
#pragma once

#include <optional>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/number/plane_budget.hpp"
#include "ref/value/fragment/quantities.hpp"

namespace ref::value {

template <class T>
struct Range {
    T low{}, high{};
};

template <class T>
struct DepthPath {
    cases::DepthFormat format = cases::DepthFormat::d32_float;
    std::optional<cases::DepthBias> bias;
    bool is_clamped = false;  // depthClampEnable
    bool is_max_norm = true;  // m = max(|zx|, |zy|); otherwise anything up to the Euclidean norm
    Range<T> unit;            // r
    T nominal_unit{};         // of r, what a report tells
    Range<double> viewport;   // its depths, low <= high
};

template <class T>
DepthPath<T> make_depth_path(const Primitive& primitive, cases::Profile profile);

// All biases that a device may add whose planes are set up from `basis`, rounding included; {0, 0}
// if the draw has no bias. `factor` is K.
template <class T>
Range<T> bias_of(const DepthPath<T>& path, const Basis<T>& basis, const T& factor);

// What depthClampEnable makes of a range of depths.
template <class T>
Range<T> clamped(const Range<T>& z, const Range<double>& viewport) {
    const T low(viewport.low);
    const T high(viewport.high);
    return {smaller(larger(z.low, low), high), smaller(larger(z.high, low), high)};
}

// The bias that most devices add, for pictures: m = max(|zx|, |zy|), and r is one step of 2^-n or
// 2^(e-23).
mpq_class nominal_bias(const DepthPath<mpq_class>& path, const Basis<mpq_class>& basis);

}  // namespace ref::value
