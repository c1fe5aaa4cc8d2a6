// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pipelines whose draws clear attachments: the door clear_draw (cases/model/door.hpp).
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "cases/model/case.hpp"
#include "shaders/shaders.hpp"
#include "vk_harness/pipeline/pipeline_base.hpp"
#include "vk_harness/target/attachments.hpp"

namespace vk_harness {

// What distinguishes two of them.
struct ClearKey {
    std::vector<VkFormat> colors;      // of the rendering, by location
    std::optional<uint32_t> location;  // of the colour that is written; nothing: depth and stencil
    shaders::Output output = shaders::Output::number;  // to that colour
    VkFormat depth_format = VK_FORMAT_UNDEFINED, stencil_format = VK_FORMAT_UNDEFINED;
    bool has_depth = false, has_stencil = false;
    uint32_t samples = 1;
    std::vector<std::array<uint8_t, 2>> sample_locations;
    friend auto operator<=>(const ClearKey&, const ClearKey&) = default;
};

// One for each colour attachment, then one for depth and stencil, if there are.
std::vector<ClearKey> clear_keys(const cases::Target& target,
                                 const std::vector<Attachment>& attachments);

Handle<VkPipeline> make_clear(PipelineBase& base, const ClearKey& key);

// A value that is not the one to which an attachment is cleared.
VkClearValue other_clear(const Attachment& attachment);

}  // namespace vk_harness
