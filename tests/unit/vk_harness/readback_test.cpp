// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/target/readback.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "vk_harness/case_check.hpp"
#include "vk_harness/own_samples.hpp"
#include "vk_harness/target/shader_interface.hpp"
#include "vk_harness/target/target.hpp"

namespace vk_harness {
namespace {

uint32_t bits_of(float value) {
    return std::bit_cast<uint32_t>(value);
}

TEST(DecodeId, IntegersBelow2To24) {
    for (const uint32_t id : {0U, 1U, 2U, 255U, 65535U, (1U << 24) - 1}) {
        EXPECT_EQ(decode_id(bits_of(static_cast<float>(id))), id);
    }
}

TEST(DecodeId, MarkersAndPoison) {
    EXPECT_EQ(decode_id(bits_of(-1.0F)), capture::kClearId);
    EXPECT_EQ(decode_id(bits_of(-2.0F)), capture::kNoPrimitive);
    EXPECT_EQ(decode_id(bits_of(kOtherClearIdAsFloat)), capture::kOtherClearId);
    EXPECT_EQ(decode_id(capture::kPoison), capture::kPoison);
}

TEST(DecodeId, NothingElseLooksLikeAnId) {
    for (const float value : {0.5F, -0.0F, -4.0F, 0x1p24F, 1e30F, INFINITY, -INFINITY,
                              std::bit_cast<float>(1U), capture::kClearValue}) {
        EXPECT_EQ(decode_id(bits_of(value)), kMalformedId) << value;
    }
    EXPECT_TRUE(rc::check("a word is the binary32 of the id that it decodes to", [](uint32_t word) {
        const uint32_t id = decode_id(word);
        RC_ASSERT(id == kMalformedId || id == capture::kClearId || id == capture::kOtherClearId ||
                  id == capture::kNoPrimitive || id == capture::kPoison ||
                  (id < (1U << 24) && bits_of(static_cast<float>(id)) == word));
    }));
}

TEST(ToldLocations, AreSixteenthsAlikeInEveryPixel) {
    std::vector<glm::vec4> told(8);
    for (size_t k = 0; k < told.size(); ++k) {
        told[k] = {k % 2 == 0 ? 0.25F : 0.9375F, k % 2 == 0 ? 0.0F : 0.5F, 0, 0};
    }
    EXPECT_EQ(told_locations(told, 2), (cases::SampleLocations{{4, 0}, {15, 8}}));
    for (const float wrong : {0.3125F, 0.26F, 1.0F, -0.0625F, NAN, capture::kClearValue}) {
        std::vector<glm::vec4> altered = told;
        altered.back().y = wrong;  // elsewhere in one pixel, or no location
        EXPECT_TRUE(told_locations(altered, 2).empty()) << wrong;
    }
}

TEST(DecodeHits, EveryPairOfCountsAndBothClearValues) {
    for (const float guard : {capture::kHitGuard, capture::kOtherHitGuard}) {
        const bool other = guard > capture::kHitGuard;
        for (uint32_t front = 0; front < 2048; front += front < 4 ? 1 : 511) {
            for (uint32_t back = 0; back < 2048; back += back < 4 ? 1 : 511) {
                // As the blend unit does it, hit by hit.
                float alpha = other ? kOtherNoHits : kNoHits;
                for (uint32_t k = 0; k < front; ++k) {
                    alpha += 1;
                }
                for (uint32_t k = 0; k < back; ++k) {
                    alpha += kBackHit;
                }
                const glm::vec4 hits = decode_hits(bits_of(alpha));
                EXPECT_EQ(hits.x, static_cast<float>(front));
                EXPECT_EQ(hits.y, static_cast<float>(back));
                EXPECT_EQ(hits.z, guard);
                EXPECT_EQ(hits.w, guard + static_cast<float>(front + back));
                const float none = other ? kOtherNoHits : kNoHits;
                EXPECT_EQ(decode_hits(bits_of(none + static_cast<float>(front)),
                                      bits_of(none + static_cast<float>(back))),
                          hits);
            }
        }
    }
}

// What is left where an attachment is not cleared, not blended, or cleared to something else.
TEST(DecodeHits, NothingElseLooksLikeACount) {
    EXPECT_EQ(bits_of(decode_hits(capture::kPoison).x), capture::kPoison);
    EXPECT_EQ(bits_of(decode_hits(capture::kPoison).w), capture::kPoison);
    for (const float alpha :
         {0.0F, -0.0F, 1.0F, kBackHit, capture::kHitGuard, capture::kOtherHitGuard, 2 * kNoHits,
          kNoHits - 0.5F, -kNoHits, INFINITY, -INFINITY, NAN, capture::kClearValue}) {
        const glm::vec4 hits = decode_hits(bits_of(alpha));
        EXPECT_NE(hits.z, capture::kHitGuard) << alpha;
        EXPECT_NE(hits.z, capture::kOtherHitGuard) << alpha;
        EXPECT_LT(decode_hits(bits_of(alpha), bits_of(kNoHits)).z, 0) << alpha;
        EXPECT_LT(decode_hits(bits_of(kNoHits), bits_of(alpha)).z, 0) << alpha;
    }
    EXPECT_LT(decode_hits(bits_of(kNoHits), bits_of(kOtherNoHits)).z, 0);
    EXPECT_EQ(bits_of(decode_hits(capture::kPoison, bits_of(kNoHits)).z), capture::kPoison);
}

// The same in binary16: from -2048 to 2048 it holds every integer, so these sums are its own.
TEST(DecodeHits, CountsInHalves) {
    const HitCode& code = kBinary16Hits;
    for (const float none : {code.none, code.other_none}) {
        const float guard = none < code.other_none ? capture::kHitGuard : capture::kOtherHitGuard;
        for (uint32_t front = 0; front <= code.most_packed; ++front) {
            for (uint32_t back = 0; back <= code.most_packed; ++back) {
                const auto f = static_cast<float>(front);
                const auto b = static_cast<float>(back);
                const glm::vec4 hits(f, b, guard, guard + f + b);
                EXPECT_EQ(decode_hits(bits_of(none + f + b * code.back_hit), code), hits);
            }
        }
        for (uint32_t count = 0; count <= code.most; ++count) {
            const auto n = static_cast<float>(count);
            EXPECT_EQ(decode_hits(bits_of(none + n), bits_of(none), code),
                      glm::vec4(n, 0, guard, guard + n));
        }
        // One more would count as another clear value's, or as none.
        EXPECT_NE(
            decode_hits(bits_of(none + static_cast<float>(code.most) + 1), bits_of(none), code).z,
            guard);
    }
    for (const float replaced : {1.0F, code.back_hit, 0.0F, -0.5F, -2049.0F, NAN}) {
        EXPECT_LT(decode_hits(bits_of(replaced), code).z, 0) << replaced;
    }
}

// A case of one draw with `attributes` attributes.
cases::Case target_case(cases::Target target, size_t attributes) {
    cases::Case c;
    c.target = std::move(target);
    c.draws.resize(1);
    c.draws[0].attributes.resize(attributes);
    return c;
}

TEST(Layout, AttachmentsDoNotOverlap) {
    for (const uint32_t samples : {1U, 4U}) {
        cases::Case c = target_case({3, 5, samples}, 2);
        c.target.color = {cases::ColorFormat::r5g6b5_unorm, {}};
        const std::vector<Attachment> attachments = attachments_of(c);
        ASSERT_EQ(attachments.size(), 6U);
        EXPECT_EQ(attachments[4].role, Role::color);
        EXPECT_TRUE(attachments[5].is_depth());
        const ReadbackLayout layout = make_layout(c.target, attachments, 100, 64);
        EXPECT_EQ(layout.offset[0], 128U);
        VkDeviceSize free = layout.offset[0];
        for (size_t k = 0; k < 6; ++k) {
            EXPECT_GE(layout.offset[k], free);
            EXPECT_EQ(layout.offset[k] % 64, 0U);
            const uint32_t bytes = k == 5 ? 4U : k < 4 ? 16U : samples == 1 ? 2U : 4U;
            free = layout.offset[k] + VkDeviceSize{15} * samples * bytes;
        }
        EXPECT_GE(layout.end, free);
    }
}

TEST(Attachments, WithoutInstrumentsOnlyColourAndDepthAreLeft) {
    cases::Case c = target_case({3, 5, 1}, 2);
    c.target.color = {cases::ColorFormat::r32_uint, {7, 0, 0, 0}};
    c.target.has_instruments = false;
    std::vector<Attachment> attachments = attachments_of(c);
    ASSERT_EQ(attachments.size(), 2U);
    EXPECT_EQ(attachments[0].format, VK_FORMAT_R32_UINT);
    EXPECT_EQ(attachments[0].clear.color.uint32[0], 7U);  // an integer, not the bits of a float
    EXPECT_TRUE(attachments[1].is_depth());
    c.target.has_depth = false;
    EXPECT_EQ(attachments_of(c).size(), 1U);
    EXPECT_EQ(attachment_bytes(c.target, attachments_of(c)), 3U * 5 * 4);
}

// A byte of the fill pattern is a code like any other; a plane that is all of it was not copied.
TEST(DecodeTexel, TheFillPatternIsAColorWhereOthersAreCopied) {
    std::array<uint32_t, 8> words;
    words.fill(capture::kPoison);
    const auto bytes = std::as_writable_bytes(std::span(words));
    std::vector<capture::ColorCodes> out(32);
    const auto poison = [&] {
        const uint32_t p = capture::kPoison;
        return std::ranges::count(out, capture::ColorCodes{p, p, p, p});
    };
    uint32_t number = 0;
    while (cases::name_of(static_cast<cases::ColorFormat>(number)) != "r8-unorm") {
        ++number;
    }
    const auto format = static_cast<cases::ColorFormat>(number);
    decode_texels(format, bytes, 1, out);
    EXPECT_EQ(poison(), 32);
    bytes[7] = std::byte{1};
    decode_texels(format, bytes, 1, out);
    EXPECT_EQ(poison(), 0);
    EXPECT_EQ(out[0], (capture::ColorCodes{0xad, 0, 0, 0}));
    out.resize(1);  // of a target of one pixel nobody can tell
    bytes[7] = bytes[3];
    decode_texels(format, bytes, 1, out);
    EXPECT_EQ(out[0], (capture::ColorCodes{0xad, 0, 0, 0}));
}

TEST(DecodeTexel, ComponentsInTheOrderOfTheFormat) {
    const auto decode = [](cases::ColorFormat format, std::array<uint32_t, 4> words,
                           uint32_t bytes) {
        capture::ColorCodes out{};
        decode_texels(format, std::as_bytes(std::span(words)), bytes, {&out, 1});
        return out;
    };
    using F = cases::ColorFormat;
    using Codes = capture::ColorCodes;
    EXPECT_EQ(decode(F::rgba8_unorm, {0x44332211U}, 4), (Codes{0x11, 0x22, 0x33, 0x44}));
    EXPECT_EQ(decode(F::rgba8_srgb, {0x44332211U}, 4), (Codes{0x11, 0x22, 0x33, 0x44}));
    EXPECT_EQ(decode(F::rgba8_uint, {0x44332211U}, 4), (Codes{0x11, 0x22, 0x33, 0x44}));
    EXPECT_EQ(decode(F::bgra8_unorm, {0x44332211U}, 4), (Codes{0x33, 0x22, 0x11, 0x44}));
    EXPECT_EQ(decode(F::rgb10a2_unorm, {1U | 2U << 10 | 3U << 20 | 2U << 30}, 4),
              (Codes{1, 2, 3, 2}));
    EXPECT_EQ(decode(F::r5g6b5_unorm, {31U << 11 | 33U << 5 | 2U}, 2), (Codes{31, 33, 2, 0}));
    EXPECT_EQ(decode(F::r5g6b5_unorm, {31U << 11 | 33U << 5 | 2U}, 4), (Codes{31, 33, 2, 0}));
    EXPECT_EQ(decode(F::rgba16_unorm, {0x22221111U, 0x44443333U}, 8),
              (Codes{0x1111, 0x2222, 0x3333, 0x4444}));
    EXPECT_EQ(decode(F::rgba16_float, {0x22221111U, 0x44443333U}, 8),
              (Codes{0x1111, 0x2222, 0x3333, 0x4444}));
    EXPECT_EQ(decode(F::rgba32_float, {1, 2, 3, 4}, 16), (Codes{1, 2, 3, 4}));
    EXPECT_EQ(decode(F::r32_float, {5}, 4), (Codes{5, 0, 0, 0}));
    EXPECT_EQ(decode(F::r32_uint, {5}, 4), (Codes{5, 0, 0, 0}));
    const Codes poison = {capture::kPoison, capture::kPoison, capture::kPoison, capture::kPoison};
    for (uint32_t f = 0; f <= static_cast<uint32_t>(cases::kLastColorFormat); ++f) {
        const auto bytes = static_cast<uint32_t>(cases::bytes_of(static_cast<F>(f)));
        std::vector<Codes> out(sizeof(Codes) / bytes);
        decode_texels(static_cast<F>(f), std::as_bytes(std::span(poison)), bytes, out);
        EXPECT_EQ(out, std::vector<Codes>(out.size(), poison)) << f;
    }
}

// The capture of a case from read-back memory.
capture::Capture read_capture(const cases::Target& target,
                              const std::vector<Attachment>& attachments, bool has_primitive,
                              const ReadbackLayout& layout, std::span<const std::byte> memory) {
    capture::Capture capture;
    capture.target = target;
    capture.has_primitive = has_primitive;
    capture.attribute_count = static_cast<uint32_t>(
        std::count_if(attachments.begin(), attachments.end(),
                      [](const Attachment& a) { return a.role == Role::attribute; }));
    capture::for_each_plane(
        [](const capture::Plane& plane, auto& entries) { entries.resize(plane.entries); }, capture,
        capture);
    read_planes(attachments, layout, memory, capture::PlaneSpans(capture));
    return capture;
}

TEST(ReadCapture, TakesEveryAttachmentFromItsPlace) {
    cases::Case c = target_case({2, 1, 1}, 1);
    c.target.color = {cases::ColorFormat::rgba8_unorm, {}};
    const std::vector<Attachment> attachments = attachments_of(c);
    const ReadbackLayout layout = make_layout(c.target, attachments, 0, 64);
    std::vector<std::byte> memory(layout.end);
    poison(memory);
    const auto put = [&memory](VkDeviceSize offset, const std::vector<float>& values) {
        std::memcpy(memory.data() + offset, values.data(), values.size() * sizeof(float));
    };
    put(layout.offset[0], {0, 1, 2, kNoHits + 3 + kBackHit, 3, -2, 5, kNoHits + 2 * kBackHit});
    put(layout.offset[1], {9, 10, 11, 12});  // the second sample is not copied
    put(layout.offset[2], {13, 14, 15, 16, 17, 18, 19, 20});
    memory[layout.offset[3] + 4] = std::byte{99};  // the first sample is the poison
    put(layout.offset[4], {0.25F, 0.75F});
    const capture::Capture capture = read_capture(c.target, attachments, true, layout, memory);
    EXPECT_TRUE(capture::has_all_planes(capture));
    EXPECT_EQ(capture.color[0], (capture::ColorCodes{0xad, 0xdb, 0xba, 0xff}));
    EXPECT_EQ(capture.color[1], (capture::ColorCodes{99, 0xdb, 0xba, 0xff}));
    // The same into planes one after the other.
    std::vector<glm::vec4> planes(capture::plane_bytes(c.target, 1) / sizeof(glm::vec4) + 1);
    read_planes(attachments, layout, memory,
                capture::planes_at(c.target, 1, std::as_writable_bytes(std::span(planes)).data()));
    const capture::CaptureView view =
        capture::view_planes(c.target, true, 1, std::as_bytes(std::span(planes)).data());
    EXPECT_EQ(view.color[1], capture.color[1]);
    EXPECT_EQ(view.depth[1], 0.75F);
    EXPECT_EQ(view.attributes[0][1], capture.attributes[0][1]);
    EXPECT_EQ(capture.hits[0], glm::vec4(3, 1, capture::kHitGuard, capture::kHitGuard + 4));
    EXPECT_EQ(capture.hits[1], glm::vec4(0, 2, capture::kHitGuard, capture::kHitGuard + 2));
    EXPECT_EQ(view.hits[0], capture.hits[0]);
    EXPECT_EQ(view.writers[1], capture.writers[1]);
    EXPECT_EQ(capture.writers[0], (capture::Writer{0, 1, 2, capture::kClearId}));
    EXPECT_EQ(capture.writers[1],
              (capture::Writer{3, capture::kNoPrimitive, 5, capture::kClearId}));
    EXPECT_EQ(capture.frag_coord[0], glm::vec4(9, 10, 11, 12));
    EXPECT_EQ(bits_of(capture.frag_coord[1].x), capture::kPoison);
    EXPECT_EQ(capture.attributes[0][1], glm::vec4(17, 18, 19, 20));
    EXPECT_EQ(capture.depth, (std::vector<float>{0.25F, 0.75F}));
    EXPECT_EQ(capture::sample_state(capture, 1), capture::SampleState::not_copied);
}

TEST(DecodePackedId, TellsDrawsAndPrimitivesApart) {
    using Ids = std::pair<uint32_t, uint32_t>;
    for (const uint32_t draws : {1U, 2U, 3U, 1000U}) {
        for (const uint32_t draw : {0U, draws / 2, draws - 1}) {
            EXPECT_EQ(decode_packed_id(bits_of(static_cast<float>(draw)), draws),
                      Ids(draw, capture::kNoPrimitive));
            EXPECT_EQ(decode_packed_id(bits_of(static_cast<float>(draws + draw)), draws),
                      Ids(kMalformedId, kMalformedId));
            for (const uint32_t primitive : {0U, 1U, 16'000U}) {
                const uint32_t id = (primitive + 2) * draws + draw;
                EXPECT_EQ(decode_packed_id(bits_of(static_cast<float>(id)), draws),
                          Ids(draw, primitive));
            }
        }
    }
    EXPECT_EQ(decode_packed_id(bits_of(kClearIdAsFloat), 3),
              Ids(capture::kClearId, capture::kClearId));
    EXPECT_EQ(decode_packed_id(bits_of(kOtherClearIdAsFloat), 3),
              Ids(capture::kOtherClearId, capture::kOtherClearId));
    EXPECT_EQ(decode_packed_id(capture::kPoison, 3), Ids(capture::kPoison, capture::kPoison));
    for (const float value : {-2.0F, 6.5F, 0x1p24F}) {
        EXPECT_EQ(decode_packed_id(bits_of(value), 3), Ids(kMalformedId, kMalformedId)) << value;
    }
}

// The same samples in narrow attachments: the capture is the same to the bit.
TEST(ReadCapture, NarrowAttachmentsHoldTheSame) {
    cases::Case c = target_case({3, 1, 1}, 3);
    c.draws.resize(5);
    TargetLayout narrow;
    narrow.split = true;
    narrow.components = {2, 2, 4, 4};
    TargetLayout pairs = narrow;
    pairs.pairs = true;
    const float clear = capture::kClearValue;
    // The first sample is clear, the second drawn, the third not copied.
    const std::vector<float> writers = {-1, -1, -1, kNoHits, 3, -2, 5, kNoHits + 2 * kBackHit};
    const std::vector<float> frag = {clear, clear, clear, clear, 9, 10, 11, 12};
    const std::vector<std::vector<float>> attributes = {{clear, clear, clear, clear, 7, 0, 0, 0},
                                                        {clear, clear, clear, clear, 0, 8, 0, 0},
                                                        {clear, clear, clear, clear, 1, 2, 3, 4}};
    const auto read = [&c](const TargetLayout& layout,
                           const std::vector<std::vector<float>>& words) {
        const std::vector<Attachment> attachments = attachments_of(c, layout);
        const ReadbackLayout places = make_layout(c.target, attachments, 0, 64);
        std::vector<std::byte> memory(places.end);
        poison(memory);
        for (size_t k = 0; k < words.size(); ++k) {
            std::memcpy(memory.data() + places.offset[k], words[k].data(),
                        words[k].size() * sizeof(float));
        }
        std::vector<glm::vec4> planes(capture::plane_bytes(c.target, 3) / sizeof(glm::vec4) + 1);
        read_planes(
            attachments, places, memory,
            capture::planes_at(c.target, 3, std::as_writable_bytes(std::span(planes)).data()));
        const capture::Capture capture = read_capture(c.target, attachments, true, places, memory);
        const capture::CaptureView view =
            capture::view_planes(c.target, true, 3, std::as_bytes(std::span(planes)).data());
        EXPECT_EQ(std::memcmp(view.hits.data(), capture.hits.data(), 48), 0);
        EXPECT_EQ(std::memcmp(view.writers.data(), capture.writers.data(), 48), 0);
        EXPECT_EQ(std::memcmp(view.frag_coord.data(), capture.frag_coord.data(), 48), 0);
        for (size_t a = 0; a < 3; ++a) {
            EXPECT_EQ(std::memcmp(view.attributes[a].data(), capture.attributes[a].data(), 48), 0);
        }
        return capture;
    };
    const capture::Capture wide =
        read({}, {writers, frag, attributes[0], attributes[1], attributes[2]});
    const std::vector<std::vector<float>> instruments = {{-1, -1, 3, 5},
                                                         {kNoHits, kNoHits, kNoHits, kNoHits + 2},
                                                         {clear, clear, 9, 10},
                                                         {clear, clear, 11, 12}};
    const auto with = [&instruments](std::vector<std::vector<float>> more) {
        more.insert(more.begin(), instruments.begin(), instruments.end());
        return more;
    };
    const capture::Capture split =
        read(narrow, with({{clear, clear, 7, 0}, {clear, clear, 0, 8}, attributes[2]}));
    const capture::Capture paired = read(pairs, with({{clear, clear, 7, 0},
                                                      {clear, clear, 0, 0},
                                                      {clear, clear, 0, 8},
                                                      {clear, clear, 0, 0},
                                                      {clear, clear, 1, 2},
                                                      {clear, clear, 3, 4}}));
    for (const capture::Capture& capture : {split, paired}) {
        EXPECT_EQ(std::memcmp(wide.hits.data(), capture.hits.data(), 48), 0);
        EXPECT_EQ(wide.writers, capture.writers);
        EXPECT_EQ(std::memcmp(wide.frag_coord.data(), capture.frag_coord.data(), 48), 0);
        for (size_t a = 0; a < 3; ++a) {
            EXPECT_EQ(std::memcmp(wide.attributes[a].data(), capture.attributes[a].data(), 48), 0);
        }
    }
    EXPECT_EQ(split.writers[1], (capture::Writer{3, capture::kNoPrimitive, 5, capture::kClearId}));
    EXPECT_EQ(split.hits[1], glm::vec4(0, 2, capture::kHitGuard, capture::kHitGuard + 2));
    EXPECT_EQ(split.attributes[1][1], glm::vec4(0, 8, 0, 0));
}

// Hits that were counted in binary16, in either layout: the capture is the same to the bit.
TEST(ReadCapture, HalvesHoldTheSame) {
    cases::Case c = target_case({3, 1, 1}, 0);
    c.draws.resize(5);
    const float clear = capture::kClearValue;
    const std::vector<float> frag = {clear, clear, clear, clear, 9, 10, 11, 12};
    const auto read = [&](const TargetLayout& layout,
                          const std::vector<std::vector<uint16_t>>& halves,
                          const std::vector<std::vector<float>>& words) {
        const std::vector<Attachment> attachments = attachments_of(c, layout);
        const ReadbackLayout places = make_layout(c.target, attachments, 0, 64);
        std::vector<std::byte> memory(places.end);
        poison(memory);
        for (size_t k = 0; k < attachments.size() - 1; ++k) {  // the last is depth
            std::memcpy(memory.data() + places.offset[k], halves[k].data(),
                        halves[k].size() * sizeof(uint16_t));
            std::memcpy(memory.data() + places.offset[k], words[k].data(),
                        words[k].size() * sizeof(float));
        }
        return read_capture(c.target, attachments, true, places, memory);
    };
    // The first sample is clear, the second has two hits by back faces, the third is not copied.
    const capture::Capture wide =
        read({}, {{}, {}}, {{-1, -1, -1, kNoHits, 3, -2, 5, kNoHits + 2 * kBackHit}, frag});
    TargetLayout halves;
    halves.halves = true;
    const capture::Capture packed = read(
        halves, {{0xbc00, 0xbc00, 0xbc00, 0xe800, 0x4200, 0xc000, 0x4500, 0xe7c0}, {}},  // -1984
        {{}, frag});
    TargetLayout split = halves;
    split.split = true;
    const capture::Capture apart =
        read(split, {{}, {0xe800, 0xe800, 0xe800, 0xe7fe}, {}, {}},
             {{-1, -1, 3, 5}, {}, {clear, clear, 9, 10}, {clear, clear, 11, 12}});
    for (const capture::Capture& capture : {packed, apart}) {
        EXPECT_EQ(std::memcmp(wide.hits.data(), capture.hits.data(), 48), 0);
        EXPECT_EQ(wide.writers, capture.writers);
        EXPECT_EQ(std::memcmp(wide.frag_coord.data(), capture.frag_coord.data(), 48), 0);
    }
    EXPECT_EQ(packed.hits[1], glm::vec4(0, 2, capture::kHitGuard, capture::kHitGuard + 2));
}

// Capabilities with which everything may be narrow.
Capabilities narrow_device(uint32_t attachments) {
    Capabilities c;
    c.core.dynamic_rendering = c.core.dynamic_state = true;
    c.narrow_sample_counts = VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT;
    c.info.max_color_attachments = attachments;
    return c;
}

TEST(TargetLayout, HasAsManyNumbersAsAnyVertexOfAnyDrawNeeds) {
    cases::Case c = target_case({3, 5, 1}, 2);
    c.draws.push_back(c.draws[0]);
    c.draws[0].attributes[0].values = {{1, 0, 0, 0}, {2, 0, 0, 0}};
    c.draws[1].attributes[0].values = {{1, 0, 0, 0}, {2, 0.5, 0, 0}};
    c.draws[0].attributes[1].values = {{1, 0, 0, 0}, {0, 0, -0.0F, 0}};  // -0 is not +0
    TargetLayout layout = target_layout(narrow_device(8), c);
    EXPECT_EQ(layout.components, (std::array<uint8_t, 4>{2, 4, 4, 4}));
    EXPECT_TRUE(layout.pairs);
    EXPECT_EQ(layout.attribute_format(0), kTwoNumbers);
    EXPECT_EQ(layout.attribute_format(1), kTwoNumbers);
    layout = target_layout(narrow_device(7), c);
    EXPECT_FALSE(layout.pairs);
    EXPECT_EQ(layout.components, (std::array<uint8_t, 4>{2, 4, 4, 4}));
    EXPECT_EQ(layout.attribute_format(0), kTwoNumbers);
    EXPECT_EQ(layout.attribute_format(1), kColorFormat);
    c.draws[0].attributes[1].values.clear();
    for (const cases::Source source : {cases::Source::sample_id, cases::Source::sample_mask_in,
                                       cases::Source::sample_position}) {
        c.draws[0].attributes[1].source = source;
        layout = target_layout(narrow_device(8), c);
        EXPECT_EQ(layout.attribute_format(1), kTwoNumbers);
        EXPECT_FALSE(layout.pairs);
    }
    c.draws[0].attributes[1].source = cases::Source::barycentric;
    EXPECT_TRUE(target_layout(narrow_device(8), c).pairs);
    EXPECT_EQ(target_layout(narrow_device(7), c).components[1], 4);
    // Levels of detail are two numbers, whatever the coordinates.
    c.draws[0].attributes[1] = {};
    c.draws[0].attributes[1].values = {{1, 2, 3, 4}};
    c.draws[0].attributes[1].probe = cases::Probe::lod;
    EXPECT_EQ(target_layout(narrow_device(8), c).components[1], 2);
}

TEST(TargetLayout, IsSplitWhereAllAttachmentsFit) {
    cases::Case c = target_case({3, 5, 1}, 4);
    EXPECT_TRUE(target_layout(narrow_device(8), c).split);
    EXPECT_FALSE(target_layout(narrow_device(7), c).split);
    c.target.color = {cases::ColorFormat::rgba8_unorm, {}};
    EXPECT_FALSE(target_layout(narrow_device(8), c).split);
    EXPECT_FALSE(target_layout(narrow_device(16), c).split);  // no such shader is built
    c.draws[0].attributes.pop_back();
    EXPECT_TRUE(target_layout(narrow_device(8), c).split);
    EXPECT_EQ(attachments_of(c, target_layout(narrow_device(8), c)).size(), 9U);  // and depth
    // What a push constant and binary32 hold of draws and primitives.
    c.draws.resize(0xffff, c.draws[0]);
    EXPECT_TRUE(target_layout(narrow_device(8), c).split);
    c.draws.resize(0x10000, c.draws[0]);
    EXPECT_FALSE(target_layout(narrow_device(8), c).split);
    c.draws.resize(1);
    c.draws[0].positions.resize(kMaxId - 3);
    EXPECT_TRUE(target_layout(narrow_device(8), c).split);
    c.draws[0].positions.resize(kMaxId - 2);
    EXPECT_FALSE(target_layout(narrow_device(8), c).split);
    c.draws[0].indices = std::vector<uint32_t>(kMaxId - 3);
    EXPECT_TRUE(target_layout(narrow_device(8), c).split);
    c.draws[0].indices.reset();
    c.draws[0].positions.resize(3);
    c.target.samples = 8;  // which the device has with wide formats alone
    EXPECT_EQ(target_layout(narrow_device(8), c), TargetLayout());
    c.target.samples = 1;
    c.target.has_instruments = false;
    EXPECT_EQ(target_layout(narrow_device(8), c), TargetLayout());
}

}  // namespace
}  // namespace vk_harness
