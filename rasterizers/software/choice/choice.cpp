// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "rasterizers/software/choice/choice.hpp"

#include <algorithm>
#include <type_traits>

namespace software {

namespace {

// Fails to compile when Device has another number of fields: then the table below lacks one.
[[maybe_unused]] void name_all_fields(const Device& device) {
    [[maybe_unused]] const auto& [subpixel_bits, rounding, ties, planes, basis,
                                  depth_has_other_basis, clip, piece_planes, tests_distances,
                                  tests_depth, fused, reciprocal_w, near_reciprocal, scales_first,
                                  centroid, inputs_follow_samples, corner_inputs,
                                  coarse_inputs_at_sample, facing_unsnapped, odd_quads,
                                  viewport_bits, keeps_viewport_grid, first_strip_order, enlarges,
                                  counts_borders, mitres_corners, covers_by_piece,
                                  rasterizes_degenerates, unorm, narrow_through_eight, blend,
                                  multiply, alpha_mask, half_toward_zero, resolve_truncates,
                                  srgb_resolved_encoded, short_levels, blit_edge, blit_steps,
                                  counts_most, fault, place_x, place_y] = device;
}

template <auto Field>
void set_word(Device& device, size_t value) {
    using Value = std::remove_reference_t<decltype(device.*Field)>;
    device.*Field = static_cast<Value>(value);
}
template <auto Field>
Choice flag(std::string_view key) {
    return {key, {"no", "yes"}, [](Device& device, size_t value) { device.*Field = value == 1; }};
}

std::string list_of(const std::vector<std::string_view>& words) {
    std::string out;
    for (const std::string_view word : words) {
        out += (out.empty() ? "" : ", ") + std::string(word);
    }
    return out;
}

}  // namespace

const std::vector<Choice>& all_choices() {
    static const std::vector<Choice> kChoices = {
        {"subpixel-bits",
         {"4", "5", "6", "7", "8", "9", "10", "11", "12"},
         [](Device& d, size_t value) { d.subpixel_bits = static_cast<int>(value) + 4; }},
        {"rounding",
         {"nearest-even", "half-up", "floor", "ceil", "truncate"},
         set_word<&Device::rounding>},
        {"ties",
         {"top-left", "top-right", "bottom-left", "bottom-right", "left-top"},
         set_word<&Device::ties>},
        {"planes", {"origin", "vertex", "barycentric"}, set_word<&Device::planes>},
        {"basis", {"unsnapped", "snapped"}, set_word<&Device::basis>},
        flag<&Device::depth_has_other_basis>("depth-has-other-basis"),
        {"clip", {"geometric", "guard-band"}, set_word<&Device::clip>},
        flag<&Device::piece_planes>("piece-planes"),
        flag<&Device::tests_distances>("tests-distances"),
        flag<&Device::tests_depth>("tests-depth"),
        flag<&Device::fused>("fused"),
        flag<&Device::reciprocal_w>("reciprocal-w"),
        flag<&Device::near_reciprocal>("near-reciprocal"),
        flag<&Device::scales_first>("scales-first"),
        {"centroid", {"first-sample", "mean"}, set_word<&Device::centroid>},
        flag<&Device::inputs_follow_samples>("inputs-follow-samples"),
        flag<&Device::corner_inputs>("corner-inputs"),
        flag<&Device::coarse_inputs_at_sample>("coarse-inputs-at-sample"),
        flag<&Device::facing_unsnapped>("facing-unsnapped"),
        flag<&Device::odd_quads>("odd-quads"),
        {"viewport-bits",
         {"0", "1", "2", "3", "4", "5", "6", "7", "8"},
         [](Device& d, size_t value) { d.viewport_bits = static_cast<int>(value); }},
        flag<&Device::keeps_viewport_grid>("keeps-viewport-grid"),
        flag<&Device::first_strip_order>("first-strip-order"),
        {"overestimation", {"none", "unit", "half-pixel"}, set_word<&Device::overestimation>},
        flag<&Device::counts_borders>("counts-borders"),
        flag<&Device::mitres_corners>("mitres-corners"),
        flag<&Device::covers_by_piece>("covers-by-piece"),
        flag<&Device::rasterizes_degenerates>("rasterizes-degenerates"),
        {"unorm", {"nearest", "nearest-even", "nearest-down", "down"}, set_word<&Device::unorm>},
        flag<&Device::narrow_through_eight>("narrow-through-eight"),
        {"blend", {"fixed", "binary32", "cut"}, set_word<&Device::blend>},
        {"multiply", {"divide", "shifts"}, set_word<&Device::multiply>},
        {"alpha-mask",
         {"ordered", "dithered", "last", "none", "all"},
         set_word<&Device::alpha_mask>},
        flag<&Device::half_toward_zero>("half-toward-zero"),
        flag<&Device::resolve_truncates>("resolve-truncates"),
        flag<&Device::srgb_resolved_encoded>("srgb-resolved-encoded"),
        flag<&Device::short_levels>("short-levels"),
        {"blit-edge", {"image", "region"}, set_word<&Device::blit_edge>},
        flag<&Device::blit_steps>("blit-steps"),
        flag<&Device::counts_most>("counts-most"),
    };
    return kChoices;
}

std::string set_choices(Device& device, std::string_view text) {
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(','));
        text.remove_prefix(std::min(text.size(), word.size() + 1));
        const std::string_view key = word.substr(0, word.find('='));
        const auto choice = std::ranges::find(all_choices(), key, &Choice::key);
        if (choice == all_choices().end()) {
            std::vector<std::string_view> keys;
            for (const Choice& c : all_choices()) {
                keys.push_back(c.key);
            }
            return "the software rasterizer has no choice '" + std::string(key) + "'; it has " +
                   list_of(keys);
        }
        const std::string_view value =
            word.size() > key.size() ? word.substr(key.size() + 1) : std::string_view();
        const auto at = std::ranges::find(choice->values, value);
        if (at == choice->values.end()) {
            return "'" + std::string(value) + "' is no value of '" + std::string(key) +
                   "', which may be " + list_of(choice->values);
        }
        choice->set(device, static_cast<size_t>(at - choice->values.begin()));
    }
    return {};
}

}  // namespace software
