// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps that write vertices in pixels, and without what they do not need.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "fuzz/reduce/measure.hpp"
#include "fuzz/reduce/steps.hpp"
#include "fuzz/reduce/viewport.hpp"

namespace fuzz {

namespace {

// The numbers of a vertex, with z = 1/2 and w = 1 where they are left out.
std::optional<std::array<double, 4>> vertex_of(const Document& value) {
    std::array<double, 4> out = {0, 0, 0.5, 1};
    if (value.array.size() > 4) {
        return std::nullopt;
    }
    for (size_t k = 0; k < value.array.size(); ++k) {
        const std::optional<double> number = value_of(value.array[k]);
        if (!number) {
            return std::nullopt;
        }
        out.at(k) = *number;
    }
    return out;
}

// Writes the vertices of the spaces clip and ndc in pixels, in binary64: most come back as the same
// binary32 in clip space; whether it matters where one does not is asked as of any step.
bool in_pixels(Document& document, size_t draw) {
    Document* table = draw_at(document, draw);
    Document* vertices = table == nullptr ? nullptr : find(*table, "vertices");
    const std::optional<std::array<double, 2>> size = size_of(document);
    if (vertices == nullptr || !size) {
        return false;
    }
    const std::string space = space_of(*table);
    if (space == "pixels") {
        return false;
    }
    const auto [x, y, width, height] = viewport_or(*table, *size);
    for (Document& vertex : vertices->array) {
        const auto given = vertex_of(vertex);
        if (!given) {
            return false;
        }
        auto [vx, vy, vz, vw] = *given;
        if (space == "clip") {
            vx /= vw;
            vy /= vw;
            vz /= vw;
        }
        std::vector<double> out = {x + width / 2 * (vx + 1), y + height / 2 * (vy + 1), vz, vw};
        if (!std::ranges::all_of(out, [](double n) { return std::isfinite(n); })) {
            return false;  // w is 0
        }
        vertex = numbers(out);
    }
    erase(*table, "space");
    return true;
}

// Leaves z, or z and w, out of the vertices: of one vertex, or of all (SIZE_MAX).
bool shorter(Document& document, size_t draw, size_t vertex, size_t length) {
    Document* table = draw_at(document, draw);
    Document* vertices = table == nullptr ? nullptr : find(*table, "vertices");
    if (vertices == nullptr || space_of(*table) == "clip") {
        return false;
    }
    bool is_shorter = false;
    for (size_t v = 0; v < vertices->array.size(); ++v) {
        std::vector<Document>& numbers = vertices->array[v].array;
        if ((vertex == SIZE_MAX || v == vertex) && numbers.size() > length) {
            numbers.resize(length);
            is_shorter = true;
        }
    }
    return is_shorter;
}

void add_vertices(const Document& document, size_t draw, const std::string& words,
                  std::function<bool(Document&)> apply, std::vector<Step>& steps) {
    add_in_draw(document, draw, words, std::move(apply), steps).need.clear();
}

}  // namespace

void add_space_steps(const Document& document, std::vector<Step>& steps) {
    for (size_t draw = 0; draw < draw_count(document); ++draw) {
        const Document* vertices = document.find("draw")->array[draw].find("vertices");
        if (vertices == nullptr) {
            continue;
        }
        add_vertices(
            document, draw, "in pixels", [draw](Document& d) { return in_pixels(d, draw); }, steps);
        add_vertices(
            document, draw, "without z and w",
            [draw](Document& d) { return shorter(d, draw, SIZE_MAX, 2); }, steps);
        add_vertices(
            document, draw, "without w",
            [draw](Document& d) { return shorter(d, draw, SIZE_MAX, 3); }, steps);
        for (size_t v = 0; v < vertices->array.size(); ++v) {
            const size_t length = vertices->array[v].array.size();
            for (size_t fewer = 2; fewer < length; ++fewer) {
                add_vertices(
                    document, draw,
                    fmt::format("without {} of vertex {}",
                                fewer == 3    ? "w"
                                : length == 4 ? "z and w"
                                              : "z",
                                v),
                    [=](Document& d) { return shorter(d, draw, v, fewer); }, steps);
            }
        }
    }
}

}  // namespace fuzz
