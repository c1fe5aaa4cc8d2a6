// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Some values of a fragment are one of a few exact numbers: FragCoord.xy, gl_SampleMaskIn,
// gl_SampleID and gl_SamplePosition.
//
// Vulkan specification, "Built-In Variables". FragCoord.xy: "the location of the center of the
// fragment", or with sample shading "of one of the samples corresponding to the shader invocation".
// SampleMask: "the subset of the covered samples for the fragment that correspond to the
// invocation", each covered sample in exactly one of them. How the samples are handed to fewer
// invocations than samples is free; that an invocation a sample has the sample itself is practice.
#pragma once

#include <array>
#include <string>

#include "ref/value/fragment/fragment_coverage.hpp"
#include "ref/value/fragment/quantities.hpp"
#include "ref/value/places.hpp"
#include "ref/value/reference.hpp"

namespace ref::value {

// What the depth attachment may hold of a number that the fragment shader wrote: itself, clamped if
// depth is, or in fixed point either neighbour, with 16 bits at profile direct3d within 0.6 of a
// step (Direct3D 11.3, 3.2.3.6). A depth beyond the viewport's that is not clamped is undefined.
class StoredDepth {
  public:
    StoredDepth(const cases::Draw& draw, cases::DepthFormat format, float written);
    bool may_be(float stored, cases::Profile profile) const;
    float nominal() const;     // the likeliest
    std::string text() const;  // "0.25 exactly", "0.24999619 or 0.25001144"
    std::array<double, 2> range() const;

  private:
    cases::DepthFormat format_;
    double steps_;
    bool is_free_;
    float z_;
    double exact_ = 0;            // in steps
    float low_ = z_, high_ = z_;  // the neighbours in fixed point
};

bool is_sample_kind(Kind kind);

// Whether a device may have the value of a quantity of these kinds under the profile.
// `fragment.coverage` is that of the profile.
bool may_be(const Fragment& fragment, const Quantity& quantity, const FragmentValues& device,
            cases::Profile profile);

// The likeliest number; what is allowed besides it, as "or 1.375, 1.875", empty if nothing is;
// and all that is allowed in words.
float nominal_number(const Fragment& fragment, const Quantity& quantity);
std::string also_allowed(const Fragment& fragment, const Quantity& quantity,
                         cases::Profile profile);
std::string allowed_text(const Fragment& fragment, const Quantity& quantity,
                         cases::Profile profile);

}  // namespace ref::value
