// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What fragment shaders make of an input: interpolateAt*, derivatives, textureQueryLod.
//
// A derivative is a difference of the input's values at two pixels of one quad (Vulkan
// specification, "Derivative Operations", "Quad scope"): fine, P(x+1) - P(x) of the pixel's own
// row; coarse, of any row of the quad; plain, one of the two, "consistently" for x and y. A quad is
// 2 x 2 pixels anywhere: no alignment is required. OpDPdx is correctly rounded, so a difference is
// off by the reaches of its two values and one rounding (docs/precision.md, "Derivatives").
#pragma once

#include <span>

#include "ref/value/accept/judge_candidates.hpp"
#include "ref/value/accept/quad.hpp"

namespace ref::value {

// Judges the probes (Kind::probe) against the candidates first..last of the set together. One
// arrangement of the quad has to explain all of them. What they fail goes into the verdict.
template <class T>
void judge_probes(const CandidateSet<T>& set, std::span<const Candidate<T>> candidates,
                  const Evaluation<T>& where, const Asked& asked, CandidateVerdict& verdict);

}  // namespace ref::value
