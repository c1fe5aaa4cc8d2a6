// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Says where in its pixels a fragment's inputs may be evaluated.
//
// Vulkan specification, "Interpolation Decorations": "an implementation-defined position within the
// fragment area"; Centroid: one that must "also fall within the bounds of the primitive"; Sample:
// at the sample; with one sample a pixel: at the centre, or at the sample where its location can be
// chosen. Direct3D 11.3, 3.5.5 and 16.3-16.5: the centre; centroid: the centre if all samples are
// covered, else the first covered one in the order of indices, after the sample mask.
//
// Of a fragment of several pixels all this is said of its whole area (ibid.: with one sample a
// pixel "at the center of the fragment area", or "at the position of the sample being shaded", of
// which it has several; DirectX-Specs, Variable Rate Shading, "Attribute Interpolation": "the
// geometric center of the full coarse pixel area", and centroid "will consider all samples for fine
// pixels within").
#pragma once

#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "ref/value/accept/judge_candidates.hpp"
#include "ref/value/fragment/fragment_coverage.hpp"
#include "ref/value/fragment/shading_rate.hpp"
#include "ref/value/reference.hpp"

namespace ref::value {

// What the places of one fragment depend on.
struct Fragment {
    cases::SampleId id;
    const cases::Target* target = nullptr;
    const cases::Draw* draw = nullptr;
    cases::PixelBlock block;               // its pixels
    PixelCoverage coverage;                // only if an input is decorated with Centroid
    std::vector<Point<mpq_class>> region;  // likewise: pixel and primitive
};

// The alternatives that the profile allows; the likeliest stands first.
template <class T>
std::vector<Evaluation<T>> evaluations(const Fragment& fragment, cases::Profile profile);

}  // namespace ref::value
