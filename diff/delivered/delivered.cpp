// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/delivered/delivered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "cases/model/derive.hpp"
#include "diff/color.hpp"
#include "diff/delivered/completion.hpp"
#include "diff/pixel_check.hpp"
#include "ref/color/color.hpp"
#include "ref/stencil/outcome.hpp"

namespace diff {

namespace {

constexpr const char* kEmptyPasses =
    "of the delivered planes ({}) a picture in which nothing is drawn would pass too; deliver "
    "coverage or hits";

bool has_instrument_planes(const capture::Delivered& planes) {
    capture::Delivered others = planes;
    others.color.clear();
    return !others.is_empty();
}

// The case with the planes that count hits and hold values, and nothing that follows from others.
cases::Case with_instruments(const cases::Case& c) {
    cases::Case out = c;
    out.target.has_instruments = true;
    out.target.has_depth = true;
    out.target.has_stencil = ref::stencil::is_needed(c);  // it says what is drawn
    out.target.color.reset();
    out.target.color_resolve = cases::Resolve::none;
    out.target.depth_resolve = cases::Resolve::none;
    for (cases::Draw& draw : out.draws) {
        draw.query = cases::Query::none;  // planes alone are delivered
        // What is left of its coverage does not depend on what is compared.
        draw.color.alpha_to_coverage =
            draw.color.alpha_to_coverage && c.target.color && !is_integer(c.target.color->format);
    }
    return out;
}

// The case with its colour target alone.
cases::Case with_color_only(const cases::Case& c) {
    cases::Case out = with_instruments(c);
    out.target.color = c.target.color;
    out.target.has_instruments = false;
    out.target.has_depth = false;
    return out;
}

Verdict compare_instruments(const cases::Case& c, const ref::Expectation& expectation,
                            const capture::Delivered& planes) {
    const cases::Case plain = with_instruments(c);
    const capture::Capture capture = completed(plain, expectation, planes);
    return compare(plain, expectation, capture, Wanted::all, selection_of(planes));
}

// What other planes tell of the fragments behind the colours, if those are the numbers of hits and
// the writers; else nothing. Of a writer that is none of the draws' the marks tell.
std::vector<ref::ColorWitness> witnesses_of(const cases::Case& c,
                                            const ref::Expectation& expectation,
                                            const capture::Delivered& planes) {
    const bool has_counts =
        planes.detail == capture::HitDetail::faces || planes.detail == capture::HitDetail::total;
    if (!has_counts || planes.draws.empty()) {
        return {};
    }
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> numbers;
    for (uint32_t t = 0; t < expectation.triangles.size(); ++t) {
        numbers.emplace(
            std::pair(expectation.triangles[t].draw, expectation.triangles[t].primitive), t);
    }
    std::vector<ref::ColorWitness> out(planes.draws.size());
    for (size_t index = 0; index < out.size(); ++index) {
        ref::ColorWitness& witness = out[index];
        witness.hits = planes.front[index] + (planes.back.empty() ? 0 : planes.back[index]);
        const auto found = numbers.find({planes.draws[index], planes.primitives[index]});
        if (found == numbers.end()) {
            continue;
        }
        witness.writer = found->second;
        const int32_t attribute = c.draws[planes.draws[index]].color.attribute;
        if (witness.hits > 0 && attribute >= 0 &&
            !planes.attributes.at(static_cast<size_t>(attribute)).empty()) {
            witness.written = &planes.attributes.at(static_cast<size_t>(attribute))[index];
        }
    }
    return out;
}

Verdict compare_color(const cases::Case& c, const ref::Expectation& expectation,
                      const std::vector<capture::ColorCodes>& color,
                      std::span<const SampleMark> marks,
                      std::span<const ref::ColorWitness> witnesses) {
    const cases::Case plain = with_color_only(c);
    capture::Capture capture;
    capture.target = plain.target;
    capture.attribute_count = cases::attributes_of(plain);
    capture.color = color;
    for (size_t k = 0; plain.target.has_stencil && k < expectation.samples.size(); ++k) {
        capture.stencil.push_back(likely_stencil(expectation, k, std::nullopt));
    }
    return compare_colors(plain, expectation, capture, marks, witnesses);
}

// Adds what the colour showed to what the other planes did.
void join(Verdict& to, const Verdict& from) {
    if (!from.ok()) {
        to.level = to.ok() ? from.level : std::min(to.level, from.level);
    }
    if (from.has_wrong_samples) {
        const bool is_first = !std::exchange(to.has_wrong_samples, true);
        to.min_x = is_first ? from.min_x : std::min(to.min_x, from.min_x);
        to.min_y = is_first ? from.min_y : std::min(to.min_y, from.min_y);
        to.max_x = is_first ? from.max_x : std::max(to.max_x, from.max_x);
        to.max_y = is_first ? from.max_y : std::max(to.max_y, from.max_y);
    }
    for (const FindingGroup& group : from.groups) {
        Finding like;
        like.kind = group.kind;
        like.rule = group.rule;
        like.level = group.level;
        to.count(like, group.count);
    }
    for (const Finding& finding : from.findings) {
        if (to.findings.size() < kMaxFindings) {
            to.findings.push_back(finding);
        }
    }
    for (size_t k = 0; k < std::min(to.marks.size(), from.marks.size()); ++k) {
        to.marks[k] = std::max(to.marks[k], from.marks[k]);
    }
    to.compared_values += from.compared_values;
    to.error = to.error.empty() ? from.error : to.error;
}

// The same planes of a picture in which nothing is drawn.
capture::Delivered cleared(const cases::Case& c, const capture::Delivered& planes) {
    capture::Delivered out = planes;
    std::fill(out.depth.begin(), out.depth.end(),
              cases::nearest_depth(c.target.depth_clear, c.target.depth_format));
    std::fill(out.frag_coord.begin(), out.frag_coord.end(), glm::vec4(capture::kClearValue));
    for (auto& attribute : out.attributes) {
        std::fill(attribute.begin(), attribute.end(), glm::vec4(capture::kClearValue));
    }
    if (!out.color.empty()) {
        const ref::color::Unit unit{c.target.color->format, cases::Profile::direct3d};
        std::fill(out.color.begin(), out.color.end(), unit.codes_of(unit.cleared(*c.target.color)));
    }
    return out;
}

// Whether a picture in which nothing is drawn would pass as well, given the planes of one.
bool may_be_empty(const cases::Case& c, const ref::Expectation& expectation,
                  const capture::Delivered& empty) {
    if (!empty.color.empty() && !may_stay_clear(with_color_only(c), expectation)) {
        return false;
    }
    const cases::Case plain = with_instruments(c);
    return !has_instrument_planes(empty) || are_right_if_empty(plain, expectation, empty);
}

Verdict compare_planes(const cases::Case& c, const ref::Expectation& expectation,
                       const capture::Delivered& planes) {
    if (planes.color.empty()) {
        return compare_instruments(c, expectation, planes);
    }
    if (!has_instrument_planes(planes)) {
        return compare_color(c, expectation, planes.color, {}, {});
    }
    Verdict verdict = compare_instruments(c, expectation, planes);
    join(verdict, compare_color(c, expectation, planes.color, verdict.marks,
                                witnesses_of(c, expectation, planes)));
    return verdict;
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
        add(planes.draws.empty(), "writer");
        add(planes.frag_coord.empty(), "FragCoord");
        add(c.target.has_depth && planes.depth.empty(), "depth");
        for (uint32_t a = 0; a < cases::attributes_of(c); ++a) {
            add(planes.attributes.at(a).empty(), fmt::format("attribute {}", a));
        }
        add(c.target.color && planes.color.empty(), "color");
        add(c.target.has_stencil, "stencil");
        add(capture::resolves_color(c.target), "resolved color");
        add(capture::resolves_depth(c.target), "resolved depth");
        add(has_pixel_rules(c) && !selection_of(planes).is_all(), "number of invocations");
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
    Verdict verdict = compare_planes(c, expectation, planes);
    // Coverage, hits and writers say themselves what is covered.
    if (verdict.ok() && planes.detail == capture::HitDetail::none && planes.draws.empty() &&
        may_be_empty(c, expectation, cleared(c, planes))) {
        verdict.error = fmt::format(kEmptyPasses, names_of(planes));
    }
    return verdict;
}

}  // namespace diff
