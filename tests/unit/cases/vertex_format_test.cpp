// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Which numbers the formats of vertices hold, and how they are written.
#include "cases/format/vertex_format.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace cases {
namespace {

using Values = std::vector<glm::vec4>;

std::string bytes(VertexFormat format, const glm::vec4& value) {
    std::array<std::byte, 16> to{};
    encode_vertex(format, value, to.data());
    std::string out(bytes_of(format), 0);
    std::memcpy(out.data(), to.data(), out.size());
    return out;
}

TEST(VertexFormat, NormalizedOnesHoldTheirEnds) {
    EXPECT_TRUE(holds(VertexFormat::rgba8_unorm, Values{{0, 1, 1, 0}}));
    EXPECT_FALSE(holds(VertexFormat::rgba8_unorm, Values{{0, 0.5F, 1, 0}}));
    EXPECT_FALSE(holds(VertexFormat::rgba8_unorm, Values{{-0.0F, 1, 1, 0}}));
    EXPECT_FALSE(holds(VertexFormat::rgba8_unorm, Values{{0, -1, 1, 0}}));
    EXPECT_TRUE(holds(VertexFormat::rgba8_snorm, Values{{0, -1, 1, 0}}));
    EXPECT_EQ(bytes(VertexFormat::rgba8_unorm, {0, 1, 1, 0}), std::string("\0\xff\xff\0", 4));
    EXPECT_EQ(bytes(VertexFormat::bgra8_unorm, {1, 0, 0, 0}), std::string("\0\0\xff\0", 4));
    EXPECT_EQ(bytes(VertexFormat::rgba8_snorm, {-1, 1, 0, 0}), std::string("\x81\x7f\0\0", 4));
    EXPECT_EQ(bytes(VertexFormat::rg16_snorm, {-1, 1, 0, 1}), std::string("\x01\x80\xff\x7f", 4));
    EXPECT_EQ(bytes(VertexFormat::rgb10a2_unorm, {0, 1, 0, 1}), std::string("\0\xfc\x0f\xc0", 4));
}

TEST(VertexFormat, ScaledOnesHoldWholeNumbers) {
    EXPECT_TRUE(holds(VertexFormat::rgba8_uscaled, Values{{0, 255, 3, 1}}));
    EXPECT_FALSE(holds(VertexFormat::rgba8_uscaled, Values{{0, 256, 3, 1}}));
    EXPECT_FALSE(holds(VertexFormat::rgba8_uscaled, Values{{0, 2.5F, 3, 1}}));
    EXPECT_TRUE(holds(VertexFormat::rgba8_sscaled, Values{{-127, 127, 3, 1}}));
    EXPECT_FALSE(holds(VertexFormat::rgba8_sscaled, Values{{-0.0F, 127, 3, 1}}));
    EXPECT_FALSE(holds(VertexFormat::rgba16_sscaled,
                       Values{{std::numeric_limits<float>::quiet_NaN(), 0, 0, 1}}));
    EXPECT_EQ(bytes(VertexFormat::rgba8_sscaled, {-2, 3, 0, 1}), std::string("\xfe\x03\0\x01", 4));
}

TEST(VertexFormat, MissingComponentsAreZeroAndOne) {
    EXPECT_TRUE(holds(VertexFormat::rg32_float, Values{{0.3F, -7, 0, 1}}));
    EXPECT_FALSE(holds(VertexFormat::rg32_float, Values{{0.3F, -7, 0, 0}}));
    EXPECT_FALSE(holds(VertexFormat::rg32_float, Values{{0.3F, -7, -0.0F, 1}}));
    EXPECT_TRUE(holds(VertexFormat::r32_float, Values{{0.3F, 0, 0, 1}}));
    EXPECT_FALSE(holds(VertexFormat::rg16_float, Values{{0.3F, 0, 0, 1}}));
    EXPECT_FALSE(holds(VertexFormat::rg32_float, Values{{1, 2, 0, 1}, {1, 2, 3, 1}}));
}

// Round and round through all that hold the numbers, and no others.
TEST(VertexFormat, EachIsChosen) {
    std::set<VertexFormat> chosen;
    for (const Values& values :
         {Values{{0, 1, 0, 1}}, Values{{-1, 1, 0, 1}}, Values{{5, 0, 0, 1}}}) {
        for (size_t salt = 0; salt < kVertexFormats.size(); ++salt) {
            const VertexFormat format = other_vertex_format(values, kAllVertexFormats, salt);
            EXPECT_TRUE(holds(format, values));
            chosen.insert(format);
        }
    }
    EXPECT_EQ(chosen.size() + 1, kVertexFormats.size());
    EXPECT_FALSE(chosen.contains(VertexFormat::rgba32_float));
    EXPECT_EQ(other_vertex_format(Values{{0.3F, 1, 2, 3}}, kAllVertexFormats, 0),
              VertexFormat::rgba32_float);
    EXPECT_EQ(other_vertex_format(Values{{0, 1, 0, 1}}, 0, 0), VertexFormat::rgba32_float);
    EXPECT_EQ(other_vertex_format(Values{}, kAllVertexFormats, 0), VertexFormat::rgba32_float);
}

}  // namespace
}  // namespace cases
