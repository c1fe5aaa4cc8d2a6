// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/readback.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "vk_harness/case_check.hpp"

namespace vk_harness {

namespace {

// Storage of bytes holds whatever objects were written there (C++20, implicit object creation);
// offsets are multiples of the layout's alignment. Copied once, without clearing the vector first.
template <class T>
std::vector<T> copy_out(std::span<const std::byte> memory, VkDeviceSize offset, size_t count) {
    const auto* first = reinterpret_cast<const T*>(memory.data() + offset);
    return std::vector<T>(first, first + count);
}

// Depth as the capture holds it (diff/capture.hpp). Copied texels of D16 are 2 bytes and of
// X8_D24 the low 24 bits of a word; with several samples a shader has written binary32.
void decode_depth(const cases::Target& target, std::span<const std::byte> from, float* to) {
    const size_t count = size_t{target.width} * target.height * target.samples;
    const auto* words = reinterpret_cast<const uint32_t*>(from.data());
    const auto poison_float = std::bit_cast<float>(diff::kPoison);
    if (target.depth_format == cases::DepthFormat::d32_float) {
        std::memcpy(to, words, count * sizeof(float));
        return;
    }
    if (target.samples > 1) {
        std::transform(words, words + count, to, [&](uint32_t word) {
            return word == diff::kPoison
                       ? poison_float
                       : diff::nearest_depth_code(std::bit_cast<float>(word), target.depth_format);
        });
        return;
    }
    if (target.depth_format == cases::DepthFormat::d24_unorm) {
        std::transform(words, words + count, to, [&](uint32_t word) {
            return word == diff::kPoison
                       ? poison_float
                       : diff::depth_of_code(word & 0xffffffU, cases::DepthFormat::d24_unorm);
        });
        return;
    }
    // Half of the poison is a code like any other; a copy that never happened leaves it everywhere.
    const auto* halves = reinterpret_cast<const uint16_t*>(from.data());
    const bool is_copied = !std::all_of(words, words + (count + 1) / 2,
                                        [](uint32_t word) { return word == diff::kPoison; });
    std::transform(halves, halves + count, to, [&](uint16_t code) {
        return is_copied ? diff::depth_of_code(code, cases::DepthFormat::d16_unorm) : poison_float;
    });
}

// Neighbours mostly have the same origin, so the last answer is kept.
void decode_writers(std::span<const diff::Writer> from, diff::Writer* to) {
    const auto decode = [](const diff::Writer& words) {
        return diff::Writer{decode_id(words.draw), decode_id(words.primitive),
                            decode_id(words.provoking_vertex), decode_id(words.spare)};
    };
    diff::Writer last;
    diff::Writer decoded = decode(last);
    for (const diff::Writer& writer : from) {
        if (!(writer == last)) {
            last = writer;
            decoded = decode(writer);
        }
        *to++ = decoded;
    }
}

}  // namespace

ReadbackLayout make_layout(const cases::Target& target, uint32_t color_count, VkDeviceSize begin,
                           VkDeviceSize alignment) {
    const VkDeviceSize samples = VkDeviceSize{target.width} * target.height * target.samples;
    const auto align = [alignment](VkDeviceSize offset) {
        return (offset + alignment - 1) & ~(alignment - 1);
    };
    ReadbackLayout layout;
    VkDeviceSize offset = align(begin);
    for (uint32_t attachment = 0; attachment < color_count; ++attachment) {
        layout.color[attachment] = offset;
        offset = align(offset + samples * sizeof(glm::vec4));
    }
    layout.depth = offset;
    layout.end = align(offset + samples * sizeof(float));
    return layout;
}

void poison(std::span<std::byte> memory) {
    // Mapped memory is aligned to at least 64 bytes (minMemoryMapAlignment), offsets to 4.
    auto* words = reinterpret_cast<uint32_t*>(memory.data());
    std::fill(words, words + memory.size() / sizeof(uint32_t), diff::kPoison);
}

uint32_t decode_id(uint32_t bits) {
    if (bits == diff::kPoison) {
        return diff::kPoison;
    }
    const auto value = std::bit_cast<float>(bits);
    if (value >= 0.0F && value < static_cast<float>(kMaxId)) {
        const auto id = static_cast<uint32_t>(value);
        return std::bit_cast<uint32_t>(static_cast<float>(id)) == bits ? id : kMalformedId;
    }
    if (bits == std::bit_cast<uint32_t>(kClearIdAsFloat)) {
        return diff::kClearId;
    }
    if (bits == std::bit_cast<uint32_t>(kOtherClearIdAsFloat)) {
        return diff::kOtherClearId;
    }
    return bits == std::bit_cast<uint32_t>(-2.0F) ? diff::kNoPrimitive : kMalformedId;
}

diff::Capture read_capture(const cases::Target& target, uint32_t attribute_count,
                           bool has_primitive, const ReadbackLayout& layout,
                           std::span<const std::byte> memory) {
    diff::Capture capture;
    capture.target = target;
    capture.has_primitive = has_primitive;
    capture.attribute_count = attribute_count;
    const size_t count = capture.sample_count();
    capture.hits = copy_out<glm::vec4>(memory, layout.color[0], count);
    capture.writers = copy_out<diff::Writer>(memory, layout.color[1], count);
    decode_writers(capture.writers, capture.writers.data());
    capture.frag_coord = copy_out<glm::vec4>(memory, layout.color[2], count);
    for (uint32_t k = 0; k < attribute_count; ++k) {
        capture.attributes[k] =
            copy_out<glm::vec4>(memory, layout.color[kFixedAttachments + k], count);
    }
    capture.depth.resize(count);
    decode_depth(target, memory.subspan(layout.depth), capture.depth.data());
    return capture;
}

void read_planes(const cases::Target& target, uint32_t attribute_count,
                 const ReadbackLayout& layout, std::span<const std::byte> memory,
                 std::span<std::byte> planes) {
    const size_t count = size_t{target.width} * target.height * target.samples;
    std::byte* to = planes.data();
    const auto copy = [&](VkDeviceSize offset, size_t bytes) {
        std::memcpy(to, memory.data() + offset, bytes);
        to += bytes;
    };
    copy(layout.color[0], count * sizeof(glm::vec4));
    const auto* writers = reinterpret_cast<const diff::Writer*>(memory.data() + layout.color[1]);
    decode_writers(std::span(writers, count), reinterpret_cast<diff::Writer*>(to));
    to += count * sizeof(diff::Writer);
    for (uint32_t k = 2; k < kFixedAttachments + attribute_count; ++k) {
        copy(layout.color[k], count * sizeof(glm::vec4));
    }
    decode_depth(target, memory.subspan(layout.depth), reinterpret_cast<float*>(to));
}

}  // namespace vk_harness
