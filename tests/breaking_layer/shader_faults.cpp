// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Interpolation decorations and clip distances, in the words of SPIR-V modules.
#include <array>

#include "fault.hpp"

namespace breaking {

namespace {

template <uint32_t from, uint32_t to>
bool replace(ShaderWords& words) {
    return words.replace_input_decoration(from, to);
}

template <uint32_t decoration>
bool add(ShaderWords& words) {
    return words.decorate_plain_inputs(decoration);
}

constexpr std::array kShaderFaults = {
    Fault{"flat-removed", "flat-smooth"_fault, {.shader = replace<kFlat, 0>}},
    Fault{"flat-as-noperspective",
          "flat-as-noperspective"_fault,
          {.shader = replace<kFlat, kNoPerspective>}},
    Fault{"flat-added", "smooth-flat"_fault, {.shader = add<kFlat>}},
    Fault{"noperspective-removed",
          "noperspective-smooth"_fault,
          {.shader = replace<kNoPerspective, 0>}},
    Fault{"noperspective-as-flat",
          "noperspective-as-flat"_fault,
          {.shader = replace<kNoPerspective, kFlat>}},
    Fault{"noperspective-added", "smooth-as-noperspective"_fault, {.shader = add<kNoPerspective>}},
    Fault{"centroid-removed", "centroid-at-centre"_fault, {.shader = replace<kCentroid, 0>}},
    Fault{
        "centroid-as-sample", "centroid-as-sample"_fault, {.shader = replace<kCentroid, kSample>}},
    Fault{"centroid-added", "plain-as-centroid"_fault, {.shader = add<kCentroid>}},
    Fault{"sample-removed", "sample-at-centre"_fault, {.shader = replace<kSample, 0>}},
    Fault{
        "sample-as-centroid", "sample-as-centroid"_fault, {.shader = replace<kSample, kCentroid>}},
    Fault{"sample-added", "plain-as-sample"_fault, {.shader = add<kSample>}},
    Fault{"clip-distance-lost",
          "distance-last-ignored"_fault,
          {.shader = [](ShaderWords& w) { return w.replace_last_distance(kClipDistance); }}},
    Fault{"clip-distance-negated",
          "distance-flipped"_fault,
          {.shader = [](ShaderWords& w) { return w.negate_distances(kClipDistance); }}},
    Fault{"clip-distance-culls",
          "clip-distance-culls"_fault,
          {.shader =
               [](ShaderWords& w) { return w.rename_distances(kClipDistance, kCullDistance); }}},
    Fault{"cull-distance-lost",
          "cull-distance-lost"_fault,
          {.shader = [](ShaderWords& w) { return w.replace_last_distance(kCullDistance); }}},
    Fault{"cull-distance-negated",
          "cull-distance-negated"_fault,
          {.shader = [](ShaderWords& w) { return w.negate_distances(kCullDistance); }}},
    Fault{"cull-distance-clips",
          "cull-distance-clips"_fault,
          {.shader =
               [](ShaderWords& w) { return w.rename_distances(kCullDistance, kClipDistance); }}},
    Fault{"fragment-discard-ignored",
          "discard-fragment-ignored"_fault,
          {.shader = [](ShaderWords& w) { return w.discard_nothing(); }}},
    Fault{"fragment-demote-ignored",
          "demote-ignored"_fault,
          {.shader = [](ShaderWords& w) { return w.demote_nothing(); }}},
    Fault{"fragment-terminate-ignored",
          "terminate-ignored"_fault,
          {.shader = [](ShaderWords& w) { return w.terminate_nothing(); }}},
    Fault{"fragment-discard-zero",
          "discard-value-or-zero"_fault,
          {.shader = [](ShaderWords& w) { return w.discard_equal(); }}},
    Fault{"fragment-discard-positive",
          "A fragment shader that discards negative values discards positive ones.",
          {.shader = [](ShaderWords& w) { return w.discard_greater(); }}},
    Fault{"early-tests-lost",
          "discard-tests-late"_fault,
          {.shader = [](ShaderWords& w) { return w.lose_early_tests(); }}},
    Fault{"frag-depth-early",
          "Fragment shaders that write a depth have early tests.",
          {.shader = [](ShaderWords& w) { return w.test_depths_early(); }}},
    Fault{"early-tests-added",
          "Fragment shaders that discard have early tests.",
          {.shader = [](ShaderWords& w) { return w.test_discards_early(); }}},
};

}  // namespace

std::span<const Fault> shader_faults() {
    return kShaderFaults;
}

}  // namespace breaking
