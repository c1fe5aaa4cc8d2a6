// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/target/attachments.hpp"

#include <algorithm>
#include <array>

#include "capture/capture.hpp"
#include "cases/format/color_format.hpp"
#include "cases/model/derive.hpp"
#include "vk_harness/device/format.hpp"
#include "vk_harness/target/readback.hpp"

namespace vk_harness {

namespace {

VkClearValue clear_color(float r, float g, float b, float a) {
    VkClearValue clear{};
    clear.color.float32[0] = r;
    clear.color.float32[1] = g;
    clear.color.float32[2] = b;
    clear.color.float32[3] = a;
    return clear;
}

VkClearValue clear_all(float value) {
    return clear_color(value, value, value, value);
}

Attachment color_attachment(const cases::ColorTarget& target) {
    Attachment out;
    out.role = Role::color;
    out.format = to_vulkan(target.format);
    out.texel_bytes = bytes_of(target.format);
    out.sample_bytes = std::max(out.texel_bytes, 4U);
    out.load = target.load;
    out.store = target.store;
    if (is_integer(target.format)) {
        for (int k = 0; k < 4; ++k) {
            out.clear.color.int32[k] = static_cast<int32_t>(target.clear[k]);
        }
    } else {
        out.clear = clear_color(target.clear.x, target.clear.y, target.clear.z, target.clear.w);
    }
    return out;
}

// What is resolved into is first cleared to something that is neither the clear value nor the same
// as any drawn value everywhere, so that a resolve that never happens does not look like an older
// one of the same case.
void append_resolved(const cases::Target& target, std::vector<Attachment>& out) {
    constexpr float kNeverResolved = 0.8125F;
    constexpr uint32_t kNeverStencil = 0x5a;
    if (capture::resolves_color(target)) {
        Attachment a = color_attachment(*target.color);
        a.role = Role::resolved_color;
        a.load = cases::LoadOp::clear;
        a.store = cases::StoreOp::store;
        if (is_integer(target.color->format)) {
            a.clear.color.uint32[0] ^= 1U;
        } else {
            a.clear = clear_all(kNeverResolved);
        }
        out.push_back(a);
    }
    const auto add_like = [&out](Role drawn, Role resolved) {
        Attachment a = *std::ranges::find(out, drawn, &Attachment::role);
        a.role = resolved;
        a.load = cases::LoadOp::clear;
        a.store = cases::StoreOp::store;
        a.clear.depthStencil = {kNeverResolved, a.clear.depthStencil.stencil ^ kNeverStencil};
        out.push_back(a);
    };
    if (capture::resolves_depth(target)) {
        add_like(Role::depth, Role::resolved_depth);
    }
    if (capture::resolves_stencil(target)) {
        add_like(Role::stencil, Role::resolved_stencil);
        out.back().is_beside_depth = capture::resolves_depth(target);
    }
}

// Whether the bits of a texel follow from what a shader reads of it: not of sRGB, of which it gets
// another number, nor of SNORM, which has two codes of -1, nor of halves, whose denormal numbers it
// may lose, nor of D24, where c / (2^24
// - 1) in binary32 may be more than half a code off: c times the rounded reciprocal 2^-24 (1 +
// 2^-23), as lavapipe computes it, makes 0.37500006 of code 6291456, whose successor is 0.37500008.
// A code of up to 16 bits is found again: what is read is within a few 2^-24 of code / largest, and
// half a code is 2^-17 or more. What is not looked at and what is resolved is copied, too.
bool can_be_input(const cases::Target& target, const Attachment& a) {
    using Kind = cases::ComponentKind;
    const auto is_code_or_binary32 = [](Kind kind) {
        return kind == Kind::unorm || kind == Kind::binary32 || kind == Kind::uint;
    };
    const bool is_wide_depth =
        a.role == Role::depth && target.depth_format == cases::DepthFormat::d24_unorm;
    return !a.is_resolved() && !a.halves && !is_wide_depth && a.role != Role::other_color &&
           (a.role != Role::color || is_code_or_binary32(row_of(target.color->format).kind));
}

}  // namespace

std::vector<Attachment> attachments_of(const cases::Case& c, const TargetLayout& layout) {
    std::vector<Attachment> out;
    const bool other = c.variation.other_clears;
    if (c.target.has_instruments) {
        const float id = other ? kOtherClearIdAsFloat : kClearIdAsFloat;
        const VkClearValue value =
            clear_all(other ? capture::kOtherClearValue : capture::kClearValue);
        const HitCode& code = layout.halves ? kBinary16Hits : kBinary32Hits;
        const float hits = other ? code.other_none : code.none;
        const uint32_t hit_bytes = layout.halves ? 2 : 4;
        if (layout.split) {
            out.push_back({Role::writer, kTwoNumbers, clear_all(id), 8, 8,
                           std::max(static_cast<uint32_t>(c.draws.size()), 1U)});
            out.push_back({Role::hits, layout.hit_format(), clear_all(hits), 2 * hit_bytes,
                           2 * hit_bytes, 1, layout.halves});
            out.push_back({Role::frag_xy, kTwoNumbers, value, 8, 8});
            out.push_back({Role::frag_zw, kTwoNumbers, value, 8, 8});
        } else {
            out.push_back({Role::writer_and_hits, layout.hit_format(),
                           clear_color(id, id, id, hits), 4 * hit_bytes, 4 * hit_bytes, 1,
                           layout.halves});
            out.push_back({Role::frag_coord, kColorFormat, value});
        }
        for (uint32_t k = 0; k < cases::attributes_of(c); ++k) {
            for (uint32_t half = 0; half < layout.attribute_attachments(); ++half) {
                const uint32_t bytes = layout.numbers(k) * 4U;
                out.push_back({half == 0 ? Role::attribute : Role::attribute_zw,
                               layout.attribute_format(k), value, bytes, bytes});
            }
        }
    }
    for (uint32_t k = 0; k < c.target.color_count(); ++k) {
        out.push_back(color_attachment(c.target.color_at(k)));
        out.back().role = k == c.target.judged_color ? Role::color : Role::other_color;
    }
    if (c.target.has_depth) {
        VkClearValue clear{};
        clear.depthStencil = {
            c.variation.other_depth_clear ? capture::kOtherClearDepth : c.target.depth_clear,
            c.target.stencil_clear};
        const VkFormat format =
            c.target.has_stencil ? layout.stencil_format : depth_format(c.target.depth_format);
        out.push_back({Role::depth, format, clear, row_of(c.target.depth_format).bytes, 4});
        if (c.target.has_stencil) {
            out.push_back({Role::stencil, format, clear, 1, 4, 1, false, true});
        }
    } else if (c.target.has_stencil) {
        VkClearValue clear{};
        clear.depthStencil.stencil = c.target.stencil_clear;
        out.push_back({Role::stencil, layout.stencil_format, clear, 1, 4});
    }
    for (Attachment& a : out) {
        if (a.role == Role::depth || a.role == Role::stencil) {
            a.load = a.is_depth() ? c.target.depth_load : c.target.stencil_load;
            a.store = a.is_depth() ? c.target.depth_store : c.target.stencil_store;
        }
    }
    append_resolved(c.target, out);
    for (Attachment& a : out) {
        a.is_sampled = c.target.frame == cases::Frame::sampled;
    }
    if (c.variation.door == cases::Door::input_attachment) {
        for (Attachment& a : out) {
            a.is_input = can_be_input(c.target, a);
        }
    }
    return out;
}

uint32_t color_count(const std::vector<Attachment>& attachments) {
    return static_cast<uint32_t>(
        std::ranges::count_if(attachments, [](const auto& a) { return a.role <= Role::color; }));
}

std::string attachment_name(const std::vector<Attachment>& attachments, size_t k) {
    // In the order of Role.
    static constexpr std::array kNames = {
        "writer and hits", "frag_coord", "writer",         "hits",           "frag_coord.xy",
        "frag_coord.zw",   "attribute ", "attribute ",     "other color ",   "color",
        "depth",           "stencil",    "resolved color", "resolved depth", "resolved stencil"};
    static_assert(kNames.size() == static_cast<size_t>(Role::resolved_stencil) + 1);
    const Role role = attachments[k].role;
    std::string name = kNames.at(static_cast<size_t>(role));
    if (role == Role::attribute || role == Role::attribute_zw || role == Role::other_color) {
        name += std::to_string(
            std::count_if(attachments.begin(), attachments.begin() + static_cast<ptrdiff_t>(k),
                          [role](const Attachment& a) { return a.role == role; }));
        name += role == Role::attribute_zw ? ".zw" : "";
    }
    return name;
}

}  // namespace vk_harness
