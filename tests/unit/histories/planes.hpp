// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The planes of a picture, and which of them are delivered.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "capture/delivered.hpp"
#include "device.hpp"
#include "scene.hpp"

namespace histories {

enum PlaneNumber : uint8_t {
    kHits,
    kWriter,
    kFragCoord,
    kAttributeV,
    kAttributeA,
    kDepth,
    kColor,
    kStencil,
    kPlaneCount
};

// What each plane shows of a sample: of a right picture all show the same.
using Shown = std::array<Seen, kPlaneCount>;
inline bool is_hit(const Seen& seen) {
    return seen.draw >= 0;
}
// Attribute "v" of the fragment that wrote last, or the clear value.
float value_v(const Seen& seen);
Shown shown(const Seen& seen);
std::vector<Shown> shown(const std::vector<Seen>& picture);

struct Planes {
    uint32_t set = 0;  // bit p: plane p is delivered
    capture::HitDetail detail = capture::HitDetail::none;
    bool is_whole = false;  // a whole capture, which always has stencils, too
    bool has(PlaneNumber p) const { return (set >> p & 1) != 0; }
};

// All subsets but the empty one of the planes that the scene has, the hits in each detail.
std::vector<Planes> subsets_of(const Scene& scene);
Planes whole_of(const Scene& scene);
// Whether `fewer` tells no more than `planes`.
bool is_part(const Planes& fewer, const Planes& planes);

capture::Delivered delivered(const Scene& scene, const Planes& planes,
                             const std::vector<Shown>& picture);
// All that the case's target holds, and what queries counted.
capture::Capture captured(const Scene& scene, const cases::Target& target,
                          const std::vector<Shown>& picture, const std::vector<uint64_t>& counted);
// Whether the judge takes stencils of pictures of which not all is delivered.
bool takes_stencil();

// Whether the planes show a history; numbers that are nearer than any number that matters are the
// same. Where hits or writers tell that nothing was drawn, nobody looks at the values of fragments.
bool shows(const Scene& scene, const Planes& planes, const Shown& picture, const Seen& history);

// "hits (faces), depth", and what they show of a sample.
std::string names_of(const Planes& planes);
std::string text_of(const Scene& scene, const Planes& planes, const Shown& picture);

}  // namespace histories
