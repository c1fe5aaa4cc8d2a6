// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/draw_shape.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "fuzz/reduce/measure.hpp"

namespace fuzz {

DrawShape shape_of(const Document& draw) {
    DrawShape shape;
    if (const Document* topology = draw.find("topology")) {
        shape.is_list = topology->string == "triangle-list";
        shape.is_strip = topology->string == "triangle-strip";
    }
    if (const Document* vertices = draw.find("vertices")) {
        shape.vertices = vertices->array.size();
    }
    const Document* indices = draw.find("indices");
    if (indices == nullptr) {
        shape.order.resize(shape.vertices);
        std::iota(shape.order.begin(), shape.order.end(), size_t{0});
        shape.segments.push_back({0, shape.vertices});
        return shape;
    }
    shape.has_indices = true;
    size_t begin = 0;
    for (const Document& index : indices->array) {
        const size_t at = shape.order.size();
        if (index.is(Kind::string) && index.string == "restart") {
            shape.has_restart = true;
            shape.order.push_back(SIZE_MAX);
            shape.segments.push_back({begin, at});
            begin = at + 1;
        } else {
            // What is no index does not load.
            const double number = value_of(index).value_or(0);
            shape.order.push_back(static_cast<size_t>(std::clamp(number, 0.0, 0x1p32)));
        }
    }
    shape.segments.push_back({begin, shape.order.size()});
    return shape;
}

size_t triangle_count(const DrawShape& shape, const Segment& segment) {
    const size_t count = segment.end - segment.begin;
    return shape.is_list ? count / 3 : std::max<size_t>(count, 2) - 2;
}

size_t triangle_count(const DrawShape& shape) {
    size_t count = 0;
    for (const Segment& segment : shape.segments) {
        count += triangle_count(shape, segment);
    }
    return count;
}

// The order of vertices is that of the Vulkan specification, "Primitive Topologies"; with the last
// vertex provoking, those of odd triangles of strips and of all of fans are turned to have it last.
std::vector<size_t> triangle_vertices(const DrawShape& shape, bool is_last_provoking) {
    std::vector<size_t> out;
    for (const Segment& segment : shape.segments) {
        for (size_t i = 0; i < triangle_count(shape, segment); ++i) {
            const size_t at = segment.begin + (shape.is_list ? 3 * i : i);
            std::array<size_t, 3> corners = {at, at + 1, at + 2};
            if (shape.is_strip && i % 2 == 1) {
                corners = is_last_provoking ? std::array{at + 1, at, at + 2}
                                            : std::array{at, at + 2, at + 1};
            } else if (!shape.is_list && !shape.is_strip) {
                corners = is_last_provoking ? std::array{segment.begin, at + 1, at + 2}
                                            : std::array{at + 1, at + 2, segment.begin};
            }
            for (const size_t corner : corners) {
                out.push_back(shape.order[corner]);
            }
        }
    }
    return out;
}

namespace {

void choose(Document& values, const std::vector<size_t>& chosen) {
    std::vector<Document> out;
    out.reserve(chosen.size());
    for (const size_t k : chosen) {
        out.push_back(values.array[k]);
    }
    values.array = std::move(out);
}

}  // namespace

void choose_vertices(Document& draw, const std::vector<size_t>& chosen) {
    Document* vertices = find(draw, "vertices");
    const size_t count = vertices->array.size();
    choose(*vertices, chosen);
    for (const char* key : {"attribute", "clip_distance", "cull_distance"}) {
        Document* tables = find(draw, key);
        if (tables == nullptr) {
            continue;
        }
        for (Document& table : tables->array) {
            if (Document* values = find(table, "values");
                values != nullptr && values->array.size() == count) {
                choose(*values, chosen);
            }
        }
    }
}

bool remove_elements(Document& draw, size_t begin, size_t end) {
    if (Document* indices = find(draw, "indices")) {
        if (end > indices->array.size()) {
            return false;
        }
        indices->array.erase(indices->array.begin() + static_cast<ptrdiff_t>(begin),
                             indices->array.begin() + static_cast<ptrdiff_t>(end));
        return true;
    }
    const size_t count = shape_of(draw).vertices;
    if (end > count) {
        return false;
    }
    std::vector<size_t> kept;
    for (size_t k = 0; k < count; ++k) {
        if (k < begin || k >= end) {
            kept.push_back(k);
        }
    }
    choose_vertices(draw, kept);
    return true;
}

}  // namespace fuzz
