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
        return fault >= first && fault <= last;  // as fault.hpp groups them
    };
    const auto any_draw = [&](const auto& has) {
        return std::any_of(c.draws.begin(), c.draws.end(), has);
    };
    if (is_between(Fault::blit_mirror_ignored, Fault::blit_missing_alpha_zero)) {
        return c.blit.has_value();
    }
    if (is_between(Fault::blend_ignored, Fault::srgb_gamma)) {
        // Resolved numbers are converted, too; all of them come from a colour.
        return c.target.color.has_value();
    }
    if (is_between(Fault::stencil_faces_exchanged, Fault::stencil_never_written)) {
        return c.target.has_stencil;
    }
    if (is_between(Fault::query_before_mask, Fault::query_always_any)) {
        return cases::asks_queries(c);
    }
    if (is_between(Fault::statistics_vertices_by_primitive, Fault::statistics_fragments_by_pixel)) {
        return any_draw([](const cases::Draw& d) { return cases::is_statistic(d.query); });
    }
    if (is_between(Fault::discard_value_or_zero, Fault::discard_value_at_centre)) {
        return cases::discards_by_value(c);
    }
    if (is_between(Fault::resolve_one_sample, Fault::resolve_ignored)) {
        return capture::resolves_color(c.target) || capture::resolves_depth(c.target);
    }
    if (is_between(Fault::distance_flipped, Fault::distance_plane_never)) {
        return any_draw([](const cases::Draw& d) { return d.distances.clip_count > 0; });
    }
    if (is_between(Fault::cull_distance_any, Fault::cull_distance_provoking)) {
        return any_draw([](const cases::Draw& d) { return d.distances.cull_count > 0; });
    }
    if (is_between(Fault::depth_volume_ignored, Fault::depth_scale_ignored)) {
        return any_draw([](const cases::Draw& d) { return d.depth.negative_one_to_one; });
    }
    if (is_between(Fault::provoking_mode_ignored, Fault::provoking_turns)) {
        return any_draw(
            [](const cases::Draw& d) { return d.provoking == cases::ProvokingVertex::last; });
    }
    if (is_between(Fault::bias_ignored, Fault::bias_clamp_both_ends)) {
        return any_draw([](const cases::Draw& d) { return d.depth.bias.has_value(); });
    }
    if (is_between(Fault::derivative_partial, Fault::lod_norm)) {
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
