// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "diff/observers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "cases/base/float_bits.hpp"
#include "cases/base/number_text.hpp"
#include "diff/sample/fragment_part.hpp"
#include "ref/expectation/stored_depths.hpp"

namespace diff {

namespace {

using Detail = ref::path::SeenHits::Detail;

bool is_clear(float v) {
    return cases::same_bits(v, capture::kClearValue);
}

}  // namespace

ref::path::SeenHits Observers::hits_at(size_t index) {
    const auto number = [](float hits) { return static_cast<uint32_t>(hits); };
    const auto any = [](bool is_hit) {
        return ref::path::SeenHits{Detail::any, is_hit ? 1U : 0U, 0};
    };
    switch (delivery_.hits) {
        case capture::HitDetail::faces:
            return {Detail::faces, number(capture_.hits[index].x), number(capture_.hits[index].y)};
        case capture::HitDetail::total:
            return {Detail::total, number(capture_.hits[index].x), 0};
        case capture::HitDetail::coverage:
            return any(capture_.hits[index].x > 0);
        case capture::HitDetail::none:
            break;
    }
    if (delivery_.has_writers) {
        return any(capture_.writers[index].draw != capture::kClearId);
    }
    if (delivery_.values.depth && !delivery_.has_values() && cases::stores_discarded(case_) &&
        !capture::is_clear_depth(case_.target, capture_.depth[index])) {
        return {};  // it may be that of a discarded fragment, which is no hit
    }
    // Beside a colour a depth is asked by itself.
    return delivery_.tells_hits() ? any(is_covered_by_values(index)) : ref::path::SeenHits{};
}

bool Observers::has_clear_values(size_t index) const {
    bool all_clear = !delivery_.values.frag_coord || is_clear(capture_.frag_coord[index].x);
    for (uint32_t a = 0; a < capture_.attribute_count; ++a) {
        all_clear = all_clear && (!delivery_.values.attributes.at(a) ||
                                  is_clear(capture_.attributes.at(a)[index].x));
    }
    return all_clear;
}

// Whether the values that were delivered say that something was drawn.
bool Observers::is_covered_by_values(size_t index) {
    const ref::SampleExpectation& expected = expectation_.samples[index];
    const bool is_depth_clear = !delivery_.values.depth || cases::stores_discarded(case_) ||
                                capture::is_clear_depth(case_.target, capture_.depth[index]);
    const bool all_clear = has_clear_values(index) && is_depth_clear;
    if (!all_clear || expected.hits.total_min == 0) {
        return !all_clear;
    }
    // Some triangles leave the clear values: of a depth equal to it, or without the attribute.
    return std::ranges::any_of(expectation_.writers_of(expected), [&](uint32_t t) {
        is_asking_ = true;
        values_.tell_ratios(false);
        const bool ok = values_
                            .judge(t, cases::sample_at(case_.target, index),
                                   values_at(capture_, index), part_of(case_, expectation_, t))
                            .ok;
        is_asking_ = false;
        return ok;
    });
}

ref::ValueReference& Observers::values_of(cases::Profile profile) {
    if (profile == expectation_.profile) {
        values_.tell_ratios(false);
        return values_;
    }
    std::unique_ptr<ref::ValueReference>& slot = looser_.at(static_cast<size_t>(profile));
    if (!slot) {
        slot = std::make_unique<ref::ValueReference>(case_, expectation_.limits, profile);
        slot->judge_only(delivery_.values);
        slot->tell_ratios(false);
        slot->tell_only([](const ref::ValueMismatch&) { return false; });
    }
    return *slot;
}

bool Observers::fits(cases::Profile profile, uint32_t t, size_t index, cases::SampleId id) {
    return values_of(profile)
        .judge(t, id, values_at(capture_, index), ref::FragmentPart::all_but_depth)
        .ok;
}

ref::path::Observed Observers::observe(cases::Profile profile, size_t index, cases::SampleId id,
                                       const SeenPlanes& seen) {
    const ref::Expectation& e = at(profile, index);
    const ref::SampleExpectation& expected = e.samples[index];
    const auto fragments = e.fragments_of(expected);
    is_asking_ = true;
    ref::path::Observed out;
    // What values alone say of hits says it of those who left them, no more.
    const bool is_derived = delivery_.hits == capture::HitDetail::none && !delivery_.has_writers;
    out.hits = is_derived ? ref::path::SeenHits{} : seen.hits;
    const bool is_unhit = out.hits.detail != Detail::none && out.hits.total() == 0;
    if ((seen.writer || seen.values) && !is_unhit) {
        const auto is_it = [&](const ref::path::Fragment& f) {
            return !seen.writer || last_fragment_.wrote(index, f.triangle);
        };
        const bool asks_values =
            seen.values && (is_derived || std::ranges::count_if(fragments, is_it) > 1);
        std::map<uint32_t, bool> known;  // by triangle, which may have several pieces
        for (const ref::path::Fragment& f : fragments) {
            const auto [at, is_new] = known.try_emplace(f.triangle, false);
            if (is_new) {
                at->second = is_it(f) && (!asks_values || fits(profile, f.triangle, index, id));
            }
            out.last.push_back(at->second);
        }
        out.may_be_unhit = is_derived && has_clear_values(index);
    }
    if (seen.depth) {
        observe_depth(profile, index, id, out);
    }
    if (seen.stencil) {
        out.stencil = capture_.stencil[index];
    }
    is_asking_ = false;
    return out;
}

void Observers::observe_depth(cases::Profile profile, size_t index, cases::SampleId id,
                              ref::path::Observed& out, const std::vector<bool>* of) {
    const ref::Expectation& e = at(profile, index);
    const float depth = capture_.depth[index];
    const bool is_clear = capture::is_clear_depth(case_.target, depth);
    is_asking_ = true;
    ref::StoredDepths(e, values_of(profile))
        .observe(e.samples[index], id, depth, is_clear, out, of);
    is_asking_ = false;
}

ref::ColorWitness Observers::witness(cases::Profile profile, size_t index, cases::SampleId id,
                                     const SeenPlanes& seen) {
    ref::ColorWitness out;
    out.paths.hits = seen.hits;
    if (at(profile, index).samples[index].is_open) {
        out.paths = observe(profile, index, id, seen);
    }
    out.knows_fragments = seen.writer && seen.hits.detail >= Detail::total;
    const bool is_hit = seen.hits.detail == Detail::none || seen.hits.total() > 0;
    for (size_t a = 0; is_hit && a < capture_.attribute_count; ++a) {
        if (delivery_.values.attributes.at(a)) {
            out.written.at(a) = &capture_.attributes.at(a)[index];
        }
    }
    return out;
}

bool Observers::has_path(cases::Profile profile, size_t index, cases::SampleId id,
                         const SeenPlanes& seen) {
    const ref::Expectation& e = at(profile, index);
    const ref::SampleExpectation& expected = e.samples[index];
    if (!expected.is_open || expected.is_free) {
        return true;
    }
    const ref::path::Question question = question_of(e, case_, expected);
    SeenPlanes others = seen;
    others.depth = false;
    ref::path::Observed observed = observe(profile, index, id, others);
    if (seen.depth && !observed.last.empty()) {
        // Mostly the last fragment that shows has stored its depth. Where a path has it so, nobody
        // needs the depths of the others, which cost most of all values.
        ref::path::Observed narrow = observed;
        observe_depth(profile, index, id, narrow, &observed.last);
        if (ref::path::has_path(question, narrow) == ref::path::Answer::yes) {
            return true;
        }
    }
    if (seen.depth) {
        observe_depth(profile, index, id, observed);
    }
    return ref::path::has_path(question, observed) != ref::path::Answer::no;
}

std::optional<Finding> Observers::judge(size_t index, cases::SampleId id, SeenPlanes& seen) {
    const ref::SampleExpectation& expected = expectation_.samples[index];
    if (!expected.is_open || expected.is_free || has_path(expectation_.profile, index, id, seen)) {
        return std::nullopt;
    }
    // The first plane that no path satisfies together with those before it is told.
    struct Plane {
        bool SeenPlanes::*is_seen;
        std::string_view name;
    };
    constexpr std::array kPlanes = {
        Plane{&SeenPlanes::writer, "writer"}, Plane{&SeenPlanes::values, "values"},
        Plane{&SeenPlanes::stencil, "stencil"}, Plane{&SeenPlanes::depth, "depth"}};
    SeenPlanes so_far{seen.hits, false, false, false, false};
    std::optional<Finding> finding;
    if (!has_path(expectation_.profile, index, id, so_far)) {  // between the bounds of the hits
        finding = finding_of(index, id, so_far, "no path has these hits");
        so_far.hits = {};
    }
    for (const Plane& plane : kPlanes) {
        if (!(seen.*plane.is_seen)) {
            continue;
        }
        so_far.*plane.is_seen = true;
        if (!has_path(expectation_.profile, index, id, so_far)) {
            const std::string why = fmt::format(
                "the {} is right by itself, but with the planes before it no path", plane.name);
            finding = finding ? std::move(finding) : finding_of(index, id, so_far, why);
            so_far.*plane.is_seen = false;
        }
    }
    seen = so_far;
    return finding;
}

std::string Observers::text_of(size_t index, const SeenPlanes& seen) const {
    std::string out;
    const auto add = [&](const std::string& words) { out += (out.empty() ? "" : "; ") + words; };
    if (seen.hits.detail == Detail::any) {
        add(seen.hits.front > 0 ? "some hits" : "no hit");
    } else if (seen.hits.detail == Detail::faces) {
        add(fmt::format("hits {} front, {} back", seen.hits.front, seen.hits.back));
    } else if (seen.hits.detail == Detail::total) {
        add(fmt::format("{} hits", seen.hits.front));
    }
    if (seen.writer) {
        const capture::Writer& writer = capture_.writers[index];
        add(writer.draw == capture::kClearId
                ? "writer: nothing drawn"
                : fmt::format("writer: draw {}, triangle {}", writer.draw, writer.primitive));
    }
    if (seen.stencil) {
        add(fmt::format("stencil {}", capture_.stencil[index]));
    }
    if (seen.depth) {
        add("depth " + cases::number_text(capture_.depth[index]));
    }
    return out;
}

Finding Observers::finding_of(size_t index, cases::SampleId id, const SeenPlanes& seen,
                              const std::string& why) {
    Finding finding = finding_at(FindingKind::value, case_.target, id);
    finding.level = loosest_wrong(expectation_.profile, [&](cases::Profile profile) {
        return !has_path(profile, index, id, seen);
    });
    tell(finding, ref::ReasonKind::planes_contradict);
    finding.quantity = "attachments";
    finding.expected = "all attachments written by the same fragments";
    finding.got = text_of(index, seen);
    finding.why += ": " + why;
    return finding;
}

}  // namespace diff
