// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/coverage/vertex_boxes.hpp"

#include "ref/position/clip.hpp"

namespace ref {

VertexBoxes::VertexBoxes(const cases::Case& c, const Limits& limits, cases::Profile profile)
    : case_(c), limits_(limits), profile_(profile), entries_(c.draws.size()) {
    for (size_t d = 0; d < c.draws.size(); ++d) {
        entries_[d].resize(c.draws[d].positions.size());
    }
}

const std::optional<Box>& VertexBoxes::of(uint32_t draw, uint32_t vertex) {
    Entry& entry = entries_[draw][vertex];
    if (!entry.is_known) {
        const cases::Draw& d = case_.draws[draw];
        entry.box = position_box(d.positions[vertex], d.viewport, limits_, profile_);
        entry.is_known = true;
    }
    return entry.box;
}

const Box* VertexBoxes::inside_view(uint32_t draw, uint32_t vertex) {
    Entry& entry = entries_[draw][vertex];
    if (entry.view == View::unknown) {
        const glm::vec4& clip = case_.draws[draw].positions[vertex];
        entry.view =
            is_representable(clip, profile_) && is_inside(clip) ? View::inside : View::outside;
    }
    if (entry.view == View::outside) {
        return nullptr;
    }
    const std::optional<Box>& box = of(draw, vertex);
    return box ? &*box : nullptr;
}

}  // namespace ref
