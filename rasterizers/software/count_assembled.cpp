// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <set>

#include "cases/model/sample.hpp"
#include "rasterizers/software/assembly.hpp"

namespace software {

using cases::Query;

namespace {

// What the input assembly has read of a draw.
struct Stream {
    uint64_t all = 0;      // vertices
    uint64_t whole = 0;    // those of complete primitives
    uint64_t partial = 0;  // incomplete primitives
    uint64_t restarts = 0;
};

Stream read_stream(const cases::Draw& draw) {
    Stream out;
    uint64_t since = 0;  // the start or the last restart
    const auto end = [&] {
        const uint64_t left = draw.topology == cases::Topology::triangle_list ? since % 3
                              : since < 3                                     ? since
                                                                              : 0;
        out.whole += since - left;
        out.partial += left > 0 ? 1 : 0;
        since = 0;
    };
    const auto next = [&] {
        ++out.all;
        ++since;
    };
    if (draw.indices) {
        for (const uint32_t index : *draw.indices) {
            if (draw.primitive_restart && index == cases::kRestartIndex) {
                ++out.restarts;
                end();
            } else {
                next();
            }
        }
    } else {
        for (size_t k = 0; k < draw.vertex_count(); ++k) {
            next();
        }
    }
    end();
    for (uint64_t* count : {&out.all, &out.whole, &out.partial, &out.restarts}) {
        *count *= draw.instances;
    }
    return out;
}

}  // namespace

void count_assembled(const cases::Draw& draw, uint32_t number,
                     std::span<const Primitive> primitives, const Device& device,
                     QueryUnit& queries) {
    if (!cases::is_statistic(draw.query)) {
        return;
    }
    const Stream stream = read_stream(draw);
    std::set<uint32_t> distinct;
    for (const Primitive& primitive : primitives) {
        distinct.insert(primitive.vertex.begin(), primitive.vertex.end());
    }
    uint64_t vertices = device.counts_most ? stream.all : stream.whole;
    uint64_t assembled = primitives.size() + (device.counts_most ? stream.partial : 0);
    uint64_t shaded = device.counts_most ? 3 * primitives.size() : distinct.size();
    switch (device.fault) {
        case "statistics-vertices-by-primitive"_fault:
            vertices = 3 * primitives.size();
            break;
        case "statistics-vertices-cached"_fault:
            vertices = distinct.size();
            break;
        case "statistics-primitives-of-list"_fault:
            assembled = vertices / 3;
            break;
        case "statistics-restarts-counted"_fault:
            assembled += stream.restarts;
            break;
        case "statistics-shades-primitives"_fault:
            shaded = primitives.size();
            break;
        default:
            break;
    }
    queries.add(number, Query::input_vertices, vertices);
    queries.add(number, Query::input_primitives, assembled);
    queries.add(number, Query::vertex_invocations, shaded);
}

}  // namespace software
