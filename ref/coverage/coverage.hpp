// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Three-valued coverage of one triangle is computed twice, by ref::exact (rationals, the oracle)
// and by ref::fast (64/128-bit fixed point). Property tests hold them to the same answers.
//
// Sign and ties: y points down. The edge function is E_ab(p) = (b-a) x (p-a) = (b_x-a_x)(p_y-a_y) -
// (b_y-a_y)(p_x-a_x) (Pineda 1988; Giesen, "The barycentric conspiracy"). Vertices are taken in the
// order that makes the area positive (clockwise on screen), so inside means E > 0 for all three
// edges. A sample on an edge between two points is `either`; only profile direct3d decides it, by
// the top-left rule (is_top_left, ref/number/edge_function.hpp).
#pragma once

#include <cstdint>

#include "cases/model/case.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/triangle.hpp"
#include "ref/position/limits.hpp"
#include "ref/position/position.hpp"
#include "ref/reason/reason.hpp"

namespace ref {

enum class Coverage : uint8_t { must_not, either, must };

// Says what was decided of one triangle at one sample, and why.
struct Decision {
    Coverage coverage = Coverage::must_not;
    // Of a conservative draw: how many times more it may cover the pixel (ref/coverage/pieces.hpp).
    uint32_t further = 0;
    Reasons reasons;
};

// Says which way a triangle faces for every position that the device may use, or that this depends
// on them.
enum class Facing : uint8_t { front, back, depends };

// Holds everything about a triangle that does not depend on the sample; setup.hpp defines it.
struct TriangleSetup;

}  // namespace ref
