// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/model/triangle.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace cases {

namespace {

// Assembles the vertices of one run between restarts, of an instance whose vertices begin at
// `begin`. Numbers from first on count up the primitives.
void assemble_run(const Draw& draw, uint32_t draw_index, std::span<const uint32_t> run,
                  uint32_t begin, uint32_t& primitive, std::vector<Triangle>& out) {
    const bool is_last = draw.provoking == ProvokingVertex::last;
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t last) {
        const auto size = draw.vertex_count();
        // A vertex number out of range has no position; the loader refuses it.
        if (a < size && b < size && c < size) {
            out.push_back({draw_index,
                           primitive,
                           {begin + a, begin + b, begin + c},
                           begin + (is_last ? last : a)});
        }
        ++primitive;
    };
    const size_t n = run.size();
    if (out.empty()) {  // nearly every case has one draw of one run
        out.reserve(draw.topology == Topology::triangle_list ? n / 3 : n);
    }
    switch (draw.topology) {
        case Topology::triangle_list:
            for (size_t i = 0; i + 2 < n; i += 3) {
                add(run[i], run[i + 1], run[i + 2], run[i + 2]);
            }
            break;
        case Topology::triangle_strip:
            for (size_t i = 0; i + 2 < n; ++i) {
                add(run[i], run[i + 1 + i % 2], run[i + 2 - i % 2], run[i + 2]);
            }
            break;
        case Topology::triangle_fan:
            for (size_t i = 0; i + 2 < n; ++i) {
                add(run[i + 1], run[i + 2], run[0], run[i + 2]);
            }
            break;
    }
}

void assemble_instance(const Draw& draw, uint32_t draw_index, uint32_t begin,
                       std::vector<Triangle>& out) {
    uint32_t primitive = 0;
    if (!draw.indices) {
        std::vector<uint32_t> run(draw.vertex_count());
        std::iota(run.begin(), run.end(), 0U);
        assemble_run(draw, draw_index, run, begin, primitive, out);
        return;
    }
    std::span<const uint32_t> rest(*draw.indices);
    while (draw.primitive_restart) {
        const auto restart = std::ranges::find(rest, kRestartIndex);
        if (restart == rest.end()) {
            break;
        }
        const auto size = static_cast<size_t>(restart - rest.begin());
        assemble_run(draw, draw_index, rest.first(size), begin, primitive, out);
        rest = rest.subspan(size + 1);
    }
    assemble_run(draw, draw_index, rest, begin, primitive, out);
}

void assemble_draw(const Draw& draw, uint32_t draw_index, std::vector<Triangle>& out) {
    const size_t cleared = draw.clear ? draw.clear->rects.size() * draw.clear->layers : 0;
    for (uint32_t k = 0; k < cleared; ++k) {
        out.push_back({draw_index, k, {0, 1, 2}, 0});
    }
    for (uint32_t i = 0; i < draw.instances && !draw.clear; ++i) {
        assemble_instance(draw, draw_index, i * static_cast<uint32_t>(draw.vertex_count()), out);
    }
}

}  // namespace

std::vector<Triangle> assemble(const Case& c) {
    std::vector<Triangle> out;
    for (size_t d = 0; d < c.draws.size(); ++d) {
        assemble_draw(c.draws[d], static_cast<uint32_t>(d), out);
    }
    return out;
}

std::vector<Triangle> assemble(const Case& c, uint32_t draw) {
    std::vector<Triangle> out;
    assemble_draw(c.draws[draw], draw, out);
    return out;
}

}  // namespace cases
