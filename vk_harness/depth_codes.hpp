// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which code of D24 a shader has read. Single samples can be read by shaders alone, as binary32,
// and Vulkan bounds nowhere how far that conversion may be off c / (2^24 - 1): neighbouring codes
// are about one unit in the last place apart, and lavapipe reads 0.37500006 of code 6291456 (c
// times the rounded reciprocal), which is nearer to code 6291457. So the device itself is asked:
// the codes around what was read are copied from a buffer to an image of one sample, which is
// exact, and read by the same kind of shader. The code that is read as the same bits is the one
// that the sample holds, if the device converts a code in the same way whatever the number of
// samples, and reads no other code as the same bits, which is checked: lavapipe reads 1 of the two
// largest codes.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "vk_harness/commands/submission.hpp"
#include "vk_harness/pipeline/pipeline_cache.hpp"

namespace vk_harness {

// Whether the device has images of this format of D24 to ask by.
bool can_ask_codes(const Capabilities& capabilities, VkFormat format);

class DepthCodes {
  public:
    explicit DepthCodes(const Device& device) : device_(&device) {}

    // Asks the device about the numbers, bits of binary32 that a shader read, of which it has not
    // been asked before. `submission`: one in which nothing is recorded and nothing executed.
    void learn(Submission& submission, PipelineCache& pipelines, VkFormat format,
               std::span<const uint32_t> words);

    // The depth (cases::depth_of_code) of each number that was learned; poison stays poison, and
    // what lies outside 0 to 1 stays what it is. A sentence: why the codes cannot be told.
    std::optional<std::string> decode(VkFormat format, std::span<const uint32_t> words,
                                      std::span<float> to) const;

  private:
    struct Format {
        std::unordered_map<uint32_t, uint32_t> code_of;  // by what it is read as
        std::set<uint32_t> asked;                        // codes
        std::set<uint32_t> ambiguous;                    // what several codes are read as
    };
    void ask(Submission& submission, PipelineCache& pipelines, VkFormat format,
             const std::vector<uint32_t>& codes);

    struct Asking;  // an image of codes and what a shader reads of it
    const Device* device_;
    std::unordered_map<VkFormat, Format> formats_;
    std::shared_ptr<Asking> last_;  // lives on if the device has not ended the work with it
};

}  // namespace vk_harness
