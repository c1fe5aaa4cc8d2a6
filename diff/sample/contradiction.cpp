// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/sample/contradiction.hpp"

#include <fmt/format.h>

#include "cases/base/float_bits.hpp"

namespace diff {

namespace {

using cases::same_bits;

bool is_clear(const glm::vec4& v) {
    return same_bits(v.x, capture::kClearValue) && same_bits(v.y, capture::kClearValue) &&
           same_bits(v.z, capture::kClearValue) && same_bits(v.w, capture::kClearValue);
}

std::string drawn_text(const glm::vec4& v) {
    return is_clear(v) ? "nothing drawn" : fmt::format("({}, {}, {}, {})", v.x, v.y, v.z, v.w);
}

std::string id_text(uint32_t id) {
    return id == capture::kClearId ? "none" : fmt::format("{}", id);
}

std::string drawn_text(const capture::Writer& w, bool has_primitive) {
    if (w == capture::Writer{}) {
        return "nothing drawn";
    }
    std::string text = "draw " + id_text(w.draw);
    if (has_primitive) {
        text += ", triangle " + id_text(w.primitive);
    }
    text += ", provoking vertex " + id_text(w.provoking_vertex);
    return w.spare == capture::kClearId ? text : fmt::format("{}, spare number {}", text, w.spare);
}

}  // namespace

std::string contradiction_text(const capture::CaptureView& capture, size_t index) {
    const glm::vec4& hits = capture.hits[index];
    // The last two count along, from kHitGuard on, so that a broken clear or blend is seen.
    const bool holds = same_bits(hits.z, capture::kHitGuard) &&
                       same_bits(hits.w, capture::kHitGuard + hits.x + hits.y);
    const bool is_hit = hits.x + hits.y > 0;
    std::string text = !holds ? fmt::format(
                                    "hit counter ({}, {}, {}, {}), which no fragments "
                                    "leave",
                                    hits.x, hits.y, hits.z, hits.w)
                       : is_hit ? fmt::format("hits {} front, {} back", hits.x, hits.y)
                                : "hits: nothing drawn";
    // All planes beside a broken counter, else those that disagree with it.
    const auto add = [&](bool is_drawn, const std::string& name, const std::string& said) {
        if (!holds || is_drawn != is_hit) {
            text += fmt::format("; {}: {}", name, said);
        }
    };
    const capture::Writer& w = capture.writers[index];
    const bool has_writer = w.draw != capture::kClearId &&
                            w.provoking_vertex != capture::kClearId &&
                            w.primitive != capture::kClearId && w.spare == capture::kClearId;
    add(is_hit ? has_writer : w != capture::Writer{}, "writer",
        drawn_text(w, capture.has_primitive));
    add(!is_clear(capture.frag_coord[index]), "FragCoord", drawn_text(capture.frag_coord[index]));
    if (!capture.depth.empty() && !is_hit) {  // a draw need not write depth
        const float depth = capture.depth[index];
        const bool is_drawn = !capture::is_clear_depth(capture.target, depth);
        add(is_drawn, "depth", is_drawn ? fmt::format("{}", depth) : "nothing drawn");
    }
    for (uint32_t a = 0; a < capture.attribute_count && !is_hit; ++a) {  // nor all attributes
        const glm::vec4& value = capture.attributes[a][index];
        add(!is_clear(value), fmt::format("attribute {}", a), drawn_text(value));
    }
    return text;
}

}  // namespace diff
