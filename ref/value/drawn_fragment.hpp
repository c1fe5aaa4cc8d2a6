// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A fragment as a device drew it: which of its values no set-up of a profile explains, and which
// is the loosest profile of which that is true.
#pragma once

#include <vector>

#include "ref/value/reference.hpp"
#include "ref/value/set_ups.hpp"

namespace ref::value {

struct DrawnFragment {
    SetUps& set_ups;
    uint32_t t;
    cases::SampleId id;
    const FragmentValues& device;
    const ValueSelection& selection;
    FragmentPart part = FragmentPart::all;

    const std::vector<Quantity>& quantities() const { return set_ups.quantities_of(t); }
    const Primitive& primitive() const { return set_ups.primitive(t); }
    // Whether the part of the fragment that is judged has the quantity.
    bool has(const Quantity& q) const {
        return selection.has(q.id) &&
               (part == FragmentPart::all || q.id.is_depth() == (part == FragmentPart::depth));
    }

    // The verdict by Balls, and by rationals where these do not tell; `exact_only`: the oracle, by
    // rationals alone. One candidate explains a fragment, or one explains what depends on the plane
    // of depth (FragCoord.z and the depth that is stored, which fixed-function hardware computes)
    // and one all else: no text says that both are set up from the same positions.
    CandidateVerdict verdict(cases::Profile at, bool exact_only = false) const;

    // What fails of verdict(), in any order and in less time: without ratios, unless they decide
    // which candidate is best. `suspects`: what fails at the profile that is judged.
    std::vector<size_t> failing(cases::Profile at, const std::vector<size_t>& suspects) const;
    // All that fails at vulkan, where each value stands alone, in the order of verdict(): probes
    // are behind all others.
    std::vector<size_t> failing_alone() const;

    // The loosest profile at which each failing value is wrong, given that one basis has to explain
    // all values of the fragment. A looser profile may blame values that this one does not (they
    // fit the basis that explains most); if it blames none of those that are left, they share its
    // level.
    std::vector<cases::Profile> levels_of(const std::vector<size_t>& failing) const;
};

}  // namespace ref::value
