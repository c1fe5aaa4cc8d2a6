// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/target/readback.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "vk_harness/target/shader_interface.hpp"

namespace vk_harness {

namespace {

// Whether `bytes` of texels were never copied: all hold the poison. A texel of less than a poison
// may hold what a part of that is, and a few may do so by chance: they count as copied.
bool is_poison(std::span<const std::byte> from, size_t bytes) {
    constexpr size_t kFew = 16;
    constexpr auto kBytes = std::bit_cast<std::array<std::byte, 4>>(capture::kPoison);
    if (bytes < kFew) {
        return false;
    }
    for (size_t k = 0; k < bytes; ++k) {
        if (from[k] != kBytes[k % kBytes.size()]) {
            return false;
        }
    }
    return true;
}

// Depth as the capture holds it (capture/capture.hpp). Copied texels of D16 are 2 bytes and of
// X8_D24 the low 24 bits of a word; with words a shader has written binary32, which of D24 is left
// to DepthCodes.
void decode_depth(const cases::Target& target, bool has_words, std::span<const std::byte> from,
                  float* to) {
    const size_t count = size_t{target.width} * target.rows() * target.samples;
    const auto* words = reinterpret_cast<const uint32_t*>(from.data());
    const auto poison_float = std::bit_cast<float>(capture::kPoison);
    if (target.depth_format == cases::DepthFormat::d32_float ||
        (has_words && target.depth_format == cases::DepthFormat::d24_unorm)) {
        std::memcpy(to, words, count * sizeof(float));
        return;
    }
    if (has_words) {
        std::transform(words, words + count, to, [&](uint32_t word) {
            return word == capture::kPoison
                       ? poison_float
                       : cases::nearest_depth_code(std::bit_cast<float>(word), target.depth_format);
        });
        return;
    }
    if (target.depth_format == cases::DepthFormat::d24_unorm) {
        std::transform(words, words + count, to, [&](uint32_t word) {
            return word == capture::kPoison
                       ? poison_float
                       : cases::depth_of_code(word & 0xffffffU, cases::DepthFormat::d24_unorm);
        });
        return;
    }
    const auto* halves = reinterpret_cast<const uint16_t*>(from.data());
    const bool is_copied = !is_poison(from, count * sizeof(uint16_t));
    std::transform(halves, halves + count, to, [&](uint16_t code) {
        return is_copied ? cases::depth_of_code(code, cases::DepthFormat::d16_unorm) : poison_float;
    });
}

// Whether some number of hits makes this of a clear value.
bool is_hits(float sum, const HitCode& code) {
    return sum >= code.none && sum < code.end && !(std::floor(sum) < sum);
}

// Of which of the two clear values; is_hits(sum).
bool is_of_other_clear(float sum, const HitCode& code) {
    return sum >= code.other_none;
}

glm::vec4 hits_of(float front, float back, bool other) {
    const float guard = other ? capture::kOtherHitGuard : capture::kHitGuard;
    return {front, back, guard, guard + front + back};
}

// Who wrote a sample and how often. The spare word is what a clear sample of that clear
// value has, and kClearId where something was drawn (capture/capture.hpp).
struct WriterAndHits {
    capture::Writer writer;
    glm::vec4 hits;
};

// `draws`: 0 if words are draw, primitive, vertex and hits, else packed_id, vertex and either hits.
WriterAndHits decode_writer_and_hits(const std::array<uint32_t, 4>& words, uint32_t draws,
                                     const HitCode& code) {
    WriterAndHits out;
    out.hits = draws == 0 ? decode_hits(words[3], code) : decode_hits(words[2], words[3], code);
    const auto [draw, primitive] = draws == 0 ? std::pair(decode_id(words[0]), decode_id(words[1]))
                                              : decode_packed_id(words[0], draws);
    const bool is_clear = out.hits.x + out.hits.y < 1;
    const uint32_t spare = std::bit_cast<uint32_t>(out.hits.z) == capture::kPoison
                               ? capture::kPoison
                           : out.hits.z < 0                              ? kMalformedId
                           : is_clear && out.hits.z > capture::kHitGuard ? capture::kOtherClearId
                                                                         : capture::kClearId;
    out.writer = {draw, primitive, decode_id(words[draws == 0 ? 2 : 1]), spare};
    return out;
}

// A binary16 as the binary32 of the same value.
float widened(uint16_t half) {
    const uint32_t sign = (half & 0x8000U) << 16U;
    const uint32_t exponent = half >> 10U & 0x1fU;
    const uint32_t mantissa = half & 0x3ffU;
    if (exponent == 0) {
        const auto size = static_cast<float>(mantissa) * 0x1p-24F;
        return sign != 0 ? -size : size;
    }
    const uint32_t wide = exponent == 0x1f ? 0xffU : exponent + 112;
    return std::bit_cast<float>(sign | wide << 23U | mantissa << 13U);
}

// Numbers of one attachment in read-back memory, `words` a sample.
struct Words {
    const uint32_t* first = nullptr;
    uint32_t words = 4;
    bool halves = false;  // each word is a binary16; two of poison are one word of it
    uint32_t at(size_t sample, uint32_t word) const {
        if (!halves) {
            return first[sample * words + word];
        }
        const auto* numbers = reinterpret_cast<const uint16_t*>(first) + sample * words;
        const uint32_t both = uint32_t{numbers[word | 1U]} << 16U | numbers[word & ~1U];
        return both == capture::kPoison ? both : std::bit_cast<uint32_t>(widened(numbers[word]));
    }
};

// Two words of `ids` and the two of `hits` that follow or stand beside them. Neighbours mostly have
// the same origin, so the last answer is kept.
void decode_writers_and_hits(const Words& ids, const Words& hit_words, uint32_t draws, size_t count,
                             glm::vec4* hits, capture::Writer* writers) {
    const uint32_t first_hit = draws == 0 ? 2 : 0;
    const HitCode& code = hit_words.halves ? kBinary16Hits : kBinary32Hits;
    std::array<uint32_t, 4> last{};
    WriterAndHits decoded = decode_writer_and_hits(last, draws, code);
    for (size_t k = 0; k < count; ++k) {
        const std::array<uint32_t, 4> words = {
            ids.at(k, 0), ids.at(k, 1), hit_words.at(k, first_hit), hit_words.at(k, first_hit + 1)};
        if (words != last) {
            last = words;
            decoded = decode_writer_and_hits(words, draws, code);
        }
        hits[k] = decoded.hits;
        writers[k] = decoded.writer;
    }
}

// The numbers of an attribute, `second` beginning with the third of them, and zeros: a clear sample
// is clear and poison is poison in all four, and so is the number of draws without the attribute,
// which is another one where attachments are cleared to other values.
void widen(const Words& first, const Words& second, size_t count, const VkClearValue& clear,
           glm::vec4* to) {
    const auto clear_word = std::bit_cast<uint32_t>(clear.color.float32[0]);
    for (size_t k = 0; k < count; ++k) {
        glm::vec4 value(0.0F);
        bool is_clear = true;
        bool is_lacking = true;
        bool is_poison = true;
        for (uint32_t c = 0; c < first.words + second.words; ++c) {
            const uint32_t word = c < first.words ? first.at(k, c) : second.at(k, c - first.words);
            value[static_cast<int>(c)] = std::bit_cast<float>(word);
            is_clear = is_clear && word == clear_word;
            is_lacking = is_lacking && word == std::bit_cast<uint32_t>(capture::kClearValue);
            is_poison = is_poison && word == capture::kPoison;
        }
        to[k] = is_clear || is_lacking || is_poison ? glm::vec4(value.x) : value;
    }
}

// Stencil as the capture holds it: copied texels are bytes, or a shader has written words.
void decode_stencil(const cases::Target& target, bool has_words, std::span<const std::byte> from,
                    uint32_t* to) {
    const size_t count = size_t{target.width} * target.rows() * target.samples;
    const auto* words = reinterpret_cast<const uint32_t*>(from.data());
    if (has_words) {
        std::copy(words, words + count, to);
        return;
    }
    const bool is_copied = !is_poison(from, count);
    std::transform(
        from.begin(), from.begin() + static_cast<ptrdiff_t>(count), to,
        [&](std::byte b) { return is_copied ? std::to_integer<uint32_t>(b) : capture::kPoison; });
}

// The shape of what a target is resolved into.
cases::Target shape_of(const Attachment& attachment, const cases::Target& target) {
    cases::Target shape = target;
    shape.samples = attachment.samples_of(target);
    return shape;
}

}  // namespace

ReadbackLayout make_layout(const cases::Target& target, const std::vector<Attachment>& attachments,
                           VkDeviceSize begin, VkDeviceSize alignment) {
    const VkDeviceSize pixels = VkDeviceSize{target.width} * target.rows();
    const auto align = [alignment](VkDeviceSize offset) {
        return (offset + alignment - 1) & ~(alignment - 1);
    };
    ReadbackLayout layout;
    VkDeviceSize offset = align(begin);
    for (const Attachment& attachment : attachments) {
        layout.offset.push_back(offset);
        const uint32_t samples = attachment.samples_of(target);
        offset = align(offset + pixels * samples * attachment.copied_bytes(samples));
    }
    layout.end = offset;
    return layout;
}

void poison(std::span<std::byte> memory) {
    // Mapped memory is aligned to at least 64 bytes (minMemoryMapAlignment), offsets to 4.
    auto* words = reinterpret_cast<uint32_t*>(memory.data());
    std::fill(words, words + memory.size() / sizeof(uint32_t), capture::kPoison);
}

glm::vec4 decode_hits(uint32_t bits, const HitCode& code) {
    const auto sum = std::bit_cast<float>(bits);
    if (bits == capture::kPoison) {
        return glm::vec4(sum);
    }
    if (!is_hits(sum, code)) {
        return {0, 0, -1, sum};
    }
    const bool other = is_of_other_clear(sum, code);
    const float hits = sum - (other ? code.other_none : code.none);
    const float back = std::floor(hits / code.back_hit);
    return hits_of(hits - back * code.back_hit, back, other);
}

glm::vec4 decode_hits(uint32_t front_bits, uint32_t back_bits, const HitCode& code) {
    const auto front = std::bit_cast<float>(front_bits);
    const auto back = std::bit_cast<float>(back_bits);
    if (front_bits == capture::kPoison || back_bits == capture::kPoison) {
        return glm::vec4(std::bit_cast<float>(capture::kPoison));
    }
    if (!is_hits(front, code) || !is_hits(back, code) ||
        is_of_other_clear(front, code) != is_of_other_clear(back, code)) {
        return {0, 0, -1, front};
    }
    const bool other = is_of_other_clear(front, code);
    const float none = other ? code.other_none : code.none;
    return hits_of(front - none, back - none, other);
}

uint32_t decode_id(uint32_t bits) {
    if (bits == capture::kPoison) {
        return capture::kPoison;
    }
    const auto value = std::bit_cast<float>(bits);
    if (value >= 0.0F && value < static_cast<float>(kMaxId)) {
        const auto id = static_cast<uint32_t>(value);
        return std::bit_cast<uint32_t>(static_cast<float>(id)) == bits ? id : kMalformedId;
    }
    if (bits == std::bit_cast<uint32_t>(kClearIdAsFloat)) {
        return capture::kClearId;
    }
    if (bits == std::bit_cast<uint32_t>(kOtherClearIdAsFloat)) {
        return capture::kOtherClearId;
    }
    return bits == std::bit_cast<uint32_t>(-2.0F) ? capture::kNoPrimitive : kMalformedId;
}

std::pair<uint32_t, uint32_t> decode_packed_id(uint32_t bits, uint32_t draws) {
    const uint32_t id = decode_id(bits);
    if (id >= kMaxId) {
        const uint32_t both = id == capture::kNoPrimitive ? kMalformedId : id;
        return {both, both};
    }
    const uint32_t row = id / draws;
    if (row == 1) {
        return {kMalformedId, kMalformedId};
    }
    return {id % draws, row == 0 ? capture::kNoPrimitive : row - 2};
}

void decode_texels(cases::ColorFormat format, std::span<const std::byte> from, uint32_t step,
                   std::span<capture::ColorCodes> to) {
    constexpr capture::ColorCodes kPoisonWords = {capture::kPoison, capture::kPoison,
                                                  capture::kPoison, capture::kPoison};
    // Colours of 32 bits are many enough for one to be the poison.
    const bool is_wide = step >= 2 * sizeof(uint32_t);
    const bool is_lost = is_poison(from, to.size() * step);
    for (size_t k = 0; k < to.size(); ++k) {
        const std::byte* texel = from.data() + k * step;
        const bool is_lost_alone = is_wide && std::memcmp(texel, kPoisonWords.data(), step) == 0;
        to[k] = is_lost || is_lost_alone ? kPoisonWords : cases::decode_texel(format, texel);
    }
}

namespace {

// Where the planes of a capture go that are decoded together.
Words words_of(const std::vector<Attachment>& attachments, const ReadbackLayout& layout,
               std::span<const std::byte> memory, size_t attachment) {
    const Attachment& a = attachments[attachment];
    return {reinterpret_cast<const uint32_t*>(memory.data() + layout.offset[attachment]),
            a.sample_bytes / (a.halves ? 2U : 4U), a.halves};
}

// The planes that attachment k begins: hits and writers, or FragCoord.
void decode_instrument(const std::vector<Attachment>& attachments, const ReadbackLayout& layout,
                       std::span<const std::byte> memory, size_t count, size_t k,
                       const capture::PlaneSpans& to) {
    const auto words = [&](size_t attachment) {
        return words_of(attachments, layout, memory, attachment);
    };
    switch (attachments[k].role) {
        case Role::writer_and_hits:
            decode_writers_and_hits(words(k), words(k), 0, count, to.hits.data(),
                                    to.writers.data());
            break;
        case Role::writer:  // then hits
            decode_writers_and_hits(words(k), words(k + 1), attachments[k].draws, count,
                                    to.hits.data(), to.writers.data());
            break;
        case Role::frag_coord:
            std::memcpy(to.frag_coord.data(), words(k).first, count * sizeof(glm::vec4));
            break;
        case Role::frag_xy: {  // then frag_zw
            const auto* xy = reinterpret_cast<const float*>(words(k).first);
            const auto* zw = reinterpret_cast<const float*>(words(k + 1).first);
            for (size_t s = 0; s < count; ++s) {
                to.frag_coord[s] = {xy[2 * s], xy[2 * s + 1], zw[2 * s], zw[2 * s + 1]};
            }
            break;
        }
        default:
            break;
    }
}

// The plane that attachment k begins.
void decode_attribute(const std::vector<Attachment>& attachments, const ReadbackLayout& layout,
                      std::span<const std::byte> memory, size_t count, size_t k, glm::vec4* to) {
    const Words first = words_of(attachments, layout, memory, k);
    const bool is_pair =
        k + 1 < attachments.size() && attachments[k + 1].role == Role::attribute_zw;
    if (first.words == 4) {
        std::memcpy(to, first.first, count * sizeof(glm::vec4));
    } else {
        widen(first,
              is_pair ? words_of(attachments, layout, memory, k + 1) : Words{nullptr, 0, false},
              count, attachments[k].clear, to);
    }
}

}  // namespace

void read_planes(const std::vector<Attachment>& attachments, const ReadbackLayout& layout,
                 std::span<const std::byte> memory, const capture::PlaneSpans& to) {
    size_t attribute = 0;
    for (size_t k = 0; k < attachments.size(); ++k) {
        const Attachment& attachment = attachments[k];
        const cases::Target shape = shape_of(attachment, to.target);
        const auto from = memory.subspan(layout.offset[k]);
        const size_t count = size_t{shape.width} * shape.rows() * shape.samples;
        const bool has_words = attachment.has_words(shape.samples);
        switch (attachment.role) {
            case Role::attribute:
                decode_attribute(attachments, layout, memory, count, k,
                                 to.attributes.at(attribute++).data());
                break;
            case Role::other_color:
                break;
            case Role::color:
                decode_texels(shape.color->format, from, attachment.copied_bytes(shape.samples),
                              to.color.first(count));
                if (attachment.store == cases::StoreOp::dont_care) {
                    std::ranges::fill(to.color, capture::ColorCodes{});
                }
                break;
            case Role::depth:
                decode_depth(shape, has_words, from, to.depth.data());
                if (attachment.store == cases::StoreOp::dont_care) {  // each copy has other bits
                    std::ranges::fill(to.depth, to.target.depth_clear);
                }
                break;
            case Role::stencil:
                decode_stencil(shape, has_words, from, to.stencil.data());
                if (attachment.store == cases::StoreOp::dont_care) {
                    std::ranges::fill(to.stencil, to.target.stencil_clear);
                }
                break;
            case Role::resolved_color:
                decode_texels(shape.color->format, from, attachment.copied_bytes(shape.samples),
                              to.resolved_color.first(count));
                break;
            case Role::resolved_depth:
                decode_depth(shape, has_words, from, to.resolved_depth.data());
                break;
            case Role::resolved_stencil:
                decode_stencil(shape, has_words, from, to.resolved_stencil.data());
                break;
            default:
                decode_instrument(attachments, layout, memory, count, k, to);
                break;
        }
    }
}

}  // namespace vk_harness
