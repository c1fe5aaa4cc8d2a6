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
    Fault{"flat-removed", "Flat inputs are interpolated.", {.shader = replace<kFlat, 0>}},
    Fault{"flat-as-noperspective",
          "Flat inputs are interpolated without perspective.",
          {.shader = replace<kFlat, kNoPerspective>}},
    Fault{"flat-added", "Plain inputs are flat.", {.shader = add<kFlat>}},
    Fault{"noperspective-removed",
          "Inputs without perspective are interpolated with it.",
          {.shader = replace<kNoPerspective, 0>}},
    Fault{"noperspective-as-flat",
          "Inputs without perspective are flat.",
          {.shader = replace<kNoPerspective, kFlat>}},
    Fault{"noperspective-added",
          "Plain inputs are interpolated without perspective.",
          {.shader = add<kNoPerspective>}},
    Fault{"centroid-removed",
          "Centroid inputs are evaluated as plain ones.",
          {.shader = replace<kCentroid, 0>}},
    Fault{"centroid-as-sample",
          "Centroid inputs are evaluated at each sample.",
          {.shader = replace<kCentroid, kSample>}},
    Fault{"centroid-added",
          "Plain inputs are evaluated at the centroid.",
          {.shader = add<kCentroid>}},
    Fault{"sample-removed",
          "Sample inputs are evaluated as plain ones.",
          {.shader = replace<kSample, 0>}},
    Fault{"sample-as-centroid",
          "Sample inputs are evaluated at the centroid.",
          {.shader = replace<kSample, kCentroid>}},
    Fault{"sample-added", "Plain inputs are evaluated at each sample.", {.shader = add<kSample>}},
    Fault{"clip-distance-lost",
          "The last clip distance clips nothing.",
          {.shader = [](ShaderWords& w) { return w.replace_last_distance(kClipDistance); }}},
    Fault{"clip-distance-negated",
          "Clip distances clip the other side.",
          {.shader = [](ShaderWords& w) { return w.negate_distances(kClipDistance); }}},
    Fault{"clip-distance-culls",
          "Clip distances cull whole triangles.",
          {.shader =
               [](ShaderWords& w) { return w.rename_distances(kClipDistance, kCullDistance); }}},
    Fault{"cull-distance-lost",
          "The last cull distance culls nothing.",
          {.shader = [](ShaderWords& w) { return w.replace_last_distance(kCullDistance); }}},
    Fault{"cull-distance-negated",
          "Cull distances cull the other side.",
          {.shader = [](ShaderWords& w) { return w.negate_distances(kCullDistance); }}},
    Fault{"cull-distance-clips",
          "Cull distances clip.",
          {.shader =
               [](ShaderWords& w) { return w.rename_distances(kCullDistance, kClipDistance); }}},
    Fault{"fragment-discard-ignored",
          "What a fragment shader discards is drawn.",
          {.shader = [](ShaderWords& w) { return w.discard_nothing(); }}},
    Fault{"fragment-demote-ignored",
          "What OpDemoteToHelperInvocation discards is drawn.",
          {.shader = [](ShaderWords& w) { return w.demote_nothing(); }}},
    Fault{"fragment-terminate-ignored",
          "What OpTerminateInvocation discards is drawn.",
          {.shader = [](ShaderWords& w) { return w.terminate_nothing(); }}},
    Fault{"fragment-discard-zero",
          "A fragment shader that discards negative values discards 0, too.",
          {.shader = [](ShaderWords& w) { return w.discard_equal(); }}},
    Fault{"fragment-discard-positive",
          "A fragment shader that discards negative values discards positive ones.",
          {.shader = [](ShaderWords& w) { return w.discard_greater(); }}},
    Fault{"early-tests-lost",
          "Fragment shaders lose their early tests.",
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
