// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes outlines of a triangle: which boxes of positions the vertices of a clipped polygon have.
#pragma once

#include <span>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/triangle.hpp"
#include "ref/coverage/distance_cut.hpp"
#include "ref/coverage/setup.hpp"
#include "ref/position/clip.hpp"
#include "ref/position/limits.hpp"

namespace ref {

// What the outlines of one triangle are made from.
struct OutlineSource {
    const cases::Draw& draw;
    const cases::Triangle& triangle;
    const Limits& limits;
    cases::Profile profile;
    VertexBoxes& boxes;
    const Window& window;
    ClipInput input;
    ClipVolume volume;
};

// The outline of what `planes` leave of the triangle, and the polygon itself. False if some vertex
// has no box, or if it is only by rounding errors that nothing is left.
bool cut_outline(const OutlineSource& s, std::span<const ClipPlane> planes, Outline& out,
                 std::vector<ClippedVertex>& polygon);

// The outline cut by `planes`, which holds no border of the viewport or all of them. False as of
// cut_outline.
bool outline_by(const OutlineSource& s, std::span<const ClipPlane> planes, Outline& out);

CutSource cut_source(const OutlineSource& s);

}  // namespace ref
