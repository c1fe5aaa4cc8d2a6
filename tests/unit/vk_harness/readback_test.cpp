// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "vk_harness/readback.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstring>

namespace vk_harness {
namespace {

uint32_t bits(float value) {
    return std::bit_cast<uint32_t>(value);
}

TEST(DecodeId, IntegersBelow2To24) {
    for (const uint32_t id : {0U, 1U, 2U, 255U, 65535U, (1U << 24) - 1}) {
        EXPECT_EQ(decode_id(bits(static_cast<float>(id))), id);
    }
}

TEST(DecodeId, MarkersAndPoison) {
    EXPECT_EQ(decode_id(bits(-1.0F)), diff::kClearId);
    EXPECT_EQ(decode_id(bits(-2.0F)), diff::kNoPrimitive);
    EXPECT_EQ(decode_id(diff::kPoison), diff::kPoison);
}

TEST(DecodeId, NothingElseLooksLikeAnId) {
    for (const float value : {0.5F, -0.0F, -3.0F, 0x1p24F, 1e30F, INFINITY, -INFINITY,
                              std::bit_cast<float>(1U), diff::kClearValue}) {
        EXPECT_EQ(decode_id(bits(value)), kMalformedId) << value;
    }
    EXPECT_TRUE(rc::check("a word is the binary32 of the id that it decodes to", [](uint32_t word) {
        const uint32_t id = decode_id(word);
        RC_ASSERT(id == kMalformedId || id == diff::kClearId || id == diff::kNoPrimitive ||
                  id == diff::kPoison || (id < (1U << 24) && bits(static_cast<float>(id)) == word));
    }));
}

TEST(Layout, AttachmentsDoNotOverlap) {
    const cases::Target target = {3, 5, 4};
    const ReadbackLayout layout = make_layout(target, 5, 100, 64);
    EXPECT_EQ(layout.color[0], 128U);
    for (size_t k = 1; k < 5; ++k) {
        EXPECT_GE(layout.color[k], layout.color[k - 1] + 60 * 16);
        EXPECT_EQ(layout.color[k] % 64, 0U);
    }
    EXPECT_GE(layout.depth, layout.color[4] + 60 * 16);
    EXPECT_GE(layout.end, layout.depth + 60 * 4);
}

TEST(ReadCapture, TakesEveryAttachmentFromItsPlace) {
    const cases::Target target = {2, 1, 1};
    const ReadbackLayout layout = make_layout(target, 4, 0, 64);
    std::vector<std::byte> memory(layout.end);
    poison(memory);
    const auto put = [&memory](VkDeviceSize offset, const std::vector<float>& values) {
        std::memcpy(memory.data() + offset, values.data(), values.size() * sizeof(float));
    };
    put(layout.color[0], {1, 2, 3, 4, 5, 6, 7, 8});
    put(layout.color[1], {0, 1, 2, -1, 3, -2, 5, -1});
    put(layout.color[2], {9, 10, 11, 12});  // the second sample is not copied
    put(layout.color[3], {13, 14, 15, 16, 17, 18, 19, 20});
    put(layout.depth, {0.25F, 0.75F});
    const diff::Capture capture = read_capture(target, 1, true, layout, memory);
    EXPECT_EQ(capture.hits[1], glm::vec4(5, 6, 7, 8));
    EXPECT_EQ(capture.writers[0], (diff::Writer{0, 1, 2, diff::kClearId}));
    EXPECT_EQ(capture.writers[1], (diff::Writer{3, diff::kNoPrimitive, 5, diff::kClearId}));
    EXPECT_EQ(capture.frag_coord[0], glm::vec4(9, 10, 11, 12));
    EXPECT_EQ(bits(capture.frag_coord[1].x), diff::kPoison);
    EXPECT_EQ(capture.attributes[0][1], glm::vec4(17, 18, 19, 20));
    EXPECT_EQ(capture.depth, (std::vector<float>{0.25F, 0.75F}));
    EXPECT_EQ(diff::sample_state(capture, 1), diff::SampleState::not_copied);
}

}  // namespace
}  // namespace vk_harness
