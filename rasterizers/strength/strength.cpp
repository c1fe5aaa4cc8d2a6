// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/strength/strength.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <type_traits>

#include "cases/fault/change.hpp"
#include "cases/fault/fault.hpp"
#include "cases/model/profile.hpp"
#include "cases/model/sample.hpp"
#include "diff/blit.hpp"
#include "diff/verdict.hpp"
#include "rasterizers/color_plane.hpp"
#include "rasterizers/software/render.hpp"
#include "rasterizers/strength/picture.hpp"

namespace software {

namespace {

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    static_assert(std::is_trivially_copyable_v<T>);
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// Rows of the catalogue, one behind the other, whose code is run for some cases alone.
struct CodeRun {
    Fault first, last;
    bool (*has)(const cases::Case& c);
};
template <auto has>
bool any_draw(const cases::Case& c) {
    return std::ranges::any_of(c.draws, has);
}
bool has_probe(const cases::Draw& d) {
    return std::ranges::any_of(d.attributes,
                               [](const auto& a) { return a.probe != cases::Probe::value; });
}
constexpr CodeRun kCodeRuns[] = {
    {"blit-mirror-ignored"_fault, "blit-missing-alpha-zero"_fault,
     [](const cases::Case& c) { return c.blit.has_value(); }},
    // Resolved numbers are converted, too; all of them come from a colour.
    {"blend-ignored"_fault, "srgb-gamma"_fault,
     [](const cases::Case& c) { return c.target.color.has_value(); }},
    {"stencil-faces-exchanged"_fault, "stencil-never-written"_fault,
     [](const cases::Case& c) { return c.target.has_stencil; }},
    {"query-before-mask"_fault, "query-always-any"_fault, cases::asks_queries},
    {"statistics-vertices-by-primitive"_fault, "statistics-fragments-by-pixel"_fault,
     any_draw<[](const cases::Draw& d) { return cases::is_statistic(d.query); }>},
    {"discard-value-or-zero"_fault, "discard-value-at-centre"_fault,
     any_draw<[](const cases::Draw& d) { return cases::discards_by_value(d); }>},
    {"resolve-one-sample"_fault, "resolve-ignored"_fault,
     [](const cases::Case& c) { return capture::resolves(c.target); }},
    {"distance-flipped"_fault, "distance-plane-never"_fault,
     any_draw<[](const cases::Draw& d) { return d.distances.clip_count != 0; }>},
    {"cull-distance-any"_fault, "cull-distance-provoking"_fault,
     any_draw<[](const cases::Draw& d) { return d.distances.cull_count != 0; }>},
    {"depth-volume-ignored"_fault, "depth-scale-ignored"_fault,
     any_draw<[](const cases::Draw& d) { return d.depth.negative_one_to_one; }>},
    {"provoking-mode-ignored"_fault, "provoking-turns"_fault,
     any_draw<[](const cases::Draw& d) { return d.provoking == cases::ProvokingVertex::last; }>},
    {"bias-ignored"_fault, "bias-clamp-both-ends"_fault,
     any_draw<[](const cases::Draw& d) { return d.depth.bias.has_value(); }>},
    {"derivative-partial"_fault, "lod-norm"_fault, any_draw<has_probe>},
};

}  // namespace

bool can_matter(Fault fault, const cases::Case& c) {
    if (!cases::has_code(fault)) {
        cases::Case taken = c;
        return cases::take_with(fault, taken) || !cases::has_change(fault);
    }
    const auto* run = std::ranges::find_if(
        kCodeRuns, [&](const CodeRun& r) { return fault >= r.first && fault <= r.last; });
    return run == std::end(kCodeRuns) || run->has(c);
}

capture::Capture captured(const cases::Case& c, const Device& device) {
    const bool has_code = device.fault == kNoFault || cases::has_code(device.fault);
    cases::Case taken = c;
    if (!has_code) {
        cases::take_with(device.fault, taken);
    }
    capture::Capture out = render(taken, device);
    rasterizers::drop_unattached(out);
    if (!has_code) {
        out.target = c.target;  // as whoever judges it takes it for
        spoil(device.fault, out);
    }
    return out;
}

diff::Verdict compare(const cases::Case& c, const ref::Expectation& expectation,
                      const capture::Capture& capture) {
    return c.blit ? diff::compare_blit(c, expectation.profile, capture)
                  : diff::compare(c, expectation, capture);
}

bool same_bits(const capture::Capture& a, const capture::Capture& b) {
    bool same = a.counted == b.counted;
    capture::for_each_plane([&same](const capture::Plane&, const auto& one,
                                    const auto& other) { same = same && same_bits(one, other); },
                            a, a, b);
    return same;
}

std::optional<diff::Verdict> try_faults(
    const cases::Case& c, std::span<const Fault> faults,
    const std::function<void(Fault, const diff::Verdict&)>& caught) {
    const ref::Expectation expectation = ref::expect(c, {}, cases::Profile::direct3d);
    const capture::Capture right = captured(c, {});
    if (diff::Verdict verdict = compare(c, expectation, right); !verdict.ok()) {
        return verdict;
    }
    for (const Fault fault : faults) {
        if (!can_matter(fault, c)) {
            continue;
        }
        Device device;
        device.fault = fault;
        const capture::Capture wrong = captured(c, device);
        if (same_bits(right, wrong)) {
            continue;
        }
        const diff::Verdict verdict = compare(c, expectation, wrong);
        if (!verdict.ok() && verdict.error.empty()) {
            caught(fault, verdict);
        }
    }
    return std::nullopt;
}

}  // namespace software
