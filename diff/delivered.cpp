// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/delivered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "cases/model/derive.hpp"
#include "diff/delivery.hpp"
#include "diff/pixel_check.hpp"

namespace diff {

std::vector<std::string> not_judged(const cases::Case& c, const capture::Delivered& planes) {
    std::vector<std::string> words;
    const auto add = [&words](bool is_missing, const std::string& word) {
        if (is_missing) {
            words.push_back(word);
        }
    };
    if (!c.blit) {
        add(planes.detail == capture::HitDetail::none, "coverage plane");
        add(planes.detail == capture::HitDetail::none ||
                planes.detail == capture::HitDetail::coverage,
            "number of hits");
        add(planes.detail != capture::HitDetail::faces, "faces");
        add(planes.draws.empty(), "writer");
        add(planes.frag_coord.empty(), "FragCoord");
        add(c.target.has_depth && planes.depth.empty(), "depth");
        for (uint32_t a = 0; a < cases::attributes_of(c); ++a) {
            add(planes.attributes.at(a).empty(), fmt::format("attribute {}", a));
        }
        add(c.target.color && planes.color.empty(), "color");
        add(c.target.has_stencil && planes.stencil.empty(), "stencil");
        add(capture::resolves_color(c.target), "resolved color");
        add(capture::resolves_depth(c.target), "resolved depth");
        add(has_pixel_rules(c) && !delivery_of(c, planes).has_all_fragments(),
            "number of invocations");
    }
    add(!c.relations.empty(), "relations");
    return words;
}

capture::Delivered judged_planes(const cases::Case& c, const capture::Capture& picture,
                                 const std::vector<std::string>& left_out) {
    const auto is_judged = [&](const std::string& word) {
        return std::ranges::find(left_out, word) == left_out.end();
    };
    capture::Delivered out;
    if (is_judged("writer")) {
        for (const capture::Writer& w : picture.writers) {
            out.draws.push_back(w.draw);
            out.primitives.push_back(w.primitive);
        }
    }
    out.frag_coord = is_judged("FragCoord") ? picture.frag_coord : out.frag_coord;
    out.depth = is_judged("depth") ? picture.depth : out.depth;
    for (uint32_t a = 0; a < cases::attributes_of(c); ++a) {
        if (is_judged(fmt::format("attribute {}", a))) {
            out.attributes.at(a) = picture.attributes.at(a);
        }
    }
    out.color = is_judged("color") ? picture.color : out.color;
    out.stencil = is_judged("stencil") ? picture.stencil : out.stencil;
    // A picture of the colour alone has no hits, though a renderer may have delivered some.
    out.detail = picture.hits.empty()          ? capture::HitDetail::none
                 : is_judged("faces")          ? capture::HitDetail::faces
                 : is_judged("number of hits") ? capture::HitDetail::total
                 : is_judged("coverage plane") ? capture::HitDetail::coverage
                                               : capture::HitDetail::none;
    for (const glm::vec4& h : picture.hits) {
        const auto front = static_cast<uint32_t>(h.x), back = static_cast<uint32_t>(h.y);
        if (out.detail == capture::HitDetail::faces) {
            out.front.push_back(front);
            out.back.push_back(back);
        } else if (out.detail != capture::HitDetail::none) {
            out.front.push_back(out.detail == capture::HitDetail::total ? front + back
                                                                        : front + back > 0);
        }
    }
    return out;
}

}  // namespace diff
