// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/shared_decisions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cases/model/rule_ids.hpp"
#include "cases/model/sample.hpp"
#include "ref/value/fragment/shading_rate.hpp"

namespace diff {

bool SharedDecisions::are_in(const cases::Case& c, cases::Profile profile) {
    return profile == cases::Profile::direct3d && c.target.samples > 1 &&
           std::ranges::any_of(c.draws, [&](const cases::Draw& draw) {
               return cases::discards_by_value(draw) &&
                      ref::value::shading_rate(draw, c.target.samples) ==
                          ref::value::ShadingRate::fragment;
           });
}

// The triangles of whose fragment an open decision concerns several samples of a pixel.
std::vector<uint32_t> SharedDecisions::triangles_of(size_t first) const {
    std::map<uint32_t, uint32_t> samples;
    for (size_t index = first; index < first + case_.target.samples; ++index) {
        const ref::SampleExpectation& expected = expectation_.samples[index];
        if (!expected.is_open || expected.is_free) {
            continue;
        }
        std::set<uint32_t> here, pieces;
        for (const ref::path::Fragment& f : expectation_.fragments_of(expected)) {
            const cases::Draw& draw = case_.draws[expectation_.triangles[f.triangle].draw];
            const bool is_shared = f.is_value_open && !f.is_in_pieces &&
                                   ref::value::shading_rate(draw, case_.target.samples) ==
                                       ref::value::ShadingRate::fragment;
            // Pieces of one triangle are several fragments.
            if (!(is_shared ? here : pieces).insert(f.triangle).second) {
                pieces.insert(f.triangle);
            }
        }
        for (const uint32_t t : here) {
            samples[t] += pieces.contains(t) ? 0U : 1U;
        }
    }
    std::vector<uint32_t> out;
    for (const auto& [t, count] : samples) {
        if (count > 1) {
            out.push_back(t);
        }
    }
    return out;
}

bool SharedDecisions::is_right(size_t index, const SeenPlanes& seen,
                               const std::set<uint32_t>& discarded,
                               const std::vector<uint32_t>& decided, ref::ColorReference* colors) {
    const ref::SampleExpectation& expected = expectation_.samples[index];
    if (!expected.is_open || expected.is_free) {
        return true;
    }
    const cases::SampleId id = cases::sample_at(case_.target, index);
    ref::path::Question question = question_of(expectation_, case_, expected);
    for (ref::path::Fragment& f : question.fragments) {
        if (!f.is_value_open || std::ranges::find(decided, f.triangle) == decided.end()) {
            continue;
        }
        const bool is_discarded = discarded.contains(f.triangle);
        if (f.is_discard_open) {
            f.is_discard_open = false;
            f.is_discarded_front = f.is_discarded_back = is_discarded;
        } else if (is_discarded) {
            f.set = static_cast<int>(question.sets.size());
            question.sets.push_back({0, 0});
        } else if (!is_discarded) {
            f.is_sure = f.is_sure_but_for_value;
        }
    }
    const ref::ColorWitness witness = observers_.witness(expectation_.profile, index, id, seen);
    return ref::path::has_path(question, witness.paths) != ref::path::Answer::no &&
           (colors == nullptr ||
            colors->explains(index, id, capture_.color[index], witness, &question));
}

std::optional<Finding> SharedDecisions::judge(const cases::SampleId& pixel,
                                              const std::vector<std::optional<SeenPlanes>>& seen,
                                              ref::ColorReference* colors) {
    const size_t first = cases::index_of(case_.target, pixel);
    const std::vector<uint32_t> triangles = triangles_of(first);
    if (triangles.empty() || triangles.size() > kMostDecisions) {
        return std::nullopt;
    }
    for (uint32_t choice = 0; choice < 1U << triangles.size(); ++choice) {
        std::set<uint32_t> discarded;
        for (size_t k = 0; k < triangles.size(); ++k) {
            if ((choice >> k & 1U) != 0) {
                discarded.insert(triangles[k]);
            }
        }
        bool are_right = true;
        for (size_t s = 0; s < seen.size() && are_right; ++s) {
            are_right = !seen[s] || is_right(first + s, *seen[s], discarded, triangles, colors);
        }
        if (are_right) {
            return std::nullopt;
        }
    }
    const cases::Triangle& t = expectation_.triangles[triangles.front()];
    Finding finding = finding_at(FindingKind::value, case_.target, pixel);
    finding.rule = cases::rule::discard_value;
    finding.level = cases::Profile::direct3d;
    finding.quantity = "samples of the pixel";
    finding.expected = "all samples that the fragment covers discarded, or none of them";
    for (size_t s = 0; s < seen.size(); ++s) {
        finding.got +=
            fmt::format("{}sample {}: {}", s == 0 ? "" : "; ", s,
                        seen[s] ? observers_.text_of(first + s, *seen[s]) : "wrong by itself");
    }
    finding.why = fmt::format(
        "triangle {} of draw {}: its shader runs once for the samples of a pixel, so what it "
        "discards is discarded at all of them",
        t.primitive, t.draw);
    return finding;
}

}  // namespace diff
