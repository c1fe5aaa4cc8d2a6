// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Complementary clip distances: "Suppose a series of primitives is drawn where each vertex i has a
// single specified clip distance d_i (or a number of similarly specified clip distances, if
// multiple half-spaces are enabled). Next, suppose that the same series of primitives are drawn
// again with each such clip distance replaced by -d_i (and the graphics pipeline is otherwise the
// same). In this case, primitives must not be missing any pixels, and pixels must not be drawn
// twice in regions where those primitives are cut by the clip planes." (Vulkan specification,
// "Primitive Clipping".) With several distances the two draws do not fill the primitive; that no
// sample is hit twice still holds.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/model/case.hpp"
#include "cases/model/triangle.hpp"

namespace ref {

inline constexpr uint32_t kNoPartner = 0xffffffffU;

struct Complement {
    uint32_t partner = kNoPartner;  // the same triangle of the other draw
    bool fills = false;             // one distance: the two make up the triangle
};

// The partner of each triangle; empty if no two draws are complementary. Only triangles that a
// plane cuts have one: one of its distances is negative at a vertex and positive at another.
std::vector<Complement> complements_of(const cases::Case& c,
                                       const std::vector<cases::Triangle>& triangles);

}  // namespace ref
