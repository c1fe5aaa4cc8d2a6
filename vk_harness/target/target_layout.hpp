// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What the device lets a case's attachments be: how wide those are that its instruments (hits,
// writer, FragCoord, attributes) are drawn to, and what a stencil lies in. A driver may compile the
// store of an attachment once a sample, and narrow ones cost it far less: lavapipe takes about 40
// ms for four numbers with four samples, under 5 ms for two.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>

#include "cases/model/case.hpp"
#include "vk_harness/device/device.hpp"

namespace vk_harness {

struct TargetLayout {
    bool split = false;  // writer, hits and FragCoord as four attachments of two numbers
    bool pairs = false;  // split: each attribute as two attachments of two numbers
    // The attachment that counts hits holds binary16: that of hits if the layout is split, else
    // writer_and_hits, whose ids are then below kMaxHalfId.
    bool halves = false;
    // Of the image that holds the stencil, and the depth if there is one; UNDEFINED: no stencil.
    VkFormat stencil_format = VK_FORMAT_UNDEFINED;
    // 2 or 4 by attribute: numbers that are drawn and read back; the others are 0 at every vertex
    // and 0 in the capture. One number costs as much as two, and would be one shader more.
    std::array<uint8_t, cases::kMaxAttributes> components = {4, 4, 4, 4};
    // Of the door state_unused: what the device has of state that can be on for nothing.
    struct Unused {
        bool bounds = false, logic = false;  // depthBounds, logicOp
        uint32_t blends = 0;  // bit k: colour k is normalized, and its format can be blended
        friend auto operator<=>(const Unused&, const Unused&) = default;
    };
    Unused unused = {};
    // Of the door exact_formats: what vertices are read in, a bit each (vertex_format.hpp).
    uint32_t vertex_formats = 0;
    // Of the door stage_unused: a fragment shader may write so many colours.
    uint32_t most_colors = 0;
    // By what the device lacks (core_support.hpp): the case is rendered by a render pass object,
    // and pipelines hold the state that Vulkan 1.0 does not set between draws.
    bool has_pass = false, holds_state = false;
    // A geometry shader names layers and viewports, which a vertex shader may not.
    bool has_geometry = false;

    // Numbers in an attribute's only attachment, or in either of its pair. 4 beyond the last
    // attribute that a case may have.
    uint32_t numbers(uint32_t attribute) const;
    VkFormat attribute_format(uint32_t attribute) const;
    // Of the attachment that counts hits.
    VkFormat hit_format() const {
        return split ? (halves ? kTwoHalves : kTwoNumbers) : (halves ? kColorHalves : kColorFormat);
    }
    uint32_t attribute_attachments() const { return pairs ? 2 : 1; }
    friend auto operator<=>(const TargetLayout&, const TargetLayout&) = default;
};

inline constexpr uint32_t kSplitAttachments = 4;   // of the instruments, without attributes
inline constexpr uint32_t kPackedAttachments = 2;  // the same where they are not split
inline constexpr uint32_t kMaxSplitAttachments =
    8;  // with attributes and colour: cmake/Shaders.cmake

// Integers up to this are exact in binary16.
inline constexpr uint32_t kMaxHalfId = 2048;

// The depth that shares an image with the stencil of a target that has one: the target's own, or
// what the device has if there is none.
cases::DepthFormat depth_beside_stencil(const Capabilities& c, const cases::Target& target);

// The narrowest layout that the device has.
TargetLayout target_layout(const Capabilities& c, const cases::Case& test);

// A sentence about why the device draws no case of this layout through the door, or draws it
// without the door as through it.
std::optional<std::string> closed_by(const TargetLayout& layout, cases::Door door);

}  // namespace vk_harness
