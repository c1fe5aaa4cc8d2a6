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
Shown shown(const Seen& seen);
std::vector<Shown> shown(const std::vector<Seen>& picture);

struct Planes {
    uint32_t set = 0;  // bit p: plane p is delivered
    capture::HitDetail detail = capture::HitDetail::none;
    bool has(PlaneNumber p) const { return (set >> p & 1) != 0; }
};

// Every plane that the scene has, hits in the order of their detail: all subsets but the empty one.
std::vector<Planes> subsets_of(const Scene& scene);

capture::Delivered delivered(const Scene& scene, const Planes& planes,
                             const std::vector<Shown>& picture);

// Whether the planes show a history; numbers that are nearer than any number that matters are the
// same. Where hits or writers tell that nothing was drawn, nobody looks at the values of fragments.
bool shows(const Scene& scene, const Planes& planes, const Shown& picture, const Seen& history);

// "hits (faces), depth", and what they show of a sample.
std::string names_of(const Planes& planes);
std::string text_of(const Scene& scene, const Planes& planes, const Shown& picture);

}  // namespace histories
