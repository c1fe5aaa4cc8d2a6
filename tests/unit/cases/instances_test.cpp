// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws of instances: which element each reads, and what its vertices are.
#include "cases/model/instances.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/base/float_bits.hpp"
#include "cases/load/loader.hpp"

namespace cases {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Draw loaded(const std::string& draw) {
    const ExpectedAll<std::vector<Case>> all = load_text(
        "format = 1\ndescription = \"d\"\nrules = [\"cover.inside\"]\n[target]\n"
        "size = [8, 8]\n[[draw]]\n" +
            draw,
        "f", "id");
    EXPECT_TRUE(all) << (all ? "" : to_string(all.error().front()));
    return all ? all->front().draws.front() : Draw{};
}

std::vector<float> first_numbers(const std::vector<glm::vec4>& of) {
    std::vector<float> out;
    for (const glm::vec4& v : of) {
        out.push_back(v.x);
    }
    return out;
}

// "(firstInstance + ((instanceIndex - firstInstance) / divisor))", firstInstance with divisor 0
// [Vulkan specification, "Vertex Input Address Calculation"].
TEST(Instances, ReadTheElementOfTheirNumber) {
    const auto elements = [](uint32_t divisor) {
        std::vector<uint32_t> out;
        for (uint32_t i = 0; i < 5; ++i) {
            out.push_back(element_of(i, divisor));
        }
        return out;
    };
    EXPECT_THAT(elements(1), ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(elements(2), ElementsAre(0, 0, 1, 1, 2));
    EXPECT_THAT(elements(3), ElementsAre(0, 0, 0, 1, 1));
    EXPECT_THAT(elements(0), ElementsAre(0, 0, 0, 0, 0));
}

const std::string kThree = R"(vertices = [[0,0],[4,0],[0,4]]
instances = 3
first_instance = 2
offsets = [[0,0,0,0], [0.5,0,0.25,0], [0,-0.5,0,1]]
[[draw.attribute]]
values = [1, 2, 3]
[[draw.attribute]]
divisor = 1
values = [4, 5, 6]
[[draw.attribute]]
divisor = 2
values = [7, 8]
[[draw.attribute]]
divisor = 0
constant = 9
)";

TEST(Instances, HaveVerticesOfTheirOwn) {
    const Draw d = loaded(kThree);
    EXPECT_EQ(d.vertex_count(), 3U);
    EXPECT_TRUE(is_instanced(d));
    EXPECT_THAT(d.positions, ElementsAre(glm::vec4(-1, -1, 0.5, 1), glm::vec4(0, -1, 0.5, 1),
                                         glm::vec4(-1, 0, 0.5, 1), glm::vec4(-0.5, -1, 0.75, 1),
                                         glm::vec4(0.5, -1, 0.75, 1), glm::vec4(-0.5, 0, 0.75, 1),
                                         glm::vec4(-1, -1.5, 0.5, 2), glm::vec4(0, -1.5, 0.5, 2),
                                         glm::vec4(-1, -0.5, 0.5, 2)));
    EXPECT_THAT(first_numbers(d.attributes[0].values), ElementsAre(1, 2, 3, 1, 2, 3, 1, 2, 3));
    EXPECT_THAT(first_numbers(d.attributes[1].values), ElementsAre(4, 4, 4, 5, 5, 5, 6, 6, 6));
    EXPECT_THAT(first_numbers(d.attributes[2].values), ElementsAre(7, 7, 7, 7, 7, 7, 8, 8, 8));
    EXPECT_THAT(first_numbers(d.attributes[3].values), ElementsAre(9, 9, 9, 9, 9, 9, 9, 9, 9));
}

TEST(Instances, GiveBackWhatTheyRead) {
    const Draw d = loaded(kThree);
    EXPECT_THAT(base_positions(d), ElementsAre(glm::vec4(-1, -1, 0.5, 1), glm::vec4(0, -1, 0.5, 1),
                                               glm::vec4(-1, 0, 0.5, 1)));
    const auto read = [&](size_t attribute) {
        const Attribute& a = d.attributes[attribute];
        return first_numbers(elements_read(d, a.values, a.divisor));
    };
    EXPECT_THAT(read(0), ElementsAre(1, 2, 3));
    EXPECT_THAT(read(1), ElementsAre(4, 5, 6));
    EXPECT_THAT(read(2), ElementsAre(7, 8));
    EXPECT_THAT(read(3), ElementsAre(9));
    EXPECT_THAT(elements_read(d, {}, 1), IsEmpty());
}

TEST(Instances, OneOfNumberZeroIsNone) {
    EXPECT_FALSE(is_instanced(loaded("vertices = [[0,0],[4,0],[0,4]]\ninstances = 1\n")));
    EXPECT_TRUE(is_instanced(loaded("vertices = [[0,0],[4,0],[0,4]]\nfirst_instance = 1\n")));
    EXPECT_TRUE(is_instanced(
        loaded("vertices = [[0,0],[4,0],[0,4]]\n[[draw.attribute]]\ndivisor = 1\nvalues = [1]\n")));
}

// What a device computes is what the reference takes: each sum is a number of binary32.
TEST(Instances, SumsAreExactOrRefused) {
    const auto sum = [](float a, float b) {
        const std::optional<glm::vec4> all =
            offset_by(glm::vec4(a, 0, 0, 0), glm::vec4(b, 0, 0, 0));
        return all ? std::optional(all->x) : std::nullopt;
    };
    EXPECT_EQ(sum(1, 0x1p-23F), 1 + 0x1p-23F);
    EXPECT_EQ(sum(1, 0x1p-24F), std::nullopt);  // halfway between two numbers
    EXPECT_EQ(sum(1, 0x1p-60F), std::nullopt);  // lost in binary64, too
    EXPECT_EQ(sum(0x1p-60F, 1), std::nullopt);
    EXPECT_EQ(sum(0x1p60F, -0x1p60F), 0.0F);
    EXPECT_EQ(sum(0x1p-126F, -0x1p-127F), std::nullopt);    // a denormal summand
    EXPECT_EQ(sum(0x1p-126F, -0x1.8p-126F), std::nullopt);  // a denormal sum
    EXPECT_EQ(sum(std::numeric_limits<float>::quiet_NaN(), 0), std::nullopt);
    EXPECT_EQ(sum(std::numeric_limits<float>::max(), std::numeric_limits<float>::max()),
              std::nullopt);
}

}  // namespace

}  // namespace cases
