// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Several colour attachments: what is one's own is taken from another. A case's colour targets are
// the last of its attachments, so the last two of these are looked at: both are colour targets in
// cases that have several.
#include <algorithm>
#include <array>
#include <utility>

#include "fault.hpp"

namespace breaking {

namespace {

using Blend = VkPipelineColorBlendAttachmentState;

bool is_same(const Blend& a, const Blend& b) {
    return a.blendEnable == b.blendEnable && a.srcColorBlendFactor == b.srcColorBlendFactor &&
           a.dstColorBlendFactor == b.dstColorBlendFactor && a.colorBlendOp == b.colorBlendOp &&
           a.srcAlphaBlendFactor == b.srcAlphaBlendFactor &&
           a.dstAlphaBlendFactor == b.dstAlphaBlendFactor && a.alphaBlendOp == b.alphaBlendOp &&
           a.colorWriteMask == b.colorWriteMask;
}

// What a driver with one blend state for its last two attachments would do.
bool state_as_before(PipelineCopy& p) {
    if (p.blends.size() < 2) {
        return false;
    }
    Blend& last = p.blends.back();
    const Blend& before = p.blends[p.blends.size() - 2];
    const bool altered = !is_same(last, before);
    last = before;
    return altered;
}

bool turn_states(PipelineCopy& p) {
    if (p.blends.size() < 2) {
        return false;
    }
    std::swap(p.blends.back(), p.blends[p.blends.size() - 2]);
    return !is_same(p.blends.back(), p.blends[p.blends.size() - 2]);
}

bool turn_masks(PipelineCopy& p) {
    if (p.blends.size() < 2) {
        return false;
    }
    std::swap(p.blends.back().colorWriteMask, p.blends[p.blends.size() - 2].colorWriteMask);
    return p.blends.back().colorWriteMask != p.blends[p.blends.size() - 2].colorWriteMask;
}

// The equations stay what they are: an attachment that does not blend has ZERO for both factors.
bool blend_together(PipelineCopy& p) {
    if (p.blends.size() < 2) {
        return false;
    }
    Blend& last = p.blends.back();
    Blend& before = p.blends[p.blends.size() - 2];
    const VkBool32 any = last.blendEnable == VK_TRUE || before.blendEnable == VK_TRUE;
    const bool altered = change(last.blendEnable, any);
    return change(before.blendEnable, any) || altered;
}

bool write_none_together(PipelineCopy& p) {
    const bool is_masked =
        p.blends.size() > 1 && std::any_of(p.blends.begin(), p.blends.end(),
                                           [](const Blend& b) { return b.colorWriteMask == 0; });
    return is_masked && change(p.blends.back().colorWriteMask, 0);
}

bool turn_clears(Rendering& r) {
    if (r.colors.size() < 2) {
        return false;
    }
    VkClearColorValue& last = r.colors.back().clearValue.color;
    VkClearColorValue& before = r.colors[r.colors.size() - 2].clearValue.color;
    std::swap(last, before);
    return !std::equal(std::begin(last.uint32), std::end(last.uint32), std::begin(before.uint32));
}

constexpr std::array kTargetFaults = {
    Fault{"targets-state-as-before",
          "The last attachment is blended and masked as the one before it.",
          {.pipeline = state_as_before}},
    Fault{"targets-states-turned",
          "The last two attachments are blended and masked as each other.",
          {.pipeline = turn_states}},
    Fault{"targets-masks-turned",
          "The write masks of the last two attachments are swapped.",
          {.pipeline = turn_masks}},
    Fault{"targets-blend-together",
          "Where one of the last two attachments is blended, both are.",
          {.pipeline = blend_together}},
    Fault{"targets-masked-together",
          "targets-masked-together"_fault,
          {.pipeline = write_none_together}},
    Fault{"targets-clears-turned",
          "The clear colours of the last two attachments are swapped.",
          {.rendering = turn_clears}},
};

}  // namespace

std::span<const Fault> target_faults() {
    return kTargetFaults;
}

}  // namespace breaking
