// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The colour plane of captures that no device drew: of the reference, of an algorithm, of a
// software device in the tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "capture/capture.hpp"
#include "cases/model/case.hpp"
#include "ref/expectation/expectation.hpp"

namespace rasterizers {

// Fills the colour plane, if the case has a colour target, from the hits, writers and attributes of
// a capture drawn with instruments: the fragments that they tell of, blended as ref/color/blend.hpp
// says. What was not hit, or not by an allowed set of fragments, keeps the clear colour.
// `expectation` is that of the case. `shown`: the triangles of the fragments that show at a sample,
// where the writer and the number of hits do not say it.
void add_color_plane(capture::Capture& capture, const cases::Case& c,
                     const ref::Expectation& expectation,
                     const std::map<size_t, std::vector<uint32_t>>& shown = {});

// Takes away the planes that the target does not have.
void drop_unattached(capture::Capture& capture);

}  // namespace rasterizers
