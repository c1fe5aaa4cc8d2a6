// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/pieces.hpp"

namespace ref {

std::vector<InnerEdge> inner_edges(const Outline& o, const PixelArea& area) {
    std::vector<InnerEdge> out;
    // A piece without area may lie along an edge of the polygon, too.
    const bool has_flat = further_pieces(o, area) > further_pieces(o, {});
    for (uint32_t i = 0; i < o.count; ++i) {
        for (uint32_t k = i + 1; k < o.count; ++k) {
            const bool are_neighbours = k == i + 1 || k - i + 1 == o.count;
            if (has_flat || !are_neighbours) {
                out.push_back({o.boxes[i], o.boxes[k]});
            }
        }
    }
    return out;
}

}  // namespace ref
