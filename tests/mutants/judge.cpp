// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "mutants/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <thread>
#include <utility>

#include "diff/blit.hpp"
#include "rasterizers/color_plane.hpp"
#include "ref/expectation/expectation.hpp"
#include "ref/position/viewport_grid.hpp"

namespace mutants {

std::vector<LegalDevice> legal_devices() {
    using cases::Profile;
    std::vector<LegalDevice> out;
    const auto add = [&](std::string name, std::string what, Profile profile, const auto& change) {
        LegalDevice legal{std::move(name), std::move(what), profile, {}};
        change(legal.device);
        out.push_back(std::move(legal));
    };
    for (const Profile profile : cases::kProfiles) {
        add(fmt::format("plain_at_{}", cases::to_string(profile)), "no choice but the usual ones",
            profile, [](Device&) {});
    }
    add("half_up", "vertices snap half up", Profile::direct3d,
        [](Device& d) { d.rounding = Rounding::half_up; });
    for (const int bits : {4, 6, 10, 12}) {
        add(fmt::format("bits_{}", bits), fmt::format("{} subpixel bits", bits), Profile::direct3d,
            [&](Device& d) { d.subpixel_bits = bits; });
    }
    add("snapped_planes", "planes of values from snapped positions", Profile::direct3d,
        [](Device& d) { d.basis = PlaneBasis::snapped; });
    add("planes_at_vertex", "planes relative to the first vertex", Profile::direct3d,
        [](Device& d) { d.planes = PlaneForm::vertex; });
    add("barycentric", "values from barycentric weights", Profile::direct3d,
        [](Device& d) { d.planes = PlaneForm::barycentric; });
    add("whole_planes", "clipped triangles keep the planes of the whole triangle",
        Profile::direct3d, [](Device& d) { d.piece_planes = false; });
    add("guard_band", "a guard band instead of clipping at the sides", Profile::direct3d,
        [](Device& d) { d.clip = ClipMethod::guard_band; });
    add("fused", "fused multiply-add", Profile::direct3d, [](Device& d) { d.fused = true; });
    add("reciprocal_w", "multiplies with 1/w instead of dividing", Profile::direct3d,
        [](Device& d) { d.reciprocal_w = true; });
    add("scales_before_it_divides",
        "the viewport's scale is multiplied first, with a 1/w that is not rounded correctly",
        Profile::direct3d, [](Device& d) {
            d.near_reciprocal = true;
            d.scales_first = true;
        });
    for (const PlaneBasis basis : {PlaneBasis::unsnapped, PlaneBasis::snapped}) {
        const bool is_snapped = basis == PlaneBasis::snapped;
        add(is_snapped ? "depth_unsnapped_values_snapped" : "depth_snapped_values_unsnapped",
            fmt::format("depth planes from {} positions, all others from {} ones",
                        is_snapped ? "unsnapped" : "snapped", is_snapped ? "snapped" : "unsnapped"),
            Profile::direct3d, [&](Device& d) {
                d.basis = basis;
                d.depth_has_other_basis = true;
            });
    }
    for (const int bits : {0, 2, 8}) {
        add(fmt::format("viewports_of_{}_bits", bits),
            fmt::format("bounds of viewports are rounded to {} subpixel bits", bits),
            Profile::direct3d, [&](Device& d) {
                d.viewport_bits = bits;
                d.keeps_viewport_grid = true;
            });
    }
    add("strips_keep_the_first_order",
        "barycentrics of strips have the order of the first vertex convention with the last one",
        Profile::direct3d, [](Device& d) { d.first_strip_order = true; });
    add("enlarges_by_half_a_pixel",
        "overestimation enlarges triangles by half a pixel, and culls those without area",
        Profile::direct3d, [](Device& d) {
            d.overestimation = software::Overestimation::half_pixel;
            d.rasterizes_degenerates = false;
        });
    add("enlarges_by_a_unit_and_counts_borders",
        "overestimation enlarges triangles by a unit, and borders count", Profile::direct3d,
        [](Device& d) {
            d.overestimation = software::Overestimation::unit;
            d.counts_borders = true;
            d.clip = ClipMethod::guard_band;
        });
    add("covers_piece_by_piece",
        "conservative draws cover by each piece of a clipped triangle by itself", Profile::direct3d,
        [](Device& d) {
            d.overestimation = software::Overestimation::unit;
            d.covers_by_piece = true;
        });
    add("mitres_corners", "overestimation moves edges, which meet where they do", Profile::practice,
        [](Device& d) {
            d.overestimation = software::Overestimation::half_pixel;
            d.mitres_corners = true;
        });
    add("dithers_alpha", "alpha to coverage keeps more or fewer samples by the pixel",
        Profile::direct3d, [](Device& d) { d.alpha_mask = software::AlphaMask::dithered; });
    add("alpha_keeps_the_last", "alpha to coverage keeps the last samples", Profile::direct3d,
        [](Device& d) { d.alpha_mask = software::AlphaMask::last; });
    add("alpha_keeps_none", "alpha to coverage keeps no sample, whatever alpha is",
        Profile::practice, [](Device& d) { d.alpha_mask = software::AlphaMask::none; });
    add("alpha_keeps_all", "alpha to coverage keeps every sample, whatever alpha is",
        Profile::practice, [](Device& d) { d.alpha_mask = software::AlphaMask::all; });
    add("counts_most", "pipeline statistics count all that they may", Profile::direct3d,
        [](Device& d) { d.counts_most = true; });
    add("odd_quads", "quads of derivatives begin at odd pixels", Profile::direct3d,
        [](Device& d) { d.odd_quads = true; });
    add("blend_in_binary32", "bytes are blended in binary32", Profile::direct3d,
        [](Device& d) { d.blend = BlendMath::binary32; });
    add("blend_in_fused_binary32", "the same fused, codes rounded half to even", Profile::direct3d,
        [](Device& d) {
            d.blend = BlendMath::binary32;
            d.unorm = UnormRounding::nearest_even;
            d.fused = true;
        });
    add("blend_with_one_product", "factors f and 1 - f are blended with one product, in binary32",
        Profile::direct3d, [](Device& d) { d.blend = BlendMath::one_product; });
    add("bytes_divided_by_255", "products of bytes divided by 255, halves rounded towards zero",
        Profile::direct3d, [](Device& d) {
            d.multiply = FixedMultiply::divide;
            d.half_toward_zero = true;
        });
    for (const Profile profile : {Profile::vulkan, Profile::practice}) {
        add(fmt::format("unorm_rounds_down_at_{}", cases::to_string(profile)),
            "UNORM is rounded down", profile, [](Device& d) { d.unorm = UnormRounding::down; });
    }
    for (const PlaneBasis basis : {PlaneBasis::unsnapped, PlaneBasis::snapped}) {
        add(basis == PlaneBasis::snapped ? "depth_tested_at_samples_snapped"
                                         : "depth_tested_at_samples",
            basis == PlaneBasis::snapped
                ? "depth planes tested at each sample, planes from snapped positions"
                : "depth planes tested at each sample, not by cutting",
            Profile::direct3d, [&](Device& d) {
                d.tests_depth = true;
                d.basis = basis;
                d.clip = ClipMethod::guard_band;
            });
    }
    add("resolve_truncates", "averages of codes rounded down, of sRGB taken of the codes",
        Profile::direct3d, [](Device& d) {
            d.resolve_truncates = true;
            d.srgb_resolved_encoded = true;
        });
    add("short_levels_of_detail", "levels of detail are kept from -16 to 31", Profile::direct3d,
        [](Device& d) { d.short_levels = true; });
    add("blit_clamped_at_the_region", "a linear blit reads nothing beyond its region",
        Profile::direct3d, [](Device& d) { d.blit_edge = BlitEdge::region; });
    add("blit_in_steps", "coordinates of a blit are summed up from texel to texel",
        Profile::direct3d, [](Device& d) { d.blit_steps = true; });
    add("inputs_at_the_centre_of_shaded_samples",
        "with sample shading undecorated inputs stay at the pixel's centre", Profile::direct3d,
        [](Device& d) { d.inputs_follow_samples = false; });
    add("inputs_near_a_corner_at_vulkan",
        "with several samples undecorated inputs are evaluated near a corner of the pixel",
        Profile::vulkan, [](Device& d) { d.corner_inputs = true; });
    add("inputs_at_a_sample_of_coarse_fragments",
        "inputs of fragments of several pixels are evaluated at the first covered sample",
        Profile::practice, [](Device& d) { d.coarse_inputs_at_sample = true; });
    add("facing_of_unsnapped_positions_at_vulkan",
        "facing comes from unsnapped positions, so that slivers may face either way",
        Profile::vulkan, [](Device& d) { d.facing_unsnapped = true; });
    add("centroid_is_the_mean", "centroid is the mean of the covered samples", Profile::practice,
        [](Device& d) { d.centroid = Centroid::mean; });
    add("like_swiftshader", "SwiftShader's choices", Profile::direct3d, [](Device& d) {
        d.subpixel_bits = 4;
        d.basis = PlaneBasis::snapped;
        d.planes = PlaneForm::vertex;
        d.piece_planes = false;
    });
    add("like_llvmpipe", "llvmpipe's choices", Profile::direct3d, [](Device& d) {
        d.fused = true;
        d.reciprocal_w = true;
    });
    add("like_hardware", "what graphics processors usually choose", Profile::direct3d,
        [](Device& d) {
            d.basis = PlaneBasis::snapped;
            d.planes = PlaneForm::barycentric;
            d.piece_planes = false;
            d.clip = ClipMethod::guard_band;
            d.fused = true;
        });
    struct Snap {
        std::string_view name, what;
        Rounding rounding;
    };
    const Snap snaps[] = {{"floor", "vertices snap downwards", Rounding::floor},
                          {"ceil", "vertices snap upwards", Rounding::ceil},
                          {"truncate", "vertices snap towards zero", Rounding::truncate}};
    for (const Snap& snap : snaps) {
        add(std::string(snap.name), std::string(snap.what), Profile::practice,
            [&](Device& d) { d.rounding = snap.rounding; });
        add(fmt::format("{}_4_bits_snapped", snap.name),
            fmt::format("{}, 4 subpixel bits, planes from snapped positions", snap.what),
            Profile::practice, [&](Device& d) {
                d.rounding = snap.rounding;
                d.subpixel_bits = 4;
                d.basis = PlaneBasis::snapped;
            });
        add(fmt::format("{}_guard_band_at_vulkan", snap.name),
            fmt::format("{}, with a guard band", snap.what), Profile::vulkan, [&](Device& d) {
                d.rounding = snap.rounding;
                d.clip = ClipMethod::guard_band;
            });
    }
    struct Tie {
        std::string_view name, what;
        TieRule rule;
    };
    const Tie ties[] = {
        {"ties_top_right", "top and right edges own their samples", TieRule::top_right},
        {"ties_bottom_left", "bottom and left edges own their samples", TieRule::bottom_left},
        {"ties_bottom_right", "bottom and right edges own their samples", TieRule::bottom_right},
        {"ties_left_top", "exactly vertical left edges and edges above own their samples",
         TieRule::left_top}};
    for (const Tie& tie : ties) {
        add(std::string(tie.name), std::string(tie.what), Profile::practice,
            [&](Device& d) { d.ties = tie.rule; });
        add(fmt::format("{}_floor_6_bits_at_vulkan", tie.name),
            fmt::format("{}, vertices snap downwards to 6 bits", tie.what), Profile::vulkan,
            [&](Device& d) {
                d.ties = tie.rule;
                d.rounding = Rounding::floor;
                d.subpixel_bits = 6;
            });
    }
    return out;
}

std::string describe(const cases::Case& c, const diff::Verdict& verdict) {
    if (!verdict.error.empty()) {
        return fmt::format("{}: {}", c.id, verdict.error);
    }
    if (verdict.findings.empty()) {
        return fmt::format("{}: no finding", c.id);
    }
    const diff::Finding& f = verdict.findings.front();
    const uint64_t total =
        std::accumulate(verdict.counts.begin(), verdict.counts.end(), uint64_t{0});
    return fmt::format(
        "{}: {} finding(s), first: {} {} [{}] at {} sample {} {}: expected {}, "
        "got {}: {} (ratio {:.3g})",
        c.id, total, diff::to_string(f.kind), f.rule, cases::to_string(f.level),
        cases::pixel_text(c.target, diff::sample_of(f)), f.sample, f.quantity, f.expected, f.got,
        f.why, f.ratio);
}

void for_each_parallel(size_t count, const std::function<void(size_t)>& work) {
    std::atomic<size_t> next{0};
    const auto run = [&] {
        for (size_t k = next++; k < count; k = next++) {
            work(k);
        }
    };
    std::vector<std::jthread> threads;
    for (unsigned t = 1; t < std::max(1U, std::thread::hardware_concurrency()); ++t) {
        threads.emplace_back(run);
    }
    run();
}

diff::Verdict judge(const cases::Case& c, const Device& device, cases::Profile profile) {
    ref::Limits limits{device.subpixel_bits};
    limits.viewport_bits = device.viewport_bits;
    limits.first_strip_order = device.first_strip_order;
    limits.overestimation = software::overestimation(device);
    limits.rasterizes_degenerates = device.rasterizes_degenerates;
    const auto capture = captured(c, device);
    diff::Verdict verdict = compare(c, ref::expect(c, limits, profile), capture);
    if (device.keeps_viewport_grid && !c.blit && !verdict.ok() && verdict.error.empty()) {
        for (const cases::Case& kept : ref::on_viewport_grids(c, limits)) {
            diff::Verdict found = compare(kept, ref::expect(kept, limits, profile), capture);
            if (found.ok()) {
                return found;
            }
        }
    }
    return verdict;
}

bool is_named(const cases::Case& c, std::string_view id) {
    return c.id == id ||
           (c.id.starts_with(id) && c.id.size() > id.size() && c.id[id.size()] == ':');
}

}  // namespace mutants
