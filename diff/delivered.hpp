// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Captures of renderers that deliver only some planes: a mask of what is covered, the triangles
// that wrote last, the values of one attribute.
//
// What is missing is not judged: a sample is wrong if no content of the missing planes could make
// the delivered ones right. So the missing ones are filled in with what the reference allows, as
// near to the delivered ones as can be, and the whole is compared as any capture.
#pragma once

#include <string>
#include <vector>

#include "capture/capture.hpp"
#include "diff/verdict.hpp"

namespace diff {

// How much is known of the hits of a sample.
enum class HitDetail : uint8_t {
    none,
    coverage,  // whether there was any
    total,     // how many
    faces      // how many by front and by back faces
};

// A plane that was not delivered is empty; the others have one entry a sample, as in a Capture.
struct Delivered {
    HitDetail detail = HitDetail::none;
    std::vector<uint32_t> front, back;        // coverage (0 or 1) and total stand in front alone
    std::vector<uint32_t> draws, primitives;  // kClearId where nothing was drawn; both or neither
    // Values of samples that nothing hit are not looked at. Without hits and writers a sample was
    // hit if any of these does not hold its clear value: kClearValue in x, Target::depth_clear.
    std::vector<glm::vec4> frag_coord;
    std::vector<float> depth;
    std::array<std::vector<glm::vec4>, cases::kMaxAttributes> attributes;
    std::vector<ColorCodes> color;  // stored codes, Target::color

    bool is_empty() const;
};

// What the case has and nobody can judge from these planes, in words: "depth", "writer",
// "number of hits". `c` has draws or a blit.
std::vector<std::string> not_judged(const cases::Case& c, const Delivered& planes);

// Judges the delivered planes; at least one. The colour is judged as if it were the only
// attachment. An error, never a pass, if a picture in which nothing is drawn would pass too.
Verdict compare_delivered(const cases::Case& c, const ref::Expectation& expectation,
                          const Delivered& planes);

}  // namespace diff
