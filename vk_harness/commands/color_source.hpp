// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What fragment shaders of bare.frag read their colours from: a part of a buffer, or a texture.
// Beside one colour lies another, so that a lost offset shows.
#pragma once

#include <vector>

#include "cases/model/case.hpp"
#include "vk_harness/memory/descriptor.hpp"
#include "vk_harness/memory/memory.hpp"
#include "vk_harness/pipeline/pipeline_base.hpp"

namespace vk_harness {

// Whether some draw of the case needs the class below.
bool has_color_sources(const cases::Case& c);

// The sources of one case's draws; those that push their colours have none.
class ColorSources {
  public:
    ColorSources(const Device& device, const PipelineLayouts& layouts, const cases::Case& c);

    // Fills the textures. Outside of rendering, in the submission of the draws.
    void record(VkCommandBuffer commands) const;
    // Binds what the shader of a draw reads, if it reads anything.
    void bind(VkCommandBuffer commands, uint32_t draw) const;

  private:
    struct Source {
        cases::ColorFrom from = cases::ColorFrom::push_constant;
        DescriptorSets set;
        SampledImage image;
        VkClearColorValue color{};
        VkDeviceSize texels = 0;  // in the buffer
        uint32_t side = 0;        // texels
    };
    SampledImage make_texture(VkFormat format, uint32_t side, bool is_rendered) const;

    const Device* device_;
    const PipelineLayouts* layouts_;
    Buffer buffer_;
    Handle<VkSampler> sampler_;
    std::vector<Source> sources_;  // one a draw
};

}  // namespace vk_harness
