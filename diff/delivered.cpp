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

namespace {

// The same planes of a picture in which nothing is drawn.
capture::Delivered cleared(const cases::Case& c, const capture::Delivered& planes) {
    capture::Delivered out = planes;
    std::ranges::fill(out.depth, cases::nearest_depth(c.target.depth_clear, c.target.depth_format));
    std::ranges::fill(out.frag_coord, glm::vec4(capture::kClearValue));
    for (auto& attribute : out.attributes) {
        std::ranges::fill(attribute, glm::vec4(capture::kClearValue));
    }
    std::ranges::fill(out.stencil, c.target.stencil_clear);
    if (!out.color.empty()) {
        const ref::color::Unit unit{c.target.color->format, cases::Profile::direct3d};
        std::ranges::fill(out.color, unit.codes_of(unit.cleared(*c.target.color)));
    }
    return out;
}

Verdict judged(const cases::Case& c, const ref::Expectation& expectation,
               const capture::Delivered& planes, Wanted wanted) {
    const capture::Capture capture = capture_of(c, expectation, planes);
    return compare_planes(c, expectation, capture, delivery_of(c, planes), wanted);
}

std::string names_of(const capture::Delivered& planes) {
    std::string names;
    const auto add = [&names](bool is_there, const std::string& name) {
        names += is_there ? (names.empty() ? "" : ", ") + name : "";
    };
    add(!planes.frag_coord.empty(), "fragcoord");
    add(!planes.depth.empty(), "depth");
    for (size_t a = 0; a < planes.attributes.size(); ++a) {
        add(!planes.attributes.at(a).empty(), fmt::format("attribute{}", a));
    }
    add(!planes.color.empty(), "color");
    add(!planes.stencil.empty(), "stencil");
    return names;
}

}  // namespace

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
        add(!delivery_of(c, planes).has_writers, "writer");
        add(planes.frag_coord.empty(), "FragCoord");
        add(c.target.has_depth && planes.depth.empty(), "depth");
        for (uint32_t a = 0; a < cases::attributes_of(c); ++a) {
            add(planes.attributes.at(a).empty(), fmt::format("attribute {}", a));
        }
        add(c.target.color && planes.color.empty(), "color");
        add(c.target.has_stencil && planes.stencil.empty(), "stencil");
        add(capture::resolves_color(c.target), "resolved color");
        add(capture::resolves_depth(c.target), "resolved depth");
        add(capture::resolves_stencil(c.target), "resolved stencil");
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

Verdict compare_delivered(const cases::Case& c, const ref::Expectation& expectation,
                          const capture::Delivered& planes) {
    Verdict verdict = judged(c, expectation, planes, Wanted::all);
    // Coverage, hits and writers say themselves what is covered.
    if (verdict.ok() && planes.detail == capture::HitDetail::none && planes.draws.empty() &&
        judged(c, expectation, cleared(c, planes), Wanted::first_finding).ok()) {
        verdict.error = fmt::format(
            "of the delivered planes ({}) a picture in which nothing is drawn would pass too; "
            "deliver coverage or hits",
            names_of(planes));
    }
    return verdict;
}

}  // namespace diff
