// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/delivered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <utility>

#include "capture/blank_capture.hpp"
#include "cases/model/derive.hpp"
#include "diff/color.hpp"
#include "diff/last_fragment.hpp"
#include "diff/pixel_check.hpp"
#include "ref/color/color.hpp"
#include "ref/stencil/outcome.hpp"
#include "ref/stencil/values.hpp"

namespace diff {

namespace {

constexpr const char* kEmptyPasses =
    "of the delivered planes ({}) a picture in which nothing is drawn would pass too; deliver "
    "coverage or hits";

// A primitive and a vertex that no case has, of a writer that was not delivered.
constexpr uint32_t kNobody = capture::kClearId - 1;

bool is_clear(float v) {
    return std::bit_cast<uint32_t>(v) == std::bit_cast<uint32_t>(capture::kClearValue);
}

ref::ValueSelection selection_of(const capture::Delivered& planes) {
    ref::ValueSelection selection;
    selection.frag_coord = !planes.frag_coord.empty();
    selection.depth = !planes.depth.empty();
    for (size_t a = 0; a < planes.attributes.size(); ++a) {
        selection.attributes.at(a) = !planes.attributes.at(a).empty();
    }
    return selection;
}

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

// A stencil that a sample may hold, with these hits if they are known.
uint32_t likely_stencil(const ref::Expectation& expectation, size_t index,
                        std::optional<std::pair<uint32_t, uint32_t>> hits) {
    return ref::stencil::least_of(stencils_at(expectation, expectation.samples[index], hits));
}

// Fills in what was not delivered.
class Completion {
  public:
    Completion(const cases::Case& c, const ref::Expectation& expectation,
               const capture::Delivered& planes)
        : case_(c),
          expectation_(expectation),
          planes_(planes),
          values_(c, expectation.limits, expectation.profile),
          selection_(selection_of(planes)),
          stores_discarded_(cases::stores_discarded(c)) {
        values_.judge_only(selection_);
    }

    capture::Capture run() {
        out_ = capture::blank_capture(case_);
        const size_t count = out_.sample_count();
        for (size_t index = 0; index < count; ++index) {
            complete(index);
            if (case_.target.has_stencil) {
                const glm::vec4& hits = out_.hits[index];
                out_.stencil.push_back(likely_stencil(
                    expectation_, index,
                    std::pair(static_cast<uint32_t>(hits.x), static_cast<uint32_t>(hits.y))));
            }
        }
        return std::move(out_);
    }

    // Whether these planes, if they are those of an empty picture, would be right.
    bool may_be_empty() {
        out_.attribute_count = cases::attributes_of(case_);
        for (size_t index = 0; index < expectation_.samples.size(); ++index) {
            if ((expectation_.samples[index].hits.total_min > 0 && !is_covered(index)) ||
                !may_have_depth(index)) {
                return false;
            }
        }
        return true;
    }

  private:
    void complete(size_t index) {
        const ref::HitBounds& bounds = expectation_.samples[index].hits;
        const bool covered = is_covered(index);
        const auto [front, back] = covered ? hits_of(index, bounds) : std::pair(0U, 0U);
        out_.hits[index] = {static_cast<float>(front), static_cast<float>(back), capture::kHitGuard,
                            capture::kHitGuard + static_cast<float>(front + back)};
        if (!covered) {
            keep_contradictions(index);
            return;
        }
        const bool is_unwritten =
            !planes_.draws.empty() && planes_.draws[index] == capture::kClearId;
        const ref::FragmentValues values = values_of(index);
        out_.frag_coord[index] = values.frag_coord;
        out_.depth[index] = values.depth;
        for (uint32_t a = 0; a < out_.attribute_count; ++a) {
            out_.attributes.at(a)[index] = values.attributes.at(a);
        }
        out_.writers[index] = is_unwritten ? capture::Writer{} : writer_of(index, values);
    }

    // Whether the delivered depth is one that may be stored, where draws test or keep depths.
    bool may_have_depth(size_t index) {
        const ref::SampleExpectation& expected = expectation_.samples[index];
        if (planes_.depth.empty() || expected.depth_count == 0) {
            return true;
        }
        const std::span<const uint32_t> writers = expectation_.depth_writers_of(expected);
        const ref::FragmentValues values = values_of(index);
        return (expected.depth_may_be_clear &&
                capture::is_clear_depth(case_.target, planes_.depth[index])) ||
               std::ranges::any_of(writers, [&](uint32_t t) {
                   return values_.judge(t, id_of(index), values, ref::FragmentPart::depth).ok;
               });
    }

    // What planes hold of a sample that others call clear: the comparison tells of it. A depth is
    // what is stored; the other values are a fragment's, and there is none.
    void keep_contradictions(size_t index) {
        if (!planes_.draws.empty() && planes_.draws[index] != capture::kClearId) {
            out_.writers[index] = {planes_.draws[index], planes_.primitives[index], 0,
                                   capture::kClearId};
        }
        if (!planes_.depth.empty()) {
            out_.depth[index] = planes_.depth[index];
        }
    }

    // What the planes say of a sample's coverage, the most telling one first.
    bool is_covered(size_t index) {
        if (planes_.detail != capture::HitDetail::none) {
            const uint32_t back =
                planes_.detail == capture::HitDetail::faces ? planes_.back[index] : uint32_t{0};
            return planes_.front[index] + back > 0;
        }
        if (!planes_.draws.empty()) {
            return planes_.draws[index] != capture::kClearId;
        }
        const bool is_depth_clear =
            planes_.depth.empty() || capture::is_clear_depth(case_.target, planes_.depth[index]);
        bool all_clear = planes_.frag_coord.empty() || is_clear(planes_.frag_coord[index].x);
        bool has_values = !planes_.frag_coord.empty();
        for (const auto& attribute : planes_.attributes) {
            all_clear = all_clear && (attribute.empty() || is_clear(attribute[index].x));
            has_values = has_values || !attribute.empty();
        }
        if (all_clear && !is_depth_clear && stores_discarded_) {
            // The depth may be that of a discarded fragment, which is no hit.
            return !has_values && expectation_.samples[index].hits.total_min > 0;
        }
        all_clear = all_clear && is_depth_clear;
        if (!all_clear || expectation_.samples[index].hits.total_min == 0) {
            return !all_clear;
        }
        // Some triangles leave the clear values: of a depth equal to it, or without the attribute.
        const ref::FragmentValues values = values_of(index);
        const auto fits = [&](uint32_t t) { return fits_triangle(t, index, values); };
        return best_writer(index, values, fits).has_value();
    }

    bool fits_triangle(uint32_t t, size_t index, const ref::FragmentValues& values) {
        return values_.judge(t, id_of(index), values, part_of(case_, expectation_, t)).ok;
    }

    std::pair<uint32_t, uint32_t> hits_of(size_t index, const ref::HitBounds& bounds) const {
        if (planes_.detail == capture::HitDetail::faces) {
            return {planes_.front[index], planes_.back[index]};
        }
        const bool is_counted = planes_.detail == capture::HitDetail::total;
        const uint32_t least = is_counted ? planes_.front[index] : std::max(1U, bounds.total_min);
        const uint32_t most = is_counted ? least : std::max(least, bounds.total_max);
        for (uint32_t total = least; total <= std::min(most, bounds.total_max); ++total) {
            for (uint32_t front = 0; front <= total; ++front) {
                if (bounds.allows(front, total - front)) {
                    return {front, total - front};
                }
            }
        }
        // Wrong whatever the faces: by the face that the triangles here have.
        const uint32_t total = is_counted ? least : 1;
        return bounds.front_max == 0 && bounds.back_max > 0 ? std::pair(0U, total)
                                                            : std::pair(total, 0U);
    }

    ref::FragmentValues values_of(size_t index) const {
        ref::FragmentValues values;
        values.frag_coord = planes_.frag_coord.empty() ? glm::vec4(0) : planes_.frag_coord[index];
        values.depth = planes_.depth.empty() ? 0.0F : planes_.depth[index];
        for (uint32_t a = 0; a < out_.attribute_count; ++a) {
            const auto& plane = planes_.attributes.at(a);
            values.attributes.at(a) = plane.empty() ? glm::vec4(0) : plane[index];
        }
        return values;
    }

    cases::SampleId id_of(size_t index) const { return cases::sample_at(case_.target, index); }

    // Of the triangles that may have written last, are the delivered writer's and fit `accept`:
    // the one that explains the values best, the last of equals.
    template <class Accept>
    std::optional<uint32_t> best_writer(size_t index, const ref::FragmentValues& values,
                                        const Accept& accept) {
        const ref::SampleExpectation& expected = expectation_.samples[index];
        std::optional<uint32_t> best;
        std::optional<ref::FragmentVerdict> best_verdict;
        for (uint32_t k = 0; k < expected.writers_count; ++k) {
            const uint32_t t = expectation_.writers[expected.writers_begin + k];
            const cases::Triangle& triangle = expectation_.triangles[t];
            const bool is_delivered =
                planes_.draws.empty() || (planes_.draws[index] == triangle.draw &&
                                          planes_.primitives[index] == triangle.primitive);
            if (!is_delivered || !accept(t)) {
                continue;
            }
            if (expected.writers_count == 1) {
                return t;
            }
            ref::FragmentVerdict verdict =
                values_.judge(t, id_of(index), values, part_of(case_, expectation_, t));
            if (!best || (verdict.ok && !best_verdict->ok) ||
                (verdict.ok == best_verdict->ok &&
                 verdict.worst_ratio <= best_verdict->worst_ratio)) {
                best = t;
                best_verdict = std::move(verdict);
            }
        }
        return best;
    }

    capture::Writer writer_of(size_t index, const ref::FragmentValues& values) {
        if (const auto t = best_writer(index, values, [](uint32_t) { return true; })) {
            const cases::Triangle& triangle = expectation_.triangles[*t];
            return {triangle.draw, triangle.primitive, triangle.provoking, capture::kClearId};
        }
        if (planes_.draws.empty()) {
            // No triangle may be here: the hits are told of. Nobody says whose they are.
            return {0, kNobody, kNobody, capture::kClearId};
        }
        capture::Writer writer{planes_.draws[index], planes_.primitives[index], 0,
                               capture::kClearId};
        for (const cases::Triangle& t : expectation_.triangles) {
            if (t.draw == writer.draw && t.primitive == writer.primitive) {
                writer.provoking_vertex = t.provoking;
            }
        }
        return writer;
    }

    const cases::Case& case_;
    const ref::Expectation& expectation_;
    const capture::Delivered& planes_;
    ref::ValueReference values_;
    ref::ValueSelection selection_;
    bool stores_discarded_ = false;
    capture::Capture out_;
};

Verdict compare_instruments(const cases::Case& c, const ref::Expectation& expectation,
                            const capture::Delivered& planes) {
    const cases::Case plain = with_instruments(c);
    const capture::Capture capture = Completion(plain, expectation, planes).run();
    return compare(plain, expectation, capture, selection_of(planes));
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
    const bool is_first = to.ok();
    if (!from.ok()) {
        to.min_x = is_first ? from.min_x : std::min(to.min_x, from.min_x);
        to.min_y = is_first ? from.min_y : std::min(to.min_y, from.min_y);
        to.max_x = is_first ? from.max_x : std::max(to.max_x, from.max_x);
        to.max_y = is_first ? from.max_y : std::max(to.max_y, from.max_y);
        to.level = is_first ? from.level : std::min(to.level, from.level);
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
    return !has_instrument_planes(empty) || Completion(plain, expectation, empty).may_be_empty();
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
