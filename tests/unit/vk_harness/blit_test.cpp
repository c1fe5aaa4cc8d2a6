// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Source texels as bytes: what is uploaded has the codes that the reference counts with.
#include "vk_harness/commands/blit.hpp"

#include <gtest/gtest.h>

#include "cases/format/color_format.hpp"
#include "cases/model/blit_source.hpp"
#include "vk_harness/target/readback.hpp"

namespace vk_harness {

TEST(EncodeTexels, AreReadBackAsTheSameCodesInEveryFormat) {
    for (uint32_t f = 0; f <= static_cast<uint32_t>(cases::kLastColorFormat); ++f) {
        cases::Blit blit;
        blit.source_format = static_cast<cases::ColorFormat>(f);
        if (!cases::can_be_blitted(blit.source_format)) {
            continue;
        }
        blit.source_width = 7;
        blit.source_height = 5;
        const std::vector<cases::TexelCodes> texels = cases::blit_source(blit);
        const std::vector<std::byte> bytes = encode_texels(blit.source_format, texels);
        ASSERT_EQ(bytes.size() % texels.size(), 0U);
        const size_t size = bytes.size() / texels.size();
        for (size_t n = 0; n < texels.size(); ++n) {
            EXPECT_EQ(cases::decode_texel(blit.source_format, bytes.data() + n * size), texels[n])
                << cases::name_of(blit.source_format) << " texel " << n;
        }
    }
}

// One texel by hand: the first component of R5G6B5 lies in the highest bits.
TEST(EncodeTexels, PackedFormatsByHand) {
    const std::vector<std::byte> bytes =
        encode_texels(cases::ColorFormat::r5g6b5_unorm, {{0x1f, 0x00, 0x01, 0}});
    ASSERT_EQ(bytes.size(), 2U);
    EXPECT_EQ(bytes[0], std::byte{0x01});
    EXPECT_EQ(bytes[1], std::byte{0xf8});
}

}  // namespace vk_harness
