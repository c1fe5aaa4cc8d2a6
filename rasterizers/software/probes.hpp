// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// interpolateAt*, derivatives and levels of detail of the software device: quads begin at even
// pixels, plain derivatives are coarse, offsets are rounded down to 1/16.
#pragma once

#include <span>

#include "rasterizers/software/multisample.hpp"
#include "rasterizers/software/planes.hpp"

namespace software {

// What the shader writes of attribute a in pixel (i,j), whose input it evaluates at `place`.
glm::vec4 probe(const cases::Draw& draw, const Device& device, const TrianglePlanes& planes,
                std::span<const SampleOffset> samples, size_t a, int64_t i, int64_t j, Place place,
                const Invocation& invocation);

// True for interpolateAtCentroid and its like: the shader names the place.
bool interpolates(cases::Probe probe);

}  // namespace software
