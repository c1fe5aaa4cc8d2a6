// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/pieces.hpp"

#include "ref/coverage/facing.hpp"

namespace ref {

bool may_fold(const Outline& o) {
    const AreaSigns signs = area_signs(o.vertices());
    return further_pieces(o) > 0 && signs.negative && signs.positive;
}

std::vector<InnerEdge> inner_edges(const Outline& o) {
    std::vector<InnerEdge> out;
    for (uint32_t i = 0; i < o.count; ++i) {
        for (uint32_t k = i + 2; k < o.count; ++k) {
            if (k - i + 1 < o.count) {  // the last vertex and the first are neighbours
                out.push_back({o.boxes[i], o.boxes[k]});
            }
        }
    }
    return out;
}

}  // namespace ref
