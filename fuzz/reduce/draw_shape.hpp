// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The vertices of a draw and what goes with them, as its table writes them.
#pragma once

#include <cstddef>
#include <vector>

#include "fuzz/document/document.hpp"

namespace fuzz {

// A run of vertices (or of indices between restarts) that makes triangles.
struct Segment {
    size_t begin = 0, end = 0;  // among the indices, or the vertices if there are none
};

struct DrawShape {
    bool is_list = true, is_strip = false, has_indices = false, has_restart = false;
    size_t vertices = 0;  // 0 if a generator makes them
    std::vector<Segment> segments;
    std::vector<size_t> order;  // the vertex of each element of the segments; SIZE_MAX: restart
};
DrawShape shape_of(const Document& draw);

size_t triangle_count(const DrawShape& shape, const Segment& segment);
size_t triangle_count(const DrawShape& shape);

// The vertices of all triangles, three each, the provoking one in its place: the same triangles as
// a list without indices.
std::vector<size_t> triangle_vertices(const DrawShape& shape, bool is_last_provoking);

// Gives the draw these of its vertices, in this order, with what stands one a vertex: values of
// attributes, clip and cull distances. Indices stay as they are.
void choose_vertices(Document& draw, const std::vector<size_t>& chosen);

// Removes elements [begin, end) of the indices, or of the vertices if there are none. False if
// there are not so many.
bool remove_elements(Document& draw, size_t begin, size_t end);

}  // namespace fuzz
