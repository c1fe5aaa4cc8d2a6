// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/load/transform.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>

namespace cases {

namespace {

void set(Number& n, mpq_class value) {
    n = {std::move(value), false};
}

void mirror(ExactVertex& v, bool x, bool y, const mpq_class& cx, const mpq_class& cy) {
    if (x) {
        set(v.xyzw[0], 2 * cx - v.x());
    }
    if (y) {
        set(v.xyzw[1], 2 * cy - v.y());
    }
}

// Clockwise on screen, y down: the x axis turns to the y axis.
void quarter_turn(ExactVertex& v, const mpq_class& cx, const mpq_class& cy) {
    const mpq_class dx = v.x() - cx;
    const mpq_class dy = v.y() - cy;
    set(v.xyzw[0], cx - dy);
    set(v.xyzw[1], cy + dx);
}

}  // namespace

void move_vertices(LeafContext& context, const TomlValue& draw, Space space, const Target& target,
                   std::vector<ExactVertex>& vertices) {
    for (const std::string_view key : {"mirror", "rotate", "offset"}) {
        if (space == Space::clip && draw.find(key) != nullptr) {
            context.error(draw.find(key)->where, std::string(key) +
                                                     " does not go with the space \"clip\"; "
                                                     "write the vertices in pixels or ndc");
            return;
        }
    }
    mpq_class cx = 0;
    mpq_class cy = 0;
    if (space == Space::pixels) {
        cx = mpq_class(target.width, 2);
        cy = mpq_class(target.height, 2);
        cx.canonicalize();
        cy.canonicalize();
    }
    uint32_t axes = 0;
    context.read(draw, kDrawKeys, "mirror", axes);
    if (axes != 0) {
        for (ExactVertex& v : vertices) {
            mirror(v, (axes & 1U) != 0, (axes & 2U) != 0, cx, cy);
        }
    }
    if (const TomlValue* value = draw.find("rotate")) {
        const std::optional<Number> angle = context.number(*value, "rotate");
        if (angle && angle->value != 0 && angle->value != 90 && angle->value != 180 &&
            angle->value != 270) {
            context.error(value->where, "rotate is not 0, 90, 180 or 270");
            return;
        }
        const long turns = angle ? angle->value.get_num().get_si() / 90 : 0;
        if (space == Space::pixels && turns % 2 != 0 && target.width != target.height) {
            context.error(value->where,
                          "rotate by 90 or 270 needs a square target; make its sides equal");
            return;
        }
        for (ExactVertex& v : vertices) {
            for (long i = 0; i < turns; ++i) {
                quarter_turn(v, cx, cy);
            }
        }
    }
    if (const TomlValue* value = draw.find("offset")) {
        const std::optional<std::vector<Number>> offset = context.numbers(*value, "offset", 2);
        if (!offset) {
            return;
        }
        for (ExactVertex& v : vertices) {
            set(v.xyzw[0], v.x() + (*offset)[0].value);
            set(v.xyzw[1], v.y() + (*offset)[1].value);
        }
    }
}

std::optional<std::vector<uint32_t>> vertex_order(LeafContext& context, const TomlValue& draw,
                                                  Topology topology, bool indexed,
                                                  size_t vertex_count) {
    std::vector<uint32_t> order(vertex_count);
    std::iota(order.begin(), order.end(), 0U);
    const auto whole = static_cast<std::ptrdiff_t>(vertex_count / 3 * 3);
    bool reversed_winding = false;
    bool reversed_order = false;
    int64_t first = 0;
    if (!context.read(draw, kDrawKeys, "winding", reversed_winding) ||
        !context.read(draw, kDrawKeys, "first", first) ||
        !context.read(draw, kDrawKeys, "order", reversed_order)) {
        return std::nullopt;
    }
    if (!reversed_winding && !reversed_order && first == 0) {
        return order;
    }
    if (topology != Topology::triangle_list || indexed) {
        const char* key = reversed_winding ? "winding" : first != 0 ? "first" : "order";
        context.error(draw.find(key)->where,
                      std::string(key) + " needs a triangle list without indices");
        return std::nullopt;
    }
    for (std::ptrdiff_t t = 0; t < whole; t += 3) {
        const auto begin = order.begin() + t;
        if (reversed_winding) {
            std::swap(begin[1], begin[2]);
        }
        std::rotate(begin, begin + static_cast<std::ptrdiff_t>(first), begin + 3);
    }
    if (reversed_order) {
        // Reversing everything reverses each triangle too; reversing each once more undoes that.
        std::reverse(order.begin(), order.begin() + whole);
        for (std::ptrdiff_t t = 0; t < whole; t += 3) {
            std::reverse(order.begin() + t, order.begin() + t + 3);
        }
    }
    return order;
}

}  // namespace cases
