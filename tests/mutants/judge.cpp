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
#include "diff/color_planes.hpp"
#include "ref/expectation.hpp"

namespace mutants {

std::vector<LegalDevice> legal_devices() {
    using cases::Profile;
    std::vector<LegalDevice> out;
    const auto add = [&](std::string name, Profile profile, const auto& change) {
        LegalDevice legal{std::move(name), profile, {}};
        change(legal.device);
        out.push_back(std::move(legal));
    };
    for (const Profile profile : cases::kProfiles) {
        add(fmt::format("plain_at_{}", cases::to_string(profile)), profile, [](Device&) {});
    }
    add("half_up", Profile::direct3d, [](Device& d) { d.rounding = Rounding::half_up; });
    for (const int bits : {4, 6, 10, 12}) {
        add(fmt::format("bits_{}", bits), Profile::direct3d,
            [&](Device& d) { d.subpixel_bits = bits; });
    }
    add("snapped_planes", Profile::direct3d, [](Device& d) { d.basis = PlaneBasis::snapped; });
    add("planes_at_vertex", Profile::direct3d, [](Device& d) { d.planes = PlaneForm::vertex; });
    add("barycentric", Profile::direct3d, [](Device& d) { d.planes = PlaneForm::barycentric; });
    add("whole_planes", Profile::direct3d, [](Device& d) { d.piece_planes = false; });
    add("guard_band", Profile::direct3d, [](Device& d) { d.clip = ClipMethod::guard_band; });
    add("fused", Profile::direct3d, [](Device& d) { d.fused = true; });
    add("reciprocal_w", Profile::direct3d, [](Device& d) { d.reciprocal_w = true; });
    add("odd_quads", Profile::direct3d, [](Device& d) { d.odd_quads = true; });
    add("blend_in_binary32", Profile::direct3d, [](Device& d) { d.blend = BlendMath::binary32; });
    add("blend_in_fused_binary32", Profile::direct3d, [](Device& d) {
        d.blend = BlendMath::binary32;
        d.unorm = UnormRounding::nearest_even;
        d.fused = true;
    });
    add("bytes_divided_by_255", Profile::direct3d, [](Device& d) {
        d.multiply = FixedMultiply::divide;
        d.half_toward_zero = true;
    });
    for (const Profile profile : {Profile::vulkan, Profile::practice}) {
        add(fmt::format("unorm_rounds_down_at_{}", cases::to_string(profile)), profile,
            [](Device& d) { d.unorm = UnormRounding::down; });
    }
    add("resolve_truncates", Profile::direct3d, [](Device& d) {
        d.resolve_truncates = true;
        d.srgb_resolved_encoded = true;
    });
    add("inputs_at_the_centre_of_shaded_samples", Profile::direct3d,
        [](Device& d) { d.inputs_follow_samples = false; });
    add("centroid_is_the_mean", Profile::practice, [](Device& d) { d.centroid = Centroid::mean; });
    add("like_swiftshader", Profile::direct3d, [](Device& d) {
        d.subpixel_bits = 4;
        d.basis = PlaneBasis::snapped;
        d.planes = PlaneForm::vertex;
        d.piece_planes = false;
    });
    add("like_llvmpipe", Profile::direct3d, [](Device& d) {
        d.fused = true;
        d.reciprocal_w = true;
    });
    add("like_hardware", Profile::direct3d, [](Device& d) {
        d.basis = PlaneBasis::snapped;
        d.planes = PlaneForm::barycentric;
        d.piece_planes = false;
        d.clip = ClipMethod::guard_band;
        d.fused = true;
    });
    const std::pair<std::string_view, Rounding> roundings[] = {
        {"floor", Rounding::floor}, {"ceil", Rounding::ceil}, {"truncate", Rounding::truncate}};
    for (const auto& [name, rounding] : roundings) {
        add(std::string(name), Profile::practice, [&](Device& d) { d.rounding = rounding; });
        add(fmt::format("{}_4_bits_snapped", name), Profile::practice, [&](Device& d) {
            d.rounding = rounding;
            d.subpixel_bits = 4;
            d.basis = PlaneBasis::snapped;
        });
        add(fmt::format("{}_guard_band_at_vulkan", name), Profile::vulkan, [&](Device& d) {
            d.rounding = rounding;
            d.clip = ClipMethod::guard_band;
        });
    }
    const std::pair<std::string_view, TieRule> rules[] = {
        {"ties_top_right", TieRule::top_right},
        {"ties_bottom_left", TieRule::bottom_left},
        {"ties_bottom_right", TieRule::bottom_right},
        {"ties_left_top", TieRule::left_top}};
    for (const auto& [name, rule] : rules) {
        add(std::string(name), Profile::practice, [&](Device& d) { d.ties = rule; });
        add(fmt::format("{}_floor_6_bits_at_vulkan", name), Profile::vulkan, [&](Device& d) {
            d.ties = rule;
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
        diff::pixel_text(c.target, diff::place_of(f)), f.sample, f.quantity, f.expected, f.got,
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
    const ref::Expectation expectation = ref::expect(c, {device.subpixel_bits}, profile);
    diff::Capture capture;
    if (c.blit) {  // the device has no blits: the target stays as it was cleared
        capture.target = c.target;
        diff::add_color_plane(capture, c, expectation);
        return diff::compare_blit(c, profile, capture);
    }
    capture = render(c, device);
    diff::drop_unattached(capture, c);
    return diff::compare(c, expectation, capture);
}

bool is_named(const cases::Case& c, std::string_view id) {
    return c.id == id ||
           (c.id.starts_with(id) && c.id.size() > id.size() && c.id[id.size()] == ':');
}

}  // namespace mutants
