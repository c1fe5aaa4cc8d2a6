// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Sample mask, sample shading, sample locations, resolves.
#include <algorithm>
#include <array>

#include "fault.hpp"

namespace breaking {

namespace {

bool no_mask(PipelineCopy& p) {
    const VkSampleMask all = (VkSampleMask{2} << (p.multisample.rasterizationSamples - 1)) - 1;
    const bool altered = (p.mask & all) != all;
    p.mask = ~VkSampleMask{0};
    return altered;
}

bool keep_alpha(PipelineCopy& p) {
    return change(p.multisample.alphaToOneEnable, VK_FALSE);
}

bool keep_alpha_of_one_sample(PipelineCopy& p) {
    return p.multisample.rasterizationSamples == VK_SAMPLE_COUNT_1_BIT && keep_alpha(p);
}

bool rotate_mask(PipelineCopy& p) {
    const uint32_t count = p.multisample.rasterizationSamples;
    const VkSampleMask all = (VkSampleMask{2} << (count - 1)) - 1;
    const VkSampleMask bits = p.mask & all;
    p.mask = (bits << 1U | bits >> (count - 1)) & all;
    return p.mask != bits;
}

bool sample_shading_on(PipelineCopy& p) {
    const bool altered = p.multisample.rasterizationSamples > 1 &&
                         change(p.multisample.sampleShadingEnable, VK_TRUE);
    p.multisample.minSampleShading = altered ? 1.0F : p.multisample.minSampleShading;
    return altered;
}

template <bool (*alter)(std::span<VkSampleLocationEXT>)>
bool of_pipeline(PipelineCopy& p) {
    return alter(p.places);
}

// The standard locations are not to be had by disabling: the depth image is told of the others,
// too.
bool all_centre(std::span<VkSampleLocationEXT> places) {
    bool altered = false;
    for (VkSampleLocationEXT& place : places) {
        const bool x = change(place.x, 0.5F);
        altered = change(place.y, 0.5F) || x || altered;
    }
    return altered;
}
bool mirror_locations(std::span<VkSampleLocationEXT> places) {
    bool altered = false;
    for (VkSampleLocationEXT& place : places) {
        altered = change(place.y, 15.0F / 16 - place.y) || altered;
    }
    return altered;
}
bool reverse_locations(std::span<VkSampleLocationEXT> places) {
    std::reverse(places.begin(), places.end());
    return places.size() > 1;
}
bool move_locations(std::span<VkSampleLocationEXT> places) {
    bool altered = false;
    for (VkSampleLocationEXT& place : places) {
        altered = (place.x < 15.0F / 16 && change(place.x, place.x + 1.0F / 16)) || altered;
    }
    return altered;
}

bool no_resolve(Rendering& r) {
    bool altered = false;
    for (VkRenderingAttachmentInfo& color : r.colors) {
        altered = change(color.resolveMode, VK_RESOLVE_MODE_NONE) || altered;
    }
    return (r.depth && change(r.depth->resolveMode, VK_RESOLVE_MODE_NONE)) || altered;
}
bool resolve_no_depth(Rendering& r) {
    return r.depth && change(r.depth->resolveMode, VK_RESOLVE_MODE_NONE);
}
bool swap_min_max(Rendering& r) {
    if (!r.depth) {
        return false;
    }
    VkResolveModeFlagBits& mode = r.depth->resolveMode;
    return (mode == VK_RESOLVE_MODE_MIN_BIT && change(mode, VK_RESOLVE_MODE_MAX_BIT)) ||
           (mode == VK_RESOLVE_MODE_MAX_BIT && change(mode, VK_RESOLVE_MODE_MIN_BIT));
}
bool depth_sample_zero(Rendering& r) {
    return r.depth && r.depth->resolveMode != VK_RESOLVE_MODE_NONE &&
           change(r.depth->resolveMode, VK_RESOLVE_MODE_SAMPLE_ZERO_BIT);
}
constexpr std::array kMultisampleFaults = {
    Fault{"sample-mask-ignored", "mask-ignored"_fault, {.pipeline = no_mask}},
    Fault{"sample-mask-rotated", "sample-mask-rotated"_fault, {.pipeline = rotate_mask}},
    Fault{
        "sample-shading-off",
        "shading-once"_fault,
        {.pipeline =
             [](PipelineCopy& p) { return change(p.multisample.sampleShadingEnable, VK_FALSE); }}},
    Fault{"sample-shading-on", "sample-shading-always"_fault, {.pipeline = sample_shading_on}},
    Fault{"sample-shading-halved",
          "sample-shading-halved"_fault,
          {.pipeline =
               [](PipelineCopy& p) {
                   return change(p.multisample.minSampleShading,
                                 p.multisample.minSampleShading / 2);
               }}},
    Fault{
        "sample-alpha-to-coverage",
        "Alpha makes coverage.",
        {.pipeline =
             [](PipelineCopy& p) { return change(p.multisample.alphaToCoverageEnable, VK_TRUE); }}},
    Fault{"sample-alpha-to-coverage-off",
          "alpha-to-coverage-ignored"_fault,
          {.pipeline =
               [](PipelineCopy& p) {
                   return change(p.multisample.alphaToCoverageEnable, VK_FALSE);
               }}},
    Fault{"sample-alpha-to-one-off", "alpha-to-one-ignored"_fault, {.pipeline = keep_alpha}},
    Fault{"sample-alpha-to-one-multisampled",
          "alpha-to-one-multisampled"_fault,
          {.pipeline = keep_alpha_of_one_sample}},
    Fault{"sample-locations-centre",
          "All samples with locations of their own lie at the centre.",
          {.pipeline = of_pipeline<all_centre>, .sample_locations = all_centre}},
    Fault{"sample-locations-mirrored",
          "samples-upside-down"_fault,
          {.pipeline = of_pipeline<mirror_locations>, .sample_locations = mirror_locations}},
    Fault{"sample-locations-reversed",
          "Sample locations are numbered last to first.",
          {.pipeline = of_pipeline<reverse_locations>, .sample_locations = reverse_locations}},
    Fault{"sample-locations-moved",
          "Sample locations lie 1/16 pixel too far right.",
          {.pipeline = of_pipeline<move_locations>, .sample_locations = move_locations}},
    Fault{"resolve-off", "resolve-ignored"_fault, {.rendering = no_resolve}},
    Fault{"resolve-no-depth", "Depth is not resolved.", {.rendering = resolve_no_depth}},
    Fault{"resolve-min-max-swapped",
          "Minimum and maximum are swapped in resolves of depth.",
          {.rendering = swap_min_max}},
    Fault{"resolve-depth-sample-zero",
          "Depth is resolved by sample 0 whatever is asked.",
          {.rendering = depth_sample_zero}},
};

}  // namespace

std::span<const Fault> multisample_faults() {
    return kMultisampleFaults;
}

}  // namespace breaking
