// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/triangle.hpp"

namespace ref {

namespace {

// Assembles the vertices of one run between restarts. Numbers from first on count up the
// primitives.
void assemble_run(const cases::Draw& draw, uint32_t draw_index, const std::vector<uint32_t>& run,
                  uint32_t& primitive, std::vector<Triangle>& out) {
    const bool is_last = draw.provoking == cases::ProvokingVertex::last;
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t last) {
        const auto size = draw.positions.size();
        // A vertex number out of range has no position; the loader refuses it.
        if (a < size && b < size && c < size) {
            out.push_back({draw_index, primitive, {a, b, c}, is_last ? last : a});
        }
        ++primitive;
    };
    const size_t n = run.size();
    switch (draw.topology) {
        case cases::Topology::triangle_list:
            for (size_t i = 0; i + 2 < n; i += 3) {
                add(run[i], run[i + 1], run[i + 2], run[i + 2]);
            }
            break;
        case cases::Topology::triangle_strip:
            for (size_t i = 0; i + 2 < n; ++i) {
                add(run[i], run[i + 1 + i % 2], run[i + 2 - i % 2], run[i + 2]);
            }
            break;
        case cases::Topology::triangle_fan:
            for (size_t i = 0; i + 2 < n; ++i) {
                add(run[i + 1], run[i + 2], run[0], run[i + 2]);
            }
            break;
    }
}

}  // namespace

std::vector<Triangle> assemble(const cases::Case& c) {
    std::vector<Triangle> out;
    for (size_t d = 0; d < c.draws.size(); ++d) {
        const cases::Draw& draw = c.draws[d];
        const auto draw_index = static_cast<uint32_t>(d);
        uint32_t primitive = 0;
        std::vector<uint32_t> run;
        if (!draw.indices) {
            run.resize(draw.positions.size());
            for (size_t i = 0; i < run.size(); ++i) {
                run[i] = static_cast<uint32_t>(i);
            }
            assemble_run(draw, draw_index, run, primitive, out);
            continue;
        }
        for (const uint32_t index : *draw.indices) {
            if (draw.primitive_restart && index == cases::kRestartIndex) {
                assemble_run(draw, draw_index, run, primitive, out);
                run.clear();
            } else {
                run.push_back(index);
            }
        }
        assemble_run(draw, draw_index, run, primitive, out);
    }
    return out;
}

}  // namespace ref
