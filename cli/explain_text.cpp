// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/explain_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/base/counted.hpp"
#include "cases/base/number_text.hpp"
#include "cases/model/rule.hpp"
#include "cases/model/sample.hpp"
#include "cases/model/words.hpp"
#include "cli/stored_depth.hpp"
#include "diff/verdict.hpp"
#include "ref/blit/blit.hpp"
#include "ref/color/color.hpp"
#include "ref/exercise/exercise.hpp"
#include "ref/expectation/counted.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/expectation/explain.hpp"
#include "ref/expectation/statistics.hpp"
#include "ref/reason/reason.hpp"
#include "ref/stencil/values.hpp"
#include "report/text/wrap.hpp"

namespace cli {

namespace {

std::string_view name(ref::Coverage coverage) {
    switch (coverage) {
        case ref::Coverage::must:
            return "must be covered";
        case ref::Coverage::either:
            return "may or may not be covered";
        case ref::Coverage::must_not:
            return "must not be covered";
    }
    return "";
}

std::string range(uint32_t low, uint32_t high) {
    return low == high ? fmt::format("{}", low) : fmt::format("{} to {}", low, high);
}

std::string allowed_hits(const ref::HitBounds& b) {
    std::string text = fmt::format("allowed: {} {} in all", range(b.total_min, b.total_max),
                                   b.total_min == 1 && b.total_max == 1 ? "hit" : "hits");
    if (b.front_max > 0 || b.back_max > 0) {
        text += fmt::format(" ({} by front faces, {} by back faces)",
                            range(b.front_min, b.front_max), range(b.back_min, b.back_max));
    }
    return text;
}

// Fractions get long where w is not a power of two; the tail helps nobody.
std::string shortened(const std::string& exact) {
    constexpr size_t kLimit = 48;
    return exact.size() <= kLimit ? exact : exact.substr(0, kLimit) + "...";
}

// What any basis, bias and store may make of a value (ValueReference::range()).
std::string accepted_text(ref::ValueReference& values, uint32_t triangle, cases::SampleId sample,
                          const ref::ExpectedValue& v) {
    if (!(v.factor > 0)) {
        return {};
    }
    std::string text = fmt::format(", accepted within {:.4g} x {:.3g}", v.factor, v.budget);
    const ref::ValueRange all =
        v.part.empty() ? values.range(triangle, sample, v.quantity) : ref::ValueRange{};
    if (!all.is_promised) {
        return text;
    }
    text += fmt::format(", of all bases{} {} to {}", all.is_of_places ? " and places" : "",
                        cases::number_text(all.low), cases::number_text(all.high));
    if (all.is_of_places) {
        text += ", and nothing between the places";
    }
    if (all.has_biased) {
        text += fmt::format(", or with the bias {} to {}", cases::number_text(all.biased_low),
                            cases::number_text(all.biased_high));
    }
    return text;
}

// `depth`: why the depth is not the one that is stored, or nothing.
std::string values_text(ref::ValueReference& values, uint32_t triangle, cases::SampleId sample,
                        std::string_view depth) {
    std::string text;
    for (const ref::ExpectedValue& v : values.expected(triangle, sample)) {
        if (v.quantity.is_depth() && !depth.empty()) {
            text += fmt::format("        {:<14} {}\n", to_text(v), depth);
        } else if (v.is_flat) {
            text += fmt::format("        {:<14} {} {}, bit for bit\n", to_text(v),
                                cases::number_text(v.nearest), v.also.empty() ? "exactly" : v.also);
        } else {
            const std::string nearest = cases::number_text(v.nearest), exact = shortened(v.exact);
            text += fmt::format("        {:<14} {}{}{}{}{}\n", to_text(v), nearest,
                                exact == nearest ? "" : " = " + exact,
                                accepted_text(values, triangle, sample, v),
                                v.also.empty() ? "" : ", ", v.also);
        }
    }
    return text;
}

// The depth that the sample holds, where it may be another one than the last writer's.
std::string stored_depth_text(const cases::Case& c, const ref::Expectation& expectation,
                              ref::ValueReference& values, size_t index, cases::SampleId sample) {
    if (!has_own_depth(c, expectation, index)) {
        return {};
    }
    const ref::SampleExpectation& s = expectation.samples[index];
    std::string text;
    const auto add = [&text](const std::string& depth) {
        text += (text.empty() ? "the depth then is " : ", or ") + depth;
    };
    for (const uint32_t t : expectation.depth_writers_of(s)) {
        for (const ref::ExpectedValue& v : values.expected(t, sample)) {
            if (v.quantity.is_depth()) {
                const cases::Triangle& triangle = expectation.triangles[t];
                add(fmt::format("that of triangle {} of draw {}, {}{}", triangle.primitive,
                                triangle.draw, cases::number_text(v.nearest),
                                v.is_flat ? "" : accepted_text(values, t, sample, v)));
            }
        }
    }
    if (s.depth_may_be_clear) {
        add(fmt::format("what it was cleared to, {}", cases::number_text(c.target.depth_clear)));
    }
    return report::wrapped(text + "\n", 100);
}

std::string clear_text(const ref::TriangleExplanation& t) {
    return fmt::format("    rectangle {} of draw {}, a clear: {}\n        {}\n",
                       t.triangle.primitive, t.triangle.draw,
                       t.fate && !t.fate->is_absent ? "clears the sample" : "leaves the sample",
                       t.sentence);
}

std::string triangle_text(const ref::TriangleExplanation& t) {
    std::string text =
        fmt::format("    triangle {} of draw {}, vertices {} {} {}: {}\n", t.triangle.primitive,
                    t.triangle.draw, t.triangle.vertex[0], t.triangle.vertex[1],
                    t.triangle.vertex[2], name(t.decision.coverage));
    for (const ref::EdgeExplanation& e : t.edges) {
        text += fmt::format("        E({},{}) from ({}, {}) to ({}, {}), a {} edge: {}{}\n", e.from,
                            e.to, ref::to_text(e.a.x), ref::to_text(e.a.y), ref::to_text(e.b.x),
                            ref::to_text(e.b.y), to_string(e.kind), ref::to_text(e.value),
                            e.value == 0 ? ", the sample is exactly on it" : "");
    }
    if (t.edges.empty()) {
        text +=
            "        no edge is shown: a vertex has no place in the picture, since its w is not "
            "above "
            "0, it is no number or it lies beyond 2^32 pixels\n";
    } else if (!std::ranges::all_of(t.boxes,
                                    [](const auto& box) { return box && box->is_point(); })) {
        text +=
            "        a device may have a vertex at more than one place: shown are the grid points "
            "nearest to the exact positions\n";
    }
    if (t.is_clipped) {
        text += "        a vertex lies outside the view volume: the clipped polygon counts too\n";
    }
    if (t.decision.further > 0) {
        text += fmt::format(
            "        drawn in {} pieces, the clipped polygon may cover the pixel by each of them\n",
            t.decision.further + 1);
    }
    text += report::wrapped(fmt::format("        {}\n", t.sentence), 100);
    if (!t.bounds_text.empty()) {
        text += fmt::format("        {}\n", t.bounds_text);
    }
    if (!t.stencil_text.empty()) {
        text += fmt::format("        {}\n", t.stencil_text);
    }
    return t.depth ? text + fmt::format("        {}\n", t.depth_text) : text;
}

// The sample's surroundings, one character a pixel (its sample of the same number): what each must
// be, with the sample in brackets.
std::string drawing(const cases::Case& c, const ref::Expectation& expectation,
                    cases::SampleId sample) {
    constexpr uint32_t kRadius = 6;  // pixels
    const auto begin = [](uint32_t at) { return at > kRadius ? at - kRadius : 0; };
    const uint32_t left = begin(sample.x), top = begin(sample.y);
    const uint32_t right = std::min(sample.x + kRadius, c.target.width - 1);
    const uint32_t bottom = std::min(sample.y + kRadius, c.target.height - 1);
    std::string text = fmt::format(
        "\n    sample {} of pixels ({}, {}) to ({}, {}): # must be hit once, 2..9 as often, . must "
        "not, ~ is free\n",
        sample.sample, left, top, right, bottom);
    for (uint32_t y = top; y <= bottom; ++y) {
        text += "    ";
        for (uint32_t x = left; x <= right; ++x) {
            const size_t row = size_t{sample.layer} * c.target.height + y;
            const size_t at = (row * c.target.width + x) * c.target.samples + sample.sample;
            const ref::HitBounds& hits = expectation.samples[at].hits;
            const char mark = !hits.is_decided()    ? '~'
                              : hits.total_max == 0 ? '.'
                              : hits.total_max == 1 ? '#'
                              : hits.total_max <= 9 ? static_cast<char>('0' + hits.total_max)
                                                    : '9';
            const bool here = x == sample.x && y == sample.y;
            const bool after = y == sample.y && x == sample.x + 1;
            text += here ? '[' : after ? ']' : ' ';
            text += mark;
        }
        text += sample.x == right && y == sample.y ? "]\n" : "\n";
    }
    return text;
}

// How the colour comes about, fragment by fragment.
std::string color_text(const cases::Case& c, const ref::Expectation& expectation, size_t index,
                       cases::SampleId sample) {
    if (!c.target.color) {
        return {};
    }
    const bool is_one_of = !expectation.samples[index].hits.is_decided();
    const std::string location =
        c.target.other_colors.empty()
            ? std::string()
            : fmt::format(
                  " at location {} of {} colour targets, of which the others do nothing to "
                  "it",
                  c.target.judged_color, c.target.color_count());
    std::string text = fmt::format("the colour{}{}:\n", location,
                                   is_one_of ? ", where the first of several allowed sets of "
                                               "fragments is drawn"
                                             : "");
    for (const ref::ColorStep& step : ref::ColorReference(c, expectation).steps(index, sample)) {
        std::string name;
        if (step.triangle) {
            const cases::Triangle& t = expectation.triangles[*step.triangle];
            name =
                fmt::format("{} {} of draw {} ", c.draws[t.draw].clear ? "rectangle" : "triangle",
                            t.primitive, t.draw);
        }
        text += report::wrapped(fmt::format("    {}{}\n", name, step.sentence), 100);
    }
    return text;
}

// Empty if it may be any number.
std::string number_text(const ref::CountBounds& bounds) {
    if (bounds.most == ref::kNoMost) {
        return bounds.least == 0 ? "" : fmt::format("at least {}", bounds.least);
    }
    return bounds.least == bounds.most ? fmt::format("{}", bounds.least)
                                       : fmt::format("{} to {}", bounds.least, bounds.most);
}

// What the queries count of a sample.
std::string counted_text(const cases::Case& c, const ref::Expectation& expectation, size_t index) {
    std::string text;
    for (uint32_t draw = 0; draw < c.draws.size(); ++draw) {
        if (!cases::is_occlusion(c.draws[draw].query)) {
            continue;
        }
        const ref::CountBounds bounds = ref::counted_at(expectation, c, index, draw, {});
        text += fmt::format("the query of draw {} counts {} here\n", draw, number_text(bounds));
    }
    return text;
}

// What the queries give in the end.
std::string queries_text(const cases::Case& c, const ref::Expectation& expectation) {
    std::string text;
    const std::vector<ref::CountBounds> all = ref::query_bounds(c, expectation, ref::ShownAt());
    for (size_t draw = 0; draw < all.size(); ++draw) {
        const std::string number = number_text(all[draw]);
        const std::string_view statistic = cases::word_of(c.draws[draw].query);
        switch (c.draws[draw].query) {
            case cases::Query::none:
                break;
            case cases::Query::occlusion_precise:
                text += fmt::format("the query of draw {} has to give {}\n", draw, number);
                break;
            case cases::Query::occlusion:
                text += fmt::format(
                    "the query of draw {} is not precise: of {} samples it has to give {}\n", draw,
                    number,
                    all[draw].most == 0    ? "0"
                    : all[draw].least == 0 ? "any number"
                                           : "any number but 0");
                break;
            case cases::Query::input_vertices:
            case cases::Query::input_primitives:
            case cases::Query::vertex_invocations:
            case cases::Query::clipping_invocations:
            case cases::Query::clipping_primitives:
            case cases::Query::fragment_invocations:
                text += number.empty()
                            ? fmt::format("the query of draw {} may give any number of {}\n", draw,
                                          statistic)
                            : fmt::format("the query of draw {} has to give {} {}\n", draw, number,
                                          statistic);
                break;
        }
    }
    return text;
}

std::string head_text(const cases::Case& c) {
    std::string text = fmt::format("{}\n    {}\n", c.id, c.claim.description);
    for (const std::string& id : c.claim.rules) {
        if (const cases::Rule* rule = cases::find_rule(id)) {
            text +=
                fmt::format("    {} ({}): {}\n", rule->id, to_string(rule->profile), rule->title);
        }
    }
    return text;
}

// What follows from all that was told, in one sentence.
std::string conclusion(const ref::HitBounds& b) {
    if (b.total_min == b.total_max) {
        return b.total_max == 0
                   ? "therefore the sample must not be covered"
                   : fmt::format("therefore the sample must be covered exactly {}",
                                 b.total_max == 1 ? "once" : fmt::format("{} times", b.total_max));
    }
    return b.total_min == 0
               ? "therefore the sample may be covered or not"
               : "therefore the sample must be covered, how often is the device's choice";
}

}  // namespace

std::string rule_text(const cases::Rule& rule, const std::vector<cases::Case>& suite) {
    std::string text = fmt::format("{}: {}\n", rule.id, rule.title);
    text += fmt::format(
        "    profile   {} (breaking it is a finding there and at every stricter profile)\n",
        to_string(rule.profile));
    text += report::wrapped(fmt::format("    text      {}\n", rule.text), 100);
    if (!rule.anchor.empty()) {
        text += fmt::format("    Vulkan    {}\n", rule.anchor);
    }
    if (!rule.direct3d.empty()) {
        text += fmt::format("    Direct3D  {} (11.3 functional specification)\n", rule.direct3d);
    }
    text += report::wrapped(
        fmt::format("    exercised by a sample {}\n", ref::exercise_of(rule.id)), 100);
    text += fmt::format("    code      {}\n", rule.code);
    std::vector<std::string> ids;
    size_t leaves = 0;
    for (const cases::Case& c : suite) {
        if (std::ranges::find(c.claim.rules, rule.id) == c.claim.rules.end()) {
            continue;
        }
        ++leaves;
        const std::string base = c.id.substr(0, c.id.find(':'));
        if (std::ranges::find(ids, base) == ids.end()) {
            ids.push_back(base);
        }
    }
    text += fmt::format("    cases     {} in {} files ('edgecase run @rule:{}')\n", leaves,
                        ids.size(), rule.id);
    for (const std::string& id : ids) {
        text += "              " + id + "\n";
    }
    return text;
}

std::string explain_text(const cases::Case& c, const ref::Limits& limits, cases::Profile profile,
                         cases::SampleId sample) {
    if (c.blit) {
        return head_text(c) + fmt::format("\ntexel ({}, {}): {}\n", sample.x, sample.y,
                                          ref::BlitReference(c).explain(sample.x, sample.y));
    }
    const ref::SampleExplanation s = ref::explain_sample(c, limits, profile, sample);
    std::string text = head_text(c);
    text +=
        fmt::format("\n{}, sample {} at ({}, {}); profile {}, {} subpixel bits\n",
                    cases::pixel_text(c.target, sample), sample.sample, ref::to_text(s.position.x),
                    ref::to_text(s.position.y), to_string(profile), limits.subpixel_bits);
    if (s.of_all) {
        text += fmt::format("    {}\n", ref::text_of_all(*s.of_all));
    }
    // The interesting ones first: those that may cover the sample, then the near misses.
    std::vector<const ref::TriangleExplanation*> order;
    for (const ref::TriangleExplanation& t : s.triangles) {
        order.push_back(&t);
    }
    std::ranges::stable_sort(order, [](const auto* a, const auto* b) {
        const auto is_close = [](const auto& t) {
            return t.decision.coverage != ref::Coverage::must_not ||
                   t.why() == ref::ReasonKind::top_left_out;
        };
        return is_close(*a) > is_close(*b);
    });
    constexpr size_t kShown = 12;
    ref::ValueReference values(c, limits, profile);
    // Of what the whole target has to show; large targets take too long.
    constexpr uint64_t kMaxPixels = uint64_t{1} << 20;
    std::optional<ref::Expectation> all;
    if (uint64_t{c.target.width} * c.target.height <= kMaxPixels) {
        all = ref::expect(c, limits, profile);
    }
    const size_t index = cases::index_of(c.target, sample);
    for (size_t i = 0; i < std::min(order.size(), kShown); ++i) {
        text += c.draws[order[i]->triangle.draw].clear ? clear_text(*order[i])
                                                       : triangle_text(*order[i]);
        if (order[i]->decision.coverage != ref::Coverage::must_not) {
            const uint32_t triangle = order[i]->index;
            text += values_text(
                values, triangle, sample,
                !c.draws[order[i]->triangle.draw].depth.write      ? "is not written by the draw"
                : all && !may_hold_depth(c, *all, index, triangle) ? "is not the one that is stored"
                                                                   : "");
        }
    }
    if (order.size() > kShown) {
        text += fmt::format("    and {} more triangles within two pixels\n", order.size() - kShown);
    }
    if (order.empty()) {
        text += "    no triangle is within two pixels\n";
    }
    for (const ref::SetExplanation& set : s.sets) {
        text += report::wrapped(fmt::format("    {}\n", set.sentence), 100);
    }
    if (all) {
        text += drawing(c, *all, sample);
    }
    text += "\n" + conclusion(s.hits) + "\n";
    text += allowed_hits(s.hits) + "\n";
    if (all) {
        text += counted_text(c, *all, index) + color_text(c, *all, index, sample);
    }
    if (s.stencils) {
        text += s.stencils->all()
                    ? "the stencil may be anything then\n"
                    : "the stencil then is " + ref::stencil::to_text(*s.stencils, " or ", 8) + "\n";
    }
    if (all) {
        text += stored_depth_text(c, *all, values, index, sample);
    }
    for (const cases::Profile looser : cases::kProfiles) {
        if (looser < profile) {
            const ref::SampleExplanation other = ref::explain_sample(c, limits, looser, sample);
            if (!(other.hits == s.hits)) {
                text += fmt::format("    at profile {} {}\n", to_string(looser),
                                    allowed_hits(other.hits));
            }
        }
    }
    return text + (all ? queries_text(c, *all) : "");
}

std::string explain_text(const cases::Case& c, const ref::Limits& limits, cases::Profile profile) {
    const ref::Expectation all = ref::expect(c, limits, profile);
    const uint64_t samples = all.samples.size();
    return head_text(c) +
           fmt::format(
               "\n{} of {} must be covered{}; profile {}, {} subpixel bits\n", all.must_samples,
               cases::counted(samples, "sample"),
               all.either_samples == 0
                   ? ""
                   : fmt::format(", of {} more than one answer is allowed", all.either_samples),
               to_string(profile), limits.subpixel_bits) +
           queries_text(c, all) + "--pixel X,Y explains a sample\n";
}

}  // namespace cli
