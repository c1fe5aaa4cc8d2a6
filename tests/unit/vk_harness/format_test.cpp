// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The tables of formats against Vulkan's own header: its name for a row's number says where the
// row's components lie.
#include "vk_harness/device/format.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "cases/format/depth_format.hpp"

namespace vk_harness {
namespace {

// VkFormat's names by their numbers, the core ones.
std::map<uint32_t, std::string> names_in_header() {
    std::ifstream file(EDGECASE_VULKAN_INCLUDE "/vulkan/vulkan_core.h");
    const std::regex line(R"(^\s*VK_FORMAT_(\w+) = (\d+),)");
    std::map<uint32_t, std::string> names;
    for (std::string text; std::getline(file, text);) {
        std::smatch match;
        if (std::regex_search(text, match, line)) {
            names.emplace(static_cast<uint32_t>(std::stoul(match[2])), match[1]);
        }
    }
    return names;
}

// "Format Definition": components of whole bytes are named in the order of memory, those of a
// packed word from its highest bit down. Of four bytes in this order there is a packed word, too.
std::string name_from(const cases::ColorFormatRow& row) {
    std::vector<uint32_t> present;
    bool is_packed = row.word.starts_with("a8b8g8r8");
    for (uint32_t k = 0; k < 4; ++k) {
        if (row.bits[k] != 0) {
            present.push_back(k);
            is_packed = is_packed || row.bits[k] % 8 != 0;
        }
    }
    std::sort(present.begin(), present.end(), [&](uint32_t a, uint32_t b) {
        return is_packed ? row.first_bit[a] > row.first_bit[b]
                         : row.first_bit[a] < row.first_bit[b];
    });
    std::string name;
    for (const uint32_t k : present) {
        name += "RGBA"[k] + std::to_string(row.bits[k]);
    }
    switch (row.kind) {
        case cases::ComponentKind::unorm:
            name += "_UNORM";
            break;
        case cases::ComponentKind::srgb:
            name += "_SRGB";
            break;
        case cases::ComponentKind::snorm:
            name += "_SNORM";
            break;
        case cases::ComponentKind::sint:
            name += "_SINT";
            break;
        case cases::ComponentKind::half:
        case cases::ComponentKind::binary32:
            name += is_packed ? "_UFLOAT" : "_SFLOAT";
            break;
        case cases::ComponentKind::uint:
            name += "_UINT";
            break;
    }
    return is_packed ? name + "_PACK" + std::to_string(8 * bytes_of(row.format)) : name;
}

}  // namespace

TEST(Formats, VulkanHasEachRowUnderTheNameOfItsLayout) {
    std::map<uint32_t, std::string> names = names_in_header();
    ASSERT_GT(names.size(), 100U);
    for (const cases::ColorFormatRow& row : cases::kColorFormats) {
        EXPECT_EQ(names[row.vulkan], name_from(row)) << row.word;
    }
    for (const cases::DepthFormatRow& row : cases::kDepthFormats) {
        EXPECT_EQ(names[row.vulkan], row.vulkan_name) << row.word;
        EXPECT_EQ(names[row.with_stencil], row.with_stencil_name) << row.word;
    }
}

// No component reaches over a 32-bit word, and none over another.
TEST(Formats, ComponentsFillATexelWithoutOverlap) {
    for (const cases::ColorFormatRow& row : cases::kColorFormats) {
        std::vector<int> used(8 * bytes_of(row.format), 0);
        for (uint32_t k = 0; k < 4; ++k) {
            for (uint32_t bit = 0; bit < row.bits[k]; ++bit) {
                ++used.at(row.first_bit[k] + bit);
                EXPECT_EQ((row.first_bit[k] + bit) / 32, row.first_bit[k] / 32U) << row.word;
            }
        }
        EXPECT_EQ(std::count(used.begin(), used.end(), 1), static_cast<long>(used.size()))
            << row.word;
    }
}

TEST(Formats, BitsAreReadThroughAFormatOfTheSameSize) {
    EXPECT_EQ(bits_format(VK_FORMAT_R8_SNORM), VK_FORMAT_R8_UINT);
    EXPECT_EQ(bits_format(to_vulkan(cases::ColorFormat::r5g6b5_unorm)), VK_FORMAT_R16_UINT);
    EXPECT_EQ(bits_format(to_vulkan(cases::ColorFormat::rgba8_srgb)), VK_FORMAT_R32_UINT);
    EXPECT_EQ(bits_format(to_vulkan(cases::ColorFormat::rgba16_float)), VK_FORMAT_R32G32_UINT);
    EXPECT_EQ(bits_format(kTwoNumbers), VK_FORMAT_R32G32_UINT);
    EXPECT_EQ(bits_format(kColorFormat), VK_FORMAT_R32G32B32A32_UINT);
}

}  // namespace vk_harness
