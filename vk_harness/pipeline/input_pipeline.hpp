// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pipelines that read what was drawn as input attachments (door input_attachment,
// cases/model/door.hpp).
#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "cases/format/color_format.hpp"
#include "vk_harness/pipeline/pipeline_base.hpp"
#include "vk_harness/pipeline/render_pass.hpp"
#include "vk_harness/target/attachments.hpp"

namespace vk_harness {

// What distinguishes two of them.
struct InputKey {
    PassKey pass;        // of which they are for the last subpass
    uint32_t index = 0;  // among its input attachments
    uint32_t words = 1;  // of a sample in the buffer
    cases::ComponentKind kind = cases::ComponentKind::binary32;
    std::array<uint8_t, 4> bits{}, first_bit{};
    friend auto operator<=>(const InputKey&, const InputKey&) = default;
};

InputKey input_key(const PassKey& pass, const cases::Target& target, const Attachment& attachment,
                   uint32_t index);

// `pass`: of key.pass.
Handle<VkPipeline> make_input(PipelineBase& base, const InputKey& key, VkRenderPass pass);

}  // namespace vk_harness
