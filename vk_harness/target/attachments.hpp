// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which attachments a case is drawn to: one list that images, pipelines, commands and read-back go
// by.
#pragma once

#include <string>
#include <vector>

#include "cases/model/case.hpp"
#include "vk_harness/device/device.hpp"
#include "vk_harness/target/target_layout.hpp"

namespace vk_harness {

enum class Role : uint8_t {
    writer_and_hits,  // draw, primitive, provoking vertex; hits
    frag_coord,
    writer,  // split: packed_id of draw and primitive, provoking vertex
    hits,
    frag_xy,
    frag_zw,
    attribute,
    attribute_zw,  // the second of a pair
    other_color,   // a colour target beside the judged one: drawn, and not looked at
    color,
    depth,
    stencil,         // the other aspect of the depth attachment's image, if there is one
    resolved_color,  // single-sampled: what `color`, `depth` and `stencil` are resolved into
    resolved_depth,
    resolved_stencil  // the other aspect of resolved_depth's image, if there is one
};

struct Attachment {
    Role role = Role::writer_and_hits;
    VkFormat format = kColorFormat;
    VkClearValue clear{};          // a value that no case can draw, capture/capture.hpp
    uint32_t texel_bytes = 16;     // of a single-sampled copy
    uint32_t sample_bytes = 16;    // of a sample in a multisampled copy: whole words
    uint32_t draws = 1;            // of the case: what packed_id goes by
    bool halves = false;           // hits, and ids beside them, are binary16
    bool is_beside_depth = false;  // a stencil in the image of the attachment before it
    cases::LoadOp load = cases::LoadOp::clear;
    cases::StoreOp store = cases::StoreOp::store;
    bool is_input = false;    // read back as an input attachment, in whole words a sample
    bool is_sampled = false;  // cases::Frame, the same by a compute shader
    bool is_depth() const { return role == Role::depth || role == Role::resolved_depth; }
    bool is_stencil() const { return role == Role::stencil || role == Role::resolved_stencil; }
    bool is_depth_stencil() const { return is_depth() || is_stencil(); }
    VkImageAspectFlags aspect() const {
        return is_stencil() ? VK_IMAGE_ASPECT_STENCIL_BIT
               : is_depth() ? VK_IMAGE_ASPECT_DEPTH_BIT
                            : VK_IMAGE_ASPECT_COLOR_BIT;
    }
    bool is_resolved() const { return role >= Role::resolved_color; }
    // Its own sample count on a target of so many samples.
    uint32_t samples_of(const cases::Target& target) const {
        return is_resolved() ? 1 : target.samples;
    }
    // Whether a shader writes it to read-back memory, in whole words, instead of a copy.
    bool has_words(uint32_t samples) const { return samples > 1 || is_input || is_sampled; }
    // Bytes of one sample in read-back memory.
    uint32_t copied_bytes(uint32_t samples) const {
        return has_words(samples) ? sample_bytes : texel_bytes;
    }
};

// How hits are counted: added to one of two clear values, each of which takes so many before the
// next begins; what is neither is no count.
struct HitCode {
    float none = 0, other_none = 0;      // cases::Variation::other_clears
    float end = 0;                       // behind the counts of other_none
    float back_hit = 0;                  // what a back hit adds where both share a number
    uint32_t most = 0, most_packed = 0;  // hits that are told apart in two numbers, in one
};

// Hits are added in binary32, which holds every integer below 2^24, to one of two clear values,
// which differ from each other, from a replaced or an uncleared value, and from no clear. In two
// numbers, of front and back hits, up to 2^22 - 1 of either kind are told apart; as the alpha of
// writer_and_hits, where a back hit adds kBackHit, up to kMaxPackedHits.
inline constexpr float kNoHits = 0x1p23F;
inline constexpr float kOtherNoHits = 0x1p23F + 0x1p22F;  // cases::Variation::other_clears
inline constexpr float kBackHit = 2048.0F;                // as shaders/capture.frag adds it
inline constexpr uint32_t kMaxPackedHits = 2047;
inline constexpr HitCode kBinary32Hits = {kNoHits,  kOtherNoHits,   0x1p24F,
                                          kBackHit, (1U << 22) - 1, kMaxPackedHits};
// The same in binary16, which holds every integer from -2048 to 2048: a replaced value (1, or a
// back hit) is no count here either, because counts are negative.
inline constexpr HitCode kBinary16Hits = {-2048.0F, -1024.0F, 0.0F, 32.0F, 1023, 31};

// In the order of shader locations: writer_and_hits, frag_coord, or writer, hits, frag_xy, frag_zw
// if the layout is split; attributes (or their pairs), colours; then depth, which has no location,
// stencil and what is resolved. Without instruments only colours, if any, and depth, if any.
std::vector<Attachment> attachments_of(const cases::Case& c, const TargetLayout& layout = {});

// How many of them are colour attachments.
uint32_t color_count(const std::vector<Attachment>& attachments);

// What a report calls attachment `k`: "depth", "attribute 1".
std::string attachment_name(const std::vector<Attachment>& attachments, size_t k);

}  // namespace vk_harness
