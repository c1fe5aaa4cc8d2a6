// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/strength/strength.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "cases/model/profile.hpp"
#include "cases/model/sample.hpp"
#include "diff/blit.hpp"
#include "diff/verdict.hpp"
#include "rasterizers/color_plane.hpp"
#include "rasterizers/software/render.hpp"

namespace software {

namespace {

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    static_assert(std::is_trivially_copyable_v<T>);
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace

bool can_matter(Fault fault, const cases::Case& c) {
    const auto is_between = [&](Fault first, Fault last) {
        return fault >= first && fault <= last;  // as the rows are grouped
    };
    const auto any_draw = [&](const auto& has) {
        return std::any_of(c.draws.begin(), c.draws.end(), has);
    };
    if (is_between("blit-mirror-ignored"_fault, "blit-missing-alpha-zero"_fault)) {
        return c.blit.has_value();
    }
    if (is_between("blend-ignored"_fault, "srgb-gamma"_fault)) {
        // Resolved numbers are converted, too; all of them come from a colour.
        return c.target.color.has_value();
    }
    if (is_between("stencil-faces-exchanged"_fault, "stencil-never-written"_fault)) {
        return c.target.has_stencil;
    }
    if (is_between("query-before-mask"_fault, "query-always-any"_fault)) {
        return cases::asks_queries(c);
    }
    if (is_between("statistics-vertices-by-primitive"_fault,
                   "statistics-fragments-by-pixel"_fault)) {
        return any_draw([](const cases::Draw& d) { return cases::is_statistic(d.query); });
    }
    if (is_between("discard-value-or-zero"_fault, "discard-value-at-centre"_fault)) {
        return cases::discards_by_value(c);
    }
    if (is_between("resolve-one-sample"_fault, "resolve-ignored"_fault)) {
        return capture::resolves_color(c.target) || capture::resolves_depth(c.target);
    }
    if (is_between("distance-flipped"_fault, "distance-plane-never"_fault)) {
        return any_draw([](const cases::Draw& d) { return d.distances.clip_count > 0; });
    }
    if (is_between("cull-distance-any"_fault, "cull-distance-provoking"_fault)) {
        return any_draw([](const cases::Draw& d) { return d.distances.cull_count > 0; });
    }
    if (is_between("depth-volume-ignored"_fault, "depth-scale-ignored"_fault)) {
        return any_draw([](const cases::Draw& d) { return d.depth.negative_one_to_one; });
    }
    if (is_between("provoking-mode-ignored"_fault, "provoking-turns"_fault)) {
        return any_draw(
            [](const cases::Draw& d) { return d.provoking == cases::ProvokingVertex::last; });
    }
    if (is_between("bias-ignored"_fault, "bias-clamp-both-ends"_fault)) {
        return any_draw([](const cases::Draw& d) { return d.depth.bias.has_value(); });
    }
    if (is_between("derivative-partial"_fault, "lod-norm"_fault)) {
        return any_draw([](const cases::Draw& d) {
            return std::any_of(d.attributes.begin(), d.attributes.end(),
                               [](const auto& a) { return a.probe != cases::Probe::value; });
        });
    }
    return true;
}

capture::Capture captured(const cases::Case& c, const Device& device) {
    capture::Capture out = render(c, device);
    rasterizers::drop_unattached(out);
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
