// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// A random planar triangulation: Delaunay, by incremental insertion with Lawson's flips
// (C. L. Lawson, Software for C1 surface interpolation, 1977) and exact integer predicates.
#include <fmt/format.h>

#include <set>
#include <utility>

#include "cases/generate/delaunay.hpp"
#include "cases/generate/generator_keys.hpp"

namespace cases {

namespace {

constexpr int64_t kMaxPoints = 65536;
// Without a grid: a prime number of steps, so no inner point lies on a power-of-two grid.
constexpr int64_t kSteps = 1000003;

// The number of lattice steps over a side.
int64_t steps(GeneratorKeys& keys, const mpq_class& from, const mpq_class& to, int64_t grid) {
    if (grid == 0) {
        return kSteps;
    }
    const mpq_class first = from * mpq_class(grid);
    const mpq_class last = to * mpq_class(grid);
    if (first.get_den() != 1 || last.get_den() != 1) {
        keys.error("from", fmt::format("from and to are not multiples of 1/{}, so the mesh could "
                                       "not fill the rectangle",
                                       grid));
        return 0;
    }
    const mpq_class n = last - first;
    if (n > kMaxLattice) {
        keys.error("grid", fmt::format("the rectangle has more than {} grid steps a side; make it "
                                       "smaller or grid coarser",
                                       kMaxLattice));
        return 0;
    }
    return n.get_num().get_si();
}

}  // namespace

std::optional<Generated> generate_mesh(GeneratorKeys& keys) {
    const int64_t count = keys.integer("points", 0, kMaxPoints, std::nullopt);
    const GeneratorKeys::Rectangle r = keys.rectangle();
    const int64_t grid = keys.grid();
    const std::optional<GeneratorKeys::WRange> w = keys.w_range();
    const bool shuffle = keys.boolean("shuffle");
    Random random(keys.seed());
    if (!keys.good()) {
        return std::nullopt;
    }
    const int64_t width = steps(keys, r.from.x, r.to.x, grid);
    const int64_t height = steps(keys, r.from.y, r.to.y, grid);
    if (!keys.good()) {
        return std::nullopt;
    }
    // Rejecting repeated points stays quick while at most half of the lattice is asked for.
    if (2 * (count + 4) > (width + 1) * (height + 1)) {
        keys.error("points", "there are more points than half of the grid's; ask for fewer");
        return std::nullopt;
    }
    Triangulation mesh(width, height);
    std::set<std::pair<int64_t, int64_t>> taken = {
        {0, 0}, {width, 0}, {0, height}, {width, height}};
    while (std::ssize(taken) < count + 4) {
        const int64_t x = random.between(0, width);
        const int64_t y = random.between(0, height);
        if (taken.emplace(x, y).second) {
            mesh.insert({x, y});
        }
    }
    Generated result;
    for (const LatticePoint& p : mesh.points()) {
        mpq_class x(p.x, width);
        mpq_class y(p.y, height);
        x.canonicalize();
        y.canonicalize();
        result.vertices.push_back(
            exact_vertex(r.from.x + (r.to.x - r.from.x) * x, r.from.y + (r.to.y - r.from.y) * y));
    }
    draw_w(result.vertices, w, random);
    result.indices = mesh.indices();
    if (shuffle) {
        shuffle_triangles(*result.indices, random);
    }
    return result;
}

}  // namespace cases
