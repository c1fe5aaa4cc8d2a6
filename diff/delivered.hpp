// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Captures of renderers that deliver only some planes: a mask of what is covered, the triangles
// that wrote last, the values of one attribute.
//
// Nothing is filled in for the others: a sample is right if one path of its fragments satisfies all
// planes that were delivered (diff/observers.hpp).
#pragma once

#include <string>
#include <vector>

#include "capture/capture.hpp"
#include "capture/delivered.hpp"
#include "diff/verdict.hpp"

namespace diff {

// What the case has and nobody can judge from these planes, in words: "depth", "writer",
// "number of hits". `c` has draws or a blit.
std::vector<std::string> not_judged(const cases::Case& c, const capture::Delivered& planes);

// The planes of a whole picture but those that not_judged() named of another one, so that both are
// judged alike. `c` has draws.
capture::Delivered judged_planes(const cases::Case& c, const capture::Capture& picture,
                                 const std::vector<std::string>& left_out);

// Judges the delivered planes; at least one. An error, never a pass, if a picture in which nothing
// is drawn would pass too.
Verdict compare_delivered(const cases::Case& c, const ref::Expectation& expectation,
                          const capture::Delivered& planes);

}  // namespace diff
