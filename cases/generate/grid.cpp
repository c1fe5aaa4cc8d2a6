// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The generators whose shape is regular: grid, fan and strip.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cases/generate/generator_keys.hpp"

namespace cases {

namespace {

constexpr std::array<std::string_view, 3> kDiagonal = {"down", "up", "random"};
constexpr int64_t kMaxCells = 4096;  // a side
constexpr int64_t kJitterSteps = 1 << 20;

// A displacement in [-reach, reach]: a multiple of 1/grid, or of reach / 2^20 without a grid.
mpq_class displacement(const mpq_class& reach, int64_t grid, Random& random) {
    mpq_class result;
    if (grid == 0) {
        result = mpq_class(random.between(-kJitterSteps, kJitterSteps), kJitterSteps);
        result.canonicalize();
        return result * reach;
    }
    const long steps = floor_of(reach * mpq_class(grid)).get_si();
    result = mpq_class(random.between(-steps, steps), grid);
    result.canonicalize();
    return result;
}

mpq_class part(const mpq_class& from, const mpq_class& to, int64_t i, int64_t n) {
    mpq_class share(i, n);
    share.canonicalize();
    return from + (to - from) * share;
}

bool check_vertex_count(GeneratorKeys& keys, const char* key, int64_t vertices) {
    if (vertices > static_cast<int64_t>(kMaxVertices)) {
        keys.error(key, fmt::format("{} vertices are too many; a draw has at most {}", vertices,
                                    kMaxVertices));
        return false;
    }
    return true;
}

std::vector<ExactVertex> to_vertices(const std::vector<ExactPoint>& points) {
    std::vector<ExactVertex> vertices;
    vertices.reserve(points.size());
    for (const ExactPoint& p : points) {
        vertices.push_back(exact_vertex(p.x, p.y));
    }
    return vertices;
}

}  // namespace

// Cells of a rectangle, each cut by a diagonal. A cell that its own diagonal would fold (because
// jitter made it concave) takes the other one, so the mesh covers each point once.
std::optional<Generated> generate_grid(GeneratorKeys& keys) {
    const int64_t columns = keys.integer("columns", 1, kMaxCells, std::nullopt);
    const int64_t rows = keys.integer("rows", 1, kMaxCells, std::nullopt);
    const GeneratorKeys::Rectangle r = keys.rectangle();
    const mpq_class jitter = keys.length("jitter", mpq_class(0));
    const int64_t grid = keys.grid();
    const size_t diagonal = keys.word("diagonal", kDiagonal, 0);
    const std::optional<GeneratorKeys::WRange> w = keys.w_range();
    const bool shuffle = keys.boolean("shuffle");
    Random random(keys.seed());
    if (!keys.good() || !check_vertex_count(keys, "columns", (columns + 1) * (rows + 1))) {
        return std::nullopt;
    }
    // Below half a cell, rounding included, the vertices stay in disjoint boxes: every cell is a
    // simple quadrilateral, which always has a diagonal inside.
    const mpq_class reach = jitter + (grid == 0 ? mpq_class(0) : mpq_class(1, 2 * grid));
    const mpq_class cell_x = (r.to.x - r.from.x) / mpq_class(columns);
    const mpq_class cell_y = (r.to.y - r.from.y) / mpq_class(rows);
    if (2 * reach >= std::min(cell_x, cell_y)) {
        keys.error("jitter",
                   "jitter and rounding reach half a cell; make jitter smaller, grid "
                   "finer or cells larger");
        return std::nullopt;
    }
    std::vector<ExactPoint> points;
    for (int64_t j = 0; j <= rows; ++j) {
        for (int64_t i = 0; i <= columns; ++i) {
            ExactPoint p{part(r.from.x, r.to.x, i, columns), part(r.from.y, r.to.y, j, rows)};
            if (i > 0 && i < columns && j > 0 && j < rows && jitter > 0) {
                p.x += displacement(jitter, grid, random);
                p.y += displacement(jitter, grid, random);
            }
            points.push_back(on_grid(p, grid));
        }
    }
    Generated result;
    result.vertices = to_vertices(points);
    draw_w(result.vertices, w, random);
    result.indices.emplace();
    for (int64_t j = 0; j < rows; ++j) {
        for (int64_t i = 0; i < columns; ++i) {
            const auto a = static_cast<uint32_t>(j * (columns + 1) + i);  // top left
            const uint32_t b = a + 1;                                     // top right
            const uint32_t c = a + static_cast<uint32_t>(columns) + 1;    // bottom left
            const uint32_t d = c + 1;                                     // bottom right
            // Counter-clockwise on screen: a front face.
            const std::array<uint32_t, 6> down = {a, d, b, a, c, d};
            const std::array<uint32_t, 6> up = {a, c, b, b, c, d};
            const auto folds = [&](const std::array<uint32_t, 6>& cut) {
                return twice_area(points[cut[0]], points[cut[1]], points[cut[2]]) >= 0 ||
                       twice_area(points[cut[3]], points[cut[4]], points[cut[5]]) >= 0;
            };
            bool take_up = diagonal == 1 || (diagonal == 2 && random.between(0, 1) == 1);
            take_up = take_up != folds(take_up ? up : down);
            const std::array<uint32_t, 6>& cut = take_up ? up : down;
            if (folds(cut)) {
                keys.error("jitter", fmt::format("cell ({}, {}) has no area; make grid finer or "
                                                 "jitter smaller",
                                                 i, j));
                return std::nullopt;
            }
            result.indices->insert(result.indices->end(), cut.begin(), cut.end());
        }
    }
    if (shuffle) {
        shuffle_triangles(*result.indices, random);
    }
    return result;
}

// Points on a circle by the rational parametrization ((1-t^2)/(1+t^2), 2t/(1+t^2)), t uniform in
// each quadrant: exact, and the same on every machine (a cosine is not).
std::optional<Generated> generate_fan(GeneratorKeys& keys) {
    const ExactPoint center_given = keys.point("center", std::nullopt);
    const mpq_class radius = keys.length("radius", std::nullopt);
    const int64_t count =
        keys.integer("count", 3, static_cast<int64_t>(kMaxVertices) - 2, std::nullopt);
    const int64_t grid = keys.grid();
    const std::optional<GeneratorKeys::WRange> w = keys.w_range();
    Random random(keys.seed());
    if (!keys.good()) {
        return std::nullopt;
    }
    const ExactPoint center = on_grid(center_given, grid);
    std::vector<ExactPoint> points = {center};
    for (int64_t i = 0; i < count; ++i) {
        mpq_class t(4 * i % count, count);
        t.canonicalize();
        mpq_class x = radius * (1 - t * t) / (1 + t * t);
        mpq_class y = -radius * 2 * t / (1 + t * t);  // upward: counter-clockwise on screen
        for (int64_t quadrant = 4 * i / count; quadrant > 0; --quadrant) {
            const mpq_class turned = y;
            y = -x;
            x = turned;
        }
        points.push_back(on_grid({center.x + x, center.y + y}, grid));
    }
    points.push_back(points[1]);
    for (size_t i = 1; i + 1 < points.size(); ++i) {
        if (twice_area(center, points[i], points[i + 1]) >= 0) {
            keys.error("count", fmt::format("triangle {} of the fan has no area; make count "
                                            "smaller, radius larger or grid finer",
                                            i - 1));
            return std::nullopt;
        }
    }
    Generated result;
    result.topology = Topology::triangle_fan;
    result.vertices = to_vertices(points);
    draw_w(result.vertices, w, random);
    result.vertices.back() = result.vertices[1];
    return result;
}

// Vertices alternate between the top and the bottom side of the rectangle, ends at its corners.
std::optional<Generated> generate_strip(GeneratorKeys& keys) {
    const GeneratorKeys::Rectangle r = keys.rectangle();
    const int64_t count =
        keys.integer("count", 1, static_cast<int64_t>(kMaxVertices) - 2, std::nullopt);
    const int64_t grid = keys.grid();
    const mpq_class jitter = keys.length("jitter", mpq_class(0));
    const std::optional<GeneratorKeys::WRange> w = keys.w_range();
    Random random(keys.seed());
    if (!keys.good()) {
        return std::nullopt;
    }
    std::vector<ExactPoint> points;
    for (int64_t i = 0; i < count + 2; ++i) {
        const int64_t on_side = i % 2 == 0 ? (count + 3) / 2 : (count + 2) / 2;  // vertices there
        const int64_t k = i / 2;
        ExactPoint p{part(r.from.x, r.to.x, k, std::max<int64_t>(on_side - 1, 1)),
                     i % 2 == 0 ? r.from.y : r.to.y};
        if (k > 0 && k + 1 < on_side && jitter > 0) {
            p.x += displacement(jitter, grid, random);
            p.y += displacement(jitter, grid, random);
        }
        points.push_back(on_grid(p, grid));
        if (i < 2) {
            continue;
        }
        const auto last = static_cast<size_t>(i);
        const mpq_class area = twice_area(points[last - 2], points[last - 1], points[last]);
        if (i % 2 == 0 ? area >= 0 : area <= 0) {
            keys.error("jitter", fmt::format("triangle {} of the strip folds over; make jitter or "
                                             "count smaller",
                                             i - 2));
            return std::nullopt;
        }
    }
    Generated result;
    result.topology = Topology::triangle_strip;
    result.vertices = to_vertices(points);
    draw_w(result.vertices, w, random);
    return result;
}

}  // namespace cases
