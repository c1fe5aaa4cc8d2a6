// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a case's samples lie in read-back memory, and how they become a capture.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "capture/capture.hpp"
#include "vk_harness/memory/memory.hpp"
#include "vk_harness/target/attachments.hpp"

namespace vk_harness {

// Byte offsets of each attachment in the read-back buffer. Words in sample order
// (capture/capture.hpp).
struct ReadbackLayout {
    std::vector<VkDeviceSize> offset;  // one an attachment
    VkDeviceSize end = 0;
};

// The layout of a case from byte `begin` on; every offset is a multiple of `alignment`, a power of
// two.
ReadbackLayout make_layout(const cases::Target& target, const std::vector<Attachment>& attachments,
                           VkDeviceSize begin, VkDeviceSize alignment);

// Fills memory with capture::kPoison words, so that what the device does not copy is seen.
void poison(std::span<std::byte> memory);

// The planes of a case from read-back memory, to where they belong (capture::planes_at).
void read_planes(const std::vector<Attachment>& attachments, const ReadbackLayout& layout,
                 std::span<const std::byte> memory, const capture::PlaneSpans& to);

// The stored codes of texels of the colour target, each of `step` bytes (1 to 16) from one to the
// next; kPoison four times if all of them are the fill pattern's, or one of 8 bytes or more is.
void decode_texels(cases::ColorFormat format, std::span<const std::byte> from, uint32_t step,
                   std::span<capture::ColorCodes> to);

// The hits plane's sample of an alpha (attachments.hpp): front and back hits with their guards, as
// capture/capture.hpp says. Poison stays poison; what no number of hits makes of a clear value gets
// guards that never hold.
glm::vec4 decode_hits(uint32_t bits, const HitCode& code = kBinary32Hits);
// The same of two numbers, for front and back hits.
glm::vec4 decode_hits(uint32_t front_bits, uint32_t back_bits, const HitCode& code = kBinary32Hits);

// An id that the device wrote as binary32: an integer below 2^24, -1 and -3 for 'cleared' and -2
// for 'this device has no gl_PrimitiveID'. Poison stays poison; anything else becomes kMalformedId.
uint32_t decode_id(uint32_t bits);

// A draw below `draws` and its primitive as one number, which binary32 holds below 2^24
// (target_layout sees to it):
//     (primitive + 2) * draws + draw,    draw without gl_PrimitiveID.
// What a shader writes so comes back as the draw and the primitive; what stands for no drawn number
// in decode_id, in both; a number between the two kinds is kMalformedId.
std::pair<uint32_t, uint32_t> decode_packed_id(uint32_t bits, uint32_t draws);
inline constexpr uint32_t kMalformedId = 0xffffffeeU;
inline constexpr float kClearIdAsFloat = -1.0F;
inline constexpr float kOtherClearIdAsFloat = -3.0F;

}  // namespace vk_harness
